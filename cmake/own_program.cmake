# SPDX-License-Identifier: MIT
# Everything that one of our own programs, libraries or tests gets on top of the sphmbs targets.
# All of them get the same processor flags: Eigen's alignment is part of the binary interface.
function(sphmbs_own_program target)
  sphmbs_warnings(${target})
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF)
  if(NOT CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang")
    return()
  endif()
  if(SPHMBS_NATIVE)
    target_compile_options(${target} PRIVATE -march=native)
  endif()
  if(SPHMBS_VECTOR_WIDTH)
    target_compile_options(${target} PRIVATE -mprefer-vector-width=${SPHMBS_VECTOR_WIDTH})
  endif()
  if(SPHMBS_SANITIZE)
    list(JOIN SPHMBS_SANITIZE "," sanitizers)
    target_compile_options(${target} PRIVATE
      -fsanitize=${sanitizers} -fno-sanitize-recover=all -fno-omit-frame-pointer)
    target_link_options(${target} PRIVATE -fsanitize=${sanitizers})
  endif()
endfunction()

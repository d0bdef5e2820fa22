# SPDX-License-Identifier: MIT
# Warnings of the programs and tests of this repository; users of the library never see them.
function(sphmbs_warnings target)
  if(CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang")
    target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wconversion -Wshadow
      $<$<BOOL:${SPHMBS_WERROR}>:-Werror>)
    # Clang sees GCC's library use what it has deprecated itself.
    if(CMAKE_CXX_COMPILER_ID MATCHES "Clang")
      target_compile_options(${target} PRIVATE -Wno-deprecated-declarations)
    endif()
    # GCC 12 warns wrongly of overlapping memory in any "text" + std::string (its bug 105651), and of
    # uninitialised or short memory inside its own AVX-512 intrinsics, which Eigen uses (bug 105593).
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
      target_compile_options(${target} PRIVATE
        -Wno-restrict -Wno-uninitialized -Wno-maybe-uninitialized -Wno-array-bounds)
    endif()
  endif()
endfunction()

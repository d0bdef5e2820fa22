# SPDX-License-Identifier: MIT
# Device policies. Used by the build and by the installed package:
#   sphmbs_offload(openacc|omp_target|cuda)
# adds sphmbs::<policy>, the library with the compiler flags of execution::OpenACC, OpenMPTarget or
# Cuda, where this compiler can build and link for it; else it says in one line why not. A program
# links one of them instead of sphmbs::sphmbs, and all its files the same one.
include(CheckCXXSourceCompiles)

set(SPHMBS_OMP_DEVICE "nvptx64-nvidia-cuda" CACHE STRING
  "Offload target of Clang; x86_64-pc-linux-gnu makes virtual devices of the host")
set(SPHMBS_GPU_ARCH "sm_80" CACHE STRING "Architecture of the GPU that Clang and nvcc compile for")
mark_as_advanced(SPHMBS_OMP_DEVICE SPHMBS_GPU_ARCH)

function(sphmbs_offload policy)
  if(TARGET sphmbs::${policy})
    return()
  endif()
  # GCC hands device code to nvptx-tools, and needs libm of the device. It knows GPUs up to sm_80; the
  # driver compiles its code for newer ones.
  set(nvptx -foffload=nvptx-none
    -foffload-options=nvptx-none=-misa=sm_80 -foffload-options=nvptx-none=-lm
    -foffload-options=nvptx-none=-latomic -foffload-options=nvptx-none=-fcf-protection=none -no-pie)
  set(loop "#pragma acc parallel loop gang vector reduction(+:s)")
  # GCC registers device code of every program with its runtime, which linkers leave out where nothing
  # else calls it.
  set(link -Wl,--push-state,--no-as-needed,-lgomp,--pop-state)
  set(definitions "")
  if(policy STREQUAL "cuda")
    _sphmbs_cuda()
    return()
  elseif(policy STREQUAL "openacc")
    set(flags -fopenacc ${nvptx})
    set(needs "GCC with its offload compiler (Debian: gcc-12-offload-nvptx)")
    if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
      message(STATUS "sphmbs: no policy openacc: it needs ${needs}")
      return()
    endif()
  elseif(policy STREQUAL "omp_target")
    set(loop "#pragma omp target teams distribute parallel for simd reduction(+:s) map(tofrom:s)")
    set(definitions SPHMBS_OMP_TARGET=1)  # 0 where devices are not GPUs of NVIDIA
    if(CMAKE_CXX_COMPILER_ID MATCHES "Clang")
      execute_process(COMMAND ${CMAKE_CXX_COMPILER} -print-resource-dir
        OUTPUT_VARIABLE resources OUTPUT_STRIP_TRAILING_WHITESPACE)
      get_filename_component(runtime "${resources}/../.." ABSOLUTE)
      set(flags -fopenmp -fopenmp-targets=${SPHMBS_OMP_DEVICE} -Wno-pass-failed)
      if(NOT SPHMBS_OMP_DEVICE MATCHES "nvptx")
        set(definitions SPHMBS_OMP_TARGET=0)
      else()
        _sphmbs_check_ptxas()
        # Leaves out Clang's <complex> for devices, which contradicts that of GCC's library.
        list(APPEND definitions _LIBCPP_COMPLEX)
        list(APPEND flags --offload-arch=${SPHMBS_GPU_ARCH} --libomptarget-nvptx-bc-path=${runtime})
      endif()
      set(link -Wl,-rpath,${runtime})
      set(needs "libomp and clang-tools of the compiler's version, and CUDA's ptxas for nvptx")
    else()
      # Functions that GCC's simd loops call keep their arrays in a stack of its own, of 128 bytes
      # unless told, and run over it in silence.
      set(flags -fopenmp ${nvptx} -foffload-options=nvptx-none=-msoft-stack-reserve-local=512)
      set(needs "GCC's offload compiler (Debian: gcc-12-offload-nvptx)")
    endif()
  else()
    message(FATAL_ERROR "sphmbs_offload(${policy}): must be openacc, omp_target or cuda")
  endif()

  # Linked too: GCC makes device code when it links.
  list(JOIN flags " " CMAKE_REQUIRED_FLAGS)
  set(CMAKE_REQUIRED_LINK_OPTIONS ${link})
  set(CMAKE_REQUIRED_QUIET ON)
  string(MAKE_C_IDENTIFIER "SPHMBS_CAN_${policy}_${flags}" can)
  check_cxx_source_compiles("#include <cmath>
int main() {
  double s = 0;
${loop}
  for (int i = 0; i < 9; ++i) s += ::sqrt(1.0 * i);
  return s < 0;
}" ${can})
  if(NOT ${can})
    unset(${can} CACHE)  # tried again when the compiler may be there
    message(STATUS "sphmbs: no policy ${policy}: it needs ${needs}")
    return()
  endif()
  add_library(sphmbs::${policy} INTERFACE IMPORTED)
  target_link_libraries(sphmbs::${policy} INTERFACE sphmbs::headers)
  # Device code of unoptimised programs overflows the device's stack.
  target_compile_options(sphmbs::${policy} INTERFACE ${flags} -O3 -fno-math-errno)
  target_link_options(sphmbs::${policy} INTERFACE ${flags} -O3 ${link})
  target_compile_definitions(sphmbs::${policy} INTERFACE ${definitions})
endfunction()

# Images by CUDA 13's assembler have another layout, which Clang before 22 does not recognise when a
# program starts: it finds no device (LLVM issue 159088).
function(_sphmbs_check_ptxas)
  find_program(SPHMBS_PTXAS ptxas HINTS /usr/local/cuda/bin)
  mark_as_advanced(SPHMBS_PTXAS)
  if(NOT SPHMBS_PTXAS OR CMAKE_CXX_COMPILER_VERSION VERSION_GREATER_EQUAL 22)
    return()
  endif()
  execute_process(COMMAND ${SPHMBS_PTXAS} --version OUTPUT_VARIABLE version ERROR_QUIET)
  if(version MATCHES "release ([0-9]+)" AND CMAKE_MATCH_1 GREATER_EQUAL 13)
    message(STATUS "sphmbs: omp_target: Clang ${CMAKE_CXX_COMPILER_VERSION} may not find GPUs with "
      "code by ptxas of CUDA ${CMAKE_MATCH_1}; ptxas of CUDA 12 is safe")
  endif()
endfunction()

# Sources of programs that link sphmbs::cuda have the language CUDA.
function(_sphmbs_cuda)
  get_property(languages GLOBAL PROPERTY ENABLED_LANGUAGES)
  if(NOT "CUDA" IN_LIST languages)
    message(STATUS "sphmbs: no policy cuda: it needs nvcc of CUDA 12 or later, and enable_language(CUDA)")
    return()
  endif()
  add_library(sphmbs::cuda INTERFACE IMPORTED)
  target_link_libraries(sphmbs::cuda INTERFACE sphmbs::headers)
  # By its flag: CMake 3.25 does not know what nvcc 13 can. 1675: pragmas of GCC.
  target_compile_options(sphmbs::cuda INTERFACE $<$<COMPILE_LANGUAGE:CUDA>:-std=c++20 -O3
    --expt-relaxed-constexpr -diag-suppress=1675 -Xcompiler=-fno-math-errno>)
  target_compile_definitions(sphmbs::cuda INTERFACE EIGEN_NO_CUDA)  # Eigen stays on the host
endfunction()

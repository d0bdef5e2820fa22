# SPDX-License-Identifier: MIT
# What a user may choose. A project that embeds sphmbs gets the library and nothing else.
option(SPHMBS_BUILD_TESTS "Build the tests" ${PROJECT_IS_TOP_LEVEL})
option(SPHMBS_BUILD_EXAMPLES "Build the example programs" ${PROJECT_IS_TOP_LEVEL})
option(SPHMBS_BUILD_BENCH "Build the benchmarks" ${PROJECT_IS_TOP_LEVEL})
option(SPHMBS_INSTALL "Create the install rules" ${PROJECT_IS_TOP_LEVEL})
option(SPHMBS_REQUIRE_ALL "Stop when a package of an enabled part is missing" OFF)

# The options below act on the programs of this repository, never on the sphmbs targets.
option(SPHMBS_NATIVE "Compile for the processor of this computer" ${PROJECT_IS_TOP_LEVEL})
option(SPHMBS_WERROR "Treat warnings as errors" OFF)
set(SPHMBS_VECTOR_WIDTH "" CACHE STRING "Bits for -mprefer-vector-width, empty: the compiler's own")
option(SPHMBS_FLOAT "All examples of gas with fields of float too (--precision)" OFF)
set(SPHMBS_OFFLOAD "" CACHE STRING "Device policy: openacc, omp_target or cuda; empty: none")
set_property(CACHE SPHMBS_OFFLOAD PROPERTY STRINGS "" openacc omp_target cuda)
option(SPHMBS_FUZZ "Build the fuzz targets of the readers, with Clang" OFF)
option(SPHMBS_COVERAGE "Count which lines the tests run, for gcov" OFF)
set(SPHMBS_SANITIZE "" CACHE STRING "Sanitizers as a list, for example address;undefined")

get_property(is_multi_config GLOBAL PROPERTY GENERATOR_IS_MULTI_CONFIG)
if(PROJECT_IS_TOP_LEVEL AND NOT is_multi_config AND NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Debug, Release, RelWithDebInfo or MinSizeRel" FORCE)
elseif(NOT is_multi_config AND NOT CMAKE_BUILD_TYPE)
  message(WARNING "sphmbs: CMAKE_BUILD_TYPE is empty, so nothing is optimised and simulations take "
    "about a hundred times as long; configure with -DCMAKE_BUILD_TYPE=Release")
endif()

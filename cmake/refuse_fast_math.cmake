# SPDX-License-Identifier: MIT
# Used by the build and by the installed package: finite-math flags compile away every NaN guard.
string(TOUPPER "${CMAKE_BUILD_TYPE}" sphmbs_build_type)
get_directory_property(sphmbs_directory_options COMPILE_OPTIONS)
set(sphmbs_all_flags "${CMAKE_CXX_FLAGS} ${sphmbs_directory_options}")
if(sphmbs_build_type)
  string(APPEND sphmbs_all_flags " ${CMAKE_CXX_FLAGS_${sphmbs_build_type}}")
endif()
if(sphmbs_all_flags MATCHES "(^|[ ;])(-ffast-math|-Ofast|-ffinite-math-only|-ffp-model=fast)($|[ ;])")
  message(FATAL_ERROR
    "sphmbs refuses ${CMAKE_MATCH_2} in the compiler flags because it removes the checks for NaN; "
    "the pair loop is vectorised without it.")
endif()

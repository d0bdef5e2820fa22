# SPDX-License-Identifier: MIT
# sphmbs::suitesparse: the sparse solvers of SuiteSparse as policies, where the package is installed.
# Used by the build and by the installed package.
find_path(SPHMBS_SUITESPARSE_INCLUDE klu.h PATH_SUFFIXES suitesparse)
set(suitesparse_libraries)
foreach(name IN ITEMS klu umfpack btf amd colamd cholmod suitesparseconfig)
  find_library(SPHMBS_${name}_LIBRARY ${name})
  mark_as_advanced(SPHMBS_${name}_LIBRARY)
  list(APPEND suitesparse_libraries ${SPHMBS_${name}_LIBRARY})
endforeach()
mark_as_advanced(SPHMBS_SUITESPARSE_INCLUDE)
if(SPHMBS_SUITESPARSE_INCLUDE AND NOT "${suitesparse_libraries}" MATCHES "NOTFOUND"
   AND NOT TARGET sphmbs::suitesparse)
  add_library(sphmbs::suitesparse INTERFACE IMPORTED GLOBAL)
  target_include_directories(sphmbs::suitesparse SYSTEM INTERFACE ${SPHMBS_SUITESPARSE_INCLUDE})
  target_link_libraries(sphmbs::suitesparse INTERFACE sphmbs::sphmbs ${suitesparse_libraries})
endif()

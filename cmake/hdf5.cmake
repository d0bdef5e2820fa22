# SPDX-License-Identifier: MIT
# sphmbs::hdf5: time series in HDF5 files, where its C library is installed. Used by the build and by
# the installed package.
find_path(SPHMBS_HDF5_INCLUDE hdf5.h PATH_SUFFIXES hdf5/serial)
find_library(SPHMBS_HDF5_LIBRARY NAMES hdf5_serial hdf5)
mark_as_advanced(SPHMBS_HDF5_INCLUDE SPHMBS_HDF5_LIBRARY)
set(hdf5_parallel)
if(EXISTS "${SPHMBS_HDF5_INCLUDE}/H5pubconf.h")
  # Headers for MPI do not compile without it.
  file(STRINGS ${SPHMBS_HDF5_INCLUDE}/H5pubconf.h hdf5_parallel REGEX "define H5_HAVE_PARALLEL 1")
endif()
if(SPHMBS_HDF5_INCLUDE AND SPHMBS_HDF5_LIBRARY AND NOT hdf5_parallel AND NOT TARGET sphmbs::hdf5)
  add_library(sphmbs::hdf5 INTERFACE IMPORTED GLOBAL)
  target_include_directories(sphmbs::hdf5 SYSTEM INTERFACE ${SPHMBS_HDF5_INCLUDE})
  target_link_libraries(sphmbs::hdf5 INTERFACE sphmbs::sphmbs ${SPHMBS_HDF5_LIBRARY})
endif()

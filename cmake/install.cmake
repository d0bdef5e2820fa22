# SPDX-License-Identifier: MIT
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)

# Headers only, so nothing depends on the architecture and the package lives below share/.
set(package_dir ${CMAKE_INSTALL_DATADIR}/cmake/sphmbs)
set(package_build_dir ${CMAKE_CURRENT_BINARY_DIR}/package)

install(DIRECTORY include/sphmbs DESTINATION include FILES_MATCHING PATTERN "*.hpp")
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/sphmbs)

install(TARGETS sphmbs sphmbs_headers sphmbs_native sphmbs_io EXPORT sphmbsTargets)
install(EXPORT sphmbsTargets NAMESPACE sphmbs:: DESTINATION ${package_dir})

configure_package_config_file(cmake/sphmbsConfig.cmake.in ${package_build_dir}/sphmbsConfig.cmake
  INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${package_build_dir}/sphmbsConfigVersion.cmake
  COMPATIBILITY SameMinorVersion ARCH_INDEPENDENT)
install(FILES
  ${package_build_dir}/sphmbsConfig.cmake
  ${package_build_dir}/sphmbsConfigVersion.cmake
  cmake/hdf5.cmake
  cmake/offload.cmake
  cmake/refuse_fast_math.cmake
  cmake/suitesparse.cmake
  DESTINATION ${package_dir})

configure_file(cmake/sphmbs.pc.in ${package_build_dir}/sphmbs.pc @ONLY)
install(FILES ${package_build_dir}/sphmbs.pc DESTINATION ${CMAKE_INSTALL_DATADIR}/pkgconfig)

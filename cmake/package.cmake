# SPDX-License-Identifier: MIT
# cpack -G DEB: the package libsphmbs-dev. Nothing is compiled for it.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "sphmbs contributors")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_DEBIAN_PACKAGE_NAME libsphmbs-dev)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "libeigen3-dev (>= 3.4), g++ (>= 4:12)")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "libhdf5-dev, libsuitesparse-dev, pkg-config, cmake")
include(CPack)

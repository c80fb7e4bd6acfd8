# `cpack` in the build directory (scripts/package.sh) makes a package for Debian.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME pseudorigid)
set(CPACK_PACKAGE_VENDOR "the pseudorigid authors")
set(CPACK_PACKAGE_CONTACT "the pseudorigid authors")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "elastic ball and its pseudo-rigid reduction")
set(CPACK_PACKAGE_DESCRIPTION
"Runs one scene with two models of the same ball, the elastic continuum by finite
elements of high order and the pseudo-rigid body, whose motions are affine, and
says where and by how much they differ.")
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
# The libraries are those that dpkg-shlibdeps finds.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "libopenblas0-serial")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "openmpi-bin, python3, python3-matplotlib, python3-vtk9, paraview")
include(CPack)

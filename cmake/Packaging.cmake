# `cpack` in the build directory (scripts/package.sh) makes two packages for Debian: pseudorigid, what people run, and
# pseudorigid-dev, the library.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME pseudorigid)
set(CPACK_PACKAGE_VENDOR "the pseudorigid authors")
set(CPACK_PACKAGE_CONTACT "the pseudorigid authors")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "elastic ball and its pseudo-rigid reduction")
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)

set(CPACK_COMPONENTS_ALL development)
if(PSEUDORIGID_PROGRAM)
  list(PREPEND CPACK_COMPONENTS_ALL program)
endif()
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME pseudorigid)
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION
"Runs one scene with two models of the same ball, the elastic continuum by finite
elements of high order and the pseudo-rigid body, whose motions are affine, and
says where and by how much they differ.")
# The libraries are those that dpkg-shlibdeps finds. The Python package needs numpy, and reads
# pictures with meshio; matplotlib draws curves, VTK bodies.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "libopenblas0-serial")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "openmpi-bin, python3, python3-numpy, python3-pandas, python3-meshio, python3-matplotlib, python3-pil, python3-vtk9, paraview")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/cmake/install/prerm)

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME pseudorigid-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION
"The library of pseudorigid: mechanical systems with constraints, integrators,
material laws and the pseudo-rigid body, for find_package(pseudorigid) of CMake.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "libeigen3-dev (>= 3.4)")
include(CPack)

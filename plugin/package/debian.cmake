# SPDX-License-Identifier: BSD-3-Clause
# A Debian package of the program, the library and its headers:
# cmake --preset deb && cmake --build --preset deb --target package
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME colmap-curvix)
set(CURVIX_PACKAGE_MAINTAINER "The colmap_curvix authors"
    CACHE STRING "Who answers for the package: Name <address>")
set(CPACK_PACKAGE_CONTACT ${CURVIX_PACKAGE_MAINTAINER})
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY ${PROJECT_DESCRIPTION})
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION
    "Turns photographs and their COLMAP model into the edges that they show, as
curves in space: lines for MeshLab and Blender, lines, arcs and splines for
CAD, and a page for the browser. Holds the program, its library and headers.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS
    ${CMAKE_LIBRARY_OUTPUT_DIRECTORY})
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS colmap)
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "blender, freecad, libeigen3-dev")
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_CURRENT_LIST_DIR}/as_debian_wants.cmake)
include(CPack)

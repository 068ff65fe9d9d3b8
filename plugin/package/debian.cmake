# SPDX-License-Identifier: BSD-3-Clause
# Debian packages: colmap-curvix of the program, the library and its headers,
# and python3-curvix, if pycurvix is built.
# cmake --preset deb && cmake --build --preset deb --target package
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME colmap-curvix)
set(CURVIX_PACKAGE_MAINTAINER "The colmap_curvix authors"
    CACHE STRING "Who answers for the package: Name <address>")
set(CPACK_PACKAGE_CONTACT ${CURVIX_PACKAGE_MAINTAINER})
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY ${PROJECT_DESCRIPTION})
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS
    ${CMAKE_LIBRARY_OUTPUT_DIRECTORY})

set(CPACK_COMPONENTS_ALL program)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME colmap-curvix)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION
    "Turns photographs and their COLMAP model into the edges that they show, as
curves in space: lines for MeshLab and Blender, lines, arcs and splines for
CAD, and a page for the browser. Holds the program, its library and headers.")
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS colmap)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "blender, freecad, libeigen3-dev, python3-curvix")

if(TARGET pycurvix)
  list(APPEND CPACK_COMPONENTS_ALL python)
  # A compiled module is for one minor version of Python.
  math(EXPR next_minor "${Python_VERSION_MINOR} + 1")
  string(JOIN ", " CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
         "colmap-curvix (= ${PROJECT_VERSION})" python3-numpy
         "python3 (>= ${Python_VERSION_MAJOR}.${Python_VERSION_MINOR})"
         "python3 (<< ${Python_VERSION_MAJOR}.${next_minor})")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-curvix)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS python3-matplotlib)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA
      ${CMAKE_CURRENT_LIST_DIR}/python/postinst
      ${CMAKE_CURRENT_LIST_DIR}/python/prerm)
  set(CPACK_COMPONENT_PYTHON_DESCRIPTION
      "The module pycurvix for Python: runs of colmap_curvix, scenes from COLMAP's
models or from arrays, and their curves as NumPy arrays.")
endif()
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_CURRENT_LIST_DIR}/as_debian_wants.cmake)
include(CPack)

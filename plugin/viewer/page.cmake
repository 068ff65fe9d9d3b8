# SPDX-License-Identifier: BSD-3-Clause
# The page of the viewer, with three.js in it, becomes a string of the program.
find_path(THREE_JS_DIR three.min.js PATHS /usr/share/javascript/three)
if(NOT THREE_JS_DIR)
  message(
    FATAL_ERROR
      "three.js is missing, which draws the viewer. Install libjs-three, or set "
      "THREE_JS_DIR to a folder with three.min.js and examples/js of r111.")
endif()
foreach(script IN ITEMS three.min examples/js/controls/OrbitControls
                        examples/js/lines/LineMaterial
                        examples/js/lines/LineSegmentsGeometry
                        examples/js/lines/LineSegments2)
  file(READ ${THREE_JS_DIR}/${script}.js text)
  string(APPEND THREE_SCRIPTS "<script>\n${text}</script>\n")
endforeach()
file(READ ${CMAKE_CURRENT_LIST_DIR}/LICENSE.three THREE_LICENSE)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS
                                       ${CMAKE_CURRENT_LIST_DIR}/measure.js)
file(READ ${CMAKE_CURRENT_LIST_DIR}/measure.js MEASURE_SCRIPT)
configure_file(${CMAKE_CURRENT_LIST_DIR}/viewer.html viewer.html @ONLY)
file(READ ${CMAKE_CURRENT_BINARY_DIR}/viewer.html CURVIX_VIEWER_PAGE)
configure_file(${CMAKE_CURRENT_LIST_DIR}/page.cc.template viewer_template.cc
               @ONLY)

# SPDX-License-Identifier: BSD-3-Clause
# cmake -D BUILD_DIR=... -D WORK_DIR=... -P public_api_test.cmake
# Installs BUILD_DIR below WORK_DIR, builds an example against it, runs both.
# FLAGS go to the compiler.
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "failed (${status}): ${ARGV}")
  endif()
endfunction()

set(prefix ${WORK_DIR}/prefix)
set(project ${WORK_DIR}/project)
file(REMOVE_RECURSE ${WORK_DIR})
run(${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${prefix})
# Moved: nothing may remember where it was installed.
file(RENAME ${prefix} ${WORK_DIR}/moved)
run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR}/public_api -B ${project}
    -D CMAKE_PREFIX_PATH=${WORK_DIR}/moved -D CMAKE_CXX_COMPILER=${COMPILER}
    -D CMAKE_CXX_FLAGS=${FLAGS})
run(${CMAKE_COMMAND} --build ${project})
run(${WORK_DIR}/moved/bin/colmap_curvix synthesize --solid block
    --num_views 12 --width 160 --height 160
    --workspace_path ${WORK_DIR}/workspace)
run(${project}/public_api ${WORK_DIR}/workspace ${WORK_DIR}/curves.ply)

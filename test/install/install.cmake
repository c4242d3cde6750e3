# SPDX-License-Identifier: BSD-3-Clause
# cmake -DBUILD=... -DSOURCE=... -DSCRATCH=... (and the compilers) -P install.cmake
function(step title)
  message(STATUS "${title}")
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${title}: failed (${status})")
  endif()
endfunction()

file(REMOVE_RECURSE ${SCRATCH})
file(MAKE_DIRECTORY ${SCRATCH})
step("install" ${CMAKE_COMMAND} --install ${BUILD} --prefix ${SCRATCH}/prefix)
step("harmos --version" ${SCRATCH}/prefix/bin/harmos --version)
step("harmos-plot --help" ${SCRATCH}/prefix/bin/harmos-plot --help)
step("configure the host application" ${CMAKE_COMMAND} -S ${SOURCE} -B ${SCRATCH}/build -G ${GENERATOR}
  -DCMAKE_PREFIX_PATH=${SCRATCH}/prefix -DCMAKE_BUILD_TYPE=${BUILD_TYPE}
  -DCMAKE_C_COMPILER=${CC} -DCMAKE_CXX_COMPILER=${CXX} -DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER}
  -DCMAKE_CXX_FLAGS=${FLAGS} -DCMAKE_CXX_FLAGS_RELEASE=${FLAGS_RELEASE})
step("build it" ${CMAKE_COMMAND} --build ${SCRATCH}/build)
foreach(ranks 1 2 4)
  execute_process(COMMAND ${MPIEXEC} ${ranks} ${SCRATCH}/build/host_application RESULT_VARIABLE status OUTPUT_VARIABLE said)
  message(STATUS "run it on ${ranks}:\n${said}")
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "run it on ${ranks}: failed (${status})")
  endif()
  string(REGEX MATCH "contact impulse[^\n]*" impulse "${said}")
  if(ranks EQUAL 1)
    set(first "${impulse}")
  elseif(NOT impulse STREQUAL first OR impulse STREQUAL "")
    message(FATAL_ERROR "on ${ranks} ranks: ${impulse}; on 1: ${first}")
  endif()
endforeach()

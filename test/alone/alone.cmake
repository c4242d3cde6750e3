# SPDX-License-Identifier: BSD-3-Clause
# cmake -DROOT=... -DSCRATCH=... (and the compilers) -P alone.cmake
function(step title)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE said ERROR_VARIABLE said)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${title}: failed (${status})\n${said}")
  endif()
  message(STATUS "${title}")
endfunction()

file(REMOVE_RECURSE ${SCRATCH})
file(GLOB packages ${ROOT}/packages/*)
foreach(folder IN LISTS packages)
  get_filename_component(name ${folder} NAME)
  step("configure ${name}" ${CMAKE_COMMAND} -S ${folder} -B ${SCRATCH}/${name} -G ${GENERATOR}
    -DCMAKE_BUILD_TYPE=${BUILD_TYPE} -DHARMOS_ENABLE_TESTS=OFF
    -DCMAKE_C_COMPILER=${CC} -DCMAKE_CXX_COMPILER=${CXX} -DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER}
    -DCMAKE_CXX_FLAGS=${FLAGS} -DCMAKE_CXX_FLAGS_RELEASE=${FLAGS_RELEASE})
endforeach()
foreach(name material parallel)
  step("build ${name}" ${CMAKE_COMMAND} --build ${SCRATCH}/${name})
endforeach()

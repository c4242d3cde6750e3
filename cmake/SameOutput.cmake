# SPDX-License-Identifier: BSD-3-Clause
# cmake -DPROGRAM=... -P SameOutput.cmake: the program prints the same on 1, 2 and 3 threads.
foreach(threads 1 2 3)
  execute_process(COMMAND ${CMAKE_COMMAND} -E env OMP_NUM_THREADS=${threads} OMP_PROC_BIND=false ${PROGRAM}
    OUTPUT_VARIABLE output RESULT_VARIABLE status)
  message("${threads} thread(s): ${output}")
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "exit status ${status}")
  endif()
  if(threads EQUAL 1)
    set(expected "${output}")
  elseif(NOT output STREQUAL expected)
    message(FATAL_ERROR "${threads} threads give other bits than one")
  endif()
endforeach()

# cmake -D ctest=CTEST -D build=DIR -D folders=LIST -P labels.cmake

cmake_minimum_required(VERSION 3.25)
execute_process(COMMAND ${ctest} --test-dir ${build} --print-labels OUTPUT_VARIABLE labels COMMAND_ERROR_IS_FATAL ANY)
foreach(folder IN LISTS folders ITEMS house)
  if(NOT labels MATCHES "\n  ${folder}\n")
    message(FATAL_ERROR "No test is labelled ${folder}: ${labels}")
  endif()
endforeach()
execute_process(COMMAND ${ctest} --test-dir ${build} -N -LE "." OUTPUT_VARIABLE without COMMAND_ERROR_IS_FATAL ANY)
if(NOT without MATCHES "Total Tests: 0")
  message(FATAL_ERROR "Tests without a label: ${without}")
endif()

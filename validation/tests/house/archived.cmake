# cmake -D git=GIT -D tree=DIR -D work=DIR -P archived.cmake

cmake_minimum_required(VERSION 3.25)
file(REMOVE_RECURSE ${work})
file(MAKE_DIRECTORY ${work}/tree)
execute_process(COMMAND ${git} -C ${tree} archive --output=${work}/tree.tar HEAD core/base COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${git} -C ${tree} rev-parse --short=12 HEAD OUTPUT_VARIABLE head OUTPUT_STRIP_TRAILING_WHITESPACE
                COMMAND_ERROR_IS_FATAL ANY)
file(ARCHIVE_EXTRACT INPUT ${work}/tree.tar DESTINATION ${work}/tree)
execute_process(COMMAND ${CMAKE_COMMAND} -D output=${work}/version.cpp -D number=1 -D compiler=c -D build=b
                        -P ${work}/tree/core/base/version.cmake COMMAND_ERROR_IS_FATAL ANY)
file(READ ${work}/version.cpp text)
string(FIND "${text}" "\"${head}\"" found)
if(found EQUAL -1)
  message(FATAL_ERROR "The archived tree of ${head} says: ${text}")
endif()

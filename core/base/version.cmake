# Writes version.cpp, at every build, touching it only if something changed.
#   cmake -D output=FILE -D number=0.1.0 -D compiler=NAME -D build=TYPE -P core/base/version.cmake

cmake_path(SET root NORMALIZE ${CMAKE_CURRENT_LIST_DIR}/../..)
set(commit unknown)

# `git archive` writes the hash here (.gitattributes).
set(archived "$Format:%H$")
if(archived MATCHES "^[0-9a-f]+$")
  string(SUBSTRING ${archived} 0 12 commit)
endif()

# A tarball unpacked inside another project's checkout must not take that project's hash: .git has to be ours.
find_program(git git)
if(git AND EXISTS ${root}/.git AND commit STREQUAL unknown)
  execute_process(COMMAND ${git} -C ${root} describe --always --dirty --abbrev=12 --exclude=*
                  OUTPUT_VARIABLE described RESULT_VARIABLE failed OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  if(NOT failed)
    set(commit ${described})
  endif()
endif()

file(CONFIGURE OUTPUT ${output} @ONLY CONTENT [[
#include "core/base/version.hpp"

treejet::Version treejet::version() { return {"@number@", "@commit@", "@compiler@", "@build@"}; }
]])

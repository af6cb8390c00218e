# docs/library.md lists the headers that are installed as stable, no more and no less.
#   cmake -D page=FILE -D installed=DIR -P public_headers.cmake

cmake_minimum_required(VERSION 3.25)
file(STRINGS ${page} lines REGEX "^\\| `[^`]+\\.hpp`")
list(TRANSFORM lines REPLACE "^\\| `([^`]+)`.*" "\\1" OUTPUT_VARIABLE documented)
file(GLOB_RECURSE headers RELATIVE ${installed} ${installed}/*.hpp)
list(FILTER headers EXCLUDE REGEX "^detail/")
list(SORT documented)
list(SORT headers)
if(NOT documented STREQUAL headers)
  message(FATAL_ERROR "documented as stable: ${documented}\ninstalled: ${headers}")
endif()

# Types in the headers that have the same name: where the linker puts two of them into one program, a function of the one
# works at the other. (Headers have no unnamed namespaces; what a source keeps to itself stands in one.)
#   cmake -D tree=DIR -P one_definition.cmake          fails and lists each name that is defined in two headers below DIR
#   cmake -D breach_here=DIR -P one_definition.cmake   fabricates two in DIR and fails if they go unnoticed

cmake_minimum_required(VERSION 3.25)

# Sets `twice` in the caller to "name: header header" of each type that two headers define in the namespace.
function(find_names_given_twice tree)
  set(twice "")
  set(known "")
  file(GLOB_RECURSE headers RELATIVE ${tree} ${tree}/core/*.hpp ${tree}/parallel/*.hpp ${tree}/forces/*.hpp
       ${tree}/integrators/*.hpp ${tree}/validation/*.hpp)
  foreach(header IN LISTS headers)
    file(STRINGS ${tree}/${header} lines REGEX "^(struct|class|enum class|union) [A-Za-z0-9_]+[^;<]*$")
    foreach(line IN LISTS lines)
      string(REGEX REPLACE "^(enum class|[a-z]+) ([A-Za-z0-9_]+).*" "\\2" name "${line}")
      if(name IN_LIST known)
        list(APPEND twice "${name}: ${of_${name}} ${header}")
      endif()
      list(APPEND known ${name})
      set(of_${name} ${header})
    endforeach()
  endforeach()
  set(twice "${twice}" PARENT_SCOPE)
endfunction()

if(DEFINED tree)
  find_names_given_twice(${tree})
  if(twice)
    list(JOIN twice "\n  " told)
    message(FATAL_ERROR "types that two headers define:\n  ${told}")
  endif()
else()
  file(WRITE ${breach_here}/core/a.hpp "struct Place {\n  int line;\n};\nclass Other;\n")
  file(WRITE ${breach_here}/validation/b.hpp "template <int D>\nclass Place final : Other {\n};\nstruct Other {};\n")
  find_names_given_twice(${breach_here})
  if(NOT twice STREQUAL "Place: core/a.hpp validation/b.hpp")
    message(FATAL_ERROR "found instead of Place: ${twice}")
  endif()
endif()

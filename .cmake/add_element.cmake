# SPDX-License-Identifier: BSD-3-Clause
# One element, one name, five places. See docs/adding.md.

# add_element(ROOM/NAME): stops configuration unless all five places of the element exist, and puts it on the list that
# register_elements() writes.
function(add_element element)
  cmake_path(GET element PARENT_PATH room)
  cmake_path(GET element FILENAME name)
  set(missing "")
  foreach(place src/elements/${element}.hpp src/elements/${element}.cpp docs/elements/${element}.md tests/elements/${element}.cpp)
    file(GLOB found CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${place})  # a glob, so that a build notices a change
    if(NOT found)
      string(APPEND missing "  ${place}\n")
    endif()
  endforeach()
  file(GLOB_RECURSE decks CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/decks/${name}*.dat)
  if(NOT decks)
    string(APPEND missing "  decks/elements/${element}.dat (or any decks/**/${name}*.dat)\n")
  endif()

  if(missing)
    string(
      CONCAT
        message
        "The element '${element}' lacks\n${missing}"
        "Start each from the one of another element: docs/adding.md says what belongs in it. "
        "While you work on it, -DENGRANE_UNFINISHED=ON makes this a warning; to take the element out, "
        "remove its add_element line from src/CMakeLists.txt.")
    if(ENGRANE_UNFINISHED)
      message(WARNING "${message}")
    else()
      message(FATAL_ERROR "${message}")
    endif()
    if(NOT EXISTS ${PROJECT_SOURCE_DIR}/src/elements/${element}.cpp)
      return()
    endif()
  endif()
  set_property(GLOBAL APPEND PROPERTY engrane_elements ${element})
endfunction()

# Writes the registration list. It is explicit, not made of self-registering statics: the linker drops those from a
# static library when nothing else refers to their file.
function(register_elements)
  get_property(names GLOBAL PROPERTY engrane_elements)
  get_target_property(type engrane_elements TYPE)
  if(type STREQUAL "INTERFACE_LIBRARY")
    return()
  endif()
  set(declarations "")
  set(calls "")
  foreach(element ${names})
    cmake_path(GET element PARENT_PATH room)
    cmake_path(GET element FILENAME name)
    string(APPEND declarations "namespace elements::${room} {\nElementType ${name}_type();\n}\n")
    string(APPEND calls "      elements::${room}::${name}_type(),\n")
  endforeach()
  file(
    CONFIGURE
    OUTPUT ${PROJECT_BINARY_DIR}/generated/element_types.cpp
    CONTENT
      [[// SPDX-License-Identifier: BSD-3-Clause
// Written by add_element() of CMake.
#include "model/registry.hpp"

namespace engrane {

@declarations@
const std::vector<ElementType>& element_types() {
  static const std::vector<ElementType> all{
@calls@  };
  return all;
}

}  // namespace engrane
]]
    @ONLY)
  target_sources(engrane_elements PRIVATE ${PROJECT_BINARY_DIR}/generated/element_types.cpp)
endfunction()

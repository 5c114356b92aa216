# SPDX-License-Identifier: BSD-3-Clause
# engrane_layer(NAME [USES layer...] [WITH library...]): the folder src/NAME as a static library engrane_NAME; the layer
# `app` as the executable. A layer without sources yet passes its dependencies on.
function(engrane_layer name)
  cmake_parse_arguments(PARSE_ARGV 1 layer "" "" "USES;WITH")
  if(ENGRANE_FUZZ AND name MATCHES "^(assembly|observe|solve|output|app)$")
    return()  # what is fuzzed reads decks: it needs neither PETSc nor HDF5, and clang builds it faster without
  endif()
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${name}/*.cpp)
  list(TRANSFORM layer_USES PREPEND engrane_)

  if(NOT sources)
    add_library(engrane_${name} INTERFACE)
    target_include_directories(engrane_${name} INTERFACE ${CMAKE_CURRENT_SOURCE_DIR})
    target_link_libraries(engrane_${name} INTERFACE ${layer_USES} ${layer_WITH})
    return()
  endif()

  if(name STREQUAL "app")
    add_executable(engrane_app ${sources})
    set_target_properties(engrane_app PROPERTIES OUTPUT_NAME engrane)
    target_compile_definitions(engrane_app PRIVATE ENGRANE_VERSION="${PROJECT_VERSION}")
  else()
    add_library(engrane_${name} STATIC ${sources})
  endif()
  target_include_directories(engrane_${name} PUBLIC ${CMAKE_CURRENT_SOURCE_DIR})
  target_link_libraries(engrane_${name} PUBLIC ${layer_USES} ${layer_WITH} PRIVATE engrane_options)
  engrane_precompiled(engrane_${name})
  # Files of a layer are compiled eight at a time, so that what their anonymous namespaces define needs names of its own within
  # a room. They share what templates make of dual numbers and of Eigen: two thirds of the time of files alone.
  set_target_properties(engrane_${name} PROPERTIES UNITY_BUILD ${ENGRANE_UNITY} UNITY_BUILD_BATCH_SIZE 8)
endfunction()

# engrane_room(LAYER/ROOM [USES room...]): a folder of a layer and the other rooms of that layer that it may include. Only
# tests/layers.py looks at it: rooms are no libraries of their own.
function(engrane_room name)
endfunction()

# The foreign headers that nearly every source reads, parsed once. None of ours: where several files are compiled as one, GCC
# reads those twice. Sources include what they use all the same; ENGRANE_PRECOMPILED=OFF shows it.
function(engrane_precompiled target)
  if(NOT ENGRANE_PRECOMPILED)
    return()
  endif()
  if(target STREQUAL "engrane_base")
    target_precompile_headers(
      ${target} PRIVATE <Eigen/Core> <Eigen/Geometry> <fmt/format.h> <algorithm> <array> <functional> <map> <memory>
      <optional> <span> <string> <vector>)
  elseif(target STREQUAL "engrane_elements")
    target_precompile_headers(${target} PRIVATE <Eigen/Dense> <fmt/format.h>)
  elseif(target STREQUAL "engrane_solve")
    target_precompile_headers(${target} PRIVATE <Eigen/Dense> <Eigen/SparseCore> <fmt/format.h>)
  elseif(target STREQUAL "engrane_test_headers")
    target_precompile_headers(${target} PRIVATE <gtest/gtest.h> <Eigen/Dense> <fmt/format.h>)
  elseif(TARGET engrane_test_headers AND NOT target MATCHES "^engrane_")
    target_precompile_headers(${target} REUSE_FROM engrane_test_headers)
  else()
    target_precompile_headers(${target} REUSE_FROM engrane_base)
  endif()
  # GCC 12 believes in overruns of std::string where <string> is precompiled; the sanitizers look for real ones
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(${target} PRIVATE -Wno-array-bounds -Wno-restrict -Wno-stringop-overread -Wno-stringop-overflow)
  endif()
endfunction()

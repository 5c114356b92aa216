# SPDX-License-Identifier: BSD-3-Clause
# Libraries that stand in for those that PETSc and HDF5 load and engrane never calls (stand_ins.py, docs/decisions/0024-stand-ins.md).
# The program names them before PETSc does, and finds them beside itself; where they are not there, the real ones are loaded.
find_package(Python3 COMPONENTS Interpreter)
if(Python3_FOUND AND CMAKE_SYSTEM_NAME STREQUAL "Linux")
  list(GET PETSC_LINK_LIBRARIES 0 petsc_library)
  list(GET HDF5_LINK_LIBRARIES 0 hdf5_library)
  execute_process(
    COMMAND
      ${Python3_EXECUTABLE} ${PROJECT_SOURCE_DIR}/.cmake/stand_ins.py --compiler ${CMAKE_CXX_COMPILER} --folder
      ${CMAKE_RUNTIME_OUTPUT_DIRECTORY}/stand_ins --users ${petsc_library} ${hdf5_library} --names libHYPRE libtrilinos_ml
      libsuperlu_dist libfftw3_mpi libyaml-0 libcurl libcrypto
    OUTPUT_VARIABLE stand_ins
    ERROR_VARIABLE stand_in_faults
    RESULT_VARIABLE stand_in_status)
  if(stand_in_status EQUAL 0)
    string(REGEX REPLACE "\n$" "" stand_ins "${stand_ins}")
    string(REPLACE "\n" ";" stand_ins "${stand_ins}")
    target_link_options(engrane_app PRIVATE -Wl,--push-state,--no-as-needed ${stand_ins} -Wl,--pop-state)
    set_target_properties(engrane_app PROPERTIES BUILD_RPATH "$ORIGIN/stand_ins" INSTALL_RPATH "$ORIGIN/stand_ins")
    install(FILES ${stand_ins} DESTINATION libexec/engrane/stand_ins)
  else()
    message(STATUS "no stand-ins for unused libraries: ${stand_in_faults}")
  endif()
endif()

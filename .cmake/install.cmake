# SPDX-License-Identifier: BSD-3-Clause
# What `cmake --install` puts where, and the Debian package that `cpack` makes of it. In bin stands the launcher; it finds the
# rest from its own place, so the folder may be moved.
install(TARGETS engrane_app RUNTIME DESTINATION libexec/engrane)
install(PROGRAMS ${PROJECT_SOURCE_DIR}/engrane DESTINATION bin)
install(
  DIRECTORY ${PROJECT_SOURCE_DIR}/post/engrane_post
  DESTINATION share/engrane/post
  FILES_MATCHING
  PATTERN "*.py"
  PATTERN "__pycache__" EXCLUDE)
install(FILES ${PROJECT_SOURCE_DIR}/post/pyproject.toml DESTINATION share/engrane/post)
install(
  DIRECTORY ${PROJECT_SOURCE_DIR}/decks
  DESTINATION share/engrane
  FILES_MATCHING
  REGEX "\\.(dat|c|f|f90)$")
install(FILES ${PROJECT_SOURCE_DIR}/src/user/engrane_user.h ${PROJECT_SOURCE_DIR}/src/user/engrane_user.f90
        DESTINATION share/engrane/user)
install(
  FILES ${PROJECT_SOURCE_DIR}/LICENSE
  DESTINATION share/doc/engrane
  RENAME copyright)

# Manual page and completions come from the program's declared cards.
set(words ${PROJECT_BINARY_DIR}/words)
install(
  CODE "
  file(MAKE_DIRECTORY \"${words}\")
  execute_process(COMMAND \"$<TARGET_FILE:engrane_app>\" man OUTPUT_FILE \"${words}/engrane.1\" COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND gzip -9nf \"${words}/engrane.1\" COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND \"$<TARGET_FILE:engrane_app>\" completion OUTPUT_FILE \"${words}/engrane\"
                  COMMAND_ERROR_IS_FATAL ANY)")
install(FILES ${words}/engrane.1.gz DESTINATION share/man/man1)
install(FILES ${words}/engrane DESTINATION share/bash-completion/completions)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME engrane)
set(CPACK_PACKAGE_VENDOR "The engrane developers")
set(CPACK_PACKAGE_CONTACT "The engrane developers <engrane@localhost>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION
    "Statics, kinematics and dynamics of wheels, shafts, joints, springs and
bodies under large rotations, from decks in the language of SAMCEF BACON
and MECANO; results in HDF5, plots, pictures and files for ParaView.")
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON) # what the program links, with the versions it needs
# The rest is for `engrane -np` and for the Python side, whose packages Debian 12 has not or has too old: the launcher
# puts them into an environment in the user's cache when they are first needed.
set(CPACK_DEBIAN_PACKAGE_DEPENDS "openmpi-bin, python3 (>= 3.11), python3-venv, ca-certificates, libosmesa6")
include(CPack)

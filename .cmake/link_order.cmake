# SPDX-License-Identifier: BSD-3-Clause
# The loader looks for a symbol in all libraries of a program in turn, breadth first. Debian's PETSc loads some hundred, and most
# symbols are of a few that stand far behind: of OpenBLAS, which looks for its own, of Trilinos, of libcrypto. Named first, in the
# order they have among themselves, they are found at once (docs/decisions/0025-start-up.md). They are loaded in any case.
#
# Sets `variable` to the link options, empty where the libraries are others.
function(engrane_link_order variable)
  set(${variable} "" PARENT_SCOPE)
  find_program(LDD ldd)
  mark_as_advanced(LDD)
  if(NOT LDD OR NOT PETSC_LINK_LIBRARIES OR ENGRANE_SANITIZE) # whose library has to be the first
    return()
  endif()
  list(GET PETSC_LINK_LIBRARIES 0 petsc)
  execute_process(COMMAND ${LDD} ${petsc} OUTPUT_VARIABLE loaded ERROR_QUIET)
  string(REGEX MATCHALL "=> /[^ ]+" loaded "${loaded}")
  list(TRANSFORM loaded REPLACE "^=> " "")
  list(FILTER loaded INCLUDE REGEX "/lib(lapack|blas|openblas|crypto|trilinos_(teuchosparameterlist|ml|ifpack|epetra))\\.so")
  if(loaded)
    set(${variable} "LINKER:--push-state,--no-as-needed" ${loaded} "LINKER:--pop-state" PARENT_SCOPE)
  endif()
endfunction()

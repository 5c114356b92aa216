! SPDX-License-Identifier: BSD-3-Clause
! User routines in Fortran. gfortran -O2 -shared -fPIC ../../src/user/engrane_user.f90 laws_fortran.f90 -o liblaws_fortran.so

!> Force law p(1) e + p(2) e**3 + p(3) v of a spring, with derivatives and energy.
subroutine hardening(version, kind, x, p, n_p, y, status) bind(C)
  use engrane_user
  implicit none
  integer(c_int), intent(in) :: version, kind, n_p
  real(c_double), intent(in) :: x(*), p(n_p)
  real(c_double), intent(inout) :: y(*)
  integer(c_int), intent(inout) :: status

  if (kind /= engrane_force) then
    status = engrane_wrong_kind
  else if (n_p /= 3) then
    status = engrane_wrong_parameters
  else
    y(1) = p(1)*x(1) + p(2)*x(1)**3 + p(3)*x(2)
    y(2) = p(1) + 3*p(2)*x(1)**2
    y(3) = p(3)
    y(4) = p(1)*x(1)**2/2 + p(2)*x(1)**4/4
  end if
end subroutine

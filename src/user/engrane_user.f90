! SPDX-License-Identifier: BSD-3-Clause
!> Interface of user routines: the constants of engrane_user.h and the signature of the subroutine. See docs/user_routines.md.
!> Compile it together with the routine: gfortran -shared -fPIC engrane_user.f90 mine.f90 -o libmine.so
module engrane_user
  use, intrinsic :: iso_c_binding, only: c_int, c_double
  implicit none
  public

  integer(c_int), parameter :: engrane_user_version = 1

  !> Kinds. x: variable; y: value and three derivatives
  integer(c_int), parameter :: engrane_function = 1
  !> x: elongation or angle, rate, time; y: force, its derivatives with respect to elongation and to rate, stored energy: the
  !> integral of the force at rest, of the elongation alone; left unset (not 0) if the force at rest depends on the time
  integer(c_int), parameter :: engrane_force = 2
  !> x: position in the tooth pitch (0 to 1), deflection; y: factor on KM, its first and second derivative with respect to the
  !> position, its derivative with respect to the deflection
  integer(c_int), parameter :: engrane_mesh = 3
  !> x: sliding speed, normal force; y: coefficient, its derivatives with respect to speed and to force
  integer(c_int), parameter :: engrane_friction = 4

  integer(c_int), parameter :: engrane_fine = 0, engrane_wrong_kind = -1, engrane_wrong_parameters = -2, engrane_outside = -3

  !> Value of every y before the call. A derivative left unset is replaced by finite differences.
  real(c_double), parameter :: engrane_not_given = -huge(1.0_c_double)

  abstract interface
    subroutine engrane_routine(version, kind, x, p, n_p, y, status) bind(C)
      import :: c_int, c_double
      integer(c_int), intent(in) :: version, kind, n_p
      real(c_double), intent(in) :: x(*), p(*)
      real(c_double), intent(inout) :: y(*)
      integer(c_int), intent(inout) :: status
    end subroutine
  end interface
end module

/* SPDX-License-Identifier: BSD-3-Clause
 * Interface of user routines: one subroutine with one signature for every kind. See docs/user_routines.md;
 * engrane_user.f90 is the same for Fortran. */
#ifndef ENGRANE_USER_H
#define ENGRANE_USER_H

#include <float.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Version of this interface. A later version adds kinds and further entries of x and y; existing ones stay. */
#define ENGRANE_USER_VERSION 1

/* What a routine computes. Entries of x and y count from 0 here, from 1 in Fortran. */
enum {
  ENGRANE_FUNCTION = 1, /* x: variable (the time, for drives and loads)
                           y: value, first, second and third derivative */
  ENGRANE_FORCE = 2,    /* x: elongation or angle, its rate, time
                           y: force, its derivatives by elongation and by rate, energy stored: the integral of the force at
                              rest, of the elongation alone; left unset (not 0) if the force at rest depends on the time */
  ENGRANE_MESH = 3,     /* x: place in the tooth pitch (0 to 1), deflection of the teeth
                           y: factor on KM, its first and second derivative by the place, its derivative by the deflection */
  ENGRANE_FRICTION = 4  /* x: sliding speed, normal force
                           y: coefficient, its derivatives by speed and by force */
};

/* Values of *status. It is 0 when the routine is called; any other number is an error code of the user's own, which engrane
 * reports. */
enum {
  ENGRANE_FINE = 0,
  ENGRANE_WRONG_KIND = -1,       /* the routine does not compute this kind */
  ENGRANE_WRONG_PARAMETERS = -2, /* too few or impossible PARAM */
  ENGRANE_OUTSIDE = -3           /* x is outside what the routine is good for; a smaller step may cure it */
};

/* Every y holds this when the routine is called. A derivative left unset is replaced by finite differences. */
#define ENGRANE_NOT_GIVEN (-DBL_MAX)

/* All arguments are passed by reference, as in Fortran 77:
 *   version  ENGRANE_USER_VERSION of the calling program
 *   kind     one of the kinds above
 *   x        input: the arguments of this kind
 *   p, n_p   input: the numbers given by PARAM in the deck, and their count
 *   y        output: the value, then its derivatives
 *   status   output: set it if something is wrong
 * The result must depend on x and p only: a step may be tried several times, also backwards, and on several ranks. */
typedef void engrane_routine(const int* version, const int* kind, const double* x, const double* p, const int* n_p, double* y,
                             int* status);

#ifdef __cplusplus
}
#endif
#endif

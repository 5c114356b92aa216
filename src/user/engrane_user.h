/* SPDX-License-Identifier: BSD-3-Clause
 * What a user routine is for engrane: one subroutine of one shape, whatever it computes. docs/user_routines.md teaches it,
 * engrane_user.f90 is the same for Fortran. */
#ifndef ENGRANE_USER_H
#define ENGRANE_USER_H

#include <float.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Version of all that stands here. A later version adds kinds and further entries of x and y; what is here stays. */
#define ENGRANE_USER_VERSION 1

/* What a routine is asked for. Entries of x and y count from 0 here, from 1 in Fortran. */
enum {
  ENGRANE_FUNCTION = 1, /* x: variable (the time, for drives and loads)
                           y: value, first, second and third derivative */
  ENGRANE_FORCE = 2,    /* x: elongation or angle, its rate, time
                           y: force, its derivatives by elongation and by rate, energy stored */
  ENGRANE_MESH = 3,     /* x: place in the tooth pitch (0 to 1), deflection of the teeth
                           y: factor on KM, its first and second derivative by the place, its derivative by the deflection */
  ENGRANE_FRICTION = 4  /* x: sliding speed, normal force
                           y: coefficient, its derivatives by speed and by force */
};

/* What *status may be set to. It is 0 when the routine is called; any other number is an error of the user's own, which engrane
 * reports with that number. */
enum {
  ENGRANE_FINE = 0,
  ENGRANE_WRONG_KIND = -1,       /* the routine does not compute this kind */
  ENGRANE_WRONG_PARAMETERS = -2, /* too few or impossible PARAM */
  ENGRANE_OUTSIDE = -3           /* x is outside what the routine is good for; a smaller step may cure it */
};

/* Every y holds this when the routine is called. A derivative left so is replaced by differences. */
#define ENGRANE_NOT_GIVEN (-DBL_MAX)

/* All by reference, as old Fortran passes arguments:
 *   version  ENGRANE_USER_VERSION of the program that calls
 *   kind     one of the kinds above
 *   x        where: the arguments of this kind
 *   p, n_p   the numbers behind PARAM in the deck, and how many there are
 *   y        to be set: the value first, then its derivatives
 *   status   to be set when something is wrong
 * The result must follow from x and p alone: a step is tried several times, backwards too, and on several ranks. */
typedef void engrane_routine(const int* version, const int* kind, const double* x, const double* p, const int* n_p, double* y,
                             int* status);

#ifdef __cplusplus
}
#endif
#endif

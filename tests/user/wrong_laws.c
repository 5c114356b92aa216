/* SPDX-License-Identifier: BSD-3-Clause
 * User routines for tests. Most are wrong, each in its own way: what engrane must say about them is in tests/errors/user. */
#include <math.h>
#include <stdlib.h>

#include "engrane_user.h"

#define ROUTINE(name) \
  void name(const int* version, const int* kind, const double* x, const double* p, const int* n_p, double* y, int* status)
#define UNUSED (void)version, (void)kind, (void)x, (void)p, (void)n_p, (void)y, (void)status

ROUTINE(wrong_slope) {
  UNUSED;
  y[0] = 100 * x[0] + x[0] * x[0] * x[0];
  y[1] = 50 + 3 * x[0] * x[0];
}

ROUTINE(wrong_rate) {
  UNUSED;
  y[0] = 100 * x[0] + 3 * x[1];
  y[1] = 100;
  y[2] = -3;
}

ROUTINE(wrong_energy) {
  UNUSED;
  y[0] = 100 * x[0];
  y[1] = 100;
  y[2] = 0;
  y[3] = 100 * x[0] * x[0];
}

/* The energy depends on the time, and only later than what is checked before the run. */
ROUTINE(swings) {
  UNUSED;
  const double swing = 2 * sin(5 * x[2]);
  y[0] = 40 * x[0] + swing;
  y[1] = 40;
  y[2] = 0;
  if (p[0] > 0) y[3] = 20 * x[0] * x[0] + swing * x[0];
}

ROUTINE(wrong_second) {
  UNUSED;
  y[0] = sin(x[0]);
  y[1] = cos(x[0]);
  y[2] = sin(x[0]);
}

ROUTINE(no_value) { UNUSED; }

ROUTINE(own_error) {
  UNUSED;
  *status = 7;
}

ROUTINE(not_a_number) {
  UNUSED;
  y[0] = sqrt(x[0] - 1e30);
}

ROUTINE(counts_calls) {
  UNUSED;
  static int calls;
  y[0] = ++calls;
}

ROUTINE(needs_two) {
  UNUSED;
  y[0] = x[0];
  if (*n_p != 2) *status = ENGRANE_WRONG_PARAMETERS;
}

/* A factor that does not repeat with the tooth. */
ROUTINE(open_pitch) {
  UNUSED;
  y[0] = 1 + 0.1 * x[0];
}

/* Nothing wrong, and no derivatives. */
ROUTINE(only_value) {
  UNUSED;
  y[0] = sin(x[0]) + 0.5 * x[1] * x[1];
}

/* Good only where its arguments are promised to be, and as a function from 0 to p[0]; no derivatives. */
ROUTINE(bounded) {
  UNUSED;
  const double most = *kind == ENGRANE_MESH ? 1 : *kind == ENGRANE_FUNCTION ? p[0] : HUGE_VAL;
  if (x[0] < 0 || x[0] > most || x[1] < 0) *status = ENGRANE_OUTSIDE;
  y[0] = 1 + 0.2 * sin(4 * atan(1) * x[0]) * (1 + 0.1 * x[1]);
}

/* A friction law of speed and force. */
ROUTINE(loaded_friction) {
  UNUSED;
  const double fall = exp(-x[0]), load = 1 / (1 + 0.1 * x[1]);
  y[0] = (0.1 + 0.2 * fall) * load;
  y[1] = -0.2 * fall * load;
  y[2] = -0.1 * (0.1 + 0.2 * fall) * load * load;
}

/* A contact: right, though its derivative jumps at 0. */
ROUTINE(one_sided) {
  UNUSED;
  y[0] = x[0] > 0 ? 100 * x[0] : 0;
  y[1] = x[0] > 0 ? 100 : 0;
  y[2] = 0;
}

/* Good at the start, and not beyond p[0]. */
ROUTINE(ends) {
  UNUSED;
  y[0] = x[0];
  if (x[0] > p[0]) *status = ENGRANE_OUTSIDE;
}

/* The same, by dividing nought by nought. */
ROUTINE(breaks) {
  UNUSED;
  y[0] = x[0] > p[0] ? (x[0] - x[0]) / (p[0] - p[0]) : x[0];
}

/* Right: its derivative at 0 is zero, and differences are not. */
ROUTINE(cubic) {
  UNUSED;
  y[0] = 3e4 * x[0] * x[0] * x[0] + 15 * x[1] * fabs(x[1]);
  y[1] = 9e4 * x[0] * x[0];
  y[2] = 30 * fabs(x[1]);
}

/* The same with a linear part that its derivative lacks. */
ROUTINE(cubic_and_linear) {
  UNUSED;
  y[0] = 5 * x[0] + 3e4 * x[0] * x[0] * x[0];
  y[1] = 9e4 * x[0] * x[0];
}

ROUTINE(aborts) {
  UNUSED;
  if (x[0] > p[0]) abort();
  y[0] = x[0];
}

ROUTINE(crashes) {
  UNUSED;
  if (x[0] > p[0]) {
    volatile double* nowhere = (volatile double*)64;
    y[0] = *nowhere;
  }
  y[0] = x[0];
}

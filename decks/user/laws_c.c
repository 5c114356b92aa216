/* SPDX-License-Identifier: BSD-3-Clause
 * User routines in C. cc -O2 -shared -fPIC -I../../src/user laws_c.c -lm -o liblaws_c.so */
#include <math.h>

#include "engrane_user.h"

/* Mesh stiffness: 1 + sum of p[2n-2] cos 2 pi n s + p[2n-1] sin 2 pi n s over the tooth pitch 0 <= s < 1. */
void fourier_mesh(const int* version, const int* kind, const double* x, const double* p, const int* n_p, double* y, int* status) {
  (void)version;
  if (*kind != ENGRANE_MESH) {
    *status = ENGRANE_WRONG_KIND;
    return;
  }
  y[0] = 1;
  y[1] = y[2] = y[3] = 0;
  for (int n = 1; 2 * n <= *n_p; ++n) {
    const double w = 2 * acos(-1.0) * n, c = cos(w * x[0]), s = sin(w * x[0]);
    const double a = p[2 * n - 2], b = p[2 * n - 1];
    y[0] += a * c + b * s;
    y[1] += w * (b * c - a * s);
    y[2] -= w * w * (a * c + b * s);
  }
}

/* Mesh stiffness that grows with the deflection and varies over the pitch: (p[0] + p[1] d)(1 + p[2] cos 2 pi s). */
void stiffening_mesh(const int* version, const int* kind, const double* x, const double* p, const int* n_p, double* y,
                     int* status) {
  (void)version;
  if (*kind != ENGRANE_MESH) {
    *status = ENGRANE_WRONG_KIND;
    return;
  }
  if (*n_p != 3) {
    *status = ENGRANE_WRONG_PARAMETERS;
    return;
  }
  const double w = 2 * acos(-1.0), grown = p[0] + p[1] * x[1];
  y[0] = grown * (1 + p[2] * cos(w * x[0]));
  y[1] = -grown * p[2] * w * sin(w * x[0]);
  y[2] = -grown * p[2] * w * w * cos(w * x[0]);
  y[3] = p[1] * (1 + p[2] * cos(w * x[0]));
}

/* Force law p[0] e + p[1] e^3 + p[2] v of a spring. No derivatives: engrane takes differences. */
void hardening_plain(const int* version, const int* kind, const double* x, const double* p, const int* n_p, double* y,
                     int* status) {
  (void)version;
  if (*kind != ENGRANE_FORCE) {
    *status = ENGRANE_WRONG_KIND;
    return;
  }
  if (*n_p != 3) {
    *status = ENGRANE_WRONG_PARAMETERS;
    return;
  }
  y[0] = p[0] * x[0] + p[1] * x[0] * x[0] * x[0] + p[2] * x[1];
}

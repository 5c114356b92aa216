// SPDX-License-Identifier: BSD-3-Clause
// What happens between two teeth of a gear pair: stiffness, backlash, damping and transmission error
// (A. Cardona 1995, equations 28–33).
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "math/dual.hpp"
#include "model/function.hpp"

namespace engrane {

/// Transmission error under static load, x_err(ψ_A): a length along the circumference that the turn of wheel A adds to u_m.
struct TransmissionError {
  enum class Kind { none, cosine, fourier, table };
  Kind kind = Kind::none;
  int teeth = 1;                       ///< z_A
  double amplitude = 0;                ///< X of (31): X (1 − cos z_A ψ_A)
  std::vector<double> coefficients;    ///< a₁ b₁ a₂ b₂ …: Σ a_n cos(n z_A ψ_A) + b_n sin(n z_A ψ_A)
  const Function* function = nullptr;  ///< of ψ_A in degrees, repeating with every turn

  /// x_err and its derivatives with respect to ψ_A (radians).
  Function::Jet at(double psi_a) const;
};

/// How the teeth of a pair stand in the reference configuration, relative to all other meshes of the same wheels. Angles in
/// radians; entry 0 is wheel A, entry 1 wheel B.
struct MeshPhase {
  /// z_A times the angle from the contact point to a tooth of A, about A's axle: 0 with a tooth of A at the contact point.
  /// The mesh is at phase + z_A ψ_A, 2π for each tooth that passes.
  double phase = 0;
  /// Angle about each wheel's axle from the wheel's first contact point in the deck to this one: the place on the wheel
  /// that is in contact is that many radians further, and moves back by ψ.
  std::array<double, 2> contact{0, 0};
  /// Approach of the teeth, along the circumference, that a loop of wheels closes with; 0 in all but planetary trains with
  /// misplaced planets.
  double misfit = 0;
};

/// max(x, 0) with its corner rounded over |x| < width/2 by a polynomial that keeps value, slope and curvature continuous;
/// exact outside. Width 0 is the corner itself.
Function::Jet rounded_ramp(double x, double width);
/// Its integral from −∞.
double rounded_ramp_integral(double x, double width);

/// The law between the approach x = u_m + x_err of the teeth and the force along the circumference. x > 0 presses the flanks
/// on which A drives in the positive sense about its axle; x < −b the other ones.
struct ToothLaw {
  enum class Damping {
    always,  ///< c_m du_m/dt whether the teeth touch or not: the paper's law
    contact  ///< only while they touch, and never more than would make the flank pull
  };
  double stiffness = 0;  ///< k_m
  double damping = 0;    ///< c_m
  double backlash = 0;   ///< b along the circumference; 0: the teeth touch on both flanks at once
  double onset = 0;      ///< width over which contact comes on, at most b
  Damping mode = Damping::always;
  TransmissionError error;
  MeshPhase mesh;

  /// [[x]] of (28), each corner rounded over `onset`.
  Function::Jet deflection(double x) const;
  /// ∫ k_m [[x]] dx: ½ k_m [[x]]² where no corner is rounded, (28).
  double potential(double x) const;
  /// −1, 0, 1: on the back flank, in the gap, on the flank with which A drives in the positive sense.
  int contact(double x) const;

  /// k_m [[x]], the elastic force of (29). Its derivative inside the gap is 1e-9 k_m instead of zero: nothing to dynamics or
  /// to frequencies, but the statics of a load that presses the far flank then has a way across.
  template <class T>
  T elastic_force(const T& x) const {
    constexpr double least_slope = 1e-9;
    const Function::Jet d = deflection(value_of(x));
    return compose(x, stiffness * d.f, stiffness * std::max(d.d1, least_slope), stiffness * d.d2);
  }

  /// What damping adds to it. With Damping::contact the sum of both keeps the sign of the flank that touches: where c_m du_m/dt
  /// alone would make it pull, it takes away the elastic force and no more. That limit is rounded too, between 90 and 110
  /// per cent of the elastic force, so that the law has a continuous slope.
  template <class T>
  T damping_force(const T& x, const T& rate) const {
    if (mode == Damping::always || backlash == 0) return damping * rate;
    return flank_damping(x, rate) - flank_damping(T(-backlash - x), T(-rate));  // the flanks mirror each other
  }

 private:
  template <class T>
  T flank_damping(const T& x, const T& rate) const {
    const Function::Jet ramp = rounded_ramp(value_of(x), onset);
    if (ramp.d1 == 0) return T(0);
    const T free = damping * compose(x, ramp.d1, ramp.d2, ramp.d3) * rate;
    if (value_of(free) >= 0) return free;
    const T elastic = compose(x, stiffness * ramp.f, stiffness * ramp.d1, stiffness * ramp.d2);
    constexpr double rounding = 0.1;
    if (value_of(free) <= -(1 + rounding) * value_of(elastic)) return -elastic;
    const T rest = 1 + free / elastic;  // what is left of the elastic force, as a fraction
    const Function::Jet kept = rounded_ramp(value_of(rest), 2 * rounding);
    return elastic * (compose(rest, kept.f, kept.d1, kept.d2) - 1);
  }
};

/// c_m = 2ξ√(k_m m_e), (32), with m_e = I_A I_B/(I_A l_B² + I_B l_A²), (33). The levers l are r cosβ, along which u_m is
/// measured; the paper's r for spur gears. An infinite inertia is a wheel that cannot turn.
double tooth_damping(double ratio, double stiffness, double inertia_a, double inertia_b, double lever_a, double lever_b);

}  // namespace engrane

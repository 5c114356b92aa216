// SPDX-License-Identifier: BSD-3-Clause
// What happens between two teeth of a gear pair: stiffness, backlash, damping and transmission error
// (A. Cardona 1995, equations 28–33).
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "elements/gears/mesh_stiffness.hpp"
#include "elements/gears/tooth_relief.hpp"
#include "math/dual.hpp"
#include "model/function.hpp"

namespace engrane::elements::gears {

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

/// Transmission error under static load: a length along the circumference that the turn of the wheels adds to u_m.
struct TransmissionError {
  enum class Kind { none, cosine, fourier, table };
  Kind kind = Kind::none;
  int teeth = 1;                       ///< z_A
  double amplitude = 0;                ///< X of (31): X (1 − cos τ), τ = z_A ψ_A + phase
  std::vector<double> coefficients;    ///< a₁ b₁ a₂ b₂ …: Σ a_n cos nτ + b_n sin nτ
  const Function* function = nullptr;  ///< of the place on wheel A in degrees, repeating with every turn

  /// What one wheel adds whatever its partner: its runout and the cumulative error of its pitches.
  struct Wheel {
    double eccentricity = 0;          ///< amplitude of the sine over a turn
    double phase = 0;                 ///< of that sine, radians
    const Function* pitch = nullptr;  ///< of the place on the wheel in degrees, repeating with every turn
    Function::Jet at(double place) const;
  };
  std::array<Wheel, 2> wheel;

  /// x_err as far as it follows wheel A, and as far as it follows wheel B, with derivatives by the wheel's turn in radians.
  Function::Jet of_a(double psi_a, const MeshPhase& mesh) const;
  Function::Jet of_b(double psi_b, const MeshPhase& mesh) const;

 private:
  Function::Jet of_teeth(double psi_a, const MeshPhase& mesh) const;
};

/// max(x, 0) with its corner rounded over |x| < width/2 by a polynomial that keeps value, slope and curvature continuous;
/// exact outside. Width 0 is the corner itself.
Function::Jet rounded_ramp(double x, double width);
/// Its integral from −∞.
double rounded_ramp_integral(double x, double width);

/// The law between the approach x = u_m + x_err of the teeth and the force along the circumference. x > 0 presses the flanks
/// on which A drives in the positive sense about its axle; x < −b the other ones.
struct ToothLaw {
  /// A flank pressed in, all over k_m, where the stiffness depends on the deflection: force f(τ, D) D of the deflection D, and
  /// what it stores, ∫ f D dx; with derivatives by the depth and by τ.
  struct Pressed {
    double force = 0, by_depth = 0, by_phase = 0;
    double energy = 0, energy_by_phase = 0, energy_by_phase_twice = 0;
    user::Results factor{};  ///< as MeshStiffness::at()
  };
  enum class Damping {
    always,  ///< c_m du_m/dt whether the teeth touch or not: the paper's law
    contact  ///< only while they touch, and never more than would make the flank pull
  };
  double stiffness = 0;  ///< k_m
  IsoStiffness iso;      ///< from which k_m was computed, with STIFF ISO; otherwise 0
  double damping = 0;    ///< c_m
  double backlash = 0;   ///< b along the circumference; 0: the teeth touch on both flanks at once
  double onset = 0;      ///< width over which contact comes on, at most b; 0: the corner itself
  double blur = 0;       ///< on either side of such a corner: what of an approach is rounding of the positions
  double exponent = 1;   ///< p: the force grows with x^p
  double reference = 1;  ///< x₀ > 0 at which the secant stiffness is k_m; of no consequence for p = 1
  /// C: teeth crowned by C (2y/b)² along the face touch over a part of it only; 0: not crowned. Only with exponent 1.
  double crown = 0;
  Damping mode = Damping::always;
  MeshStiffness course;
  ToothRelief relief;
  TransmissionError error;
  MeshPhase mesh;

  /// Does the force depend on how far the teeth are pressed in by more than flank()?
  bool by_load() const { return course.loaded || relief.active(); }

  /// What a flank pressed in by x resists with, over k_m: max(x, 0), rounded over `onset`; x₀ (x/x₀)^p; or crowned, the mean over
  /// the face of max(x − C (2y/b)², 0), which is ⅔ x √(x/C) up to x = C and x − C/3 beyond. The last two need no rounding.
  Function::Jet flank(double x) const;
  /// Its integral from −∞.
  double flank_integral(double x) const;
  /// max(x, 0): rounded over `onset`, or with half the slope within ±`blur`. A start without load leaves the flanks just
  /// touching, and rounding must not choose in each iteration whether they do.
  Function::Jet ramp(double x) const;

  /// A flank pressed in by `depth` where by_load() (exponent 1). With relief the sum over all pairs on the path,
  /// V = k_m/ε Σ w(ζ_j) ∫ flank(x − δ(ζ_j)) dx, ζ_j/p_b = τ/2π + flank + j; the path of back flanks is the mirror image, τ → −τ.
  Pressed pressed(double phase, double depth, bool back = false) const;

  /// [[x]] of (28) by both flanks.
  Function::Jet deflection(double x) const;
  /// ∫ [[x]] dx: ½ [[x]]² where no corner is rounded, (28) over k_m.
  double deflection_integral(double x) const;
  /// ∫ k_m [[x]] dx
  double potential(double x) const { return stiffness * deflection_integral(x); }
  /// −1, 0, 1: on the back flank, in the gap, on the flank with which A drives in the positive sense.
  int contact(double x) const { return contact(x, -backlash - x); }
  /// The same from how far each flank is pressed in; to rounding of the positions.
  int contact(double front, double back) const {
    if (front >= -blur) return 1;
    return back >= -blur ? -1 : 0;
  }

  /// [[x]] in the arithmetic of x. Its derivative inside the gap is 1e-9 instead of zero: nothing to dynamics or to
  /// frequencies, but the statics of a load that presses the far flank then has a way across.
  template <class T>
  T elastic_deflection(const T& x) const {
    const Function::Jet d = deflection(value_of(x));
    return compose(x, d.f, std::max(d.d1, least_slope), d.d2);
  }
  static constexpr double least_slope = 1e-9;
  /// Half the width over which the limit of a flank's damping is rounded, of the elastic force.
  static constexpr double limit_rounding = 0.1;

  /// What damping adds to the elastic force, where the flanks are pressed in by `front` and `back` and resist with `elastic`
  /// forces of their own. With Damping::contact the sum of both keeps the sign of the flank that touches: where c_m du_m/dt
  /// alone would make it pull, it takes away the elastic force and no more. That limit is rounded too, between 90 and 110
  /// per cent of the elastic force, so that the law has a continuous slope.
  template <class T>
  T damping_force(const T& front, const T& back, const T& elastic_front, const T& elastic_back, const T& rate) const {
    if (mode == Damping::always) return damping * rate;
    return flank_damping(front, elastic_front, rate) - flank_damping(back, elastic_back, T(-rate));  // mirror images
  }

 private:
  Pressed pressed_pairs(double phase, double depth) const;
  template <class T>
  T flank_damping(const T& x, const T& elastic, const T& rate) const {
    const Function::Jet window = ramp(value_of(x));
    if (window.d1 == 0) return T(0);
    const T free = damping * compose(x, window.d1, window.d2, window.d3) * rate;
    if (value_of(free) >= 0) return free;
    constexpr double rounding = limit_rounding;
    if (value_of(free) <= -(1 + rounding) * value_of(elastic)) return -elastic;
    const T rest = 1 + free / elastic;  // what is left of the elastic force, as a fraction
    const Function::Jet kept = rounded_ramp(value_of(rest), 2 * rounding);
    return elastic * (compose(rest, kept.f, kept.d1, kept.d2) - 1);
  }
};

/// c_m = 2ξ√(k_m m_e), (32), with m_e = I_A I_B/(I_A l_B² + I_B l_A²), (33). The levers l are r cosβ, along which u_m is
/// measured; the paper's r for spur gears. An infinite inertia is a wheel that cannot turn.
double tooth_damping(double ratio, double stiffness, double inertia_a, double inertia_b, double lever_a, double lever_b);

}  // namespace engrane::elements::gears

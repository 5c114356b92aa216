// SPDX-License-Identifier: BSD-3-Clause
// Tooth law of a gear pair: stiffness, backlash, damping and transmission error (A. Cardona 1995, equations 28–33).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "elements/gears/mesh_stiffness.hpp"
#include "elements/gears/tooth_relief.hpp"
#include "math/dual.hpp"
#include "model/function.hpp"

namespace engrane::elements::gears {

/// Tooth positions of a pair in the reference configuration, consistent with all other meshes of the same wheels. Angles in
/// radians; entry 0 is wheel A, entry 1 wheel B.
struct MeshPhase {
  /// z_A times the angle about A's axle from the contact point to a tooth of A; 0 with a tooth of A at the contact point. The
  /// mesh phase is phase + z_A ψ_A, 2π per tooth.
  double phase = 0;
  /// Angle about each wheel's axle from the wheel's first contact point in the deck to this one. The place on the wheel that is
  /// in contact is further on by this angle, and moves back by ψ.
  std::array<double, 2> contact{0, 0};
  /// Approach of the teeth along the circumference left over when a loop of wheels is closed; 0 except in planetary trains with
  /// misplaced planets.
  double misfit = 0;
};

/// Static transmission error: a length along the circumference, depending on the angles of the wheels, that is added to u_m.
struct TransmissionError {
  enum class Kind { none, cosine, fourier, table };
  Kind kind = Kind::none;
  int teeth = 1;                       ///< z_A
  double amplitude = 0;                ///< X of (31): X (1 − cos τ), τ = z_A ψ_A + phase
  std::vector<double> coefficients;    ///< a₁ b₁ a₂ b₂ …: Σ a_n cos nτ + b_n sin nτ
  const Function* function = nullptr;  ///< of the place on wheel A in degrees, periodic with one turn

  /// Contribution of one wheel, whatever its partner: runout and cumulative pitch error.
  struct Wheel {
    double eccentricity = 0;          ///< amplitude of a sine with period one turn
    double phase = 0;                 ///< of that sine, radians
    const Function* pitch = nullptr;  ///< of the place on the wheel in degrees, periodic with one turn
    Function::Jet at(double place) const;
  };
  std::array<Wheel, 2> wheel;

  /// The parts of x_err that depend on wheel A and on wheel B, with derivatives with respect to that wheel's angle in radians.
  Function::Jet of_a(double psi_a, const MeshPhase& mesh) const;
  Function::Jet of_b(double psi_b, const MeshPhase& mesh) const;

 private:
  Function::Jet of_teeth(double psi_a, const MeshPhase& mesh) const;
};

/// max(x, 0) with its corner rounded over |x| < width/2 by a polynomial with continuous value, slope and curvature; exact
/// outside. Width 0 is the exact corner.
Function::Jet rounded_ramp(double x, double width);
/// Its integral from −∞.
double rounded_ramp_integral(double x, double width);

/// Law between the approach x = u_m + x_err of the teeth and the force along the circumference. x > 0 presses the flanks with
/// which A drives in the positive sense about its axle; x < −b presses the other ones.
struct ToothLaw {
  /// Response of a flank, divided by k_m, when the stiffness depends on the deflection D: force f(τ, D) D and stored energy ∫ f
  /// D dx, with derivatives with respect to the depth and to τ.
  struct Pressed {
    double force = 0, by_depth = 0, by_phase = 0;
    double energy = 0, energy_by_phase = 0, energy_by_phase_twice = 0;
    user::Results factor{};  ///< see MeshStiffness::at()
  };
  enum class Damping {
    always,  ///< c_m du_m/dt whether or not the teeth touch: the paper's law
    contact  ///< c_m dx/dt, of the approach with x_err, only in contact, and limited so that the flank does not pull
  };
  double stiffness = 0;  ///< k_m
  IsoStiffness iso;      ///< from which k_m was computed, with STIFF ISO; otherwise 0
  double damping = 0;    ///< c_m
  double backlash = 0;   ///< b along the circumference; 0: the teeth touch on both flanks at once
  double onset = 0;      ///< width over which contact sets in, at most b; 0: exact corner
  double blur = 0;       ///< half width around such a corner in which the approach is only rounding error of the positions
  double exponent = 1;   ///< p: the force grows with x^p
  double reference = 1;  ///< x₀ > 0 at which the secant stiffness is k_m; irrelevant for p = 1
  /// C: teeth crowned by C (2y/b)² along the face touch over part of it only; 0: not crowned. Only with exponent 1.
  double crown = 0;
  Damping mode = Damping::always;
  MeshStiffness course;
  ToothRelief relief;
  TransmissionError error;
  MeshPhase mesh;

  /// Whether the force depends on the deflection in other ways than through flank().
  bool by_load() const { return course.loaded || relief.active(); }

  /// Force of a flank pressed in by x, divided by k_m: max(x, 0), rounded over `onset`; x₀ (x/x₀)^p; or, if crowned, the mean
  /// over the face of max(x − C (2y/b)², 0), which is ⅔ x √(x/C) up to x = C and x − C/3 beyond. The last two need no rounding.
  Function::Jet flank(double x) const;
  /// Its integral from −∞.
  double flank_integral(double x) const;
  /// max(x, 0), rounded over `onset`, or with slope ½ within ±`blur`. A start without load leaves the flanks just touching, and
  /// rounding errors must not decide in each iteration whether they do.
  Function::Jet ramp(double x) const;

  /// Response of a flank pressed in by `depth` if by_load() (exponent 1). With relief it is the sum over all pairs on the path,
  /// V = k_m/ε Σ w(ζ_j) ∫ flank(x − δ(ζ_j)) dx, ζ_j/p_b = τ/2π + flank + j. The path of back flanks is the mirror image, τ →
  /// −τ.
  Pressed pressed(double phase, double depth, bool back = false) const;
  /// With relief: w(ζ_j) (depth − δ(ζ_j)), positive if the pair of flanks touches, with derivatives with respect to the depth and
  /// to τ.
  struct PairDepth {
    double weighted = 0, by_depth = 0, by_phase = 0;
  };
  /// Of all pairs on the path, the one pressed in most first.
  std::vector<PairDepth> pair_depths(double phase, double depth, bool back) const;
  /// Largest number of pairs on the path.
  int most_pairs() const { return static_cast<int>(std::ceil(relief.contact_ratio() + relief.edge / relief.base_pitch)); }

  /// [[x]] of (28) for both flanks.
  Function::Jet deflection(double x) const;
  /// ∫ [[x]] dx: ½ [[x]]² where no corner is rounded; (28) divided by k_m.
  double deflection_integral(double x) const;
  /// ∫ k_m [[x]] dx
  double potential(double x) const { return stiffness * deflection_integral(x); }
  /// Contact state: −1 back flank, 0 in the backlash, 1 the flank with which A drives in the positive sense.
  int contact(double x) const { return contact(x, -backlash - x); }
  /// The same from the penetration of each flank, to within the rounding of the positions.
  int contact(double front, double back) const {
    if (front >= -blur) return 1;
    return back >= -blur ? -1 : 0;
  }

  /// [[x]] for the number type of x. Its derivative inside the backlash is 1e-9 instead of zero: negligible for dynamics and
  /// frequencies, but it lets statics move across to the flank that the load presses.
  template <class T>
  T elastic_deflection(const T& x) const {
    const Function::Jet d = deflection(value_of(x));
    return compose(x, d.f, std::max(d.d1, least_slope), d.d2);
  }
  static constexpr double least_slope = 1e-9;
  /// Half width of the rounding of a flank's damping limit, relative to the elastic force.
  static constexpr double limit_rounding = 0.1;

  /// Damping force, in addition to the elastic force. The flanks are pressed in by `front` and `back`, with the elastic forces
  /// `elastic_front` and `elastic_back`, and approach at `rate`. With Damping::contact the total force keeps the sign of the
  /// flank in contact: where c_m `rate` alone would make it pull, the damping cancels the elastic force and no more. The limit is
  /// rounded between 90 and 110 per cent of the elastic force, so that the law has a continuous slope.
  template <class T>
  T damping_force(const T& front, const T& back, const T& elastic_front, const T& elastic_back, const T& rate) const {
    if (mode == Damping::always) return damping * rate;
    return flank_damping(front, elastic_front, rate) - flank_damping(back, elastic_back, T(-rate));  // mirror images
  }

 private:
  Pressed pressed_pairs(double phase, double depth) const;
  /// Calls visit(w(ζ), δ(ζ)) for each pair on the path, with derivatives with respect to ζ.
  template <class Visit>
  void for_each_pair(double phase, const Visit& visit) const {
    const double pitch = relief.base_pitch, reach = 0.5 * relief.edge, cycle = phase / (2 * std::numbers::pi) + relief.flank;
    for (double j = std::ceil((-relief.approach - reach) / pitch - cycle); pitch * (cycle + j) < relief.recess + reach; ++j)
      visit(relief.present(pitch * (cycle + j)), relief.lacking(pitch * (cycle + j)));
  }
  template <class T>
  T flank_damping(const T& x, const T& elastic, const T& rate) const {
    const Function::Jet window = ramp(value_of(x));
    if (window.d1 == 0) return T(0);
    const T free = damping * compose(x, window.d1, window.d2, window.d3) * rate;
    if (value_of(free) >= 0) return free;
    constexpr double rounding = limit_rounding;
    if (value_of(free) <= -(1 + rounding) * value_of(elastic)) return -elastic;
    const T rest = 1 + free / elastic;  // remaining fraction of the elastic force
    const Function::Jet kept = rounded_ramp(value_of(rest), 2 * rounding);
    return elastic * (compose(rest, kept.f, kept.d1, kept.d2) - 1);
  }
};

/// c_m = 2ξ√(k_m m_e), (32), with m_e = I_A I_B/(I_A l_B² + I_B l_A²), (33). The levers l are r cosβ, along which u_m is
/// measured; for spur gears these are the paper's r. An infinite inertia represents a wheel that cannot turn.
double tooth_damping(double ratio, double stiffness, double inertia_a, double inertia_b, double lever_a, double lever_b);

}  // namespace engrane::elements::gears

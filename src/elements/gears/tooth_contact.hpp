// SPDX-License-Identifier: BSD-3-Clause
// Forces between meshing teeth, of two wheels or of a pinion and a rack.
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "elements/common/friction_law.hpp"
#include "elements/common/law_corners.hpp"
#include "elements/gears/gear_teeth.hpp"
#include "math/vector.hpp"
#include "model/templated_element.hpp"

namespace engrane::elements::gears {

/// Constant dimensions of the contact. Angles in radians; β is the paper's helix of wheel A.
struct ContactGeometry {
  double pressure_angle = 0;             ///< α_n
  double transverse_pressure_angle = 0;  ///< α_t; only of parallel axles
  double helix = 0;                      ///< β of A
  int teeth = 1;                         ///< z_A, which converts ψ_A into mesh phase
  double radius = 1;                     ///< pitch radius of A
  double width = 0;                      ///< face width, over which slices are distributed

  /// External: r_bA + r_bB, the sum of the base radii; internal: that of the pinion less that of the ring, negative; 0 for a
  /// rack, whose pressure angle is constant.
  double base_radii = 0;
  double center_distance = 0;  ///< of the reference configuration
  double reach = 0;            ///< by which the tips overlap: as cut (CutTeeth::tip_overlap()), else two addenda of m_n
  double side = 1;             ///< κ: 1 external, −1 internal
  double axle_sense = 1;       ///< σ: ξ₁ = σ μ₁
  /// Path of contact from the pitch point, in the direction in which A moves: front flanks touch from −approach to recess. For
  /// parallel axles, and for intersecting axles by their virtual wheels.
  double approach = 0, recess = 0;
  double base_pitch = 0;  ///< transverse
  /// Position of A's front flank from the middle of its tooth, in pitches, at the working pitch circle: a quarter without
  /// profile shift.
  double flank = 0.25;

  double turn_ratio = 0;     ///< ψ̇_B/ψ̇_A of rigid teeth
  double slip_per_turn = 0;  ///< sliding at the pitch point over ψ̇_A; zero for parallel or intersecting axles and racks

  /// From cosα_t′ = (a₀/a) cosα_t. `opening` is the distance by which the wheels have moved apart across the teeth.
  double working_pressure_angle(double opening) const;
  /// Opening of each flank, along the circumference, when the wheels move apart; for involutes (cosβ/cosα_t) (r_bA + r_bB)(inv
  /// α_t′ − inv α_t).
  Function::Jet flank_opening(double opening) const;
};

/// Friction between teeth: sliding at the pitch point, or of each pair of flanks along the path of contact, and rolling.
struct ToothFriction {
  FrictionLaw law;
  bool profile = false;  ///< each pair of flanks slides in proportion to its distance from the pitch point
  double rolling = 0;    ///< lever of the rolling resistance, a length
};

/// Options beyond the model of the original paper.
struct ContactOptions {
  bool separation = true;  ///< the radial force (34, 35)
  bool running = false;    ///< pressure angle and flanks follow the current distance of the axles
  int slices = 1;          ///< along the face width; more than 1 needs `running`
  std::optional<ToothFriction> friction;
};

/// One of the two toothed bodies in the current configuration, global components.
template <class T>
struct ToothedSide {
  Vec3T<T> axle;     ///< μ₁″ or ξ₁″
  Vec3T<T> arm;      ///< from the node to the contact point (10)
  Vec3T<T> eta_2;    ///< across the tooth, from A to B
  Vec3T<T> eta_3;    ///< normal to the tooth's middle plane
  Vec3T<T> forward;  ///< μ₃″ or ξ₃″
};

/// A wheel from its rotation R and angle ψ, by (4), (16) and (6) or (8). `triad`: columns μ or ξ in the reference
/// configuration; `tooth`: Y_A or Y_B.
template <class T>
ToothedSide<T> toothed_wheel(const Mat3& triad, const Mat3& tooth, double radius, const Mat3T<T>& R, const T& psi) {
  using std::cos, std::sin;
  const T c = cos(psi), s = sin(psi);
  const Vec3T<T> turned_2 = rotate(R, Vec3(triad.col(1))), turned_3 = rotate(R, Vec3(triad.col(2)));  // (4)
  ToothedSide<T> w;
  w.axle = rotate(R, Vec3(triad.col(0)));
  for (int k = 0; k < 3; ++k) {
    const T e_2 = turned_2[k] * c - turned_3[k] * s;  // (16)
    w.forward[k] = turned_2[k] * s + turned_3[k] * c;
    w.arm[k] = radius * e_2;
    w.eta_2[k] = tooth(0, 1) * w.axle[k] + tooth(1, 1) * e_2 + tooth(2, 1) * w.forward[k];
    w.eta_3[k] = tooth(0, 2) * w.axle[k] + tooth(1, 2) * e_2 + tooth(2, 2) * w.forward[k];
  }
  return w;
}

/// State of friction that can stick (GripState): the direction of sliding, or the force that holds it.
template <class T>
struct ToothGrip {
  int direction = 0;  ///< 1: as when ψ_A increases; −1: opposite; 0: not sliding in a known direction
  bool holds = false;
  T force = T(0);  ///< on A along its sliding on B; conjugate to ψ_A times ToothContact::grip_lever()

  /// Whether friction depends on the velocities alone.
  bool free() const { return direction == 0 && !holds; }
};

template <class T>
struct FlankPairs;

/// Forces of the teeth on A, with the opposite on B, and moments on A and B about their nodes. Frame loads also act on the
/// coordinate of a body's motion relative to the pair's frame; body loads do not.
template <class T>
struct ToothLoads {
  Vec3T<T> frame_force = Vec3T<T>(T(0), T(0), T(0)), body_force = frame_force;
  std::array<Vec3T<T>, 2> frame_moment{frame_force, frame_force}, body_moment{frame_force, frame_force};
};

/// Results of a contact.
struct ContactReport {
  std::array<Vec3, 2> force, moment;  ///< of the teeth on A and B, moments about the nodes, global components
  double approach = 0;                ///< u_m + x_err
  double front = 0, back = 0;         ///< penetration of each flank, at the middle of the face
  double opening = 0;                 ///< of the wheels, across the teeth
  double stiffness_factor = 1;        ///< of the mesh stiffness variation
  double potential = 0;
  double damping_power = 0, friction_power = 0, separation_power = 0;
  double sliding_speed = 0;     ///< at the pitch point
  double friction_force = 0;    ///< magnitude
  Vec3 sliding = Vec3::Zero();  ///< sliding velocity of the fastest flank, if there is friction
  double grip_limit = 0;        ///< largest friction force at rest
  double load = 0;              ///< of elastic teeth, along the circumference, damping included

  struct Slice {
    double force = 0;            ///< along the circumference
    double front = 0, back = 0;  ///< penetration of each flank
  };
  std::vector<Slice> slices;  ///< only if the wheels run at their current distance
};

/// The separating force (34) does work on the wheels when the centre distance changes; it counts as external.
inline Energies energies_of(const ContactReport& r) {
  return {0, r.potential, r.damping_power + r.friction_power, r.separation_power};
}

/// The contact of two toothed bodies: constraints (21)–(23) with their forces, the tooth law (28–33), and the options beyond
/// the paper. The element's scalars are ψ_A, the motion of B, and u_m with elastic teeth; its multipliers are those of φ₁, φ₂,
/// φ₃.
class ToothContact {
 public:
  ToothContact(const ContactGeometry& geometry, const ToothLaw& law, const ContactOptions& options)
      : geometry_(geometry),
        law_(law),
        options_(options),
        cos_alpha_(std::cos(geometry.pressure_angle)),
        sin_alpha_(std::sin(geometry.pressure_angle)),
        cos_beta_(std::cos(geometry.helix)) {
    if (elastic()) set_corners();
    if (options_.slices > 1) slice_crown_ = std::exchange(law_.crown, 0);
    if (parts()) law_.blur = 64 * std::numeric_limits<double>::epsilon() * geometry.radius;
  }

  const ContactGeometry& geometry() const { return geometry_; }
  const ToothLaw& law() const { return law_; }
  const ContactOptions& options() const { return options_; }
  bool elastic() const { return law_.stiffness > 0; }
  /// Whether SMOOTH rounds the onset of contact, so that the law differs from (28) for small penetrations.
  bool rounds_contact() const { return elastic() && law_.exponent == 1 && law_.crown == 0 && law_.onset > 0; }
  /// Force along the circumference of the more loaded flank, divided by k_m.
  double deflection(const ContactReport& report) const { return std::max(law_.flank(report.front).f, law_.flank(report.back).f); }
  /// Remarks for a run in which no flank was ever pressed in by more than `deflection` and the wheels moved apart by
  /// `opening` at most.
  std::vector<std::string> remarks(double deflection, double opening) const;
  double cos_alpha() const { return cos_alpha_; }

  /// Writes all residual rows except the parts of ψ_A and of B's motion due to (21) and the frame, which the element derives
  /// from `loads`. `closing` is φ₁/cosα_n without u_m. Returns the normal force kλ₁.
  template <class T>
  T act(const Motion<T, 2>& motion, const ToothedSide<T>& a, const ToothedSide<T>& b, const T& closing, Balance<T, 2>& balance,
        const ToothGrip<T>& grip, ToothLoads<T>& loads, ContactReport* report) const;
  /// Whether the friction can stick.
  bool grips() const { return options_.friction && options_.friction->law.rests; }
  /// The coordinate of friction at rest is this times ψ_A: the distance that A slides on B at the pitch point or, if flanks
  /// roll there and slide elsewhere, the distance along the pitch circle.
  double grip_lever() const { return options_.friction->profile ? geometry_.radius : geometry_.slip_per_turn; }

  /// Names of the switches where forces are not smooth: both ends of each rounded corner, or the corner itself; the limit of
  /// the damping of a flank in contact; the change of the load from one flank to the other, with whose magnitude the separating
  /// force and friction go; and the corners of tables and of straight relief, which the turning wheels pass.
  std::vector<SwitchNames> switch_names() const;
  /// Whether flanks may part or have no stiffness where they touch, with or without switches.
  bool has_gaps() const { return parts() || (elastic() && (law_.exponent != 1 || law_.crown > 0)); }
  /// Whether a flank, at the middle of the face, is in contact or open by no more than rounding.
  bool touches(const ContactReport& report, const State& state) const;
  /// Values of the switches; the history in `state` begins with the whole turns of the wheels that have no part in their angles.
  /// The rates neglect the changing distance of running axles and changes of the stiffness; this affects the search for events,
  /// not their location.
  void switches(const ContactReport& report, const State& state, std::span<Switch> values) const;

 private:
  /// Magnitude of the terms that the penetration of a flank is the difference of.
  double size_of_gap(const ContactReport& report, const State& state) const;
  /// Whether flanks come into contact and part.
  bool parts() const { return elastic() && (law_.backlash > 0 || options_.running); }
  bool limits_damping() const { return parts() && law_.mode == ToothLaw::Damping::contact && law_.damping > 0; }
  /// Whether the force between flanks, or the damping, has a corner where they touch at the middle of the face.
  bool corner_at_middle() const { return limits_damping() || (options_.slices == 1 && !law_.relief.active()); }
  /// Whether the separating force is (34, 35) and not the derivative of a potential.
  bool separates_by_load() const { return options_.separation && !(options_.running && elastic()); }
  /// Whether forces with the magnitude of the load have a corner where it changes its flank, and neither flank parts there.
  bool turns_load() const { return !limits_damping() && (separates_by_load() || options_.friction); }
  /// Corners of a periodic function of offset + slope ψ of a wheel: of the error of the teeth, their stiffness or relief.
  struct TurnCorners {
    LawCorners corners;
    std::string of;
    std::size_t wheel = 0;
    double slope = 1, offset = 0;
    int flank = 0;  ///< only while it is pressed in: 1 the front, −1 the back flank; 0: always
  };
  void set_corners();
  template <class T>
  void press(const Motion<T, 2>& motion, const ToothedSide<T>& a, const ToothedSide<T>& b, const Vec3T<T>& gap, const T& force_1,
             Balance<T, 2>& balance, ToothLoads<T>& loads, ContactReport* report) const;
  template <class T>
  void rub(const Motion<T, 2>& motion, const ToothedSide<T>& a, const ToothedSide<T>& b, const Vec3T<T>& gap, const T& force_1,
           const ToothGrip<T>& grip, ToothLoads<T>& loads, ContactReport* report) const;

  /// Path of contact along the line of action, from the pitch point, and the width over which flanks enter and leave it.
  struct Path {
    double low, high, edge;
  };
  /// `sense`: 1 if the front flanks of A's teeth carry load, −1 if the back flanks do.
  Path path(double sense) const;
  template <class T>
  FlankPairs<T> flanks(const T& psi_a, double sense) const;

  ContactGeometry geometry_;
  ToothLaw law_;
  ContactOptions options_;
  double cos_alpha_, sin_alpha_, cos_beta_;
  double slice_crown_ = 0;  ///< crowning, applied per slice
  std::vector<TurnCorners> corners_;
};

}  // namespace engrane::elements::gears

#include "elements/gears/tooth_contact_forces.hpp"
#include "elements/gears/tooth_friction_forces.hpp"

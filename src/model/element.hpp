// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/dimension.hpp"
#include "math/vector.hpp"

namespace engrane {

/// What an element needs of a node: nodes get unknowns only where some element asks for them.
enum class NodeNeed : unsigned char { translation = 1, rotation = 2, both = 3 };

/// A named scalar of an element: an unknown of its own, a multiplier, or an output channel.
struct Named {
  std::string name;     ///< upper case with underscores: `NORMAL_FORCE`
  Dimension dimension;  ///< of the value; of a multiplier: of its constraint
  std::string help;     ///< a few words, shown beside plots and in the listing
};

/// What a multiplier is, for those who speak of constraints without knowing the elements.
enum class Role : unsigned char {
  other,   ///< its help says what
  force,   ///< holds a point of one node on a line or place of the other, along one direction
  moment,  ///< holds the turn of one node from the other about one direction
  drive,   ///< imposes a motion: can be left out, and is what asks for too much when nothing else does
  tooth    ///< holds the flanks of rigid teeth together
};

/// The multiplier of one holonomic constraint: `{"TOOTH", dimension::length, "normal force", Role::tooth}`.
struct Multiplier : Named {
  Role role = Role::other;
};

/// One change of an element that gives up some of its constraints, as advice against redundant ones.
struct Release {
  std::string change;            ///< "make {} a SPHERICAL", with {} for the element
  std::vector<int> multipliers;  ///< given up by it: indices into Layout::multipliers, ascending
  std::string what;              ///< "moment about the second axis"; may be empty
};

/// What happens when a switch of an element changes sign, in words for the listing: `front flank touches`.
struct SwitchNames {
  std::string rises;  ///< from negative to positive
  std::string falls;
};

/// A scalar function of the state whose sign tells phases of an element's motion apart, such as a gap that is open or closed.
struct Switch {
  double value = 0;
  double rate = 0;  ///< its time derivative
  double size =
      0;  ///< of the terms that `value` is the sum of: what is rounding, and what is not; 0: the switch has no meaning now
};

/// Which unknowns an element works on. Its local slots, in order: six per node (three translations, three material
/// rotation increments, whether the node has them or not; node 0, the ground, too), its scalars, its multipliers.
struct Layout {
  std::vector<int> nodes;               ///< ids; 0 is the ground
  std::vector<NodeNeed> needs;          ///< one per node
  std::vector<Named> scalars;           ///< own unknowns with rates, such as ψ_A, ψ_B, u_m
  std::vector<Multiplier> multipliers;  ///< one per holonomic constraint, in the order of the residual's constraint rows
  int history = 0;                      ///< committed numbers kept from step to step (turn counts, contact states)
  std::vector<SwitchNames> switches;    ///< where the element's law is not smooth: dynamics places ends of steps there

  int slots() const { return static_cast<int>(6 * nodes.size() + scalars.size() + multipliers.size()); }
};

/// Motion of a node. Translations in global components, rotations by the matrix R that turns the reference
/// orientation (global axes) into the current one, angular velocity and acceleration in material components.
struct NodeState {
  Vec3 x = Vec3::Zero();
  Mat3 R = Mat3::Identity();
  Vec3 v = Vec3::Zero(), W = Vec3::Zero();
  Vec3 a = Vec3::Zero(), A = Vec3::Zero();
  Mat3 T = Mat3::Identity();  ///< material increment of R per increment of the step's rotation vector; identity outside a step
};

/// Everything an element may look at. The spans view arrays owned by the caller.
struct State {
  std::span<const NodeState> nodes;  ///< in the order of Layout::nodes
  std::span<const double> scalars;   ///< values of the own unknowns
  std::span<const double> scalar_rates;
  std::span<const double> scalar_accelerations;
  std::span<const double> multipliers;  ///< kλ, in units of force or moment
  std::span<const double> history;      ///< as committed at the end of the last step
  double time = 0;
  Vec3 gravity = Vec3::Zero();
  double penalty = 0;  ///< p of the augmented Lagrangian (paper, eq. 2)
  /// Part of a contact's stiffness that acts across its open gap as well, 0 but while statics looks for the flanks that
  /// carry: with 1 contacts are springs, and there is always a way from one flank to the other.
  double contact_homotopy = 0;
};

/// Weights of a tangent: cq ∂r/∂q + cv ∂r/∂v + ca ∂r/∂a in the columns of nodes and scalars; those of multipliers are
/// ∂r/∂(kλ) whatever the weights.
struct Weights {
  double q = 1;
  double v = 0;
  double a = 0;
};

/// Energies held by an element and power that flows through it. Positive `dissipated` leaves the system; positive
/// `external` enters it.
struct Energies {
  double kinetic = 0;
  double potential = 0;
  double dissipated = 0;  ///< power
  double external = 0;    ///< power of applied forces and drives
};

/// A shape that stands for the element in pictures (docs/format.md), as JSON members without braces.
using Drawing = std::vector<std::string>;

/// One line of `engrane check`: a derived quantity of the element, such as a pitch radius.
struct Derived {
  std::string name;
  double value = 0;
  Dimension dimension;
};

/// A finite element or joint. Elements are constant after building, know nothing of assembly and nothing of each other.
///
/// The residual is r = M a + g(q, v, t) − B(kλ − pΦ) in the node and scalar slots (forces in global components, moments
/// in material components of the node) and −Φ in the multiplier slots, so that the static tangent of conservative
/// elements is symmetric (paper, eqs. 1–3). All arrays have Layout::slots() entries, tangents are row-major squares;
/// both are overwritten.
class Element {
 public:
  explicit Element(int id) : id_(id) {}
  virtual ~Element() = default;
  Element(const Element&) = delete;
  Element& operator=(const Element&) = delete;

  int id() const { return id_; }
  virtual const Layout& layout() const = 0;

  virtual void residual(const State& state, std::span<double> r) const = 0;
  /// The residual and its tangent in one call, since they share their work. Columns of rotations are per increment of
  /// the step's rotation vector (NodeState::T).
  virtual void tangent(const State& state, Weights weights, std::span<double> r, std::span<double> k) const = 0;
  /// Φ with its first and second time derivative along the motion in `state`; one entry per multiplier.
  virtual void constraint_rates(const State& state, std::span<double> phi, std::span<double> rate,
                                std::span<double> second) const = 0;

  /// Initial values of own unknowns and history in the reference configuration.
  virtual void start(std::span<double> scalars, std::span<double> history) const;
  /// Called when a step is accepted: writes the new history; may shift own scalars by whole periods.
  virtual void commit(const State& state, std::span<double> scalars, std::span<double> history) const;

  /// Values of the switches, in the order of Layout::switches.
  virtual void switches(const State& state, std::span<Switch> values) const;

  virtual Energies energies(const State& state) const;

  /// Inertia tensor that the element gives to one of its nodes, about the node, in reference (global) components.
  virtual Mat3 inertia_at(int node) const;

  /// Output channels and their values in the order of `channels()`.
  virtual const std::vector<Named>& channels() const;
  virtual void observe(const State& state, std::span<double> values) const;

  /// Changes that hold less, the usual ones of machines first.
  virtual std::vector<Release> releases() const;
  /// Whether the element makes its nodes a body that can have mass; advice against motions that no inertia resists looks here.
  virtual bool is_body() const { return false; }

  virtual std::vector<Derived> derived() const;
  virtual Drawing drawing() const;

 private:
  int id_;
};

}  // namespace engrane

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <concepts>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "base/dimension.hpp"
#include "math/vector.hpp"

namespace engrane {

/// Node unknowns an element needs; a node has only the unknowns that some element needs. `in_plane`: translations along x and y
/// only.
enum class NodeNeed : unsigned char { translation = 1, rotation = 2, both = 3, in_plane = 4 };

/// Shape of a mesh cell. Its nodes are the corners, then the mid-side nodes, starting with the side between the first two
/// corners. Solids: corners of the base, corners of the top, then mid-side nodes of the base, of the top, and of the edges
/// between.
enum class CellShape : unsigned char {
  none,
  triangle,
  triangle6,
  quadrilateral,
  quadrilateral8,
  tetrahedron,
  tetrahedron10,
  wedge,
  wedge15,
  hexahedron,
  hexahedron20
};

/// A named scalar quantity.
struct Named {
  std::string name;     ///< upper case with underscores: `NORMAL_FORCE`
  Dimension dimension;  ///< of the value; for a multiplier: of its constraint
  std::string help;     ///< a few words, shown beside plots and in the listing
};

/// A result of an element, a node or the run at each instant.
struct Channel : Named {
  /// How the value varies between two instants at which it is known.
  enum class Course : unsigned char {
    smooth,  ///< interpolated by a polynomial
    size,    ///< square root of a polynomial interpolating the square: magnitude of a vector, which has a corner near zero
    ratio,   ///< linear: quotient of two results that may vanish together, where it jumps
    state,   ///< value of the nearer instant: takes few discrete values, such as whether teeth are in contact
    step     ///< value of the later instant: refers to the whole step
  };
  Course course = Course::smooth;
  /// Limits of the value: polynomials across the corner where it reaches one do not exceed it.
  double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
};

/// An internal unknown of an element.
struct Scalar : Named {
  /// A signal that commands a force or a moment: its equation is one of signals in the unit of that load, not a balance of loads.
  bool signal = false;
};

/// Element results with too many values for channels: stresses at the Gauss points, section forces along a beam.
struct Field : Named {
  enum class Place : unsigned char { element, node, point };
  Place place = Place::element;
  std::vector<std::string> components = {};  ///< `XX`, `YY`, `XY`; empty: a scalar
  int points = 1;                            ///< for Place::point: number of points per element
  bool averaged = false;                     ///< also extrapolated to the nodes and averaged there (Element::section)

  std::size_t width() const { return components.empty() ? 1 : components.size(); }
  /// Number of values on an element with this many nodes.
  std::size_t size(std::size_t nodes) const {
    const std::size_t places = place == Place::node ? nodes : place == Place::point ? static_cast<std::size_t>(points) : 1;
    return places * width();
  }
};

/// Mechanical meaning of a multiplier, for code that handles constraints without knowing the elements.
enum class Role : unsigned char {
  other,   ///< described by its help text
  force,   ///< keeps a point of one node on a line or at a point of the other node, along one direction
  moment,  ///< prevents relative rotation of two nodes about one direction
  drive,   ///< imposes a motion: may be left out, and is blamed for overdetermination if nothing else is
  tooth,   ///< keeps the flanks of rigid teeth in contact
  grip     ///< static dry friction: a constraint only while the surfaces stick (Layout::grips)
};

/// The multiplier of one holonomic constraint: `{"TOOTH", dimension::length, "normal force", Role::tooth}`.
struct Multiplier : Named {
  Role role = Role::other;
};

/// A change of an element that releases some of its constraints, suggested as a remedy for redundant ones.
struct Release {
  std::string change;            ///< "make {} a SPHERICAL", with {} for the element
  std::vector<int> multipliers;  ///< released by it: indices into Layout::multipliers, ascending
  std::string what;              ///< "moment about the second axis"; may be empty
};

/// Names for the listing of the two sign changes of a switch: `front flank touches`.
struct SwitchNames {
  std::string rises;  ///< from negative to positive
  std::string falls;
  /// Forces only bend there, with little effect on the motion: steps end there only where forces within steps are asked for
  /// (SolverOptions::bends).
  bool bend = false;
  int multiplier = -1;  ///< its value is that of this multiplier of the element; −1: it is a function of the motion
};

/// Switch function of the state: its sign separates phases of an element's motion, such as an open and a closed gap.
struct Switch {
  double value = 0;
  double rate = 0;  ///< its time derivative; NaN: unknown
  double size = 0;  ///< magnitude of the terms that sum to `value`, for judging rounding errors; 0: the switch is inactive

  /// A switch closer to zero than this fraction of its terms is at rounding level.
  static constexpr double rounding = 1e-13;
  /// Whether it is active and its sign is rounding.
  bool unclear() const { return size != 0 && std::abs(value) <= rounding * size; }
};

/// Dry friction with a sticking phase.
struct GripShape {
  int size = 1;                          ///< number of coordinates along which the surfaces slide: 1 to 3
  std::array<double, 3> lever{1, 1, 1};  ///< per coordinate: sliding speed over the rate of the coordinate
};

/// The unknowns an element works on. Its local slots are, in order: the unknowns it needs of each node including the ground
/// (three translations, or two in the plane; three material rotation increments), its scalars, its multipliers.
struct Layout {
  std::vector<int> nodes;               ///< ids; 0 is the ground
  std::vector<NodeNeed> needs;          ///< one per node
  std::vector<Scalar> scalars;          ///< internal unknowns with rates, such as ψ_A, ψ_B, u_m
  std::vector<Multiplier> multipliers;  ///< one per holonomic constraint, in the order of the residual's constraint rows
  /// True: the element uses the multipliers of the nearest preceding element that has its own. Each constraint is then a sum
  /// over these elements, and each element writes its contribution. The cost of a constraint on many nodes is thus linear in
  /// their number.
  bool shares_multipliers = false;
  int history = 0;  ///< number of committed values kept from step to step (turn counts, contact states)
  /// Dry frictions with a sticking phase. Their multipliers come last, with Role::grip, one per coordinate of sliding. Φ is the
  /// coordinate minus its value at the sticking position, and the force on it is static friction. Their GripStates
  /// (model/grip.hpp) are the last values of the history.
  std::vector<GripShape> grips;
  int slides = 0;                     ///< number of dry frictions regularised near zero speed (Element::sliding)
  std::vector<SwitchNames> switches;  ///< where the element's law is not smooth; in dynamics, steps end at their sign changes

  /// Dry friction of either kind.
  bool has_friction() const { return slides > 0 || !grips.empty(); }
  bool needs_any(std::size_t node, NodeNeed what) const {
    return (static_cast<unsigned>(needs[node]) & static_cast<unsigned>(what)) != 0;
  }
  /// Whether it needs a component of a node: 0 to 2 translations, 3 to 5 rotations.
  bool has(std::size_t node, int component) const {
    return needs_any(node, component < 3 ? NodeNeed::translation : NodeNeed::rotation) ||
           (component < 2 && needs_any(node, NodeNeed::in_plane));
  }
  /// First slot of a node's translations (three, or two in the plane) or rotations; −1 if the element does not need them.
  int node_slot(std::size_t node, NodeNeed what) const {
    if (!needs_any(node, what)) return -1;
    int slot = what == NodeNeed::rotation && needs_any(node, NodeNeed::translation) ? 3 : 0;
    for (std::size_t i = 0; i < node; ++i) slot += width(i);
    return slot;
  }
  int node_slots() const {
    int count = 0;
    for (std::size_t i = 0; i < needs.size(); ++i) count += width(i);
    return count;
  }
  /// Number of multipliers it adds to the system.
  std::size_t own_multipliers() const { return shares_multipliers ? 0 : multipliers.size(); }
  int slots() const { return node_slots() + static_cast<int>(scalars.size() + multipliers.size()); }
  /// First multiplier of a grip. grip_row(0) is the number of multipliers that belong to no grip.
  int grip_row(std::size_t grip = 0) const {
    auto row = static_cast<int>(multipliers.size());
    for (std::size_t i = grip; i < grips.size(); ++i) row -= grips[i].size;
    return row;
  }

 private:
  int width(std::size_t node) const {
    return (needs_any(node, NodeNeed::translation) ? 3
            : needs_any(node, NodeNeed::in_plane)  ? 2
                                                   : 0) +
           (needs_any(node, NodeNeed::rotation) ? 3 : 0);
  }
};

/// Motion of a node. Translations are in global components. R rotates the reference orientation (global axes) into the current
/// one. Angular velocity and acceleration are in material components.
struct NodeState {
  Vec3 x = Vec3::Zero();
  Mat3 R = Mat3::Identity();
  Vec3 v = Vec3::Zero(), W = Vec3::Zero();
  Vec3 a = Vec3::Zero(), A = Vec3::Zero();
  Mat3 T = Mat3::Identity();  ///< material increment of R per increment of the step's rotation vector; identity outside a step
};

/// View of an element's nodes within a larger array.
class NodeStates {
 public:
  NodeStates() = default;
  /// All of a vector, array or span, in order.
  template <class Nodes>
  requires std::convertible_to<const Nodes&, std::span<const NodeState>> NodeStates(
      const Nodes& nodes) {  // NOLINT(google-explicit-constructor): a view, as a span is
    const std::span<const NodeState> all(nodes);
    all_ = all.data();
    size_ = all.size();
  }
  /// The nodes at the positions `index`. `remainders`: Configuration::remainders; empty: all are zero.
  NodeStates(std::span<const NodeState> all, std::span<const int> index, std::span<const double> remainders = {})
      : all_(all.data()), index_(index.data()), remainders_(remainders.data()), size_(index.size()) {}

  const NodeState& operator[](std::size_t i) const { return all_[index_ ? static_cast<std::size_t>(index_[i]) : i]; }
  std::size_t size() const { return size_; }
  /// What rounding has left of the position: x − X + rest is the displacement from X, also where it is below the rounding of x.
  Vec3 rest(std::size_t i) const {
    return remainders_ ? Vec3(Eigen::Map<const Vec3>(remainders_ + 6 * (index_ ? static_cast<std::size_t>(index_[i]) : i)))
                       : Vec3(Vec3::Zero());
  }
  NodeStates first(std::size_t count) const {
    NodeStates part = *this;
    part.size_ = count;
    return part;
  }

 private:
  const NodeState* all_ = nullptr;
  const int* index_ = nullptr;
  const double* remainders_ = nullptr;
  std::size_t size_ = 0;
};

/// Gravity that functions of time give, as a load.
struct VaryingGravity {
  Vec3 acceleration = Vec3::Zero();
  Vec3 rate = Vec3::Zero();
};

/// Everything an element may depend on. The spans view arrays owned by the caller.
struct State {
  NodeStates nodes;                 ///< in the order of Layout::nodes
  std::span<const double> scalars;  ///< values of the internal unknowns
  std::span<const double> scalar_rates;
  std::span<const double> scalar_accelerations;
  std::span<const double> multipliers;  ///< kλ, in units of force or moment
  std::span<const double> history;      ///< as committed at the end of the last step
  double time = 0;
  double h = 0;                 ///< length of the step that ends at `time`; 0 if there is none, as in statics and at the start
  Vec3 gravity = Vec3::Zero();  ///< all of it
  const VaryingGravity* varying = nullptr;  ///< the part that depends on time; nullptr: none does
  double penalty = 0;                       ///< p of the augmented Lagrangian (paper, eq. 2)
  /// Fraction of the contact stiffness that also acts across an open gap. It is 0 except while statics searches for the flanks
  /// in contact. With 1, contacts are linear springs, so that a path always leads from one flank to the other.
  double contact_homotopy = 0;

  Vec3 steady_gravity() const { return varying ? Vec3(gravity - varying->acceleration) : gravity; }
};

/// Weights of a tangent: cq ∂r/∂q + cv ∂r/∂v + ca ∂r/∂a in the columns of nodes and scalars, cλ ∂r/∂(kλ) in those of
/// multipliers. {1, 0, 0, 0}, {0, 1, 0, 0} and {0, 0, 1, 0} give K, C and M alone.
struct Weights {
  double q = 1;
  double v = 0;
  double a = 0;
  double multipliers = 1;
};

/// Energies stored in an element and power flowing through it. Positive `dissipated` leaves the system; positive `external`
/// enters it.
struct Energies {
  double kinetic = 0;
  double potential = 0;
  double dissipated = 0;  ///< power
  double external = 0;    ///< power of applied forces and drives
  double strain = 0;      ///< part of `potential` that mesh cells store as strain energy

  /// Adds what gravity does to a mass at x with the velocity v. Constant gravity has a potential; gravity that depends on time
  /// does work, as other loads do, since with a potential that changes by itself no energy balance would close.
  void add_weight(const State& state, double mass, const Vec3& x, const Vec3& v) {
    potential -= mass * state.steady_gravity().dot(x);
    if (state.varying) external += mass * state.varying->acceleration.dot(v);
  }
};

/// Half the squared energy norm ∫ S·C⁻¹S dV of an element's stress S (second Piola–Kirchhoff for large displacements, with
/// moduli C), and of the difference between another stress and S.
struct StressEnergies {
  double stress = 0;
  double difference = 0;
};

/// Shapes that represent the element in pictures (docs/format.md), as JSON members without braces.
using Drawing = std::vector<std::string>;

/// One line of `engrane check`: a derived quantity of the element, such as a pitch radius.
struct Derived {
  std::string name;
  double value = 0;
  Dimension dimension;
  bool bound = false;  ///< the quantity only bounds a motion, which may never reach it: "no lower limit" is often MIN -1E9
};

/// A finite element or joint. Elements are immutable after building and know neither the assembly nor each other.
///
/// The residual is r = M a + g(q, v, t) − B(kλ − pΦ) in the node and scalar slots (forces in global components, moments in
/// material components of the node) and −Φ in the multiplier slots, so that the static tangent of conservative elements is
/// symmetric (paper, eqs. 1–3). Vectors have Layout::slots() entries; tangents are square and row-major. Both are overwritten.
class Element {
 public:
  explicit Element(int id) : id_(id) {}
  virtual ~Element() = default;
  Element(const Element&) = delete;
  Element& operator=(const Element&) = delete;

  int id() const { return id_; }
  virtual const Layout& layout() const = 0;
  /// Ids of its nodes. Use this rather than Layout::nodes, which an element of a block shares with others and which only marks
  /// the ground.
  virtual std::span<const int> node_ids() const { return layout().nodes; }

  virtual void residual(const State& state, std::span<double> r) const = 0;
  /// Residual and tangent in one call, as they share work. Columns of rotations are per increment of the step's rotation vector
  /// (NodeState::T).
  virtual void tangent(const State& state, Weights weights, std::span<double> r, std::span<double> k) const = 0;
  /// Φ with its first and second time derivatives along the motion in `state`; one entry per multiplier.
  virtual void constraint_rates(const State& state, std::span<double> phi, std::span<double> rate,
                                std::span<double> second) const = 0;

  /// Initial values of internal unknowns and history in the reference configuration.
  virtual void start(std::span<double> scalars, std::span<double> history) const;
  /// Updates turn counts and similar history that only tracks the position of the element. Called when a step is accepted and
  /// during the search for a position. Writes the new history and may shift internal unknowns by whole periods. The default
  /// copies the history.
  virtual void count_turns(const State& state, std::span<double> scalars, std::span<double> history) const;
  /// Called only when a step is accepted. Writes the new history including path-dependent state (plastic strain, sticking). The
  /// default calls count_turns().
  virtual void commit(const State& state, std::span<double> scalars, std::span<double> history) const;

  /// Values of the switches, in the order of Layout::switches.
  virtual void switches(const State& state, std::span<Switch> values) const;
  /// Whether forces act across gaps that statics may have to bridge (State::contact_homotopy), and whether such a gap is closed
  /// or open by no more than rounding. By default the switches tell.
  virtual bool has_gaps() const { return !layout().switches.empty(); }
  virtual bool touches(const State& state) const;

  /// Sliding velocity of each regularised friction, divided by its regularisation speed, in any axes. Newton's iteration uses
  /// it to avoid jumping across the regularised range from one sliding direction to the opposite one.
  virtual void sliding(const State& state, std::span<Vec3> speeds) const;
  /// Limit of static friction of each grip, a force or moment: static coefficient times normal load.
  virtual void grip_limits(const State& state, std::span<double> limits) const;

  virtual Energies energies(const State& state) const;
  /// External forces on the nodes, in the slots of the layout: loads and weight. If there are none, returns false and writes
  /// nothing.
  virtual bool applied(const State& /*state*/, std::span<double> /*forces*/) const { return false; }
  virtual CellShape cell_shape() const { return CellShape::none; }
  /// Whether it is a piece of an elastic body that resists every change of shape: a cell or a beam, but no membrane.
  virtual bool keeps_shape() const { return false; }
  /// Whether its forces depend on displacements with what rounding has left of them (NodeStates::rest), not on positions.
  virtual bool sees_remainders() const { return false; }
  /// Whether its tangent turns with its nodes: a rigid-body motion changes no force in axes that move along.
  virtual bool turns_with_nodes() const { return keeps_shape() || cell_shape() != CellShape::none; }
  /// Whether the element has its own entity in the mesh of the results; a pressure, for example, is part of its cell.
  virtual bool in_mesh() const { return true; }

  /// Inertia tensor that the element contributes to one of its nodes, about the node, in reference (global) components.
  virtual Mat3 inertia_at(int node) const;

  /// Output channels and their values in the order of `channels()`.
  virtual const std::vector<Channel>& channels() const;
  virtual void observe(const State& state, std::span<double> values) const;

  /// Fields and all their values: field by field, within each place by place, within each component by component.
  virtual const std::vector<Field>& fields() const;
  virtual void evaluate_fields(const State& state, std::span<double> values) const;

  /// Section of the element, numbered from 0. Stresses are continuous within a section: fields with Field::averaged are
  /// averaged at nodes shared by elements of one section. −1: the element has no such fields.
  virtual int section() const { return -1; }
  /// Matrix that maps a field's values at its points to its nodes: nodes × points. nullptr for an element without section.
  virtual const Eigen::MatrixXd* extrapolation() const { return nullptr; }
  /// Energies of the element's stress and of its deviation from the stress interpolated from `at_nodes`, whose rows are the
  /// components of its field STRESS at each node.
  virtual StressEnergies stress_energies(const State& /*state*/, std::span<const double> /*at_nodes*/) const { return {}; }

  /// Changes that release constraints, those most common in machines first.
  virtual std::vector<Release> releases() const;
  /// Whether the element makes its nodes a body that can have mass; used for advice on motions without inertia.
  virtual bool is_body() const { return false; }
  /// Whether the element is a force or moment that the deck gives.
  virtual bool is_load() const { return false; }
  /// Whether the static forces are linear in the displacements, so that one tangent is valid for every equilibrium. Without
  /// multipliers this tangent must be symmetric, as such forces have a potential.
  virtual bool is_linear() const { return false; }

  /// If the forces are not finite: the reason and a remedy, to follow the element's name in a message. Empty if unknown.
  virtual const char* why_not_finite() const { return ""; }

  /// Warnings for the user at the end of a run, from the last committed history: sentences without the element's name.
  virtual std::vector<std::string> remarks(std::span<const double> /*history*/) const { return {}; }

  virtual std::vector<Derived> derived() const;
  virtual Drawing drawing() const;

 private:
  int id_;
};

}  // namespace engrane

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <concepts>
#include <span>
#include <string>
#include <vector>

#include "base/dimension.hpp"
#include "math/vector.hpp"

namespace engrane {

/// What an element needs of a node: nodes get unknowns only where some element asks for them. `in_plane`: translations along x
/// and y alone.
enum class NodeNeed : unsigned char { translation = 1, rotation = 2, both = 3, in_plane = 4 };

/// What a cell of a mesh looks like; its nodes are the corners, then the mid-side nodes from the side of the first two on. Of a
/// solid: the corners of its base and of its top, then the middles of the sides of the base, of the top, and of those between.
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

/// A scalar with a name.
struct Named {
  std::string name;     ///< upper case with underscores: `NORMAL_FORCE`
  Dimension dimension;  ///< of the value; of a multiplier: of its constraint
  std::string help;     ///< a few words, shown beside plots and in the listing
};

/// A result of an element, a node or the run at each instant.
struct Channel : Named {
  /// What is between two instants at which the value is known.
  enum class Course : unsigned char {
    smooth,  ///< the values of a polynomial
    size,    ///< the root of a polynomial of squares: the size of a vector, which has a corner where that passes near zero
    ratio,   ///< a straight line: of two results that may pass through zero together, where the ratio jumps
    state,   ///< the value of the nearer one: it has a few values only, such as whether teeth touch
    step     ///< the value of the later one: it tells of the whole step
  };
  Course course = Course::smooth;
};

/// An unknown of an element's own.
struct Scalar : Named {
  bool first_order = false;  ///< its equation holds its rate, and no acceleration: the state of a controller
};

/// Results of an element that are too many for channels: a stress at every Gauss point, section forces along a beam.
struct Field : Named {
  enum class Place : unsigned char { element, node, point };
  Place place = Place::element;
  std::vector<std::string> components = {};  ///< `XX`, `YY`, `XY`; none: a scalar
  int points = 1;                            ///< of Place::point: how many an element has
  bool averaged = false;                     ///< extrapolated to the nodes as well, and averaged there (Element::section)

  /// How many numbers it has on an element of so many nodes.
  std::size_t size(std::size_t nodes) const {
    const std::size_t places = place == Place::node ? nodes : place == Place::point ? static_cast<std::size_t>(points) : 1;
    return places * (components.empty() ? 1 : components.size());
  }
};

/// What a multiplier is, for those who speak of constraints without knowing the elements.
enum class Role : unsigned char {
  other,   ///< its help says what
  force,   ///< holds a point of one node on a line or place of the other, along one direction
  moment,  ///< holds the turn of one node from the other about one direction
  drive,   ///< imposes a motion: can be left out, and is what asks for too much when nothing else does
  tooth,   ///< holds the flanks of rigid teeth together
  grip     ///< dry friction at rest: a constraint only while its surfaces do not slide (Layout::grips)
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
  double rate = 0;  ///< its time derivative; NaN: unknown
  double size =
      0;  ///< of the terms that `value` is the sum of: what is rounding, and what is not; 0: the switch has no meaning now
};

/// A dry friction that can rest.
struct GripShape {
  int size = 1;                          ///< how many coordinates its surfaces slide along: 1 to 3
  std::array<double, 3> lever{1, 1, 1};  ///< of each: speed of sliding over the rate of the coordinate
};

/// Which unknowns an element works on. Its local slots, in order: those that it asks of each node (three translations, or two in
/// the plane, three material rotation increments; of node 0, the ground, too), its scalars, its multipliers.
struct Layout {
  std::vector<int> nodes;               ///< ids; 0 is the ground
  std::vector<NodeNeed> needs;          ///< one per node
  std::vector<Scalar> scalars;          ///< own unknowns with rates, such as ψ_A, ψ_B, u_m
  std::vector<Multiplier> multipliers;  ///< one per holonomic constraint, in the order of the residual's constraint rows
  /// The multipliers are those of the nearest element before it that has its own: their constraints are sums over such elements,
  /// each of which writes its share. A constraint on many nodes so costs in proportion to their number.
  bool shares_multipliers = false;
  int history = 0;  ///< committed numbers kept from step to step (turn counts, contact states)
  /// Dry frictions that can rest. The last multipliers are theirs, with Role::grip, one for each coordinate along which the
  /// surfaces slide: Φ is the coordinate less the place where they rest, and the force on it is the friction at rest. The last
  /// numbers of the history are their GripStates (model/grip.hpp).
  std::vector<GripShape> grips;
  int slides = 0;                     ///< dry frictions that are regularised at rest (Element::sliding)
  std::vector<SwitchNames> switches;  ///< where the element's law is not smooth: dynamics places ends of steps there

  bool needs_any(std::size_t node, NodeNeed what) const {
    return (static_cast<unsigned>(needs[node]) & static_cast<unsigned>(what)) != 0;
  }
  /// Whether it asks for a component of a node: 0 to 2 translations, 3 to 5 rotations.
  bool has(std::size_t node, int component) const {
    return needs_any(node, component < 3 ? NodeNeed::translation : NodeNeed::rotation) ||
           (component < 2 && needs_any(node, NodeNeed::in_plane));
  }
  /// First slot of a node's three translations or rotations, or of its two in the plane; −1 when the element does not ask for
  /// them.
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
  /// How many multipliers it brings into the system.
  std::size_t own_multipliers() const { return shares_multipliers ? 0 : multipliers.size(); }
  int slots() const { return node_slots() + static_cast<int>(scalars.size() + multipliers.size()); }
  /// The first multiplier of a grip, or where those of all other constraints end.
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

/// Motion of a node. Translations in global components, rotations by the matrix R that turns the reference
/// orientation (global axes) into the current one, angular velocity and acceleration in material components.
struct NodeState {
  Vec3 x = Vec3::Zero();
  Mat3 R = Mat3::Identity();
  Vec3 v = Vec3::Zero(), W = Vec3::Zero();
  Vec3 a = Vec3::Zero(), A = Vec3::Zero();
  Mat3 T = Mat3::Identity();  ///< material increment of R per increment of the step's rotation vector; identity outside a step
};

/// An element's nodes, where they stand in a larger array.
class NodeStates {
 public:
  NodeStates() = default;
  /// All of a vector, array or span, in its order.
  template <class Nodes>
  requires std::convertible_to<const Nodes&, std::span<const NodeState>> NodeStates(
      const Nodes& nodes) {  // NOLINT(google-explicit-constructor): a view, as a span is
    const std::span<const NodeState> all(nodes);
    all_ = all.data();
    size_ = all.size();
  }
  /// Those at `index`.
  NodeStates(std::span<const NodeState> all, std::span<const int> index)
      : all_(all.data()), index_(index.data()), size_(index.size()) {}

  const NodeState& operator[](std::size_t i) const { return all_[index_ ? static_cast<std::size_t>(index_[i]) : i]; }
  std::size_t size() const { return size_; }
  NodeStates first(std::size_t count) const {
    NodeStates part = *this;
    part.size_ = count;
    return part;
  }

 private:
  const NodeState* all_ = nullptr;
  const int* index_ = nullptr;
  std::size_t size_ = 0;
};

/// Everything an element may look at. The spans view arrays owned by the caller.
struct State {
  NodeStates nodes;                 ///< in the order of Layout::nodes
  std::span<const double> scalars;  ///< values of the own unknowns
  std::span<const double> scalar_rates;
  std::span<const double> scalar_accelerations;
  std::span<const double> multipliers;  ///< kλ, in units of force or moment
  std::span<const double> history;      ///< as committed at the end of the last step
  double time = 0;
  double h = 0;  ///< length of the step that ends at `time`; 0 where there is none, as in statics and at the start
  Vec3 gravity = Vec3::Zero();
  double penalty = 0;  ///< p of the augmented Lagrangian (paper, eq. 2)
  /// Part of a contact's stiffness that acts across its open gap as well, 0 but while statics looks for the flanks that
  /// carry: with 1 contacts are springs, and there is always a way from one flank to the other.
  double contact_homotopy = 0;
};

/// Weights of a tangent: cq ∂r/∂q + cv ∂r/∂v + ca ∂r/∂a in the columns of nodes and scalars, cλ ∂r/∂(kλ) in those of
/// multipliers. K, C and M apart are {1, 0, 0, 0}, {0, 1, 0, 0} and {0, 0, 1, 0}.
struct Weights {
  double q = 1;
  double v = 0;
  double a = 0;
  double multipliers = 1;
};

/// Energies held by an element and power that flows through it. Positive `dissipated` leaves the system; positive
/// `external` enters it.
struct Energies {
  double kinetic = 0;
  double potential = 0;
  double dissipated = 0;  ///< power
  double external = 0;    ///< power of applied forces and drives
  double strain = 0;      ///< part of `potential` that cells of a mesh hold as strain
};

/// Half the square of the energy norm ∫ S·C⁻¹S dV of an element's stress S (second Piola–Kirchhoff where displacements are large,
/// C its moduli), and of the difference between another stress and it.
struct StressEnergies {
  double stress = 0;
  double difference = 0;
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
  /// Ids of its nodes. An element of a block shares its layout with others, which tells only nodes on the ground from others.
  virtual std::span<const int> node_ids() const { return layout().nodes; }

  virtual void residual(const State& state, std::span<double> r) const = 0;
  /// The residual and its tangent in one call, since they share their work. Columns of rotations are per increment of
  /// the step's rotation vector (NodeState::T).
  virtual void tangent(const State& state, Weights weights, std::span<double> r, std::span<double> k) const = 0;
  /// Φ with its first and second time derivative along the motion in `state`; one entry per multiplier.
  virtual void constraint_rates(const State& state, std::span<double> phi, std::span<double> rate,
                                std::span<double> second) const = 0;

  /// Initial values of own unknowns and history in the reference configuration.
  virtual void start(std::span<double> scalars, std::span<double> history) const;
  /// Follows whole turns and the like, which only say where the element is: called when a step is accepted and on the way to a
  /// position that is sought. Writes the new history; may shift own scalars by whole periods. By itself history stays.
  virtual void count_turns(const State& state, std::span<double> scalars, std::span<double> history) const;
  /// Called when a step is accepted, and only then: writes the new history as far as it tells what happened (plastic strain,
  /// sticking). By itself that is what count_turns() writes.
  virtual void commit(const State& state, std::span<double> scalars, std::span<double> history) const;

  /// Values of the switches, in the order of Layout::switches.
  virtual void switches(const State& state, std::span<Switch> values) const;

  /// The sliding velocity of each friction that is regularised, over the speed below which it is, in any axes. Newton's iteration
  /// does not jump over the curve from one direction of sliding to the other.
  virtual void sliding(const State& state, std::span<Vec3> speeds) const;
  /// The largest force or moment that each grip holds at rest: the static coefficient times what presses its surfaces.
  virtual void grip_limits(const State& state, std::span<double> limits) const;

  virtual Energies energies(const State& state) const;
  /// Forces that act on the nodes from outside of the model, in the slots of the layout: loads and weight. False, and nothing
  /// written, when there are none.
  virtual bool applied(const State& /*state*/, std::span<double> /*forces*/) const { return false; }
  virtual CellShape cell_shape() const { return CellShape::none; }
  /// Whether something stands for the element in the mesh of the results; a pressure is there as part of its cell.
  virtual bool in_mesh() const { return true; }

  /// Inertia tensor that the element gives to one of its nodes, about the node, in reference (global) components.
  virtual Mat3 inertia_at(int node) const;

  /// Output channels and their values in the order of `channels()`.
  virtual const std::vector<Channel>& channels() const;
  virtual void observe(const State& state, std::span<double> values) const;

  /// Fields, and all their values: field by field, in each place by place, in each component by component.
  virtual const std::vector<Field>& fields() const;
  virtual void evaluate_fields(const State& state, std::span<double> values) const;

  /// Elements of one section, which are numbered from 0, have stresses without jumps between them: fields with
  /// Field::averaged are averaged at their common nodes. −1: the element has no such fields.
  virtual int section() const { return -1; }
  /// From a field's values at its points to those at its nodes: nodes × points. nullptr: of an element without section.
  virtual const Eigen::MatrixXd* extrapolation() const { return nullptr; }
  /// The stress of the element, and how it differs from the one between the values given at its nodes: rows of the components of
  /// its field STRESS.
  virtual StressEnergies stress_energies(const State& /*state*/, std::span<const double> /*at_nodes*/) const { return {}; }

  /// Changes that hold less, the usual ones of machines first.
  virtual std::vector<Release> releases() const;
  /// Whether the element makes its nodes a body that can have mass; advice against motions that no inertia resists looks here.
  virtual bool is_body() const { return false; }
  /// Its forces at rest are linear in the displacements: one tangent serves any equilibrium. Without multipliers it is symmetric,
  /// for such forces have a potential.
  virtual bool is_linear() const { return false; }

  /// Where its forces are not finite: why, and what to change, after the element's name. Empty: nothing more is known.
  virtual const char* why_not_finite() const { return ""; }

  /// Warnings for the user at the end of a run: sentences without the element's name, from the history as committed last.
  virtual std::vector<std::string> remarks(std::span<const double> /*history*/) const { return {}; }

  virtual std::vector<Derived> derived() const;
  virtual Drawing drawing() const;

 private:
  int id_;
};

}  // namespace engrane

// SPDX-License-Identifier: BSD-3-Clause
// The checks that every element passes. A test states its element once, as a Subject, and calls run_suite().
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "model/element.hpp"
#include "model/registry.hpp"

namespace engrane::suite {

using Random = std::mt19937;
using NodeMap = std::map<int, Vec3>;
using FunctionMap = std::map<int, std::unique_ptr<Function>>;

/// Uniform in [-1, 1].
double uniform(Random& random);
Vec3 uniform_vector(Random& random);
/// Uniform over the rotations.
Mat3 uniform_rotation(Random& random);
/// The same of what a subject may do: in its plane, where it has one.
struct Subject;
Vec3 uniform_vector(const Subject& subject, Random& random);
Mat3 uniform_rotation(const Subject& subject, Random& random);

/// Owns everything a State views, and moves it in the coordinates that tangents differentiate by.
class StateBuffer {
 public:
  /// The reference configuration of the element: nodes at their places, at rest, own unknowns and history as started.
  StateBuffer(const Element& element, const NodeMap& places);

  State view() const;
  /// Takes over what the element commits of this state, as at the end of a step.
  void commit(const Element& element);

  /// Rotates node i to start_R exp(y), with T to match.
  void turn(std::size_t i, const Mat3& start_R, const Vec3& y);

  /// Adds to one slot (Layout's order): to its coordinate, velocity or acceleration; a rotation's coordinate is the
  /// rotation vector y of turn(). The multipliers are in the slots behind the unknowns.
  enum class Level { position, velocity, acceleration };
  void add(std::size_t slot, Level level, double amount);
  bool is_ground(std::size_t node) const { return ids[node] == 0; }
  double velocity(std::size_t slot) const;

  /// The state a time t later along the motion with the accelerations held: x + vt + ½at², R exp(Wt + ½At²).
  StateBuffer after(double t) const;

  std::vector<int> ids;
  std::vector<NodeState> nodes;
  std::vector<Mat3> start_R;  ///< of the step; R = start_R exp(y)
  std::vector<Vec3> y;        ///< the step's rotation vectors
  std::vector<double> scalars, scalar_rates, scalar_accelerations, multipliers, history;
  double time = 0;
  Vec3 gravity = Vec3::Zero();
  double penalty = 0;
};

/// The checks of the suite, to name one that does not apply.
enum class Check {
  tangent,       ///< tangent = derivative of the residual for q, v, a apart, rotations in the step's rotation vector
  rates,         ///< constraint_rates = differences of Φ along the motion
  ideal,         ///< constraint forces are Bᵀλ: the tangent's blocks are transposes of each other
  lagrange,      ///< without multipliers the residual is Lagrange's equations of energies().kinetic and .potential
  power,         ///< r·q̇ + λ·Φ̇ = d(kinetic + potential)/dt + dissipated − external
  rigid,         ///< a rigid motion of the reference configuration makes no force
  objectivity,   ///< a rigid rotation and shift of any state rotates the forces
  rotated_copy,  ///< the element built in a rotated frame gives rotated forces
  equilibrium,   ///< forces and moments of all nodes, the ground too, sum to zero
  zero,          ///< the reference configuration at rest has no residual
  needs,         ///< nothing depends on unknowns that the layout does not ask for, nor first-order ones on accelerations
  mass,          ///< the resistance to a common acceleration, and the weight, are those of Subject::mass
  swap,          ///< the element with its nodes the other way round gives the same forces
  parts,         ///< tangents are sums of K, C, M and the multipliers' columns, which can be had apart
  finite,        ///< everything is finite
};

/// An element under test.
struct Subject {
  std::string name;
  NodeMap nodes;  ///< reference positions
  /// Builds the element with all its geometry (places and directions of its card) turned about the origin.
  std::function<std::unique_ptr<Element>(const Mat3& turn)> build;
  /// Bends a random state to where the element has a meaning (teeth in contact, lengths not zero); may be empty.
  std::function<void(StateBuffer&, Random&)> adjust = {};
  bool in_plane = false;            ///< it moves in the plane XY only: so do random states, and turns are about z
  double length = 1;                ///< size of random displacements, and unit of difference steps
  double velocity = 1;              ///< size of random velocities and, per unit time, accelerations
  double force = 1;                 ///< size of random multipliers
  double scalar = 1;                ///< size of random own unknowns
  double penalty = 3;               ///< penalty p used in tangents
  double turn = 3;                  ///< largest random rotation, radians (from the reference orientation)
  double step = 1e-3;               ///< of the sixth-order differences, as a fraction of the sizes above
  double tolerance = 1e-8;          ///< relative, of everything compared with differences
  int states = 4;                   ///< number of random states
  std::optional<double> mass = {};  ///< of all nodes together
  /// The same element with its nodes the other way round, and how own unknowns and multipliers are carried over.
  std::function<std::unique_ptr<Element>()> build_swapped = {};
  std::function<void(const StateBuffer& state, StateBuffer& swapped)> carry = {};
  /// The constraints' components are along axes of the element's own choice: `rotated_copy` then compares forces of the
  /// penalised violations only, which no choice changes.
  bool own_axes = false;
  std::map<Check, std::string> skip = {};  ///< checks that do not apply, each with its reason
};

/// Runs every check on a few random states. Skipped by themselves: `rigid` and `objectivity` of an element on the ground,
/// which does not move; `mass` and `swap` where the subject does not state them.
void run_suite(const Subject& subject);

/// Only that nothing overflows, divides by zero or loses a sign of life: for subjects with extreme data. Rotations are of
/// 1e6 turns as one rotation vector.
void run_extreme(const Subject& subject);

/// A state at random: displacements, rotations, rates, multipliers, time, gravity.
StateBuffer random_state(const Subject& subject, const Element& element, Random& random);

/// The residual, with six rows for every node whatever the element asks for: zero where it does not. Then scalars, multipliers.
std::vector<double> residual_of(const Element& element, const StateBuffer& state);
/// The tangent likewise: row-major, as wide as residual_of() is long; and the residual that comes with it, where asked for.
std::vector<double> tangent_of(const Element& element, const StateBuffer& state, Weights weights,
                               std::vector<double>* residual = nullptr);
/// The value of an output channel; fails the test when there is none of that name.
double channel_of(const Element& element, const StateBuffer& state, const std::string& name);
/// What the listing tells of the element under this name; likewise.
double derived_of(const Element& element, const std::string& name);

/// mean + amplitude sin(rate t + phase), with its integral from 0: a function for drives and loads under test.
class Wave : public Function {
 public:
  Wave(double mean, double amplitude, double rate, double phase)
      : mean_(mean), amplitude_(amplitude), rate_(rate), phase_(phase) {}
  Jet at(double t) const override;
  double integral(double t) const override;

 private:
  double mean_, amplitude_, rate_, phase_;
};

/// What build() needs besides the card.
struct BuildOptions {
  const FunctionMap* functions = nullptr;
  Diagnostics* diagnostics = nullptr;  ///< without it, any fault of the card fails the test
  std::function<double(int, const Vec3&)> wheel_inertia = [](int, const Vec3&) { return 0.0; };
  int id = 1;
  const std::vector<deck::Record>* records = nullptr;  ///< of the other elements
  BlockStore* blocks = nullptr;                        ///< without it every element is alone in its block
  const Temperatures* temperatures = nullptr;
};

/// Builds an element from its card's struct, as a deck would.
std::unique_ptr<Element> build_record(const ElementType& type, std::any data, const NodeMap& nodes, const BuildOptions& options);

template <class Data>
std::unique_ptr<Element> build(const ElementType& type, const Data& data, const NodeMap& nodes,
                               const BuildOptions& options = {}) {
  return build_record(type, std::any(data), nodes, options);
}

/// Every position turned about the origin.
NodeMap turned(const NodeMap& nodes, const Mat3& turn);

}  // namespace engrane::suite

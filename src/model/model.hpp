// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "base/diagnostics.hpp"
#include "base/dimension.hpp"
#include "deck/cards/cards.hpp"
#include "deck/read/reader.hpp"
#include "model/element.hpp"
#include "model/function.hpp"
#include "model/node_positions.hpp"
#include "model/plane.hpp"
#include "model/registry.hpp"

namespace engrane {

/// A displacement component (0–2 translations, 3–5 rotations) of a node that the deck prescribes: value × function(t).
/// Rotations in radians about the global axis.
struct Support {
  int node = 0;  ///< index into Model::nodes
  int component = 0;
  double value = 0;
  const Function* function = nullptr;  ///< nullptr: constant
};

/// An initial displacement or velocity of a node's component.
struct InitialValue {
  int node = 0;
  int component = 0;
  double value = 0;
  bool velocity = false;
  bool imposed = false;  ///< must hold; otherwise a wish that the constraints may change
};

/// What a coordinate of an element, or its rate, is at the start: it holds exactly, and the nodes follow.
struct InitialCoordinate {
  int part = 0;     ///< index into Model::parts
  int channel = 0;  ///< of the element: the coordinate; its rate is the next one
  double value = 0;
  bool velocity = false;
  Location location;
};

/// A node that at the start moves and turns with a rigid body that spins: v = ω × (x − p), angular velocity ω.
struct InitialSpin {
  int node = 0;               ///< index into Model::nodes
  Vec3 omega = Vec3::Zero();  ///< global components
  Vec3 point = Vec3::Zero();  ///< p, on the axis
};

/// Acceleration of gravity: vector × function(t).
struct Gravity {
  Vec3 acceleration = Vec3::Zero();
  const Function* function = nullptr;
};

/// What to run and how, each with the place it was said.
struct Commands {
  deck::AnalysisCard analysis;
  deck::SteppingCard stepping;
  std::optional<deck::PathCard> path;
  std::optional<deck::BucklingCard> buckling;
  deck::ArchiveCard archive;
  std::vector<deck::CheckCard> checks;
  std::vector<Location> check_locations;
};

/// The mechanism as the deck describes it: constant while it is solved.
struct Model {
  using Node = NodePositions::Node;
  struct Part {
    std::unique_ptr<Element> element;
    std::string type;  ///< card name, such as `GEAR`; `CHA` for a nodal load
    /// Of the deck that the model was built from, which lives as long, or of `written_out`; nullptr once the records of a mesh
    /// are forgotten.
    const deck::Record* record = nullptr;
    Location location;
    std::vector<int> nodes;  ///< indices of the element's nodes
  };

  std::string title;
  std::shared_ptr<const deck::Deck> written_out;  ///< the deck with what its short forms stand for; nullptr: it has none
  UnitSystem units;
  std::vector<Node> nodes;  ///< the ground first (id 0), then by id
  std::map<int, std::unique_ptr<Function>> functions;
  std::set<const Function*> of_time;  ///< those whose variable is time
  std::vector<Part> parts;
  std::vector<Support> supports;
  std::vector<InitialValue> initial;
  std::vector<InitialCoordinate> initial_coordinates;
  std::vector<InitialSpin> initial_spins;
  std::vector<Gravity> gravity;
  Commands commands;
  PlaneModel plane;  ///< not active unless the deck asks for it (`.SAM PLANE`)

  int node_index(int id) const;  ///< -1 when there is no such node
  Vec3 gravity_at(double time) const;
  /// Instants between two others at which a function of time has a corner (Function::corners), in increasing order.
  std::vector<double> corners(double from, double to) const;
  /// Does one of them jump there, from the number before `time` to `time` itself?
  bool jumps_at(double time) const;
  /// The length that tolerances are measured with: the diagonal of the box around the nodes that elements use. Where all of
  /// them are in one place, but for rounding, the largest length that an element knows (radius of gyration, pitch radius,
  /// natural length); 1 where no length exists at all.
  double extent() const { return extent_; }
  /// Finds the extent. build_model() has done so.
  void measure();

 private:
  double extent_ = 1;
};

/// Whether the deck has a mesh.
bool has_cells(const Model& model);

/// Mass that an element gives to the translation of its first node, from its residual under a unit acceleration.
double mass_at_first_node(const Model& model, const Model::Part& part);

/// The record of an element as JSON, for the results file. That of a load on several nodes speaks of the one it is on.
std::string parameters_json(const Model::Part& part);

/// All cards of the language: general commands and registered elements.
deck::Catalogue catalogue(const std::vector<ElementType>& types);

/// Builds the model of a deck, to whose records it points. Faults go to `diagnostics`; the result is to be used only when there
/// are none.
Model build_model(const deck::Deck& deck, const std::vector<ElementType>& types, Diagnostics& diagnostics);

}  // namespace engrane

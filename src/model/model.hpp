// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <optional>
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

/// An initial displacement or velocity component of a node.
struct InitialValue {
  int node = 0;
  int component = 0;
  double value = 0;
  bool velocity = false;
  bool imposed = false;  ///< must hold exactly; otherwise a desired value that the constraints may change
};

/// Initial value of an element's coordinate or its rate. It holds exactly, and the nodes follow.
struct InitialCoordinate {
  int part = 0;     ///< index into Model::parts
  int channel = 0;  ///< index of the coordinate's channel; its rate is the next one
  double value = 0;
  bool velocity = false;
  Location location;
};

/// Initial rigid rotation of a node: v = ω × (x − p), angular velocity ω.
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

/// The analysis to run and its settings.
struct Commands {
  deck::AnalysisCard analysis;
  deck::SteppingCard stepping;
  std::optional<deck::PathCard> path;
  std::optional<deck::BucklingCard> buckling;
  deck::ArchiveCard archive;
  std::vector<deck::CheckCard> checks;
};

/// The mechanism described by the deck; constant during the solution.
struct Model {
  using Node = NodePositions::Node;
  struct Part {
    std::unique_ptr<Element> element;
    std::string type;  ///< card name, such as `GEAR`; `CHA` for a nodal load
    /// In the deck the model was built from, which outlives the model, or in `written_out`; nullptr once the records of a mesh
    /// are discarded.
    const deck::Record* record = nullptr;
    Location location;
    std::vector<int> nodes;  ///< indices of the element's nodes

    /// Whether it is a nodal load (`.CLM CHA`), which has no number in the deck.
    bool is_nodal_load() const { return type == "CHA"; }
    /// Whether it is a cell of the deck's mesh (`.MAI`); beams are cells without a CellShape.
    bool is_cell() const { return type == "MAI"; }
    /// "GEAR 7".
    std::string name() const { return type + " " + std::to_string(element->id()); }
  };

  std::string title;
  std::shared_ptr<const deck::Deck> written_out;  ///< the deck with its short forms expanded; nullptr if it has none
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

  const Node& node(int index) const { return nodes[static_cast<std::size_t>(index)]; }
  const Part& part(int index) const { return parts[static_cast<std::size_t>(index)]; }
  int node_index(int id) const;  ///< -1 when there is no such node
  Vec3 gravity_at(double time) const;
  /// The part of it that functions of time give; nothing if there are none.
  std::optional<VaryingGravity> varying_gravity_at(double time) const;
  /// Instants in (from, to), ascending, at which a function of time has a corner, or is less smooth than between them
  /// (Function::corners and joints).
  std::vector<double> joints(double from, double to) const;
  /// The corners alone.
  std::vector<double> corners(double from, double to) const;
  /// Whether any function of time jumps from the number before `time` to `time` itself.
  bool jumps_at(double time) const;
  /// Reference length for tolerances: diameter of the sphere around the mean of the nodes that elements use, each counted once
  /// for every element, that reaches the farthest. If all of them coincide up to rounding, the largest length known to an element
  /// (radius of gyration, pitch radius, natural length). Limits of stops may never be reached and count only without such a
  /// length: the least that is not zero, if below 1. Otherwise 1.
  double extent() const { return extent_; }
  /// Computes the extent; build_model() calls it.
  void measure();

 private:
  double extent_ = 1;
};

/// Whether the deck has a mesh.
bool has_cells(const Model& model);

/// The record of an element as JSON, for the results file. For a load on several nodes, only the node of this element is given.
std::string parameters_json(const Model::Part& part);

/// All cards of the language: general commands and registered elements.
deck::Catalogue catalogue(const std::vector<ElementType>& types);

/// Builds the model of a deck; the model refers to the deck's records. Faults go to `diagnostics`; use the result only if there
/// are none.
Model build_model(const deck::Deck& deck, const std::vector<ElementType>& types, Diagnostics& diagnostics);

}  // namespace engrane

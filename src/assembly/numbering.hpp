// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <vector>

#include "assembly/configuration.hpp"
#include "assembly/partition.hpp"
#include "model/model.hpp"

namespace engrane {

/// What an unknown or its equation measures; decides how its residual is judged.
enum class Measure : unsigned char { force, moment, length, angle };

/// One unknown of the assembled system, for messages and norms.
struct Unknown {
  int slot = 0;
  int part = -1;  ///< the element that owns it; -1 when a node does
  int node = -1;  ///< index of the node that owns it; -1 when an element does
  int item = 0;   ///< component of the node, or index of the element's scalar or multiplier
  bool multiplier = false;
  bool first_order = false;          ///< Scalar::first_order
  Measure measure = Measure::force;  ///< of its equation
};

/// Where everything stands. A slot is a place for a value: six per node (whether or not it has the unknown), then the
/// elements' scalars (together the motion), then the multipliers. An equation is a slot that is really unknown. In a model of a
/// plane (Model::plane) components of nodes that lead out of it are fixed, and constraints that act only out of it have none.
class Numbering {
 public:
  /// Of a model that one rank has.
  explicit Numbering(const Model& model) : Numbering(model, Partition(model)) {}
  /// With equations rank after rank: those of an element with its rank, those of a node with the rank of its first element.
  Numbering(const Model& model, Partition partition);

  const Partition& partition() const { return partition_; }
  /// This rank's equations: from first_row() to before end_row().
  int first_row() const { return first_row_; }
  int end_row() const { return end_row_; }
  bool is_own(int equation) const { return equation >= first_row_ && equation < end_row_; }
  /// What this rank evaluates to have its equations whole, by index into Model::parts: its own elements, then ghosts, which are
  /// elements of other ranks that have to do with this rank's equations.
  const std::vector<int>& evaluated() const { return evaluated_; }
  /// Elements that several ranks evaluate.
  int shared_parts() const { return shared_parts_; }

  int equations() const { return static_cast<int>(unknowns_.size()); }
  int motion_slots() const { return motion_slots_; }
  int slots() const { return static_cast<int>(equation_.size()); }
  /// Equation of a slot; -1 when it is fixed, prescribed or not needed by any element.
  int equation(int slot) const { return equation_[static_cast<std::size_t>(slot)]; }
  /// The unknown of a multiplier, in the order of Configuration::multipliers; also of one that has no equation.
  const Unknown& multiplier(int index) const;
  const Unknown& unknown(int equation) const { return unknowns_[static_cast<std::size_t>(equation)]; }
  const std::vector<Unknown>& unknowns() const { return unknowns_; }
  Measure measure(int equation) const { return unknown(equation).measure; }

  int parts() const { return static_cast<int>(parts_.size()) - 1; }
  /// Global slot of each local slot of an element.
  std::span<const int> part_slots(int part) const {
    const auto p = static_cast<std::size_t>(part);
    return std::span(part_slots_).subspan(parts_[p].slot, parts_[p + 1].slot - parts_[p].slot);
  }
  /// Bytes that are kept for the elements.
  std::size_t part_bytes() const { return parts_.size() * sizeof(Part) + part_slots_.size() * sizeof(int); }
  int scalar_begin(int part) const { return parts_[static_cast<std::size_t>(part)].scalar; }
  int multiplier_begin(int part) const { return parts_[static_cast<std::size_t>(part)].multiplier; }
  int history_begin(int part) const { return parts_[static_cast<std::size_t>(part)].history; }

  /// The mechanism as the deck gives it: reference positions, elements' starting values, everything at rest.
  Configuration reference_configuration(double time) const;

  /// Whether a node has rotation unknowns (free or held) at all.
  bool rotates(int node) const { return rotates_[static_cast<std::size_t>(node)]; }

  /// "node 57 (rz)" or "GEAR 7 (LAMBDA_1)".
  std::string describe(int equation) const;

 private:
  struct Part {
    std::size_t slot = 0;  ///< first in part_slots_
    int scalar = 0, multiplier = 0, history = 0;
  };
  void order_by_ranks();
  void find_ghosts(const std::vector<int>& row_end);

  const Model& model_;
  Partition partition_;
  std::vector<int> evaluated_;
  int first_row_ = 0, end_row_ = 0, shared_parts_ = 0;
  std::vector<int> equation_;
  std::vector<Unknown> unknowns_;
  std::vector<Unknown> left_out_;  ///< multipliers without equation, by slot
  std::vector<Part> parts_;        ///< and one more, where the last ends
  std::vector<int> part_slots_;
  std::vector<bool> rotates_;
  int motion_slots_ = 0;
  int scalars_ = 0, multipliers_ = 0, history_ = 0;
};

/// Name of a node's component 0–5: "x" … "rz".
const char* component_name(int component);

}  // namespace engrane

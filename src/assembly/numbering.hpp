// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <vector>

#include "assembly/configuration.hpp"
#include "assembly/partition.hpp"
#include "model/model.hpp"

namespace engrane {

/// Physical quantity of an equation's residual. It decides which reference the residual is compared with.
enum class Measure : unsigned char { force, moment, length, angle };

/// One unknown of the assembled system, for messages and norms.
struct Unknown {
  int slot = 0;
  int part = -1;  ///< element that owns it; -1 if a node does
  int node = -1;  ///< index of the node that owns it; -1 if an element does
  int item = 0;   ///< component of the node, or index of the element's scalar or multiplier
  bool multiplier = false;
  bool signal = false;               ///< see Scalar::signal
  Measure measure = Measure::force;  ///< of its equation

  /// Whether it is an angle or a moment; so is its residual.
  bool rotational() const { return measure == Measure::moment || measure == Measure::angle; }
};

/// Numbering of slots and equations. A slot is the storage place of one value: six per node, whether or not these are unknowns,
/// then the scalars of the elements (together the motion slots), then the multipliers. An equation is a slot that is actually
/// solved for. In a plane model (Model::plane), out-of-plane components of nodes are fixed, and constraints that act only out
/// of the plane have no equation.
class Numbering {
 public:
  /// For a model on one rank.
  explicit Numbering(const Model& model) : Numbering(model, Partition(model)) {}
  /// Numbers the equations rank by rank. Those of an element belong to its rank, those of a node to the rank of the first
  /// element in Model::parts that uses it.
  Numbering(const Model& model, Partition partition);

  const Partition& partition() const { return partition_; }
  /// This rank's equations are first_row() to end_row() − 1.
  int first_row() const { return first_row_; }
  int end_row() const { return end_row_; }
  bool is_own(int equation) const { return equation >= first_row_ && equation < end_row_; }
  /// Elements that this rank evaluates, as indices into Model::parts: its own, then its ghosts. Ghosts are elements of other
  /// ranks that contribute to equations of this rank.
  const std::vector<int>& evaluated() const { return evaluated_; }
  /// Number of elements that more than one rank evaluates.
  int shared_parts() const { return shared_parts_; }

  int equations() const { return static_cast<int>(unknowns_.size()); }
  int motion_slots() const { return motion_slots_; }
  int slots() const { return static_cast<int>(equation_.size()); }
  /// Equation of a slot; -1 if it is fixed, prescribed or not needed by any element.
  int equation(int slot) const { return equation_[static_cast<std::size_t>(slot)]; }
  /// Unknown of a multiplier, in the order of Configuration::multipliers; also defined for multipliers without an equation.
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
  /// Memory used for the element tables, in bytes.
  std::size_t part_bytes() const { return parts_.size() * sizeof(Part) + part_slots_.size() * sizeof(int); }
  int scalar_begin(int part) const { return parts_[static_cast<std::size_t>(part)].scalar; }
  int multiplier_begin(int part) const { return parts_[static_cast<std::size_t>(part)].multiplier; }
  int history_begin(int part) const { return parts_[static_cast<std::size_t>(part)].history; }

  /// The initial state as given by the deck: reference positions, initial values of the elements, everything at rest.
  Configuration reference_configuration(double time) const;

  /// "node 57 (rz)" or "GEAR 7 (LAMBDA_1)".
  std::string describe(int equation) const;

 private:
  struct Part {
    std::size_t slot = 0;  ///< index into part_slots_
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
  std::vector<Unknown> left_out_;  ///< multipliers without an equation, sorted by slot
  std::vector<Part> parts_;        ///< one entry per part and a final one with the ends
  std::vector<int> part_slots_;
  int motion_slots_ = 0;
  int scalars_ = 0, multipliers_ = 0, history_ = 0;
};

/// Name of a node component 0 to 5: "x" … "rz".
const char* component_name(int component);

}  // namespace engrane

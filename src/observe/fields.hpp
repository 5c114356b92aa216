// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "model/model.hpp"
#include "observe/reactions.hpp"

namespace engrane::observe {

/// A field over the nodes at one instant: three global components for each node but the ground, in the order of Model::nodes.
struct NodalField {
  Named named;
  std::vector<double> rows;
};

/// A field that elements declare: a row for each part of the model, the mean over its nodes or points where it has several; not
/// a number where a part does not have the field.
struct ElementField {
  Named named;
  std::vector<std::string> components;  ///< none: a scalar
  std::vector<double> rows;

  /// Where some part has several values: all of them, a row for each node or point of a part that has the field, part by part.
  std::vector<double> places;
  std::vector<int> place_parts;  ///< index of the part of each row; empty: `rows` says all

  std::size_t width() const { return components.empty() ? 1 : components.size(); }
};

/// The fields that the elements of a model declare. Fields of one name are one field; who declares it first says its components.
class ElementFields {
 public:
  explicit ElementFields(Assembler& assembler);

  /// Names, units and components; rows as evaluated last, on rank 0.
  const std::vector<ElementField>& fields() const { return fields_; }
  /// Each rank evaluates its own elements. Collective.
  void evaluate(const Configuration& c);
  /// Gives rows and places of each field to `replace`, to be changed.
  template <class Replace>
  void replace(const Replace& replace) {
    for (ElementField& field : fields_) {
      replace(field.rows);
      replace(field.places);
    }
  }

 private:
  /// One field of one part.
  struct Use {
    int part = 0;
    std::size_t field = 0;   ///< in fields_
    std::size_t first = 0;   ///< of its numbers among all that the part evaluates
    std::size_t places = 1;  ///< nodes or points
    std::size_t row = 0;     ///< of the first in ElementField::places
  };
  Assembler& assembler_;
  std::vector<ElementField> fields_;
  std::vector<Use> uses_;  ///< of all ranks, by part
};

/// Names and units of the fields over the nodes; velocities are among them where something moves.
std::vector<Named> nodal_field_names(bool moves);
/// The fields in that order.
std::vector<NodalField> nodal_fields(const Model& model, const Configuration& c, const std::vector<Reaction>& reactions,
                                     bool moves);

}  // namespace engrane::observe

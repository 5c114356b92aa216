// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "model/model.hpp"
#include "observe/nodal_averages.hpp"
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
  std::size_t place_count = 0;  ///< of these rows; 0: `rows` says all

  std::size_t width() const { return components.empty() ? 1 : components.size(); }
};

/// What the stresses of all cells are estimated to be off by, after Zienkiewicz and Zhu (1987), Int. J. Numer. Methods Eng. 24.
struct StressError {
  double energy = 0;      ///< half the square of the energy norm of the stresses, summed over the cells
  double difference = 0;  ///< the same of the averaged stresses less them

  /// Part of the energy norm, eq. 20 there: η² = ‖e‖² / (‖σ‖² + ‖e‖²).
  double relative() const { return difference > 0 ? std::sqrt(difference / (energy + difference)) : 0; }
};

/// The fields that the elements of a model declare. Fields of one name are one field; who declares it first says its components.
class ElementFields {
 public:
  explicit ElementFields(Assembler& assembler);

  /// Names, units and components; rows as evaluated last, on rank 0.
  const std::vector<ElementField>& fields() const { return fields_; }
  /// Of each row of ElementField::places the index of its part.
  std::vector<int> place_parts(std::size_t field) const;
  /// Each rank evaluates its own elements. Collective.
  void evaluate(const Configuration& c);
  /// Gives rows and places of each field to `replace`, to be changed.
  template <class Replace>
  void replace(const Replace& replace) {
    for (ElementField& field : fields_) {
      replace(field.rows);
      replace(field.places);
    }
    averages_.replace(replace);
    replace(energies_);
  }

  const SectionPoints& points() const { return points_; }
  /// Fields averaged at nodes; rows as evaluated last, on rank 0.
  const std::vector<AveragedField>& averages() const { return averages_.fields(); }
  /// Of the last evaluation; nothing before it, and where no element has stresses.
  std::optional<StressError> stress_error() const;

 private:
  /// One field of parts of a kind.
  struct Use {
    std::size_t field = 0;   ///< in fields_
    std::size_t first = 0;   ///< of its numbers among all that the part evaluates
    std::size_t places = 1;  ///< nodes or points
    bool averaged = false;   ///< at nodes as well
  };
  /// Parts with the same declarations and as many nodes.
  struct Kind {
    std::vector<Use> uses;
    std::size_t size = 0;  ///< of all numbers that such a part evaluates
  };
  Kind make_kind(const Model::Part& part, std::map<std::string, std::size_t>& known);
  void evaluate_own(const Configuration& c);
  void estimate_errors(const Configuration& c);
  bool has(std::size_t field, std::size_t part) const;

  Assembler& assembler_;
  SectionPoints points_;
  NodalAverages averages_;
  std::vector<ElementField> fields_;
  std::vector<Kind> kinds_;
  std::vector<int> kind_of_part_;     ///< of all ranks, in kinds_
  std::optional<std::size_t> error_;  ///< in fields_: the estimated error, which no element declares
  std::size_t stress_ = 0;            ///< in fields_: what it is the error of
  std::vector<double> energies_;      ///< those of StressError
};

/// Names and units of the fields over the nodes; velocities are among them where something moves.
std::vector<Named> nodal_field_names(bool moves);
/// The fields in that order.
std::vector<NodalField> nodal_fields(const Model& model, const Configuration& c, const std::vector<Reaction>& reactions,
                                     bool moves);

}  // namespace engrane::observe

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "assembly/reactions.hpp"
#include "model/model.hpp"
#include "observe/nodal_averages.hpp"

namespace engrane::observe {

/// Field over the nodes at one instant: three global components per node except the ground, in the order of Model::nodes.
struct NodalField {
  Named named;
  std::vector<double> rows;
};

/// Field declared by elements: one row per part of the model, averaged over its nodes or points if it has several; NaN for
/// parts without the field.
struct ElementField {
  Named named;
  std::vector<std::string> components;  ///< empty for a scalar
  std::vector<double> rows;

  /// If some part has several values: all of them, one row per node or point of each part with the field, part by part.
  std::vector<double> places;
  std::size_t place_count = 0;  ///< number of these rows; 0 if `rows` holds everything

  std::size_t width() const { return components.empty() ? 1 : components.size(); }
};

/// Estimated error of the stresses of all cells, after Zienkiewicz and Zhu (1987), Int. J. Numer. Methods Eng. 24.
struct StressError {
  double energy = 0;      ///< half the squared energy norm of the stresses, summed over the cells
  double difference = 0;  ///< the same of the difference between averaged and element stresses

  /// Relative error in the energy norm, eq. 20 there: η² = ‖e‖² / (‖σ‖² + ‖e‖²).
  double relative() const { return difference > 0 ? std::sqrt(difference / (energy + difference)) : 0; }
};

struct DerivedKind;

/// The fields that the elements of a model declare. Fields with the same name are merged: the declaration of the elements with
/// most components counts. Stresses and strains of plane cells beside solids have zeros in the components that plane cells lack.
class ElementFields {
 public:
  explicit ElementFields(Assembler& assembler);

  /// Names, units and components; rows of the last evaluation, on rank 0.
  const std::vector<ElementField>& fields() const { return fields_; }
  /// Index of the part for each row of ElementField::places.
  std::vector<int> place_parts(std::size_t field) const;
  /// Evaluates all fields. Each rank evaluates its own elements. Collective.
  void evaluate(const Configuration& c);
  /// Passes the rows and places of each field, and the energies of the stress error, to `replace`, which may modify them.
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
  /// Fields averaged at nodes; rows of the last evaluation, on rank 0.
  const std::vector<AveragedField>& averages() const { return averages_.fields(); }
  /// Of the last evaluation; empty before it, and if no element has stresses.
  std::optional<StressError> stress_error() const;

 private:
  /// One field of a kind of part.
  struct Use {
    std::size_t field = 0;                 ///< index into fields_
    std::size_t first = 0;                 ///< index of its first value among all values of the part
    std::size_t places = 1;                ///< number of nodes or points
    bool averaged = false;                 ///< also averaged at nodes
    std::size_t width = 1;                 ///< number of components declared; the first of those of the field
    const DerivedKind* derived = nullptr;  ///< the values are computed from those at `first`, a stress
  };
  /// Parts with the same declarations and the same number of nodes.
  struct Kind {
    std::vector<Use> uses;
    std::size_t size = 0;  ///< number of all values of such a part
  };
  Kind make_kind(const Model::Part& part, const std::map<std::string, std::size_t>& known);
  /// Fills fields_ with the merged declarations; returns their indices.
  std::map<std::string, std::size_t> merge_declarations();
  /// Values of one use as rows of its field, from all values of a part. Valid until the next call.
  std::span<const double> rows_of(const Use& use, std::span<const double> values);
  void evaluate_own(const Configuration& c);
  void estimate_errors(const Configuration& c);
  bool has(std::size_t field, std::size_t part) const;

  Assembler& assembler_;
  SectionPoints points_;
  NodalAverages averages_;
  std::vector<ElementField> fields_;
  std::vector<Kind> kinds_;
  std::vector<int> kind_of_part_;     ///< index into kinds_, for the parts of all ranks
  std::optional<std::size_t> error_;  ///< index into fields_ of the estimated error, which no element declares
  std::size_t stress_ = 0;            ///< index into fields_ of the stress whose error it is
  std::vector<double> energies_;      ///< energy and difference of StressError
  std::vector<double> scratch_;
};

/// Whether ElementFields::averages() has this field of an element with a section.
bool is_averaged(const Field& field);

/// Names and units of the fields over the nodes. Velocities are included if `moves`.
std::vector<Named> nodal_field_names(bool moves);
/// Values of these fields, in the same order.
std::vector<NodalField> nodal_fields(const Model& model, const Configuration& c, const std::vector<Reaction>& reactions,
                                     bool moves);

}  // namespace engrane::observe

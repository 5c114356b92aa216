// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mpi.h>

#include <Eigen/Core>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "model/model.hpp"

namespace engrane::observe {

/// The points of the mesh of the results: all nodes but the ground, in the order of Model::nodes, and behind them a node once
/// more for each further section (Element::section) of which it is. What jumps from section to section has one value at each
/// point.
class SectionPoints {
 public:
  explicit SectionPoints(const Model& model);

  std::size_t size() const { return first_section_.size() - 1 + copies_.size(); }
  /// Indices into Model::nodes of the points behind those of the nodes.
  const std::vector<int>& copies() const { return copies_; }
  /// The point of an element's node (an index into Part::nodes), which is not the ground.
  int at(const Model::Part& part, std::size_t node) const;

 private:
  std::vector<int> first_section_;  ///< of each node
  std::map<std::pair<int, int>, int> further_;
  std::vector<int> copies_;
};

/// A field at the points of SectionPoints; not a number where it has no value.
struct AveragedField {
  Named named;
  std::vector<std::string> components;  ///< none: a scalar
  std::vector<double> rows;             ///< on rank 0

  std::size_t width() const { return components.empty() ? 1 : components.size(); }
};

/// What elements extrapolate to their nodes, averaged over the elements of a section: each counts once, whatever its size. (Where
/// a small element meets a large one the value of the small one belongs to a point nearer to the node: weights by volume would
/// favour the other.)
class NodalAverages {
 public:
  explicit NodalAverages(const SectionPoints& points) : points_(points) {}

  /// A part has this field, which is averaged; all are declared before values are added. A field of the same name has the
  /// components that were first declared; others are left out.
  void declare(const Field& field, const Model::Part& part);
  /// A field that follows from the average of another: `value` from its components.
  void derive(const std::string& from, AveragedField field, void (*value)(std::span<const double> from, double* out));

  bool empty() const { return sums_.empty(); }
  const std::vector<AveragedField>& fields() const { return fields_; }

  void clear();
  /// Values of a part at its points, point by point.
  void add(const std::string& name, const Model::Part& part, std::span<const double> values);
  /// Sums over all ranks, and averages. Collective.
  void finish(MPI_Comm comm);
  /// Averages at the nodes of a part, node by node, on any rank; nothing when the part does not have the field.
  std::span<const double> at_nodes(const std::string& name, const Model::Part& part);

  /// Gives the rows of each field to `replace`, to be changed.
  template <class Replace>
  void replace(const Replace& replace) {
    for (AveragedField& field : fields_) replace(field.rows);
  }

 private:
  struct Sum {
    std::string name;
    std::size_t width;
    std::vector<int> counts;     ///< elements at each point, of all ranks
    std::vector<double> values;  ///< sums, then averages
  };
  struct Derived {
    std::size_t from;  ///< in sums_
    std::size_t field;
    void (*value)(std::span<const double> from, double* out);
  };
  Sum* find(const std::string& name, std::size_t width, const Model::Part& part);

  const SectionPoints& points_;
  std::vector<Sum> sums_;              ///< of the first fields
  std::vector<AveragedField> fields_;  ///< those of sums_, then those derived
  std::vector<Derived> derived_;
  Eigen::MatrixXd scratch_;
  std::vector<double> gathered_;
};

}  // namespace engrane::observe

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

/// Points of the results mesh: all nodes except the ground, in the order of Model::nodes, then one copy of a node for each
/// further section (Element::section) that it belongs to. Fields that jump between sections so have a unique value at each
/// point.
class SectionPoints {
 public:
  explicit SectionPoints(const Model& model);

  std::size_t size() const { return first_section_.size() - 1 + copies_.size(); }
  /// Node (index into Model::nodes) of each copy.
  const std::vector<int>& copies() const { return copies_; }
  /// Point of an element's node `node` (index into Part::nodes), which must not be the ground.
  int at(const Model::Part& part, std::size_t node) const;

 private:
  std::vector<int> first_section_;  ///< first section of each node
  std::map<std::pair<int, int>, int> further_;
  std::vector<int> copies_;
};

/// Field at the points of SectionPoints; NaN where it has no value.
struct AveragedField {
  Named named;
  std::vector<std::string> components;  ///< empty for a scalar
  std::vector<double> rows;             ///< on rank 0

  std::size_t width() const { return components.empty() ? 1 : components.size(); }
};

/// Element values extrapolated to the nodes and averaged over the elements of a section, with equal weights. (Where a small
/// element meets a large one, the value of the small one comes from a point nearer to the node; weighting by volume would
/// favour the other.)
class NodalAverages {
 public:
  explicit NodalAverages(const SectionPoints& points) : points_(points) {}

  /// Declares a field of a part that is to be averaged, with these components, of which its own are the first. All fields must be
  /// declared before values are added.
  void declare(const Field& field, const std::vector<std::string>& components, const Model::Part& part);
  /// Adds a field derived from the average of the field `from`: `value` computes it from the components of that field.
  void derive(const std::string& from, AveragedField field, void (*value)(std::span<const double> from, double* out));

  bool empty() const { return sums_.empty(); }
  const std::vector<AveragedField>& fields() const { return fields_; }

  void clear();
  /// Adds the values of a part at its points, point by point.
  void add(const std::string& name, const Model::Part& part, std::span<const double> values);
  /// Sums over all ranks and divides by the number of elements. Collective.
  void finish(MPI_Comm comm);
  /// Averages of the part's own components at its nodes, node by node, on any rank; empty if the part does not have the field.
  std::span<const double> at_nodes(const std::string& name, const Model::Part& part);

  /// Passes the rows of each field to `replace`, which may modify them.
  template <class Replace>
  void replace(const Replace& replace) {
    for (AveragedField& field : fields_) replace(field.rows);
  }

 private:
  struct Sum {
    std::string name;
    std::size_t width;
    std::vector<int> counts;     ///< number of elements at each point, on all ranks
    std::vector<double> values;  ///< sums, then averages
  };
  struct Derived {
    std::size_t from;  ///< index into sums_
    std::size_t field;
    void (*value)(std::span<const double> from, double* out);
  };
  Sum* find(const std::string& name, const Model::Part& part);

  const SectionPoints& points_;
  std::vector<Sum> sums_;              ///< sums for the first fields of fields_
  std::vector<AveragedField> fields_;  ///< the fields of sums_, then the derived ones
  std::vector<Derived> derived_;
  Eigen::MatrixXd scratch_;
  std::vector<double> gathered_;
};

}  // namespace engrane::observe

// SPDX-License-Identifier: BSD-3-Clause
#include "observe/nodal_averages.hpp"

#include <algorithm>
#include <limits>

namespace engrane::observe {

SectionPoints::SectionPoints(const Model& model) : first_section_(model.nodes.size(), -1) {
  for (const Model::Part& part : model.parts) {
    const int section = part.element->section();
    if (section < 0) continue;
    for (const int node : part.nodes) {
      int& first = first_section_[static_cast<std::size_t>(node)];
      if (first < 0) first = section;
      if (first == section) continue;
      const int next = static_cast<int>(size());
      if (further_.try_emplace({node, section}, next).second) copies_.push_back(node);
    }
  }
}

int SectionPoints::at(const Model::Part& part, std::size_t node) const {
  const int index = part.nodes[node], section = part.element->section();
  if (section < 0 || first_section_[static_cast<std::size_t>(index)] == section) return index - 1;
  return further_.at({index, section});
}

NodalAverages::Sum* NodalAverages::find(const std::string& name, const Model::Part& part) {
  if (part.element->section() < 0) return nullptr;
  const auto found = std::find_if(sums_.begin(), sums_.end(), [&](const Sum& sum) { return sum.name == name; });
  return found == sums_.end() ? nullptr : &*found;
}

void NodalAverages::declare(const Field& field, const std::vector<std::string>& components, const Model::Part& part) {
  if (std::none_of(sums_.begin(), sums_.end(), [&](const Sum& sum) { return sum.name == field.name; })) {
    sums_.push_back({field.name, std::max<std::size_t>(components.size(), 1), std::vector<int>(points_.size(), 0), {}});
    fields_.push_back({field, components, {}});
  }
  Sum* sum = find(field.name, part);
  if (!sum) return;
  for (std::size_t i = 0; i < part.nodes.size(); ++i) ++sum->counts[static_cast<std::size_t>(points_.at(part, i))];
}

void NodalAverages::derive(const std::string& from, AveragedField field, void (*value)(std::span<const double>, double*)) {
  const auto found = std::find_if(sums_.begin(), sums_.end(), [&](const Sum& sum) { return sum.name == from; });
  if (found == sums_.end()) return;
  derived_.push_back({static_cast<std::size_t>(found - sums_.begin()), fields_.size(), value});
  fields_.push_back(std::move(field));
}

void NodalAverages::clear() {
  for (Sum& sum : sums_) sum.values.assign(sum.counts.size() * sum.width, 0.0);
}

void NodalAverages::add(const std::string& name, const Model::Part& part, std::span<const double> values) {
  if (part.element->section() < 0) return;
  const Eigen::MatrixXd& to_nodes = *part.element->extrapolation();
  const auto width = static_cast<Eigen::Index>(values.size()) / to_nodes.cols();
  Sum* sum = find(name, part);
  if (!sum) return;
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  scratch_.noalias() = to_nodes * Eigen::Map<const Rows>(values.data(), to_nodes.cols(), width);
  for (std::size_t i = 0; i < part.nodes.size(); ++i) {
    double* row = sum->values.data() + static_cast<std::size_t>(points_.at(part, i)) * sum->width;
    for (Eigen::Index k = 0; k < width; ++k) row[k] += scratch_(static_cast<Eigen::Index>(i), k);
  }
}

void NodalAverages::finish(MPI_Comm comm) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t s = 0; s < sums_.size(); ++s) {
    Sum& sum = sums_[s];
    MPI_Allreduce(MPI_IN_PLACE, sum.values.data(), static_cast<int>(sum.values.size()), MPI_DOUBLE, MPI_SUM, comm);
    for (std::size_t i = 0; i < sum.values.size(); ++i) {
      const int count = sum.counts[i / sum.width];
      sum.values[i] = count > 0 ? sum.values[i] / count : none;
    }
    if (rank == 0) fields_[s].rows = sum.values;
  }
  if (rank != 0) return;
  for (const Derived& derived : derived_) {
    const Sum& sum = sums_[derived.from];
    AveragedField& field = fields_[derived.field];
    field.rows.assign(sum.counts.size() * field.width(), none);
    for (std::size_t i = 0; i < sum.counts.size(); ++i)
      if (sum.counts[i] > 0)
        derived.value(std::span(sum.values).subspan(i * sum.width, sum.width), field.rows.data() + i * field.width());
  }
}

std::span<const double> NodalAverages::at_nodes(const std::string& name, const Model::Part& part) {
  std::size_t width = 0;
  for (const Field& field : part.element->fields())
    if (field.name == name) width = field.width();
  const Sum* sum = find(name, part);
  if (!sum || width == 0) return {};
  gathered_.clear();
  for (std::size_t i = 0; i < part.nodes.size(); ++i) {
    const auto row = sum->values.begin() + points_.at(part, i) * static_cast<std::ptrdiff_t>(sum->width);
    gathered_.insert(gathered_.end(), row, row + static_cast<std::ptrdiff_t>(width));
  }
  return gathered_;
}

}  // namespace engrane::observe

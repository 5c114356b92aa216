// SPDX-License-Identifier: BSD-3-Clause
#include "assembly/partition.hpp"

#include <algorithm>
#include <numeric>

namespace engrane {

namespace {

/// Minimum number of elements per rank for which graph partitioning is worthwhile.
constexpr std::size_t worth_parting = 100;
/// Largest vertex weight: the sum of all weights must fit in PetscInt.
constexpr double heaviest = 100;

/// Adjacency of elements: the neighbours of element i are to[begin[i]] … to[begin[i + 1] − 1], ascending, with the number of
/// nodes that link them.
struct Graph {
  std::vector<PetscInt> begin, to, nodes;
};

/// Links the elements at each node with one another, so that the weight of a cut approximates the number of shared nodes. Each
/// element is linked only with the next few at the node: a node with ten thousand elements must not create a hundred million
/// links.
Graph graph_of(const Model& model) {
  constexpr std::size_t next_few = 8;
  std::vector<std::vector<int>> at_node(model.nodes.size());
  for (std::size_t p = 0; p < model.parts.size(); ++p)
    for (const int node : model.parts[p].nodes)
      if (node > 0) at_node[static_cast<std::size_t>(node)].push_back(static_cast<int>(p));  // the ground links nothing
  std::vector<std::pair<int, int>> links;
  for (const std::vector<int>& parts : at_node)
    for (std::size_t i = 0; i < parts.size(); ++i)
      for (std::size_t k = i + 1; k < std::min(parts.size(), i + 1 + next_few); ++k) {
        if (parts[i] == parts[k]) continue;
        links.emplace_back(parts[i], parts[k]);
        links.emplace_back(parts[k], parts[i]);
      }
  std::sort(links.begin(), links.end());
  Graph graph;
  graph.begin.assign(model.parts.size() + 1, 0);
  for (std::size_t i = 0; i < links.size(); ++i) {
    if (i > 0 && links[i] == links[i - 1]) {
      ++graph.nodes.back();
      continue;
    }
    graph.to.push_back(links[i].second);
    graph.nodes.push_back(1);
    ++graph.begin[static_cast<std::size_t>(links[i].first) + 1];
  }
  std::partial_sum(graph.begin.begin(), graph.begin.end(), graph.begin.begin());
  return graph;
}

/// Cost of each element: the number of entries of its tangent.
std::vector<double> costs_of(const Model& model) {
  std::vector<double> costs;
  costs.reserve(model.parts.size());
  for (const Model::Part& part : model.parts) {
    const auto slots = static_cast<double>(part.element->layout().slots());
    costs.push_back(slots * slots);
  }
  return costs;
}

/// Copy that PETSc will free.
PetscInt* petsc_copy(const std::vector<PetscInt>& values) {
  PetscInt* copy = nullptr;
  check_petsc(PetscMalloc1(values.size(), &copy));
  std::copy(values.begin(), values.end(), copy);
  return copy;
}

}  // namespace

Partition::Partition(const Model& model) : own_(model.parts.size()) { std::iota(own_.begin(), own_.end(), 0); }

Partition::Partition(const Model& model, MPI_Comm comm) {
  MPI_Comm_rank(comm, &rank_);
  MPI_Comm_size(comm, &ranks_);
  if (ranks_ == 1) {
    *this = Partition(model);
    return;
  }
  const auto parts = static_cast<int>(model.parts.size());
  owners_.resize(model.parts.size());
  if (model.parts.size() < worth_parting * static_cast<std::size_t>(ranks_)) {
    deal_out(parts);
  } else {
    // only rank 0 partitions: parallel Scotch may find a different partition in each run, and runs must be reproducible bit for
    // bit
    if (rank_ == 0) part_graph(model);
    MPI_Bcast(owners_.data(), parts, MPI_INT, 0, comm);
  }
  for (int p = 0; p < parts; ++p)
    if (owner(p) == rank_) own_.push_back(p);
}

void Partition::deal_out(int parts) {
  for (int rank = 0; rank < ranks_; ++rank) {
    const auto begin = [&](int r) { return static_cast<std::ptrdiff_t>(parts) * r / ranks_; };
    std::fill(owners_.begin() + begin(rank), owners_.begin() + begin(rank + 1), rank);
  }
}

void Partition::part_graph(const Model& model) {
  const Graph graph = graph_of(model);
  const std::vector<double> costs = costs_of(model);
  const double most = *std::max_element(costs.begin(), costs.end());
  const auto parts = static_cast<PetscInt>(model.parts.size());

  Owned<Mat> adjacency;
  check_petsc(MatCreateMPIAdj(PETSC_COMM_SELF, parts, parts, petsc_copy(graph.begin), petsc_copy(graph.to),
                              petsc_copy(graph.nodes), adjacency.out()));
  Owned<MatPartitioning> partitioning;
  check_petsc(MatPartitioningCreate(PETSC_COMM_SELF, partitioning.out()));
  check_petsc(MatPartitioningSetAdjacency(partitioning, adjacency));
  check_petsc(MatPartitioningSetType(partitioning, MATPARTITIONINGPTSCOTCH));
  check_petsc(MatPartitioningSetNParts(partitioning, ranks_));
  check_petsc(MatPartitioningSetUseEdgeWeights(partitioning, PETSC_TRUE));
  PetscInt* weights = nullptr;
  check_petsc(PetscMalloc1(costs.size(), &weights));
  std::transform(costs.begin(), costs.end(), weights,
                 [most](double cost) { return 1 + static_cast<PetscInt>(heaviest * cost / std::max(most, 1.0)); });
  check_petsc(MatPartitioningSetVertexWeights(partitioning, weights));
  Owned<IS> found;
  check_petsc(MatPartitioningApply(partitioning, found.out()));
  const PetscInt* ranks = nullptr;
  check_petsc(ISGetIndices(found, &ranks));
  std::copy_n(ranks, owners_.size(), owners_.begin());
  check_petsc(ISRestoreIndices(found, &ranks));
}

}  // namespace engrane

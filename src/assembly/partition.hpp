// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "assembly/petsc.hpp"
#include "model/model.hpp"

namespace engrane {

/// Assigns elements to ranks. Small models are divided into equal shares in the order of the deck. Larger ones are partitioned
/// so that the parts share few nodes: fewer elements are then evaluated twice (Numbering::evaluated), and the ranks communicate
/// less.
class Partition {
 public:
  /// Assigns all elements to one rank.
  explicit Partition(const Model& model);
  /// Collective. The result is the same on every rank and in every run.
  Partition(const Model& model, MPI_Comm comm);

  int rank() const { return rank_; }
  int ranks() const { return ranks_; }
  /// `part`: index into Model::parts.
  int owner(int part) const { return owners_.empty() ? 0 : owners_[static_cast<std::size_t>(part)]; }
  /// Elements of this rank, ascending.
  const std::vector<int>& own() const { return own_; }

 private:
  void deal_out(int parts);
  void part_graph(const Model& model);

  int rank_ = 0, ranks_ = 1;
  std::vector<int> owners_, own_;
};

}  // namespace engrane

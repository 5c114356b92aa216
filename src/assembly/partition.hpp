// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "assembly/petsc.hpp"
#include "model/model.hpp"

namespace engrane {

/// Which rank has which element. Few elements are dealt out in the order of the deck, in equal shares; many are parted along few
/// shared nodes, so that few are evaluated twice (Numbering::evaluated) and ranks have little to tell each other.
class Partition {
 public:
  /// One rank has all.
  explicit Partition(const Model& model);
  /// Collective; the same on every rank and in every run.
  Partition(const Model& model, MPI_Comm comm);

  int rank() const { return rank_; }
  int ranks() const { return ranks_; }
  /// By index into Model::parts.
  int owner(int part) const { return owners_.empty() ? 0 : owners_[static_cast<std::size_t>(part)]; }
  /// The elements of this rank, ascending.
  const std::vector<int>& own() const { return own_; }

 private:
  void deal_out(int parts);
  void part_graph(const Model& model);

  int rank_ = 0, ranks_ = 1;
  std::vector<int> owners_, own_;
};

}  // namespace engrane

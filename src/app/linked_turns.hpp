// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "assembly/configuration.hpp"
#include "model/model.hpp"

namespace engrane::app {

/// Looks for nodes that turn far and lead meshes with small displacements by links, which follow them to first order only.
class LinkedTurns {
 public:
  explicit LinkedTurns(const Model& model);

  /// Takes each accepted step.
  void take(const Configuration& c);
  /// A warning on the node that turned farthest; empty if there is none.
  std::string remark() const;

 private:
  const Model& model_;
  std::vector<std::size_t> links_;  ///< indices into Model::parts, one for each leading node
  std::size_t farthest_ = 0;        ///< index into links_
  double angle_ = 0, time_ = 0;
};

}  // namespace engrane::app

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>
#include <vector>

#include "assembly/configuration.hpp"

namespace engrane::observe {

/// Compact, lossless copy of a configuration that is rarely read. A node that neither rotates nor moves, as all nodes in
/// statics of a mesh, takes only the memory of its position, about a tenth of a NodeState.
class PackedConfiguration {
 public:
  PackedConfiguration() = default;
  explicit PackedConfiguration(const Configuration& c);
  Configuration unpacked() const;

 private:
  Configuration rest_;                             ///< everything except the nodes
  std::vector<Vec3> positions_;                    ///< of all nodes
  std::vector<std::pair<int, NodeState>> others_;  ///< nodes with more than a position
};

}  // namespace engrane::observe

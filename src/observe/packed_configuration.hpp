// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>
#include <vector>

#include "assembly/configuration.hpp"

namespace engrane::observe {

/// A configuration that is kept and seldom read. Nodes that neither turn nor move, which in statics of a mesh are all, take the
/// bytes of a position, a tenth of a NodeState. Nothing is lost.
class PackedConfiguration {
 public:
  PackedConfiguration() = default;
  explicit PackedConfiguration(const Configuration& c);
  Configuration unpacked() const;

 private:
  Configuration rest_;                             ///< all but its nodes
  std::vector<Vec3> positions_;                    ///< of all nodes
  std::vector<std::pair<int, NodeState>> others_;  ///< nodes of which more than the position is to be remembered
};

}  // namespace engrane::observe

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "solve/analysis.hpp"

namespace engrane {

/// Equilibrium without inertia and damping, time being only the parameter of loads and drives.
class Statics final : public Analysis {
 public:
  explicit Statics(Workbench& bench);

  StartReport start(Configuration& c) override;
  NewtonReport attempt(const Configuration& from, double h, Configuration& to) override;

 private:
  Owned<Vec> unknowns_;
};

}  // namespace engrane

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/read.hpp"
#include "output/results.hpp"
#include "solve/run/runner.hpp"

namespace engrane::app {

/// Energies of the whole model and the work done since the start.
struct EnergyBalance {
  double kinetic = 0, potential = 0;
  double external_work = 0, dissipated = 0;
  double initial = 0;        ///< kinetic + potential at the start
  double largest_error = 0;  ///< largest |error()| so far

  /// What the balance fails to close by: E − E₀ − W + D.
  double error() const { return kinetic + potential - initial - external_work + dissipated; }
};

/// Looks at every accepted configuration: evaluates all output channels, keeps the energy balance, and says what is due
/// for the results. Every rank may have one; it needs no communication.
class Recorder {
 public:
  Recorder(const Reading& reading, solve::SolverContext& context);

  output::ResultsLayout layout() const;
  const std::vector<output::HistoryTable>& groups() const { return groups_; }
  /// Index of a channel in values(), or -1. `owner` as in HistoryTable::owner.
  int channel(const std::string& owner, const std::string& name) const;

  void observe(const Configuration& c, const solve::StepReport& step);
  const std::vector<double>& values() const { return values_; }
  const EnergyBalance& energies() const { return energies_; }

  /// Channels, index into values(), that redundant constraints leave undetermined: looked for at the start, after 1, 2, 4, …
  /// steps and at the end, since what is undetermined in one position may show in other components in the next.
  const std::vector<int>& not_unique() const { return not_unique_; }

  bool sample_due() const { return sample_due_; }
  bool frame_due() const { return frame_due_; }
  /// Fields of the last observed configuration; the spans live until the next observe().
  output::FrameValues frame() const;

  /// Reaction force and torque (global components) on a supported node, index into Model::nodes.
  struct Reaction {
    int node;
    Vec3 force, torque;
  };
  const std::vector<Reaction>& reactions() const { return reactions_; }

 private:
  void observe_elements(const Configuration& c, const solve::StepReport& step);
  void observe_nodes(const Configuration& c);
  std::vector<Reaction> reactions_at(const Configuration& c);
  void find_not_unique(const Configuration& c);
  /// Values of elements' channels and of nodes' reactions, zero in between.
  std::vector<double> reaction_values(const Configuration& c);
  /// Work of loads and supports between two equilibria, by the trapezoidal rule along the straight way between them.
  double static_work(const Configuration& from, const Configuration& to);
  void fill_fields(const Configuration& c);

  const Reading& reading_;
  solve::SolverContext& context_;
  bool moves_;  ///< the analysis has velocities
  std::vector<output::HistoryTable> groups_;
  std::vector<int> channel_begin_;   ///< per part, first channel in values_
  std::vector<int> observed_nodes_;  ///< with histories
  int node_begin_ = 0, run_begin_ = 0;
  std::vector<double> values_;
  EnergyBalance energies_;
  std::vector<int> not_unique_;
  Configuration before_;  ///< of a static run: the last equilibrium
  double events_ = 0;
  double external_power_ = 0, dissipated_power_ = 0, last_time_ = 0;
  std::vector<int> supported_;
  std::vector<Reaction> reactions_;
  double frame_step_, sample_step_, next_frame_ = 0, next_sample_ = 0;
  bool frame_due_ = false, sample_due_ = false;
  std::vector<double> displacement_, rotation_, velocity_, angular_, reaction_force_, reaction_torque_;
};

}  // namespace engrane::app

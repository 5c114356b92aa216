// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Dense>
#include <optional>
#include <string>
#include <vector>

#include "math/extrapolation.hpp"
#include "observe/energies.hpp"
#include "observe/fields.hpp"
#include "observe/histories.hpp"
#include "observe/reactions.hpp"

namespace engrane::observe {

/// What an accepted configuration came from.
struct Step {
  double length = 0;
  int iterations = 0;      ///< of Newton's method
  std::size_t events = 0;  ///< met in it
  bool corner = false;     ///< it ends where a function of time has a corner
  // along a path of equilibria
  int unstable = 0;          ///< directions in which this one is unstable
  double critical_time = 0;  ///< load time of the last critical point
};

/// Everything that is computed from accepted configurations: the energy balance, histories, fields, reactions, and which
/// reactions are not unique. Each rank evaluates the elements that it owns; what is read from here is on rank 0.
class Observer {
 public:
  /// Collective, like all that is not const. `moves`: the analysis has velocities.
  Observer(Assembler& assembler, bool moves, const Selection& selection);

  /// The next accepted configuration, the start first. Histories and fields are computed where they are wanted.
  void observe(const Configuration& c, const Step& step, bool histories, bool fields);

  /// Remembers the histories observed from now on, for between().
  void keep_ends();
  /// A configuration in balance within the step whose end is observed next.
  void observe_inside(const Configuration& c);
  /// What values() were at an instant between the last two ends observed, of which `c` has the motion. All lies on a polynomial
  /// through the values observed since the last event, but for what nodes do, and angles that begin anew: these are of
  /// the motion. A force of something stiff, evaluated from an interpolated motion, would be its error.
  void between(const Configuration& c);
  /// Makes values() those of the last configuration observed again.
  void back_to_end();
  /// Computes the fields of a configuration in balance.
  void find_fields(const Configuration& c);
  /// The same for an instant between two ends, of which only the motion is known: forces are linear from end to end.
  void find_fields(const Configuration& c, const Configuration& from, const Configuration& to);

  /// Finds the channels that change when forces are added to the multipliers of `c` that have no effect on what moves; a few
  /// such combinations, the largest entry of each 1: redundant constraints leave them undetermined. To be asked now and then,
  /// since what is undetermined in one position may show in other components in the next.
  void find_not_unique(const Configuration& c, const std::vector<Eigen::VectorXd>& undetermined);

  const std::vector<Table>& tables() const { return histories_.tables(); }
  /// Channels of the whole model, whose values stand behind those of all tables.
  const std::vector<Channel>& run_channels() const { return run_channels_; }
  /// Column of a channel in values(), or -1. `owner` is `element/7`, `node/4` or `run`.
  int channel(const std::string& owner, const std::string& name) const;

  bool moves() const { return moves_; }
  /// Of the last configuration for which histories were wanted.
  const std::vector<double>& values() const { return values_; }
  /// Of the last configuration for which fields were wanted.
  const std::vector<NodalField>& fields() const { return fields_; }
  const std::vector<ElementField>& element_fields() const { return element_fields_.fields(); }
  /// Parts of the rows of ElementField::places.
  std::vector<int> place_parts(std::size_t field) const { return element_fields_.place_parts(field); }
  /// Fields averaged at nodes, and the points that they have values at.
  const std::vector<AveragedField>& averages() const { return element_fields_.averages(); }
  const SectionPoints& points() const { return element_fields_.points(); }
  /// Of the last fields; nothing where there are none or no element has stresses.
  std::optional<StressError> stress_error() const { return element_fields_.stress_error(); }
  const EnergyBalance& energies() const { return ledger_.balance(); }
  const std::vector<Reaction>& reactions() const { return last_reactions_; }
  /// Columns of values() that were found not to be unique so far, ascending.
  const std::vector<int>& not_unique() const { return not_unique_; }

  /// Buckling times for their channels; as many as the deck asks for, 0 where there is none.
  void set_buckling_times(std::vector<double> times) {
    times.resize(buckling_times_.size(), 0.0);
    buckling_times_ = std::move(times);
  }

  /// What must be remembered for a restart, beside the configuration last observed, which load() takes from the snapshot too.
  /// save() on rank 0, load() on all.
  void save(Snapshot& snapshot) const;
  void load(const Snapshot& snapshot);

 private:
  Assembler& assembler_;
  bool moves_;
  Reactions supports_;
  Histories histories_;
  EnergyLedger ledger_;
  std::vector<Channel> run_channels_;
  std::vector<double> values_;
  std::vector<NodalField> fields_;
  ElementFields element_fields_;
  std::vector<Reaction> last_reactions_;
  std::vector<int> not_unique_;
  double events_ = 0;
  std::vector<double> buckling_times_;
  bool cells_;       ///< the model has a mesh
  double mass_ = 0;  ///< of all, where it has

  void evaluate_histories(const Configuration& c, const Step& step);
  /// What a value is between two ends.
  struct Way {
    Channel::Course course;
    bool moves;  ///< it is that of the motion
  };
  std::vector<Way> ways() const;
  /// Adds values() to the points of the polynomials.
  void keep(double time);
  bool keeps_ends_ = false;
  std::vector<Way> ways_;
  std::vector<char> angles_;  ///< of each value of elements: it may begin anew after a turn
  std::vector<double> end_;   ///< values of the latest point, whose time is end_time_
  double end_time_ = 0;
  Extrapolation ends_;
  std::size_t steady_ = 0;  ///< points so far between which no angle has begun anew, and that stand close enough to tell
  bool inside_ = false;     ///< the present step has points inside
  bool event_ = false;      ///< what follows the latest point does not continue it
};

/// Channels of the whole model.
std::vector<Channel> run_channels(const Model& model, bool moves);

}  // namespace engrane::observe

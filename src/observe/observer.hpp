// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Dense>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "assembly/reactions.hpp"
#include "observe/energies.hpp"
#include "observe/fields.hpp"
#include "observe/histories.hpp"
#include "observe/history_interpolation.hpp"

namespace engrane::observe {

/// The step that led to an accepted configuration.
struct Step {
  double length = 0;
  int iterations = 0;      ///< Newton iterations
  std::size_t events = 0;  ///< number of events in the step
  bool corner = false;     ///< a function of time has a corner at its end
  bool jump = false;       ///< a function of time has jumped in it, while nothing moved
  bool impulse = false;    ///< the speed of a drive has jumped, and the velocities with it
  // along an equilibrium path
  int unstable = 0;          ///< number of unstable directions at this equilibrium
  double critical_time = 0;  ///< load time of the last critical point
};

/// Computes all results from accepted configurations: energy balance, histories, fields, reactions, and which reactions are not
/// unique. Each rank evaluates its own elements; the results are on rank 0.
class Observer {
 public:
  /// Collective, like all non-const members. `moves`: the analysis has velocities.
  Observer(Assembler& assembler, bool moves, const Selection& selection);

  /// Observes the next accepted configuration; the first one is the start. Computes histories and fields only on request.
  void observe(const Configuration& c, const Step& step, bool histories, bool fields);

  /// Keeps the values of all histories observed from now on, for between().
  void keep_ends();
  /// Integrates powers by polynomials through several ends of steps (EnergyLedger), for even steps of a scheme of high order.
  void integrate_smoothly() { ledger_.integrate_smoothly(); }
  /// Observes a configuration in equilibrium inside the step whose end is observed next, at one of the lobatto_points.
  void observe_inside(const Configuration& c);
  /// Takes only the power of a configuration as for observe_inside(), without histories.
  void integrate_inside(const Configuration& c) { ledger_.add_inside(c, supports_.at(c)); }
  /// Sets values() to those at an instant between the last two step ends, where `c` is the interpolated motion. Most values
  /// come from polynomials through the values observed since the last event (Channel::Course). Angles, velocities and angular
  /// velocities of nodes come from `c`; so do those of elements while an angle may have jumped by a turn. Forces are not
  /// evaluated from `c`: in a stiff element, the interpolation error would dominate. DeterminedChannels are functions of time
  /// and of the interpolated channels. Without `motion` `c` is the end of a drift, and only its time counts.
  void between(const Configuration& c, bool motion = true);
  /// Whether forces between step ends are to be those of a balance there (FineForces).
  bool has_fine_forces() const { return fine_forces_; }
  /// After between(): replaces the values of nodes, elements and the ground by those of a configuration in equilibrium there.
  void take_balance(const Configuration& c);
  /// Sets values() back to those of the last configuration observed.
  void back_to_end();
  /// Computes the fields of a configuration in equilibrium.
  void find_fields(const Configuration& c);
  /// Computes the fields at an instant between two step ends where only the motion `c` is known: forces are interpolated
  /// linearly.
  void find_fields(const Configuration& c, const Configuration& from, const Configuration& to);

  /// Finds the channels that are not unique because of redundant constraints: those that change when a self-equilibrated
  /// combination of multipliers is added to those of `c`. `undetermined`: a few such combinations, each with largest entry 1.
  /// Call repeatedly during the run: in another position, other channels may be affected.
  void find_not_unique(const Configuration& c, const std::vector<Eigen::VectorXd>& undetermined);

  const std::vector<Table>& tables() const { return histories_.tables(); }
  /// Channels of the whole model. Their values follow those of all tables.
  const std::vector<Channel>& run_channels() const { return run_channels_; }
  /// Column of a channel in values(), or -1. `owner` is `element/7`, `node/4` or `run`.
  int channel(const std::string& owner, const std::string& name) const;

  bool moves() const { return moves_; }
  /// Of the last configuration for which histories were requested.
  const std::vector<double>& values() const { return values_; }
  /// Of the last configuration for which fields were requested.
  const std::vector<NodalField>& fields() const { return fields_; }
  const std::vector<ElementField>& element_fields() const { return element_fields_.fields(); }
  /// Index of the part for each row of ElementField::places.
  std::vector<int> place_parts(std::size_t field) const { return element_fields_.place_parts(field); }
  /// Fields averaged at nodes, and the points where they are given.
  const std::vector<AveragedField>& averages() const { return element_fields_.averages(); }
  const SectionPoints& points() const { return element_fields_.points(); }
  /// Of the last fields; empty if there are none or no element has stresses.
  std::optional<StressError> stress_error() const { return element_fields_.stress_error(); }
  const EnergyBalance& energies() const { return ledger_.balance(); }
  const std::vector<Reaction>& reactions() const { return last_reactions_; }
  /// Columns of values() found not to be unique so far, ascending.
  const std::vector<int>& not_unique() const { return not_unique_; }

  /// Sets the values of the buckling time channels. Missing modes get 0.
  void set_buckling_times(std::vector<double> times) {
    times.resize(buckling_times_.size(), 0.0);
    buckling_times_ = std::move(times);
  }

  /// Everything needed for a restart, except the last configuration observed, which load() also takes from the snapshot. Call
  /// save() on rank 0 and load() on all ranks.
  void save(Snapshot& snapshot) const;
  void load(const Snapshot& snapshot);

 private:
  Assembler& assembler_;
  bool moves_;
  Reactions supports_;
  ElementFields element_fields_;
  Histories histories_;
  EnergyLedger ledger_;
  std::vector<Channel> run_channels_;
  std::vector<double> values_;
  std::vector<NodalField> fields_;
  std::vector<Reaction> last_reactions_;
  std::vector<int> not_unique_;
  double events_ = 0;
  std::vector<double> buckling_times_;
  bool fine_forces_;
  bool cells_;       ///< the model has cells
  double mass_ = 0;  ///< total mass, only if it has cells

  void evaluate_histories(const Configuration& c, const Step& step);
  /// Writes force and moment of the ground to values().
  void put_ground(const Resultant& ground);
  /// Writes the energies of the whole model to values(). Returns how many are adjacent: the strain energy is not.
  std::ptrdiff_t put_energies(const EnergyBalance& e);
  /// Adds the values of inside_ to the interpolation points, with the work that is known now.
  void keep_inside();
  /// The channel of each value.
  std::vector<const Channel*> channels() const;
  /// Sets the values of Histories::known(), for between(). `steady`: no angle jumps around `c`; `sources`: the
  /// interpolated sources.
  void put_known(const Configuration& c, bool steady, std::span<const double> sources);
  std::optional<HistoryInterpolation> interpolation_;  ///< once keep_ends() has been called
  std::vector<bool> of_steps_;                         ///< from then on: values that belong to a whole step
  std::vector<double> sources_;  ///< of the values of Histories::known(), which are found from them between two instants
  struct Inside {
    double time;
    std::vector<double> values, sources;
  };
  std::vector<Inside> inside_;  ///< interpolation points inside the current step
};

/// Channels of the whole model.
std::vector<Channel> run_channels(const Model& model, bool moves);

}  // namespace engrane::observe

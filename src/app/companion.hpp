// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "app/error_estimate.hpp"
#include "app/read.hpp"
#include "model/solver_options.hpp"
#include "observe/observer.hpp"
#include "solve/algebra/references.hpp"
#include "solve/schemes/lost_vibrations.hpp"

namespace engrane::app {

struct Resumption;

/// A channel with an error of its own: relative to the range of the channel, by a vibration with this period.
struct LostChannel {
  double error = 0;
  std::string channel;
  double period = 0;
};

/// The options with another TOL, and with it what follows from TOL: how far iterations go, and how sharply events are met.
SolverOptions with_tolerance(const Model& model, const SolverOptions& options, double tolerance);

/// A run before the run itself, with a looser tolerance and without files. The error of the run itself is estimated from their
/// difference (Hairer, Nørsett and Wanner, Solving Ordinary Differential Equations I, II.4, for one step; here for whole runs).
class Companion {
 public:
  enum class Span : unsigned char {
    whole,
    whole_if_it_follows  ///< ends early if its steps do not follow its tolerance
  };
  /// Makes the companion run; collective. `options`: of the run itself. `quiet`: shows no progress. `resumption`: the restart
  /// point from which both continue; nullptr: they begin at the start.
  Companion(const Reading& reading, const SolverOptions& options, MPI_Comm comm, bool quiet, const Resumption* resumption,
            Span span = Span::whole);

  /// Compares the values of the run itself at an even instant, the last that `observer` observed. On rank 0.
  void compare(double time, const observe::Observer& observer);
  /// Widens the ranges of channels to the values of the run itself at the end of a step, the last that `observer` observed. On
  /// rank 0. A motion with the frequency of the samples, or a multiple of it, looks still at the even instants.
  void widen(const observe::Observer& observer);
  /// The estimate after the run itself has ended with this number of steps. On rank 0.
  ErrorEstimate estimate(long steps) const;
  /// Of the channels that are compared, the acceleration of a node, or the force or velocity of an element, with the largest part
  /// lost by steps of the run itself. On rank 0, after estimate().
  LostChannel most_lost(const solve::LostVibrations& lost) const;
  /// Why the companion run failed; empty if it did not. On all ranks.
  const std::string& trouble() const { return estimate_.trouble; }
  /// Whether the run itself may be the companion of one with this tolerance. On all ranks.
  bool serves(double tolerance) const;
  /// Makes the run itself, of this number of steps and with the vibrations that these have lost, if the scheme knows them, the
  /// companion of a run with the options `next`. On all ranks.
  void succeed(long steps, const SolverOptions& next, const solve::LostVibrations* lost);
  /// Differences of the two runs by channel; empty before the run itself, and on ranks other than 0.
  std::vector<double> differences() const;
  /// Gives the differences() of a companion and its run, both with a greater TOL, to this one.
  void remember(const std::vector<double>& differences);
  /// Whether its steps followed TOL rather than HMAX. On all ranks.
  bool follows_tolerance() const { return follows_tolerance_; }

 private:
  /// Chooses the channels to compare: smooth ones, since states that change at another instant and unbounded ratios say nothing
  /// of the error; of the channels of the whole model only those that `.CHK` names, since work may be a small difference of large
  /// amounts.
  void choose_columns(const observe::Observer& observer, const Model& model);
  void record(double time, const std::vector<double>& values);
  /// Sets Column::load.
  void find_loads(const solve::References& references);
  /// Sets Column::at.
  void find_columns(const observe::Observer& observer);
  /// Row of an instant in values_; nothing if it is not kept.
  std::optional<std::size_t> place(double time) const;

  /// Whether this is the time of the last call. Of the values before and after a jump the first count.
  bool repeats(double time);

  /// A channel that is compared.
  struct Column {
    std::size_t own, at;  ///< column in values() of the companion's observer, and of the observer of the run itself
    std::string owner, channel;
    Dimension dimension;
    double squares = 0, least = 0, largest = 0;
    double before = 0;            ///< difference between the companion and its own companion; 0: it had none
    double earlier = 0;           ///< difference between two runs with a greater TOL; 0: there were none
    std::vector<int> nodes = {};  ///< of the element, for a force or a velocity: indices into Model::nodes
    int part = -1;                ///< element (index into Model::parts); −1: not a channel of an element
    int node = -1;                ///< index into Model::nodes; −1: not a channel of a node
    int component = -1;           ///< 0 to 2, of a vector of a node whose three columns are adjacent; −1: not one of these
    bool slides = false;          ///< the speed at which parts of an element slide: about zero where nothing slides
    double load = 0;  ///< for a force or moment: noise that the loads on its element make; for a power: that of a moment

    void include(double value) {
      least = std::min(least, value);
      largest = std::max(largest, value);
    }
    double range() const { return largest - least; }
    double size() const { return std::max(std::abs(largest), std::abs(least)); }
  };
  /// The largest range and size of all channels of a dimension.
  struct Largest {
    Dimension dimension;
    double range = 0, size = 0;
  };
  /// The part of an acceleration, of a force or of a velocity that steps have lost, over its range; an element has the forces of
  /// inertia of its nodes, and their relative velocity.
  LostChannel lost_acceleration(const Column& column, const solve::LostVibrations& lost) const;
  LostChannel lost_force(const Column& column, const solve::LostVibrations& lost) const;
  LostChannel lost_speed(const Column& column, const solve::LostVibrations& lost) const;
  /// Whether the companion has lost a vibration with another period in this slot. Then it is none of the model: a force that
  /// bends within a step, as that of a contact does, looks like one with a period that is proportional to the step.
  bool contradicts(const solve::LostVibrations& lost, std::size_t slot) const;
  /// Difference between the run and its companion in a column, from their rows of values at an instant.
  double difference(std::size_t column, const double* run, const double* companion) const;
  /// Difference between the two runs in a channel: root of the mean square over time.
  double difference(const Column& column) const;
  /// Observed order of convergence with the number of steps, from three successive runs; at most `assumed` (Roache, Verification
  /// and Validation in Computational Science and Engineering (1998), ch. 5).
  double order_of(const Column& column, long steps, double assumed) const;
  std::vector<Largest> largest_by_dimension() const;
  /// Whether it is a speed or acceleration of a node along or about an axis in which its place stands still but for rounding.
  bool stands_still(const Column& column) const;
  /// Whether the values of a column that changes far less than others of its dimension do not converge: differences of runs with
  /// ever smaller TOL do not fall. Such is what rounding of places leaves of the accelerations along stiff parts.
  bool is_rounding(const Column& column, const std::vector<Largest>& all) const;
  /// Largest range of a column that may be rounding and residuals of iterations alone, given the largest of all channels.
  double noise_of(const Column& column, const std::vector<Largest>& all) const;
  /// What the error of a column is a fraction of: its range, or, if most of the range is error, its size. Constants, such as the
  /// angular momentum of a free body, have no range of their own.
  double scale_of(std::size_t c) const;
  std::vector<Column> columns_;
  std::vector<double> lost_periods_;     ///< of what the companion has lost (LostVibrations::periods)
  std::vector<std::string> unjudged_;    ///< channels asked for by name that are never compared
  bool placed_ = true;                   ///< Column::at is known
  bool judges_run_ = false;              ///< a channel of the whole model is compared
  double handled_ = 0;                   ///< EnergyBalance::handled() of the run itself
  double extent_, duration_;             ///< of the model, and of the run
  double precision_, precision_of_run_;  ///< SolverOptions::precision of the companion and of the run itself
  double start_, interval_;
  std::size_t rows_ = 0, compared_ = 0;
  double last_ = -std::numeric_limits<double>::infinity();  ///< time of the last call of repeats()
  long steps_ = 0;
  long steps_before_ = 0;  ///< of the companion's own companion
  double order_of_steps_ = 2;
  bool follows_tolerance_ = false;
  std::vector<double> values_;      ///< of the companion: one row per instant; NaN if it was not reached
  std::vector<double> values_run_;  ///< of the run itself, laid out as values_
  ErrorEstimate estimate_;
  double begun_ = 0;  ///< processor time at which the run itself began
};

}  // namespace engrane::app

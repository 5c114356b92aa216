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

namespace engrane::app {

struct Resumption;

/// The options with another TOL, and with it what follows from TOL: how far iterations go, and how sharply events are met.
SolverOptions with_tolerance(const Model& model, const SolverOptions& options, double tolerance);

/// A run before the run, with a looser tolerance and without files: what the two differ by tells the error of the better one
/// (Hairer, Nørsett and Wanner, Solving Ordinary Differential Equations I, II.4, for one step; here for whole runs).
class Companion {
 public:
  enum class Span : unsigned char {
    whole,
    whole_if_it_follows  ///< ends early where its steps do not follow its tolerance
  };
  /// Runs; collective. `options`: of the run that it goes with. `quiet`: without a word on how far it is. `resumption`: where
  /// both go on from; nullptr: they start.
  Companion(const Reading& reading, const SolverOptions& options, MPI_Comm comm, bool quiet, const Resumption* resumption,
            Span span = Span::whole);

  /// An even instant of the run itself, which its observer has seen last. On rank 0.
  void compare(double time, const observe::Observer& observer);
  /// The end of a step of the run itself, which its observer has seen last. On rank 0. Ranges include it: what repeats as often
  /// as it is sampled, or at a multiple of that, looks still at the even instants.
  void widen(const observe::Observer& observer);
  /// After the run, of so many steps. On rank 0.
  ErrorEstimate estimate(long steps) const;
  /// Why it failed; empty when it did not. On all ranks.
  const std::string& trouble() const { return estimate_.trouble; }
  /// After the run, of so many steps: may the run itself be the companion of one with this tolerance? On all ranks.
  bool serves(double tolerance) const;
  /// It becomes that of a run with these options. On all ranks.
  void succeed(long steps, const SolverOptions& next);
  /// Was it TOL that chose its steps, and not the longest step? On all ranks.
  bool follows_tolerance() const { return follows_tolerance_; }

 private:
  /// Those that are smooth: a state that changes at another instant, or a ratio without bound, says nothing of the run. Of the
  /// channels of the whole model only those that `.CHK` names: work may be a small difference of what comes and goes.
  void choose_columns(const observe::Observer& observer, const Model& model);
  void record(double time, const std::vector<double>& values);
  /// Finds Column::load.
  void find_loads(const solve::References& references);
  /// Finds Column::at among the values of the run itself.
  void find_columns(const observe::Observer& observer);
  /// Place of an instant among those kept; empty for the others.
  std::optional<std::size_t> place(double time) const;

  /// Is it that of the last call? Of the two ends of a jump the first counts.
  bool repeats(double time);

  /// A channel that is compared.
  struct Column {
    std::size_t own, at;  ///< place among the values of this run's observer, and of the run's own
    std::string owner, channel;
    Dimension dimension;
    double squares = 0, least = 0, largest = 0;
    double before = 0;   ///< what the companion and its own companion differed by; 0: it had none
    int part = -1;       ///< of the model; −1: it is not one of an element
    int component = -1;  ///< of a vector of a node with three columns side by side; −1: it is none, or not all are compared
    double load = 0;     ///< of a force or a moment: the largest on the nodes of its element

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
  /// What the run is off by from its companion in a column, given their rows of values at an instant.
  double difference(std::size_t column, const double* run, const double* companion) const;
  /// What the two runs differ by in a channel: root of the mean square over time.
  double difference(const Column& column) const;
  /// The power of the numbers of steps that errors fall with, as three runs show that follow one another, at most `assumed`: the
  /// observed order (Roache, Verification and Validation in Computational Science and Engineering (1998), ch. 5).
  double order_of(const Column& column, long steps, double assumed) const;
  std::vector<Largest> largest_by_dimension() const;
  /// A range that tells of nothing but rounding and what iterations leave, beside all channels.
  double noise_of(const Column& column, const std::vector<Largest>& all) const;
  std::vector<Column> columns_;
  bool placed_ = true;                   ///< Column::at is known
  bool judges_run_ = false;              ///< a channel of the whole model is compared
  double handled_ = 0;                   ///< energy that has passed through the model of the run itself
  double extent_, duration_;             ///< of the model, and of the run
  double precision_, precision_of_run_;  ///< how far iterations go, here and in the run
  double start_, interval_;
  std::size_t rows_ = 0, compared_ = 0;
  double last_ = -std::numeric_limits<double>::infinity();  ///< the instant recorded, or compared, before
  long steps_ = 0;
  long steps_before_ = 0;  ///< of the companion's own companion
  double order_of_steps_ = 2;
  bool follows_tolerance_ = false;
  std::vector<double> values_;      ///< row by row; NaN where the instant was not reached
  std::vector<double> values_run_;  ///< the same of the run itself
  ErrorEstimate estimate_;
  double begun_ = 0;  ///< processor time at which the run itself began
};

}  // namespace engrane::app

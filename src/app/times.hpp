// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <string>

#include "output/listing.hpp"
#include "solve/algebra/linear.hpp"

namespace engrane::app {

/// Breakdown of a run's time: PETSc's event log for elements and factorisation, a stopwatch for output.
class Times {
 public:
  Times();

  /// Counts its own lifetime as output.
  class Watch {
   public:
    explicit Watch(double& sum) : sum_(sum) {}
    ~Watch() { sum_ += std::chrono::duration<double>(Clock::now() - begun_).count(); }
    Watch(const Watch&) = delete;
    Watch& operator=(const Watch&) = delete;

   private:
    using Clock = std::chrono::steady_clock;
    double& sum_;
    Clock::time_point begun_ = Clock::now();
  };
  Watch output() { return Watch(output_); }

  output::TimeSplit split(const solve::LinearSolver& solver) const;
  /// Suggests another solver if it would save time; empty if the gain is not worth mentioning.
  std::string advice(const solve::LinearSolver& solver, int ranks) const;

 private:
  struct Sum {
    double time = 0;
    int count = 0;
  };
  /// An event of PETSc's log, which counts since the program started, over earlier decks and attempts too.
  struct Event {
    const char* name;
    Sum before{};
    Sum now() const;
    Sum since() const;
  };
  void leave_out_the_rest();

  Event residuals_{"Residual"}, tangents_{"Tangent"}, factorisations_{"MatLUFactorNum"}, solutions_{"MatSolve"};
  std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
  double output_ = 0;
};

}  // namespace engrane::app

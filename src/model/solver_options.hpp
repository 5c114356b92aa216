// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string>

#include "model/model.hpp"

namespace engrane {

/// Analysis and solver settings: the cards `.SAM` and `.SUB` in terms of the solver, with all defaults filled in.
struct SolverOptions {
  enum class Analysis : unsigned char { statics, kinematics, dynamics };
  enum class Family : unsigned char { chung, newmark, hht, bossak, radau };

  Analysis analysis = Analysis::statics;
  Family family = Family::chung;  ///< of the time integration scheme, in dynamics
  double damping = 0.8;           ///< ρ∞ of CHUNG; α of HHT and BOSSAK
  bool static_start = false;      ///< dynamics starts from static equilibrium

  /// `.PATH`: equilibria are continued along the arc length of their path. It ends when the load parameter (time) reaches
  /// `end`, or earlier:
  struct Path {
    bool follow = false;
    int steps = 0;  ///< after this many steps; 0: no limit
    int node = 0, component = 0;
    double displacement = 0;  ///< when this node has this displacement from its reference position; node 0: no such limit
    int branch = 0;           ///< number of the bifurcation at which the path branches along the mode; 0: none
    double amplitude = 0;     ///< largest displacement of the branching step, with its sign
  } path;

  double begin = 0, end = 1;  ///< time
  double step = 0.1;          ///< H
  double tolerance = 0;       ///< largest local error of a step, as measured by StepError; 0: all steps have length H
  double longest = 0;         ///< longest step, with a tolerance
  int cuts = 10;              ///< maximum number of halvings of H

  std::string package = "MUMPS";  ///< linear solver (`.SAM SOLVER`)
  bool scheme_is_free = false;    ///< ACCURACY has chosen the scheme, and may choose another
  double target = 0;              ///< error requested by ACCURACY, relative to the ranges of the results; 0: none
  double precision = 1e-9;        ///< tolerance of Newton's iteration, relative to the largest force in the model
  bool keep_factors = false;      ///< factorised Newton matrices are reused for several steps of a transient
  int iterations = 20;            ///< maximum number of Newton iterations per attempt
  double scale = 0;               ///< k of the augmented Lagrangian; 0: automatic
  double penalty = 0;             ///< p of the augmented Lagrangian
  bool events = true;             ///< steps end where a law of an element changes
  bool bends = false;             ///< also where forces only bend (SwitchNames::bend)
  double event_tolerance = 1e-6;  ///< tolerance of their localisation, as a fraction of H
  double energy_error = 1;        ///< largest error of the energy balance, relative to EnergyBalance::handled(); 0: no limit

  bool moves() const { return analysis != Analysis::statics; }
  /// Steps all have length H, but those of RADAU also end at corners of functions of time: across one they are of low order.
  bool ends_even_steps_at_corners() const { return tolerance == 0 && analysis == Analysis::dynamics && family == Family::radau; }
};

/// Levels of `.SAM ACCURACY`: the target error of results relative to their ranges, the local tolerance with which nearly all
/// models meet it, and the initial tolerance of Radau IIA where the tolerance controls the steps (docs/accuracy.md).
struct AccuracyRung {
  const char* name;
  double target, tolerance, first;
};
inline constexpr std::array<AccuracyRung, 4> accuracy_rungs{
    {{"FAST", 1e-2, 5e-4, 2e-3}, {"NORMAL", 1e-3, 5e-5, 5e-4}, {"FINE", 1e-5, 2e-6, 2e-5}, {"REFERENCE", 1e-8, 2e-8, 2e-7}}};

/// Level of a dynamic analysis; nullptr if it requests no accuracy.
const AccuracyRung* accuracy_rung(const deck::AnalysisCard& analysis);

/// Sets TOL where ACCURACY determines it, removes it where it has no effect, and refuses HMAX without it.
void settle_tolerance(const deck::Deck& deck, Commands& commands, Diagnostics& diagnostics);

SolverOptions solver_options(const Model& model);

/// Default tolerance for locating events with error-controlled steps, as a fraction of the step: half of TOL, limited from
/// above.
double event_tolerance_for(double tolerance);

}  // namespace engrane

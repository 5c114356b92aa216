// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string>

#include "model/model.hpp"

namespace engrane {

/// What is to be solved and how: the cards `.SAM` and `.SUB` without the words of the deck, every default filled in.
struct SolverOptions {
  enum class Analysis : unsigned char { statics, kinematics, dynamics };
  enum class Family : unsigned char { chung, newmark, hht, bossak, radau };

  Analysis analysis = Analysis::statics;
  Family family = Family::chung;  ///< of the scheme, in dynamics
  double damping = 0.8;           ///< ρ∞ of CHUNG; α of HHT and BOSSAK
  bool static_start = false;      ///< dynamics begins in static equilibrium

  /// `.PATH`: equilibria are followed by the length of their path. It ends where the loads' time is `end`, or before.
  struct Path {
    bool follow = false;
    int steps = 0;  ///< after so many; 0: however many
    int node = 0, component = 0;
    double displacement = 0;  ///< where this node has moved so far from its reference; node 0: none
    int branch = 0;           ///< at this bifurcation the path goes on along the mode; 0: at none
    double amplitude = 0;     ///< largest displacement of the step that does so, with its sign
  } path;

  double begin = 0, end = 1;  ///< time
  double step = 0.1;          ///< H
  double tolerance = 0;       ///< most local error of a step, as StepError measures it; 0: all steps are of H
  double longest = 0;         ///< step, with a tolerance
  int cuts = 10;              ///< how often H may be halved

  std::string package = "MUMPS";  ///< direct solver
  bool scheme_is_free = false;    ///< ACCURACY has chosen it, and may choose another
  double target = 0;              ///< of the error that ACCURACY asks for, over ranges; 0: none
  double precision = 1e-9;        ///< of Newton's iteration, relative to the largest force in the model
  bool keep_factors = false;      ///< Newton's factors serve several steps of a transient
  int iterations = 20;            ///< most Newton iterations of an attempt
  double scale = 0;               ///< k of the augmented Lagrangian; 0: automatic
  double penalty = 0;             ///< p of the augmented Lagrangian
  bool events = true;             ///< steps end where a law of an element changes
  double event_tolerance = 1e-6;  ///< how sharply, as a part of H
  double energy_error = 1;        ///< most that the energy balance may be off, over EnergyBalance::handled(); 0: any

  bool moves() const { return analysis != Analysis::statics; }
};

/// What `.SAM ACCURACY` stands for: the error of results over their ranges, the local tolerance that nearly all models meet it
/// with, and the one that Radau IIA begins with where it is the tolerance that chooses the steps (docs/accuracy.md).
struct AccuracyRung {
  const char* name;
  double target, tolerance, first;
};
inline constexpr std::array<AccuracyRung, 4> accuracy_rungs{
    {{"FAST", 1e-2, 5e-4, 2e-3}, {"NORMAL", 1e-3, 5e-5, 5e-4}, {"FINE", 1e-5, 2e-6, 2e-5}, {"REFERENCE", 1e-8, 2e-8, 2e-7}}};

/// That of a dynamic analysis; nullptr where it asks for no accuracy.
const AccuracyRung* accuracy_rung(const deck::AnalysisCard& analysis);

SolverOptions solver_options(const Model& model);

/// How sharply controlled steps meet events, as a part of their length, in a deck that does not say: half of TOL.
double event_tolerance_for(double tolerance);

}  // namespace engrane

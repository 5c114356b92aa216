// SPDX-License-Identifier: BSD-3-Clause
// Runs a deck given as text inside a test, step by step.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <sstream>
#include <string>

#include "model/model.hpp"
#include "solve/run/runner.hpp"

namespace engrane::test {

using namespace solve;

/// Nodes and elements of a spatial double pendulum with offset inertia: rotations, gyroscopic terms, constraints.
inline const std::string double_pendulum = R"(
.NOE
 I 1 X 1 0 0
 I 2 X 2 0.5 0.3
.MCE
 I 1 HINGE N 0 1 AXIS 0 1 1 AT 0 0 0
 I 2 HINGE N 1 2 AXIS 1 0 2 AT 1.5 0.2 0.1
 I 3 INERTIA N 1 M 1 J 0.1 0.3 0.3
 I 4 INERTIA N 2 M 2 J 0.2 0.1 0.2
)";

/// A model read from text, with its workbench; fails the test when the deck is wrong.
class DeckRun {
 public:
  explicit DeckRun(const std::string& text) {
    deck_ = deck::read_text("test.dat", text, catalogue(element_types()), sources_, diagnostics_);
    model_ = build_model(deck_, element_types(), diagnostics_);
    std::ostringstream faults;
    diagnostics_.print(faults, sources_);
    if (diagnostics_.has_errors()) throw std::runtime_error(faults.str());
    context_ = std::make_unique<SolverContext>(model_, PETSC_COMM_SELF);
  }

  SolverContext& context() { return *context_; }
  const Model& model() const { return model_; }

  /// Runs to the end; `look` sees the start and every step. Returns the last configuration.
  Configuration run(const std::function<void(const Configuration&, const StepReport&)>& look = {}) {
    Configuration last;
    const auto scheme = make_scheme(*context_);
    Runner(*context_, *scheme)
        .run(
            [&](const Configuration& c, const StepReport& step) {
              if (look) look(c, step);
              last = c;
              return true;
            },
            [](const StartReport&) {});
    return last;
  }

  const NodeState& node(const Configuration& c, int id) const { return c.nodes[static_cast<std::size_t>(model_.node_index(id))]; }

  /// A channel of an element in a configuration.
  double channel(const Configuration& c, int element, const std::string& name) {
    for (std::size_t p = 0; p < model_.parts.size(); ++p) {
      const Element& e = *model_.parts[p].element;
      if (e.id() != element) continue;
      std::vector<double> values(e.channels().size());
      e.observe(context_->assembler.view(static_cast<int>(p), c), values);
      for (std::size_t i = 0; i < values.size(); ++i)
        if (e.channels()[i].name == name) return values[i];
    }
    throw std::runtime_error("no channel " + name);
  }

 private:
  SourceMap sources_;
  Diagnostics diagnostics_;
  deck::Deck deck_;
  Model model_;
  std::unique_ptr<SolverContext> context_;
};

}  // namespace engrane::test

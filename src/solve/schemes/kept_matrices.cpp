// SPDX-License-Identifier: BSD-3-Clause
#include "solve/schemes/kept_matrices.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "assembly/configuration_snapshot.hpp"
#include "solve/schemes/snapshot_part.hpp"

namespace engrane::solve {

namespace {

/// Limits to what is kept: entries of all matrices, and sets.
constexpr double most_numbers = 4e6, most_sets = 64;
/// Number of steps after an event that have sets of their own.
constexpr int most_steps = 2;

}  // namespace

KeptMatrices::KeptMatrices(Assembler& assembler, StageSolver& solver) : assembler_(assembler), solver_(solver) {
  MatInfo info;
  check_petsc(MatGetInfo(assembler.matrix(), MAT_GLOBAL_SUM, &info));
  most_ = static_cast<std::size_t>(std::clamp(most_numbers / (3 * std::max(info.nz_allocated, 1.0)), 1.0, most_sets));
}

void KeptMatrices::enter(const std::vector<int>& sides) {
  std::vector<int> phase = sides;
  phase.insert(phase.end(), phase_.begin(), phase_.begin() + static_cast<std::ptrdiff_t>(phase_.empty() ? 0 : sides.size()));
  phase.push_back(0);
  phase_ = std::move(phase);
}

void KeptMatrices::step() {
  if (!phase_.empty() && phase_.back() < most_steps) ++phase_.back();
}

bool KeptMatrices::recall(double h) { return combine(phase_, h); }

bool KeptMatrices::restore(double h) { return combine(current_, h); }

bool KeptMatrices::combine(const std::vector<int>& phase, double h) {
  const auto known = sets_.find(phase);
  if (known == sets_.end() || known->second.scale != assembler_.scale()) return false;
  solver_.combine(known->second.matrices, h);
  current_ = phase;
  return true;
}

void KeptMatrices::evaluate(const Configuration& c, double h) {
  if (sets_.size() >= most_ && sets_.find(phase_) == sets_.end()) sets_.clear();
  const auto [place, made] = sets_.try_emplace(phase_);
  Set& set = place->second;
  if (made) set.matrices = new_stage_matrices(assembler_);
  set.at = c;
  set.scale = assembler_.scale();
  evaluate_at(assembler_, c, set.matrices);
  solver_.combine(set.matrices, h);
  current_ = phase_;
}

const StageMatrices* KeptMatrices::current() const {
  const auto known = sets_.find(current_);
  return known == sets_.end() ? nullptr : &known->second.matrices;
}

void KeptMatrices::save(Snapshot& snapshot) const {
  snapshot.put("phase", {phase_.begin(), phase_.end()});
  snapshot.put("current", {current_.begin(), current_.end()});
  int number = 0;
  for (const auto& [phase, set] : sets_) {
    if (set.scale != assembler_.scale()) continue;
    Snapshot one;
    save_configuration(set.at, one);
    one.put("phase", {phase.begin(), phase.end()});
    save_part(one, fmt::format("set {}/", number++), snapshot);
  }
  snapshot.put("sets", number);
}

void KeptMatrices::load(const Snapshot& snapshot) {
  const auto whole = [](const Snapshot& from, const char* name = "phase") {
    const std::vector<double>& phase = from.array(name);
    std::vector<int> numbers(phase.size());
    std::transform(phase.begin(), phase.end(), numbers.begin(), [](double number) { return static_cast<int>(number); });
    return numbers;
  };
  phase_ = whole(snapshot);
  current_ = whole(snapshot, "current");
  sets_.clear();
  for (int number = 0; number < static_cast<int>(snapshot.number("sets")); ++number) {
    const Snapshot one = part_of(snapshot, fmt::format("set {}/", number));
    Set& set = sets_[whole(one)];
    set.at = assembler_.numbering().reference_configuration(0);
    load_configuration(one, set.at);
    set.scale = assembler_.scale();
    set.matrices = new_stage_matrices(assembler_);
    evaluate_at(assembler_, set.at, set.matrices);
  }
}

}  // namespace engrane::solve

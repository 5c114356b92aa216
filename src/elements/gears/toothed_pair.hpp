// SPDX-License-Identifier: BSD-3-Clause
// Common base of the gear pair and the rack and pinion: unknowns and results of their teeth.
#pragma once

#include <algorithm>
#include <array>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "elements/common/slide_switches.hpp"
#include "elements/gears/contact_channels.hpp"
#include "elements/gears/tooth_contact.hpp"
#include "model/elastic_teeth.hpp"
#include "model/fine_forces.hpp"
#include "model/grip.hpp"
#include "model/templated_element.hpp"

namespace engrane::elements::gears {

/// Base of elements whose teeth meet on two nodes. The derived element writes its residual once, as
///
///     template <class T> void mesh(const Motion<T, 2>&, const State&, Balance<T, 2>&, ContactReport*) const;
///
/// including the rows of its first two scalars; `ToothContact::act` writes the others.
template <class Derived>
class ToothedPair : public TemplatedElement<Derived, 2, 20>, public ElasticTeeth, public FineForces {
 public:
  ToothedPair(int id, std::array<int, 2> nodes, const ToothContact& contact, std::array<Scalar, 2> motions, int history,
              std::vector<Channel> channels)
      : TemplatedElement<Derived, 2, 20>(id), contact_(contact), channels_(std::move(channels)) {
    add_contact_channels(channels_, contact_);
    Layout layout;
    layout.nodes.assign(nodes.begin(), nodes.end());
    layout.needs = {NodeNeed::both, NodeNeed::both};
    layout.scalars.assign(motions.begin(), motions.end());
    if (contact_.elastic()) layout.scalars.push_back({"U_M", dimension::length, "tooth deformation along the circumference"});
    layout.multipliers = {{"TOOTH", dimension::length, "tooth contact, phi_1: its multiplier is the normal force", Role::tooth},
                          {"MESH", dimension::length, "contact points along the circumference, phi_2"},
                          {"TRIAD", dimension::angle, "tooth triads about the tooth, phi_3"}};
    layout.history = history + extremes;
    layout.switches = contact_.switch_names();
    if (contact_.options().friction && !contact_.grips()) name_slide(layout, "flanks: ", false);
    if (contact_.grips()) add_grip(layout, {"GRIP", dimension::length, "friction at rest between the flanks"});
    this->set_layout(std::move(layout));
  }

  template <class T>
  void evaluate(const Motion<T, 2>& motion, const State& state, Balance<T, 2>& balance) const {
    self().mesh(motion, state, balance, nullptr);
  }

  /// Also stores, in the last history entries before the grips, the largest distance by which the wheels moved apart and the
  /// largest deflection of a flank whose contact onset is rounded.
  void commit(const State& state, std::span<double> scalars, std::span<double> history) const override {
    const ContactReport now = report(state);  // counting turns may shift ψ
    self().count_turns(state, scalars, history);
    const std::size_t at = first_extreme(history.size());
    history[at] = std::max(state.history[at], now.opening);
    if (contact_.rounds_contact()) history[at + 1] = std::max(state.history[at + 1], contact_.deflection(now));
  }
  std::vector<std::string> remarks(std::span<const double> history) const override {
    const std::size_t at = first_extreme(history.size());
    return contact_.remarks(history[at + 1], history[at]);
  }

  const ToothLaw& teeth() const { return contact_.law(); }
  const ContactOptions& options() const { return contact_.options(); }
  /// Results of the teeth, including their forces on both bodies.
  ContactReport report(const State& state) const {
    ContactReport report;
    Balance<double, 2> balance(state);
    self().mesh(this->template motion<double>(state), state, balance, &report);
    return report;
  }

  void start(std::span<double> scalars, std::span<double> history) const override {
    std::fill(scalars.begin(), scalars.end(), 0.0);
    std::fill(history.begin(), history.end(), 0.0);
  }
  /// Friction of each pair of flanks changes with every pair that enters, leaves or passes the pitch point.
  bool has_fine_forces() const override { return contact_.options().friction && contact_.options().friction->profile; }
  std::optional<Repetition> repetition() const override {
    return has_fine_forces() ? Repetition{0, static_cast<double>(contact_.geometry().teeth)} : std::optional<Repetition>();
  }
  int tooth_deformation() const override { return contact_.elastic() ? 2 : -1; }
  double tooth_deflection(const State& state) const override {
    const ContactReport now = report(state);
    return std::max({now.front, now.back, 0.0});
  }
  double tooth_size() const override { return std::max(self().design().normal_module, contact_.law().backlash); }
  Energies energies(const State& state) const override { return energies_of(report(state)); }
  const std::vector<Channel>& channels() const override { return channels_; }
  void switches(const State& state, std::span<Switch> values) const override {
    if (values.empty()) return;
    const auto slides = static_cast<std::size_t>(this->layout().slides);
    const std::size_t of_grips = contact_.grips() ? 2 : 0, of_contact = values.size() - of_grips - slides;
    if (of_contact > 0) contact_.switches(report(state), state, values.first(of_contact));
    grip_switches(*this, state, slide_switches(*this, state, values.subspan(of_contact), [](std::size_t) { return false; }));
  }
  bool has_gaps() const override { return contact_.has_gaps(); }
  bool touches(const State& state) const override { return contact_.touches(report(state), state); }
  void sliding(const State& state, std::span<Vec3> speeds) const override {
    if (!speeds.empty()) speeds[0] = report(state).sliding / contact_.options().friction->law.width;
  }
  void grip_limits(const State& state, std::span<double> limits) const override {
    if (contact_.grips()) limits[0] = report(state).grip_limit;
  }

 protected:
  ToothContact contact_;

  /// Friction at rest, including the constraint row of its grip; `turns` whole turns are added to ψ_A.
  template <class T>
  ToothGrip<T> grip(const T& psi_a, double turns, const State& state, Balance<T, 2>& balance) const {
    if (!contact_.grips()) return {};
    const GripState now = GripState::of(this->layout(), state.history, 0);
    const T along = contact_.grip_lever() * (psi_a + 2 * std::numbers::pi * turns) - now.held[0];
    const T held = balance.constraint(3, along);
    const bool holds = now.mode == GripState::holding;
    return {now.sense(), holds, holds ? held : T(0)};
  }

 private:
  static constexpr int extremes = 2;  ///< history entries: largest opening, largest deflection

  const Derived& self() const { return static_cast<const Derived&>(*this); }
  std::size_t first_extreme(std::size_t history) const {
    return history - static_cast<std::size_t>(extremes + (contact_.grips() ? GripState::history({}) : 0));
  }

  std::vector<Channel> channels_;
};

}  // namespace engrane::elements::gears

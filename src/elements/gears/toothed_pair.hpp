// SPDX-License-Identifier: BSD-3-Clause
// What a gear pair and a rack and pinion have in common as elements: the unknowns of their teeth and what they tell of them.
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "elements/gears/contact_channels.hpp"
#include "elements/gears/tooth_contact.hpp"
#include "model/templated_element.hpp"

namespace engrane::elements::gears {

/// Base of the elements whose teeth meet on two nodes. The derived element writes its residual once, as
///
///     template <class T> void mesh(const Motion<T, 2>&, const State&, Balance<T, 2>&, ContactReport*) const;
///
/// with the rows of its first two scalars, and `ToothContact::act` for the rest.
template <class Derived>
class ToothedPair : public TemplatedElement<Derived, 2, 18> {
 public:
  ToothedPair(int id, std::array<int, 2> nodes, const ToothContact& contact, std::array<Scalar, 2> motions, int history,
              std::vector<Named> channels)
      : TemplatedElement<Derived, 2, 18>(id), contact_(contact), channels_(std::move(channels)) {
    add_contact_channels(channels_, contact_);
    Layout layout;
    layout.nodes.assign(nodes.begin(), nodes.end());
    layout.needs = {NodeNeed::both, NodeNeed::both};
    layout.scalars.assign(motions.begin(), motions.end());
    if (contact_.elastic()) layout.scalars.push_back({"U_M", dimension::length, "tooth deformation along the circumference"});
    layout.multipliers = {{"TOOTH", dimension::length, "tooth contact, phi_1: its multiplier is the normal force", Role::tooth},
                          {"MESH", dimension::length, "contact points along the circumference, phi_2"},
                          {"TRIAD", dimension::angle, "tooth triads about the tooth, phi_3"}};
    layout.history = history + (contact_.rounds_contact() ? 1 : 0);
    layout.switches = contact_.switch_names();
    this->set_layout(std::move(layout));
  }

  template <class T>
  void evaluate(const Motion<T, 2>& motion, const State& state, Balance<T, 2>& balance) const {
    self().mesh(motion, state, balance, nullptr);
  }

  /// Remembers, last in the history, the most that a flank of teeth with a rounded onset was pressed in.
  void commit(const State& state, std::span<double> scalars, std::span<double> history) const override {
    const double pressed = contact_.rounds_contact() ? contact_.deflection(report(state)) : 0;  // counting turns may shift ψ
    self().count_turns(state, scalars, history);
    if (contact_.rounds_contact()) history.back() = std::max(state.history.back(), pressed);
  }
  std::vector<std::string> remarks(std::span<const double> history) const override {
    if (!contact_.rounds_contact()) return {};
    return contact_.remarks(history.back());
  }

  const ToothLaw& teeth() const { return contact_.law(); }
  const ContactOptions& options() const { return contact_.options(); }
  /// What the teeth tell, their forces on both bodies among it.
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
  Energies energies(const State& state) const override { return energies_of(report(state)); }
  const std::vector<Named>& channels() const override { return channels_; }
  void switches(const State& state, std::span<Switch> values) const override {
    if (!values.empty()) contact_.switches(report(state), state, values);
  }

 protected:
  ToothContact contact_;

 private:
  const Derived& self() const { return static_cast<const Derived&>(*this); }

  std::vector<Named> channels_;
};

}  // namespace engrane::elements::gears

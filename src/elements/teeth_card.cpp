// SPDX-License-Identifier: BSD-3-Clause
#include "elements/teeth_card.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

#include "elements/building.hpp"

namespace engrane {

namespace {

bool repeats_each_turn(const Function& function) {
  double size = 0, change = 0;
  for (int i = 0; i < 97; ++i) {
    const double x = -360 + 7.3 * i, f = function.at(x).f;
    size = std::max(size, std::abs(f));
    change = std::max(change, std::abs(function.at(x + 360).f - f));
  }
  return change <= 1e-9 * size;
}

bool set_error(ToothLaw& law, const TeethData& data, const TeethOwner& owner, const BuildContext& context) {
  if (!data.error.given()) return true;
  TransmissionError& error = law.error;
  error.teeth = owner.teeth[0];
  if (data.error.is("COS")) {
    error.kind = TransmissionError::Kind::cosine;
    error.amplitude = data.error.values[0];
  } else if (data.error.is("FOURIER")) {
    error.kind = TransmissionError::Kind::fourier;
    error.coefficients = data.error.values;
    if (error.coefficients.size() % 2 != 0) {
      context.error("ERR", fmt::format("ERR FOURIER with {} coefficients: they come in pairs a_n b_n", error.coefficients.size()),
                    "give 0 for a missing sine");
      return false;
    }
  } else {
    error.kind = TransmissionError::Kind::table;
    const double id = data.error.values[0];
    if (id != std::floor(id) || std::abs(id) > 1e9) {
      context.error("ERR", fmt::format("ERR TABLE {}: not the number of a function", number(id)));
      return false;
    }
    error.function = context.function(static_cast<int>(id), "ERR");
    if (!error.function) return false;
    if (!repeats_each_turn(*error.function)) {
      context.error("ERR", fmt::format("function {} does not repeat with each turn of wheel A", static_cast<int>(id)),
                    fmt::format("it is a function of A's angle in degrees: give it PERIOD 360, or PERIOD (360/{}) for one tooth",
                                owner.teeth[0]));
      return false;
    }
  }
  return true;
}

bool set_damping(ToothLaw& law, const TeethData& data, const TeethOwner& owner, const BuildContext& context) {
  if (data.damping && data.damping_ratio) {
    context.error("CM", "both XI and CM are given: each fixes the damping of the teeth", "keep one of them");
    return false;
  }
  if (data.damping) law.damping = *data.damping;
  if (!data.damping_ratio || *data.damping_ratio == 0) return true;
  std::array<double, 2> inertia{};
  bool good = true;
  for (const std::size_t wheel : {std::size_t{0}, std::size_t{1}}) {
    const int node = owner.nodes[wheel];
    inertia[wheel] = node == 0 ? std::numeric_limits<double>::infinity() : context.wheel_inertia(node, owner.axle[wheel]);
    if (inertia[wheel] > 0) continue;
    good = false;
    context.error("XI",
                  fmt::format("XI needs the inertia of both wheels about their axles (32, 33); node {} of wheel {} has none",
                              node, wheel == 0 ? "A" : "B"),
                  "give the damper itself with CM, or the wheel's inertia with INERTIA");
  }
  if (good)
    law.damping = tooth_damping(*data.damping_ratio, law.stiffness, inertia[0], inertia[1], owner.lever[0], owner.lever[1]);
  return good;
}

}  // namespace

std::optional<ToothLaw> tooth_law(const TeethData& data, const TeethOwner& owner, const BuildContext& context) {
  ToothLaw law;
  if (!data.stiffness) {
    const std::array<std::pair<std::string_view, bool>, 6> elastic{{{"XI", data.damping_ratio.has_value()},
                                                                    {"CM", data.damping.has_value()},
                                                                    {"JEU", data.backlash.has_value()},
                                                                    {"SMOOTH", data.onset.has_value()},
                                                                    {"DAMP", data.damping_mode.given()},
                                                                    {"ERR", data.error.given()}}};
    bool rigid = true;
    for (const auto& [keyword, given] : elastic)
      if (given) {
        rigid = false;
        context.error(keyword, fmt::format("{} describes elastic teeth, but these are rigid", keyword),
                      "give the tooth stiffness KM");
      }
    if (!rigid) return {};
    return law;
  }
  law.stiffness = *data.stiffness;
  law.backlash = data.backlash.value_or(0);
  law.onset = data.onset.value_or(1e-3 * law.backlash);
  law.mode = data.damping_mode.is("CONTACT") || (!data.damping_mode.given() && law.backlash > 0) ? ToothLaw::Damping::contact
                                                                                                 : ToothLaw::Damping::always;
  bool good = true;
  if (data.onset && law.onset > law.backlash) {
    context.error(
        "SMOOTH", fmt::format("SMOOTH {} is wider than the backlash JEU {}", number(law.onset), number(law.backlash)),
        law.backlash > 0 ? "give a small fraction of JEU" : "without JEU there is no onset of contact: leave SMOOTH out");
    good = false;
  }
  good = set_error(law, data, owner, context) && good;
  good = set_damping(law, data, owner, context) && good;
  if (!good) return {};
  return law;
}

}  // namespace engrane

// SPDX-License-Identifier: BSD-3-Clause
#include "elements/common/friction_card.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "elements/common/building.hpp"
#include "model/user_function.hpp"

namespace engrane::elements {

bool named_function(const BuildContext& context, std::string_view keyword, double id, const Function*& function) {
  if (id != std::floor(id) || std::abs(id) > 1e9) {
    context.error(keyword, fmt::format("{} {}: not the number of a function", keyword, number(id)));
    return false;
  }
  function = context.function(static_cast<int>(id), keyword);
  return function != nullptr;
}

bool read_friction(const BuildContext& context, const deck::Tagged& given, FrictionLaw& law) {
  const std::vector<double>& values = given.values;
  if (given.is("FCT")) {
    law.kind = FrictionLaw::Kind::function;
    if (!named_function(context, "FRICTION", values[0], law.of_speed)) return false;
    return values.size() < 2 || named_function(context, "FRICTION", values[1], law.of_load);
  }
  if (given.is("USER")) {
    const double scale = law.width > 0 ? law.width : 1;
    std::vector<user::Arguments> samples;
    for (const double speed : {1.0, 0.1, 0.5, 2.0, 10.0, 1000.0})
      for (const double load : {1.0, 100.0}) samples.push_back({speed * scale, load, 0});
    law.user = user_routine(context, "FRICTION", values[0], user::Kind::friction, {scale, 1, 1}, samples);
    return law.user != nullptr;
  }
  law.mu = values[0];
  if (given.is("CONST") && values.size() > 1) {
    if (!law.rests || values[1] < values[0]) {
      context.error("FRICTION",
                    law.rests ? "the coefficient at rest is below that of sliding" : "a coefficient at rest needs STICK",
                    "FRICTION CONST mu mu_s with STICK and mu_s >= mu");
      return false;
    }
    law.at_rest = values[1];
  }
  if (given.is("STRIBECK")) {
    law.kind = FrictionLaw::Kind::stribeck;
    law.kinetic = values[1];
    law.stribeck_speed = values[2];
    law.viscous = values.size() > 3 ? values[3] : 0;
  }
  const bool negative = std::any_of(values.begin(), values.end(), [](double v) { return v < 0; });
  if (negative || (law.kind == FrictionLaw::Kind::stribeck && law.stribeck_speed == 0)) {
    context.error("FRICTION", "friction coefficients are not negative, and the Stribeck speed is positive");
    return false;
  }
  return true;
}

}  // namespace engrane::elements

// SPDX-License-Identifier: BSD-3-Clause
// The keyword FRICTION of teeth, joints and cams.
#pragma once

#include "elements/common/friction_law.hpp"
#include "model/registry.hpp"

namespace engrane::elements {

/// Reads CONST, STRIBECK, FCT or USER into a law whose `width` and `rests` are already set. Returns false, with an error at
/// FRICTION, if the numbers are invalid.
bool read_friction(const BuildContext& context, const deck::Tagged& given, FrictionLaw& law);

/// Looks up the function with the number given on a card. Returns false, with an error at the keyword, if it does not exist.
bool named_function(const BuildContext& context, std::string_view keyword, double id, const Function*& function);

/// Adds the options of FRICTION. `rests`: the card has STICK, so that CONST may have a coefficient at rest.
inline void add_friction_options(deck::FieldBuilder field, bool rests = true) {
  field.synonyms({"FROTTEMENT"})
      .option({"CONST", {"COULOMB", "CONSTANT"}, rests ? "mu [mu_s]: mu_s at rest, with STICK" : "mu", 1, rests ? 2 : 1})
      .option({"STRIBECK", {}, "mu_s mu_k v_s [c]: mu_k + (mu_s - mu_k) exp(-(v/v_s)^2) + c v", 3, 4})
      .option({"FCT", {"NF", "TABLE"}, "f [g]: function f of the sliding speed, times function g of the normal force", 1, 2})
      .option({"USER", {"UTILISATEUR"}, "f: routine f of .FCT, of the sliding speed and the normal force", 1, 1});
}

}  // namespace engrane::elements

// SPDX-License-Identifier: BSD-3-Clause
#include "model/user_function.hpp"

#include <cmath>
#include <utility>

#include "base/text.hpp"
#include "model/registry.hpp"

namespace engrane {

namespace {

/// Time functions are resolved by the steps: a duration of this many steps is taken as the scale of change.
constexpr double steps_per_scale = 50;

}  // namespace

UserFunction::UserFunction(std::shared_ptr<const user::Source> source, const FunctionSetting& setting)
    : source_(source),
      routine_(std::move(source), user::Kind::function, {steps_per_scale * setting.step, 1, 1}),
      start_(setting.start),
      end_(setting.end),
      integral_(
          [this](double x) {
            return routine_.at({x, 0, 0})[0];
          },
          setting.step) {}

Function::Jet UserFunction::at(double x) const {
  const user::Results y = routine_.at({x, 0, 0});
  return {y[0], y[1], y[2], y[3]};
}

bool UserFunction::check(Location where, Diagnostics& diagnostics) const {
  std::vector<user::Arguments> samples;
  for (const double part : {0.0, 0.0513, 0.2371, 0.4129, 0.6407, 0.8191, 1.0})
    samples.push_back({start_ + part * (end_ - start_), 0, 0});
  const user::Fault fault = routine_.check(samples);
  if (!fault.good()) diagnostics.error(where, fault.message, fault.hint);
  return fault.good();
}

std::unique_ptr<Function> make_user_function(const deck::Record& record, const FunctionSetting& setting,
                                             Diagnostics& diagnostics) {
  const auto& card = *record.get<deck::FunctionCard>();
  const auto fail = [&](const char* keyword, const user::Fault& fault) {
    diagnostics.error(record.where(keyword), fault.message, fault.hint);
    return nullptr;
  };
  auto source = std::make_shared<user::Source>();
  source->name = card.user[1];
  source->parameters = card.parameters;
  source->scale = card.scale;
  user::Fault fault;
  source->library = user::Library::open(card.user[0], setting.folder, fault);
  if (!source->library) return fail("USER", fault);
  source->address = source->library->routine(source->name, fault);
  if (!source->address) return fail("USER", fault);
  return std::make_unique<UserFunction>(std::move(source), setting);
}

bool is_function_of_one_variable(const Function* function, Location where, Diagnostics& diagnostics) {
  if (function && function->law()) {
    diagnostics.error(where, "a formula of D and V is no function of one variable",
                      "it is a law: LAW EXPR f in a spring; a function's variable is T");
    return false;
  }
  const auto* user = dynamic_cast<const UserFunction*>(function);
  return !user || user->check(where, diagnostics);
}

std::shared_ptr<const user::Routine> user_routine(const BuildContext& context, std::string_view keyword, double id,
                                                  user::Kind kind, const user::Arguments& scale,
                                                  const std::vector<user::Arguments>& samples) {
  const std::string known = id == std::floor(id) && std::abs(id) < 1e9 ? std::to_string(static_cast<int>(id)) : format_number(id);
  const auto it = context.functions.find(static_cast<int>(std::abs(id) < 1e9 ? id : 0));
  if (it == context.functions.end() || known != std::to_string(it->first)) {
    context.diagnostics.missing(".FCT", context.record.where(keyword), "function " + known + " does not exist",
                                "declare the routine with .FCT I f USER \"library\" \"routine\"");
    return nullptr;
  }
  if (!it->second) return nullptr;  // already reported
  const auto* function = dynamic_cast<const UserFunction*>(it->second.get());
  if (!function) {
    context.error(keyword, "function " + known + " is no user routine, and USER takes one as a " + user::describe(kind),
                  "a function of one variable stands behind another word; engrane help shows which");
    return nullptr;
  }
  auto routine = std::make_shared<user::Routine>(function->source(), kind, scale);
  if (const user::Fault fault = routine->check(samples); !fault.good()) {
    context.error(keyword, fault.message, fault.hint);
    return nullptr;
  }
  return routine;
}

}  // namespace engrane

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostics.hpp"
#include "model/function.hpp"
#include "model/function_integral.hpp"
#include "user/routine.hpp"

namespace engrane {

struct BuildContext;

/// A routine of the user's (`.FCT I f USER …`): a function of one variable where a function is asked for, and by
/// `user_routine()` a law of more than one.
class UserFunction final : public Function {
 public:
  UserFunction(std::shared_ptr<const user::Source> source, const FunctionSetting& setting);

  Jet at(double x) const override;
  double integral(double x) const override { return integral_(x); }

  const std::shared_ptr<const user::Source>& source() const { return source_; }
  /// Tries it as a function of one variable, from the start of the run to its end; an error at `where` and false when it is none.
  bool check(Location where, Diagnostics& diagnostics) const;

 private:
  std::shared_ptr<const user::Source> source_;
  user::Routine routine_;
  double start_, end_;
  PanelIntegral integral_;
};

/// The function of a USER record; faults go to `diagnostics` and yield nullptr.
std::unique_ptr<Function> make_user_function(const deck::Record& record, const FunctionSetting& setting,
                                             Diagnostics& diagnostics);

/// Is a function that a keyword names fit to be one of one variable? False, with an error at `where`, when it is a routine of
/// another kind or a law. nullptr is fit: what is wrong with it was said already.
bool is_function_of_one_variable(const Function* function, Location where, Diagnostics& diagnostics);

/// The routine of a `.FCT USER` that a keyword names, used as a law of some kind: `scale` and `samples` as
/// user::Routine takes them. An error at the keyword, and nullptr, when there is none or it does not pass its check.
std::shared_ptr<const user::Routine> user_routine(const BuildContext& context, std::string_view keyword, double id,
                                                  user::Kind kind, const user::Arguments& scale,
                                                  const std::vector<user::Arguments>& samples);

}  // namespace engrane

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

/// A user routine (`.FCT I f USER …`): a function of one variable where a function is expected, or by `user_routine()` a law of
/// several variables.
class UserFunction final : public Function {
 public:
  UserFunction(std::shared_ptr<const user::Source> source, const FunctionSetting& setting);

  Jet at(double x) const override;
  double integral(double x) const override { return integral_(x); }

  const std::shared_ptr<const user::Source>& source() const { return source_; }
  /// Tests it as a function of one variable between the start and the end of the run. If it fails, reports an error at `where`
  /// and returns false.
  bool check(Location where, Diagnostics& diagnostics) const;

 private:
  std::shared_ptr<const user::Source> source_;
  user::Routine routine_;
  double start_, end_;
  PanelIntegral integral_;
};

/// Builds the function of a USER record. Faults go to `diagnostics`, and the result is nullptr.
std::unique_ptr<Function> make_user_function(const deck::Record& record, const FunctionSetting& setting,
                                             Diagnostics& diagnostics);

/// Whether a function that a keyword names can be used as one of one variable. If it is a law or a routine of another kind,
/// reports an error at `where` and returns false. True for nullptr, whose fault was already reported.
bool is_function_of_one_variable(const Function* function, Location where, Diagnostics& diagnostics);

/// The routine of a `.FCT USER` that a keyword names, used as a law of the given kind; `scale` and `samples` as for
/// user::Routine. If there is none or its check fails, reports an error at the keyword and returns nullptr.
std::shared_ptr<const user::Routine> user_routine(const BuildContext& context, std::string_view keyword, double id,
                                                  user::Kind kind, const user::Arguments& scale,
                                                  const std::vector<user::Arguments>& samples);

}  // namespace engrane

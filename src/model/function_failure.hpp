// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace engrane {

/// Records that a formula gave a non-finite number; `text` names the formula, the value and the point. `order` is 0 for the
/// value, 1 for the first derivative, and so on. A lower order replaces a higher one; at equal order, the later failure
/// replaces the earlier. The solver reports the record when it cannot proceed; failures at points that are not needed do no
/// harm.
void note_function_failure(int order, std::string text);

/// The recorded failure; empty if none since forget_function_failures().
std::string last_function_failure();
void forget_function_failures();

/// `is not a number`, `is infinite`
std::string describe_not_finite(double value);

}  // namespace engrane

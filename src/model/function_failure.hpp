// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace engrane {

/// Remembers that a formula gave something that is no finite number: `text` says which, what and where. `order` is 0 for its
/// value, 1 for its first derivative, …; a lower order is remembered instead of a higher, and a later failure instead of an
/// earlier. The solver asks for it when it cannot go on; a formula that fails where nobody needs it does no harm.
void note_function_failure(int order, std::string text);

/// What was noted last since forget_function_failures(); empty when nothing was.
std::string last_function_failure();
void forget_function_failures();

/// `is not a number`, `is infinite`
std::string describe_not_finite(double value);

}  // namespace engrane

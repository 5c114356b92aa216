// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace engrane {

/// Returns a message about a foreign file (SourceMap::foreign) with its quoted text removed: "`...` is not a keyword".
std::string without_quotes(std::string_view message);

}  // namespace engrane

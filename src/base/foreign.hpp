// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace engrane {

/// A message about a foreign file (SourceMap::foreign) without what it quotes of it: "`...` is not a keyword".
std::string without_quotes(std::string_view message);

}  // namespace engrane

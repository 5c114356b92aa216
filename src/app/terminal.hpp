// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace engrane::app {

/// Lines as they may go to a terminal: what a deck says (titles, references, formulas) must not steer it. Control characters
/// but the ends of lines become `?`.
std::string terminal_text(std::string_view text);

}  // namespace engrane::app

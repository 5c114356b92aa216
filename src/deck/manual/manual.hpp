// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "deck/read/reader.hpp"

namespace engrane::deck {

std::string help_overview(const Catalogue& catalogue);    ///< `engrane help`: all cards, a line each
std::string help_card(const Schema& schema);              ///< `engrane help GEAR`
std::string template_card(const Schema& schema);          ///< `engrane template GEAR`: a deck fragment to fill in
std::string manual_markdown(const Catalogue& catalogue);  ///< `engrane manual`: docs/reference.md
std::string json_schema(const Catalogue& catalogue);      ///< `engrane schema`

}  // namespace engrane::deck

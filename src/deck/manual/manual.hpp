// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "deck/read/reader.hpp"

namespace engrane::deck {

std::string help_overview(const Catalogue& catalogue);  ///< `engrane help`: all cards, a line each
std::string help_card(const Schema& schema);            ///< `engrane help GEAR`
/// `engrane help friction`: cards and keywords whose texts speak of the words, in English, Spanish or French, the nearest first;
/// empty when none do.
std::string help_search(const Catalogue& catalogue, const std::string& text);
/// The card of this name, or what the search finds.
std::string help_for(const Catalogue& catalogue, const std::string& text);
/// `engrane completion`: words, options and names of cards for bash.
std::string bash_completion(const Catalogue& catalogue, const std::vector<std::string>& tasks,
                            const std::vector<std::string>& options);
/// `engrane man`: the manual page, in roff. `usage` is what --help prints.
std::string man_page(const Catalogue& catalogue, const std::string& version, const std::string& usage);
std::string template_card(const Schema& schema);          ///< `engrane template GEAR`: a deck fragment to fill in
std::string manual_markdown(const Catalogue& catalogue);  ///< `engrane manual`: docs/reference.md
std::string json_schema(const Catalogue& catalogue);      ///< `engrane schema`

}  // namespace engrane::deck

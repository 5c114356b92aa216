// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "deck/read/reader.hpp"
#include "deck/schema/orders.hpp"

namespace engrane::deck {

std::string help_overview(const Catalogue& catalogue);  ///< `engrane help`: all cards, one line each
std::string help_card(const Schema& schema);            ///< `engrane help GEAR`
std::string help_order(const Order& order);             ///< `engrane help ABRE`
/// `engrane help friction`: cards and keywords whose texts contain the words, in English, Spanish or French, most relevant
/// first; empty if there are none.
std::string help_search(const Catalogue& catalogue, const std::string& text);
/// Help for the card or the order of this name or, if there is none, the result of the search.
std::string help_for(const Catalogue& catalogue, const std::string& text);
/// `engrane completion`: completion script for bash, with subcommands, options and names of cards.
std::string bash_completion(const Catalogue& catalogue, const std::vector<std::string>& tasks,
                            const std::vector<std::string>& options);
/// `engrane man`: the manual page in roff format. `usage` is the output of --help.
std::string man_page(const Catalogue& catalogue, const std::string& version, const std::string& usage);
std::string template_card(const Schema& schema);          ///< `engrane template GEAR`: a deck fragment to fill in
std::string manual_markdown(const Catalogue& catalogue);  ///< `engrane manual`: docs/reference.md
std::string json_schema(const Catalogue& catalogue);      ///< `engrane schema`

}  // namespace engrane::deck

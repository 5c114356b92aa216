// SPDX-License-Identifier: BSD-3-Clause
// Shell completion and the manual page, generated from the declared cards.
#include <algorithm>
#include <string>
#include <vector>

#include "base/text.hpp"
#include "deck/manual/manual.hpp"
#include "deck/schema/field_text.hpp"

namespace engrane::deck {

namespace {

/// Escapes a line for roff: a leading dot or quote, backslashes and hyphens have a special meaning.
std::string roff(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else
      out += c == '\n' ? ' ' : c;
  }
  return (out.starts_with('.') || out.starts_with('\'') ? "\\&" : "") + out;
}

void append_words(std::string& out, const Schema& card) {
  out += ".SS " + roff(card.name) + "\n" + roff(card.summary) + ".\n";
  for (const Field& field : card.fields) {
    out += ".TP\n.B " + roff(join(spellings(field), ", ")) + "\n" + roff(field.help);
    if (field.required) out += " (required)";
    if (const std::string known = default_text(card, field); !known.empty()) out += roff(" (default " + known + ")");
    out += "\n";
    for (const Option& option : field.options) out += ".br\n" + roff(option.name + ": " + option.help) + "\n";
  }
}

}  // namespace

std::string bash_completion(const Catalogue& catalogue, const std::vector<std::string>& tasks,
                            const std::vector<std::string>& options) {
  const auto listed = [](const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
    return text;
  };
  std::vector<std::string> cards;
  for (const auto* list : {&catalogue.elements, &catalogue.commands})
    for (const Schema* card : *list) cards.push_back(card->key().empty() ? card->name : std::string(card->key()));
  std::sort(cards.begin(), cards.end());
  cards.erase(std::unique(cards.begin(), cards.end()), cards.end());
  return "# bash completion of engrane; made by: engrane completion\n"
         "_engrane() {\n"
         "  local word=${COMP_WORDS[COMP_CWORD]}\n"
         "  COMPREPLY=()\n"
         "  if [[ $COMP_CWORD -gt 1 && ( ${COMP_WORDS[1]} == help || ${COMP_WORDS[1]} == template ) ]]; then\n"
         "    mapfile -t COMPREPLY < <(compgen -W '" +
         listed(cards) +
         "' -- \"${word^^}\")\n"
         "  elif [[ $word == -* ]]; then\n"
         "    mapfile -t COMPREPLY < <(compgen -W '" +
         listed(options) +
         "' -- \"$word\")\n"
         "  else\n"
         "    [[ $COMP_CWORD -eq 1 ]] && mapfile -t COMPREPLY < <(compgen -W '" +
         listed(tasks) +
         "' -- \"$word\")\n"
         "    mapfile -t -O ${#COMPREPLY[@]} COMPREPLY < <(compgen -d -- \"$word\"; compgen -f -X '!*.@(dat|h5)' -- \"$word\")\n"
         "  fi\n"
         "}\n"
         "shopt -s extglob\n"
         "complete -o filenames -F _engrane engrane ./engrane\n";
}

std::string man_page(const Catalogue& catalogue, const std::string& version, const std::string& usage) {
  std::string out = ".\\\" SPDX-License-Identifier: BSD-3-Clause\n.TH ENGRANE 1 \"\" \"engrane " + version +
                    "\"\n.SH NAME\nengrane \\- flexible multibody mechanisms with gears\n.SH SYNOPSIS\n.nf\n";
  std::size_t start = 0;
  while (start < usage.size()) {
    const std::size_t end = std::min(usage.find('\n', start), usage.size());
    out += roff(usage.substr(start, end - start)) + "\n";
    start = end + 1;
  }
  out += ".fi\n.SH COMMANDS OF A DECK\n";
  for (const Schema* card : catalogue.commands) append_words(out, *card);
  out += ".SH ELEMENTS\nAn element is given in .MCE as I <number> <TYPE> N <nodes> <keyword values>.\n";
  for (const Schema* card : catalogue.elements) append_words(out, *card);
  return out;
}

}  // namespace engrane::deck

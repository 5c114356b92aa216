// SPDX-License-Identifier: BSD-3-Clause
// `engrane help` for a text that is not the name of a card: full-text search over the cards.
#include <algorithm>
#include <cstddef>
#include <sstream>
#include <string>
#include <vector>

#include "base/text.hpp"
#include "deck/manual/manual.hpp"
#include "deck/schema/field_text.hpp"
#include "deck/schema/matching.hpp"
#include "deck/schema/thesaurus.hpp"

namespace engrane::deck {

namespace {

constexpr std::size_t most_cards = 12, most_keywords = 4;

/// Relevance of a match by its place in a card: a name counts more than a summary, a summary more than a description.
enum Worth : int { in_description = 1, in_help = 2, in_summary = 4, in_keyword = 5, in_name = 12 };

/// A search word: prefixes of matching words, and names that its concepts lead to.
struct Wanted {
  std::vector<std::string> beginnings;  ///< normalised by plain_word()
  std::vector<std::string> cards, keywords;
};

Wanted wanted_for(const std::string& word) {
  Wanted wanted;
  std::string plain = plain_word(word);
  while (!plain.empty() && plain.front() == '.') plain.erase(0, 1);
  const auto add = [&wanted](std::string beginning) {
    if (beginning.size() > 4 && beginning.back() == 'S' && beginning[beginning.size() - 2] != 'S') beginning.pop_back();
    wanted.beginnings.push_back(std::move(beginning));
  };
  add(plain);
  for (const Concept* c : find_concepts(word.starts_with('.') ? word.substr(1) : word)) {
    for (const std::string_view term : c->terms) add(plain_word(term));
    for (const std::string_view name : c->cards) wanted.cards.emplace_back(name);
    for (const std::string_view name : c->keywords) wanted.keywords.emplace_back(name);
  }
  return wanted;
}

/// Whether a word of the text starts with one of these prefixes.
bool speaks_of(const std::string& text, const std::vector<std::string>& beginnings) {
  const std::string plain = "_" + plain_word(text);
  return std::any_of(beginnings.begin(), beginnings.end(), [&](const std::string& beginning) {
    for (std::size_t at = plain.find(beginning, 1); at != plain.npos; at = plain.find(beginning, at + 1)) {
      const char before = plain[at - 1];
      if (!((before >= 'A' && before <= 'Z') || (before >= '0' && before <= '9'))) return true;
    }
    return false;
  });
}

bool is_among(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

struct Hit {
  const Schema* card = nullptr;
  int worth = 0;
  std::vector<const Field*> keywords;  ///< that match
};

/// Relevance of a keyword of a card to the search word.
int worth_of(const Field& field, const Wanted& wanted) {
  int worth = 0;
  if (is_among(wanted.keywords, field.keyword) || speaks_of(join(spellings(field), " "), wanted.beginnings)) worth += in_keyword;
  std::string help = field.help;
  for (const Option& option : field.options) help += " " + option.name + " " + join(option.synonyms, " ") + " " + option.help;
  for (const Code& code : field.codes) help += " " + code.meaning;
  return speaks_of(help, wanted.beginnings) ? worth + in_help : worth;
}

/// Searches a card; no hit unless every search word matches.
Hit look_into(const Schema& card, const std::vector<Wanted>& words) {
  Hit hit{&card, 0, {}};
  for (const Wanted& wanted : words) {
    int worth = 0;
    if (is_among(wanted.cards, card.name) || speaks_of(card.name + " " + join(card.synonyms, " "), wanted.beginnings))
      worth += in_name;
    if (speaks_of(card.summary, wanted.beginnings)) worth += in_summary;
    if (speaks_of(card.description, wanted.beginnings)) worth += in_description;
    int best = 0;
    for (const Field& field : card.fields) {
      const int here = worth_of(field, wanted);
      best = std::max(best, here);
      if (here > 0 && std::find(hit.keywords.begin(), hit.keywords.end(), &field) == hit.keywords.end())
        hit.keywords.push_back(&field);
    }
    worth += best;
    if (worth == 0) return {};
    hit.worth += worth;
  }
  return hit;
}

std::string shortened(const std::string& text, std::size_t size) {
  const std::vector<std::string> lines = wrap(text, size);
  return lines.empty() ? "" : lines.size() == 1 ? lines[0] : lines[0] + " …";
}

}  // namespace

std::string help_search(const Catalogue& catalogue, const std::string& text) {
  std::vector<Wanted> words;
  // `.DYNAM` may be a command of another program
  const std::vector<const Concept*> named = find_concepts(text.starts_with('.') ? text.substr(1) : text);
  // two words may form one name: `pressure angle`
  if (!named.empty()) {
    words.push_back(wanted_for(text));
  } else {
    std::istringstream stream(text);
    for (std::string word; stream >> word;) words.push_back(wanted_for(word));
  }
  std::vector<Hit> hits;
  for (const auto* list : {&catalogue.elements, &catalogue.commands})
    for (const Schema* card : *list)
      if (Hit hit = look_into(*card, words); hit.card && hit.worth > 0) hits.push_back(std::move(hit));
  if (words.empty() || hits.empty()) return {};
  std::stable_sort(hits.begin(), hits.end(), [](const Hit& a, const Hit& b) { return a.worth > b.worth; });

  std::string out = "No card is called " + text + "; these have to do with it (`engrane help NAME` tells more)\n\n";
  for (const Concept* c : named)
    if (!c->advice.empty()) out += std::string(c->advice) + ".\n\n";
  for (std::size_t i = 0; i < std::min(hits.size(), most_cards); ++i) {
    const Hit& hit = hits[i];
    out += hit.card->name + ": " + hit.card->summary + "\n";
    std::size_t shown = 0;
    for (const Field* field : hit.keywords) {
      if (shown++ == most_keywords) {
        out += "    and " + counted(hit.keywords.size() - most_keywords, "more keyword") + "\n";
        break;
      }
      out += "    " + field->keyword + ": " + shortened(field->help, 80) + "\n";
    }
  }
  if (hits.size() > most_cards) out += "and " + counted(hits.size() - most_cards, "more card") + "\n";
  return out;
}

std::string help_for(const Catalogue& catalogue, const std::string& text) {
  if (const Order* order = find_order(text)) return help_order(*order);
  std::vector<const Schema*> family;  // cards of a command such as `.CLM`
  for (const Schema* schema : catalogue.commands)
    if (same_word(schema->command(), text.starts_with('.') ? text : "." + text)) family.push_back(schema);
  if (family.size() > 1) {
    std::string out =
        std::string(family.front()->command()) + " has records of several kinds (`engrane help NAME` tells more)\n\n";
    for (const Schema* schema : family) out += schema->name + ": " + schema->summary + "\n";
    return out;
  }
  if (const Schema* card = catalogue.find(text)) return help_card(*card);
  const auto found = find_concepts(text);
  if (found.size() == 1 && found.front()->cards.size() == 1)
    if (const Schema* card = catalogue.find(found.front()->cards.front()))
      return plain_word(text) + " is called " + card->name + " here." +
             (found.front()->advice.empty() ? "" : " " + std::string(found.front()->advice) + ".") + "\n\n" + help_card(*card);
  return help_search(catalogue, text);
}

}  // namespace engrane::deck

// SPDX-License-Identifier: BSD-3-Clause
// canonical_text is a fixed point of reading; help, template, manual and JSON schema agree with the reader.
#include <gtest/gtest.h>

#include <random>
#include <regex>
#include <string>
#include <vector>

#include "deck/manual/manual.hpp"
#include "deck/schema/matching.hpp"
#include "deck_testing.hpp"

namespace engrane::deck {
namespace {

void expect_fixed_point(const std::string& text) {
  const ReadDeck first = read(text);
  ASSERT_FALSE(first.diagnostics.has_errors()) << text << first.messages();
  const std::string canonical = canonical_text(first.deck);
  const ReadDeck second = read(canonical);
  ASSERT_FALSE(second.diagnostics.has_errors()) << canonical << second.messages();
  EXPECT_EQ(canonical_text(second.deck), canonical);
  EXPECT_EQ(second.json(), first.json());
  ASSERT_EQ(second.deck.records.size(), first.deck.records.size());
  for (std::size_t i = 0; i < first.deck.records.size(); ++i)
    for (const Field& field : first.deck.records[i].schema->fields) {
      if (!field.whole.empty() || !field.codes.empty()) continue;
      EXPECT_EQ(first.deck.records[i].given(field.keyword), second.deck.records[i].given(field.keyword))
          << canonical << field.keyword;
    }
}

TEST(DeckCanonical, ExamplesOfAllCards) {
  for (const Schema& schema : general_commands())
    for (const std::string& example : schema.examples) {
      const ReadDeck deck = read(example);
      EXPECT_EQ(deck.messages(), "") << example;
      expect_fixed_point(example);
    }
}

TEST(DeckCanonical, EdgeCases) {
  expect_fixed_point("");
  expect_fixed_point(".TITRE \"\"");
  expect_fixed_point(".NOE I 1 Y 3\n.NOE I 2 X -0. 1e-308 1.7976931348623157e308\n");
  expect_fixed_point("MODE LECT 5000\n.TITRE \"" + std::string(2000, 'x') + "\"\n.NOE I 1");
  expect_fixed_point(".CLM FIX NOEUD 1 C 1\n.NOE I 1\n.CLM ADD FIX NOEUD 2 C 2\n.SAI STYP 163 223 NEWTON");
  expect_fixed_point(".SEL GROUP 3 NOM \"tab\there\" ELEMENTS 1 A 900 UNION 1 \"x y\" BOITE 0 1 0 1 0 1");
  expect_fixed_point(".FCT I 1 TABLE 0 (1/3) 1 1e10 2 0");
  expect_fixed_point(".SEL GROUP 1 BOITE 6*0.5");
  EXPECT_NE(canonical_text(read(".SEL GROUP 1 NOEUDS 1 2 3 4 7").deck).find("IDS 1 A 4 7"), std::string::npos);
}

/// Decks from a generator that picks keywords, spellings and values from the schemas themselves.
class RandomDeck {
 public:
  explicit RandomDeck(unsigned seed) : random_(seed) {}

  std::string record(const Schema& schema, int id) {
    std::string text = "\n" + std::string(schema.command()) + (schema.redefines ? " ADD" : "") + "\n";
    if (schema.command() == ".MCE")
      text += " I " + std::to_string(id) + " " + pick(record_words(schema));
    else if (schema.numbered)
      text += " " + schema.record_key + " " + std::to_string(id);
    else if (!schema.key().empty())
      text += " " + pick(record_words(schema));
    for (const Field& field : schema.fields)
      if (field.whole.empty() && (field.required || below(2) == 0)) text += (below(4) == 0 ? "\n  " : " ") + item(field);
    return text + "\n";
  }

 private:
  std::size_t below(std::size_t bound) { return std::uniform_int_distribution<std::size_t>(0, bound - 1)(random_); }
  std::string pick(const std::vector<std::string>& words) { return words[below(words.size())]; }

  std::string number(const Field& field) {
    if (!field.codes.empty()) return std::to_string(field.codes[below(field.codes.size())].number);
    const double low = std::isfinite(field.lower) ? field.lower : -5;
    const double high = std::isfinite(field.upper) ? field.upper : low + 10;
    if (field.type == FieldType::integer) {
      const int least = std::max(static_cast<int>(low), field.reference == Reference::nothing ? static_cast<int>(low) : 0);
      return std::to_string(least +
                            static_cast<int>(below(static_cast<std::size_t>(high) - static_cast<std::size_t>(least) + 1)));
    }
    return std::to_string(low + (high - low) * (0.1 + 0.08 * static_cast<double>(below(10))));
  }

  std::string item(const Field& field) {
    std::string text = pick(spellings(field));
    if (field.type == FieldType::flag) return text;
    if (field.type == FieldType::choice) {
      const Option& option = field.options[below(field.options.size())];
      text += " " + option.name;
      for (int i = 0; i < option.min_values; ++i) text += " " + std::to_string(i);
      return text;
    }
    const int most = std::min(field.max_values, field.min_values + 3);
    const int count = field.min_values + static_cast<int>(below(static_cast<std::size_t>(most - field.min_values) + 1));
    for (int i = 0; i < count; ++i)
      text += field.type == FieldType::text ? " \"t" + std::to_string(i) + "\"" : " " + number(field);
    return text;
  }

  std::mt19937 random_;
};

TEST(DeckCanonical, RandomRecordsOfEveryCard) {
  const Catalogue& catalogue = fake_catalogue();
  int good = 0;
  for (unsigned seed = 0; seed < 4000; ++seed) {
    RandomDeck random(seed);
    std::vector<const Schema*> all = catalogue.commands;
    all.insert(all.end(), catalogue.elements.begin(), catalogue.elements.end());
    const std::string text = random.record(*all[seed % all.size()], 1) + random.record(*all[(seed / 3) % all.size()], 2);
    if (read(text).diagnostics.has_errors()) continue;  // values that contradict each other, which the cards refuse
    ++good;
    expect_fixed_point(text);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(good, 500);
}

TEST(DeckCards, SchemasAreSound) {
  const Catalogue& catalogue = fake_catalogue();
  for (const Schema* schema : catalogue.commands) EXPECT_EQ(schema_faults(*schema), std::vector<std::string>{}) << schema->name;
  for (const Schema* schema : catalogue.elements) EXPECT_EQ(schema_faults(*schema), std::vector<std::string>{}) << schema->name;
}

TEST(DeckCards, CommandsDifferInTheirSignificantLetters) {
  std::map<std::string, std::string> owner;
  for (const Schema& schema : general_commands())
    for (const std::string& word : command_words(schema)) {
      const auto [entry, fresh] = owner.try_emplace(significant(word), schema.command());
      EXPECT_EQ(entry->second, schema.command()) << word;
    }
}

TEST(DeckCards, FilledTemplatesRead) {
  std::vector<const Schema*> all = fake_catalogue().commands;
  all.insert(all.end(), fake_catalogue().elements.begin(), fake_catalogue().elements.end());
  for (const Schema* schema : all) {
    std::string text = template_card(*schema);
    for (const auto& [blank, value] : std::vector<std::pair<std::string, std::string>>{
             {"<id>", "1"}, {"<node>", "1"}, {"<whole>", "5"}, {"<number>", "0.5"}, {"<text>", "text"}})
      text = std::regex_replace(text, std::regex(blank), value);
    const ReadDeck deck = read(text);
    for (const Diagnostic& diagnostic : deck.diagnostics.all()) {
      // what the blanks leave open (which shape a function has, a tolerance) is for the user to choose
      const bool open_choice = diagnostic.message.find("has no shape") != std::string::npos ||
                               diagnostic.message.find("no tolerance") != std::string::npos ||
                               diagnostic.message.find("gives the cells nothing") != std::string::npos ||
                               diagnostic.message.find("holds nothing") != std::string::npos ||
                               diagnostic.message.find("has no stiffness") != std::string::npos ||
                               diagnostic.message.find("needs C") != std::string::npos ||
                               diagnostic.severity == Severity::warning;
      EXPECT_TRUE(open_choice) << text << deck.messages();
    }
    EXPECT_EQ(deck.deck.records.size() + deck.deck.faulty.size(), 1U) << text;
  }
}

TEST(DeckCards, CatalogueFindsCardsByAnyName) {
  const Catalogue& catalogue = fake_catalogue();
  for (const auto& [word, name] : std::vector<std::pair<const char*, const char*>>{{"GEAR", "GEAR"},
                                                                                   {"engrenage", "GEAR"},
                                                                                   {"HIN", "HINGE"},
                                                                                   {".NOE", ".NOE"},
                                                                                   {".noeuds", ".NOE"},
                                                                                   {"NOE", ".NOE"},
                                                                                   {".CLM FIX", ".CLM FIX"},
                                                                                   {"FIX", ".CLM FIX"},
                                                                                   {"SAM", ".SAM"}}) {
    const Schema* schema = catalogue.find(word);
    ASSERT_NE(schema, nullptr) << word;
    EXPECT_EQ(schema->name, name) << word;
  }
  EXPECT_EQ(catalogue.find("NOTHING"), nullptr);
}

TEST(DeckCards, ManualHasEveryKeyword) {
  const std::string manual = manual_markdown(fake_catalogue());
  const std::string overview = help_overview(fake_catalogue());
  for (const Schema& schema : general_commands()) {
    EXPECT_NE(manual.find("### " + schema.name + "\n"), std::string::npos) << schema.name;
    EXPECT_NE(overview.find("  " + schema.name + " "), std::string::npos) << schema.name;
    const std::string help = help_card(schema);
    for (const Field& field : schema.fields) {
      EXPECT_NE(manual.find("| `" + field.keyword + "` |"), std::string::npos) << schema.name << field.keyword;
      EXPECT_NE(help.find("  " + field.keyword), std::string::npos) << schema.name << field.keyword;
    }
  }
}

}  // namespace
}  // namespace engrane::deck

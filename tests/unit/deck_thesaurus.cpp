// SPDX-License-Identifier: BSD-3-Clause
// What people call cards elsewhere must lead to cards and keywords that exist.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "deck/manual/manual.hpp"
#include "deck/schema/matching.hpp"
#include "deck/schema/thesaurus.hpp"
#include "model/model.hpp"
#include "model/registry.hpp"

namespace engrane::deck {
namespace {

TEST(Thesaurus, LeadsToCardsAndKeywordsThatExist) {
  const Catalogue all = engrane::catalogue(element_types());
  std::set<std::string> cards, keywords;
  for (const auto* list : {&all.commands, &all.elements})
    for (const Schema* schema : *list) {
      cards.insert(schema->name);
      for (const std::string& word : field_words(*schema)) keywords.insert(word);
    }
  cards.insert(".MCE");
  for (const Concept& c : concepts()) {
    EXPECT_FALSE(c.words.empty());
    for (const std::string_view name : c.cards) EXPECT_TRUE(cards.contains(std::string(name))) << name;
    for (const std::string_view name : c.keywords) EXPECT_TRUE(keywords.contains(std::string(name))) << name;
    for (const std::string_view word : c.words) {
      EXPECT_EQ(plain_word(word), word);
      for (const std::string_view card : c.cards) EXPECT_NE(word, card) << "a card needs no other way to its own name";
    }
  }
}

TEST(Thesaurus, AccentsAndPluralsAreNothing) {
  EXPECT_EQ(plain_word("fricción"), "FRICCION");
  EXPECT_EQ(plain_word("Élément-ñ"), "ELEMENT_N");
  for (const char* word : {"friction", "Fricción", "ROZAMIENTO", "frottement", "frottements", "rozamientos"}) {
    const auto found = find_concepts(word);
    ASSERT_EQ(found.size(), 1U) << word;
    EXPECT_EQ(found.front()->keywords.front(), "FRICTION") << word;
  }
  EXPECT_TRUE(find_concepts("xyzzy").empty());
}

TEST(Help, FindsTheCardThatBeginsSo) {
  const Catalogue all = engrane::catalogue(element_types());
  for (const auto& [word, name] : {std::pair{"FIX", ".CLM FIX"},
                                   {"fixed", ".CLM FIX"},
                                   {"CHA", ".CLM CHA"},
                                   {"charn", "HINGE"},
                                   {"hinge", "HINGE"},
                                   {".NOE", ".NOE"},
                                   {"noe", ".NOE"},
                                   {".CLM CHA", ".CLM CHA"},
                                   {"GEAR_PAIR", "GEAR"},
                                   {"ress", ""},
                                   {"xyzzy", ""}}) {
    const Schema* card = all.find(word);
    EXPECT_EQ(card ? card->name : "", name) << word;
  }
}

/// The cards that a search names, in its order.
std::vector<std::string> found_by(const std::string& words) {
  const Catalogue all = engrane::catalogue(element_types());
  const std::string text = help_for(all, words);
  std::vector<std::pair<std::size_t, std::string>> places;
  for (const auto* list : {&all.commands, &all.elements})
    for (const Schema* schema : *list)
      if (const std::size_t at = text.find("\n" + schema->name + ": "); at != text.npos) places.emplace_back(at, schema->name);
  std::sort(places.begin(), places.end());
  std::vector<std::string> names;
  for (const auto& [at, name] : places) names.push_back(name);
  return names;
}

TEST(Help, SearchesTheTexts) {
  const auto friction = found_by("friction");
  EXPECT_NE(std::find(friction.begin(), friction.end(), "HINGE"), friction.end());
  EXPECT_NE(std::find(friction.begin(), friction.end(), "GEAR"), friction.end());
  EXPECT_EQ(std::find(friction.begin(), friction.end(), ".NOE"), friction.end());
  EXPECT_EQ(found_by("rozamiento"), friction);
  EXPECT_EQ(found_by("Frottement"), friction);
  EXPECT_EQ(found_by("worm lead").front(), "GEAR");
  EXPECT_EQ(found_by("pressure angle").front(), "GEAR");
  EXPECT_EQ(found_by("amortiguador").front(), "SPRING") << "names go before texts";
  EXPECT_TRUE(help_for(engrane::catalogue(element_types()), "xyzzy").empty());
  const std::string hinge = help_for(engrane::catalogue(element_types()), "bisagra");
  EXPECT_TRUE(hinge.starts_with("BISAGRA is called HINGE here.")) << hinge.substr(0, 100);
  EXPECT_NE(hinge.find("\nHINGE (also"), std::string::npos);
}

TEST(Help, LeadsFromWhatMachinesAreCalled) {
  for (const auto& [words, card] : {std::pair{"piston", "GAS"},
                                    {"gas spring", "GAS"},
                                    {"tensioner", "BELT"},
                                    {"idler", "BELT"},
                                    {"idler", "GEAR"},
                                    {"freewheel", "TSPRING"},
                                    {"one-way clutch", "TSPRING"},
                                    {"ratchet", "HINGE"},
                                    {"governor", "CONTROLLER"},
                                    {"differential", "GEAR"},
                                    {"gyroscope", "RIGID"},
                                    {"gimbal", "HINGE"},
                                    {"hub", "WELD"},
                                    {"prescribed force", "FORCE"},
                                    {"rotating frame", ".CLM ROT"},
                                    {"tire", "RACK"},
                                    {"hydraulic", "PRISMATIC"},
                                    {"shell", "MEMBRANE"}}) {
    const auto found = found_by(words);
    EXPECT_NE(std::find(found.begin(), found.end(), card), found.end()) << words;
  }
  const Catalogue all = engrane::catalogue(element_types());
  const std::string toothed = help_for(all, "timing belt");
  EXPECT_TRUE(toothed.starts_with("TIMING_BELT is called BELT here. A toothed belt")) << toothed.substr(0, 100);
  EXPECT_TRUE(help_for(all, "chain drive").starts_with("CHAIN_DRIVE is called BELT here."));
  for (const char* word : {"tensioner", "idler", "eigenvalue", "modal", "modes", "frequency", "eigen", "vibration", ".DYNAM",
                           "shell", "plate", "plasticity", "tire", "hydraulic"})
    EXPECT_NE(help_for(all, word).find("not in this version"), std::string::npos) << word;
}

}  // namespace
}  // namespace engrane::deck

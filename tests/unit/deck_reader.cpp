// SPDX-License-Identifier: BSD-3-Clause
// Commands, files, and what is wrong with them.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "deck/cards/mesh_cards.hpp"
#include "deck/read/reader.hpp"
#include "deck_testing.hpp"

namespace engrane::deck {
namespace {

TEST(DeckReader, ClmAloneStartsAfresh) {
  const ReadDeck again = read(".CLM FIX NOEUD 1 C 1\n.CLM FIX NOEUD 2 C 1\n");
  ASSERT_EQ(again.deck.records.size(), 1U);
  EXPECT_EQ(again.at<FixCard>(0).nodes, std::vector<int>{2});
  EXPECT_EQ(again.diagnostics.warnings(), 1);
  const ReadDeck added = read(".CLM FIX NOEUD 1 C 1\n.CLM ADD FIX NOEUD 2 C 1\n");
  EXPECT_EQ(added.deck.records.size(), 2U);
  EXPECT_EQ(added.messages(), "");
}

TEST(DeckReader, OtherCommandsAdd) {
  const ReadDeck deck = read(".NOE I 1\n.MCE I 1 RIGID N 1 2\n.NOE I 2\n.MCE I 2 RIGID N 2 1\n");
  EXPECT_EQ(deck.messages(), "");
  EXPECT_EQ(deck.deck.records.size(), 4U);
  // as they do if they say so
  const ReadDeck said = read(
      ".NOE ADD I 1\n.NOE AJOUT\n I 2\n.MCE ADD I 1 RIGID N 1 2\n.MAT ADD I 1 YT 1\n"
      ".SEL ADD GROUP 1 NOM \"a\" NOEUDS 1\n.SEL ADD\n GROUP 1 NOEUDS 2\n"
      ".HYP ADD AXIS\n.PHP ADD GROUP 1 THICK VAL 2.\n.AEL ADD I 1 MAT 1\n"
      ".SAI ADD STYP 163\n.FCT ADD I 1 RAMP 0 0 1 1\n");
  EXPECT_EQ(said.messages(), "");
  EXPECT_EQ(said.deck.records.size(), 11U);
  EXPECT_EQ(only_message(".SUB ADD TF 1 H 1"), "`ADD` is not a keyword of .SUB");
  EXPECT_EQ(only_message(".MCE I 1 RIGID N 1\n.MCE I 1 HINGE N 1 2"), ".MCE 1 is given twice");
  EXPECT_EQ(only_message(".SUB TF 1 H 1\n.SUB TF 2 H 1"), ".SUB is given twice");
}

TEST(DeckReader, DelForgets) {
  EXPECT_EQ(read(".NOE I 1\n.CLM FIX NOEUD 1 C 1\n.DEL.CLM\n").deck.records.size(), 1U);
  const ReadDeck all = read(".NOE I 1\n.SUB TF 1 H 1\n.DEL.*\n.NOE I 1\n.SUB TF 2 H 1\n");
  EXPECT_EQ(all.messages(), "");
  EXPECT_EQ(all.deck.records.size(), 2U);
  EXPECT_EQ(only_message(".DEL.XYZ"), "`.DEL.XYZ` does not say which command to delete");
}

TEST(DeckReader, LeadingKeywordsStartTheNextRecord) {
  const ReadDeck deck = read(".CLM\n FIX NOEUD 1 GROUP \"a\" C 1 2 NOEUD 2 C 3\n  GROUP 7 C 1\n DEP NOEUD 3 C 1 V 2.\n");
  EXPECT_EQ(deck.messages(), "");
  ASSERT_EQ(deck.deck.records.size(), 4U);
  EXPECT_EQ(deck.at<FixCard>(0).groups, std::vector<std::string>{"a"});
  EXPECT_EQ(deck.at<FixCard>(1).components, std::vector<int>{3});
  EXPECT_EQ(deck.at<FixCard>(2).groups, std::vector<std::string>{"7"});
  EXPECT_EQ(deck.at<DisplacementCard>(3).values, std::vector<double>{2});
}

TEST(DeckReader, Checks) {
  const ReadDeck deck = read(
      ".CHK\n ELEMENT 1 NORMAL_FORCE T 1 V 2 RTOL 1e-9 REF \"x\"\n NODE 4 UX MAX WINDOW 0 1 V 3 ATOL 1 RUN ENERGY_ERROR V 0 ATOL "
      "1\n");
  EXPECT_EQ(deck.messages(), "");
  ASSERT_EQ(deck.deck.records.size(), 3U);
  EXPECT_EQ(deck.at<CheckCard>(0).element, 1);
  EXPECT_EQ(deck.at<CheckCard>(0).quantity, "NORMAL_FORCE");
  EXPECT_EQ(deck.at<CheckCard>(0).reference, "x");
  EXPECT_EQ(deck.at<CheckCard>(1).measure.tag, "MAX");
  EXPECT_TRUE(deck.at<CheckCard>(2).run);
}

TEST(DeckReader, HeadingHoldsForTheNodesOfItsCommand) {
  const ReadDeck deck = read(".NOE FRAME 3\n I 1 X 1\n I 2 FRAME 0\n.NOE\n I 3\n");
  EXPECT_EQ(deck.messages(), "");
  EXPECT_EQ(deck.at<NodeCard>(0).frame, 3);
  EXPECT_EQ(deck.at<NodeCard>(1).frame, 0);
  EXPECT_EQ(deck.at<NodeCard>(2).frame, 0);
}

TEST(DeckReader, AllErrorsInOneRun) {
  const ReadDeck deck = read(
      ".NOE\n I 1 X 1 Y a\n I 1\n.MCE\n I 1 GAER N 1 2\n I 2 HINGE N 1 2 DRIVE FAST\n I 3 GEAR N 1 2 Z 1 20 MN 0\n I 4 "
      "RIGID\n.FOO\n.SAM TYPE FLY\n");
  EXPECT_EQ(deck.diagnostics.errors(), 9) << deck.messages();
}

TEST(DeckReader, FaultyRecordsStandApart) {
  const ReadDeck deck = read(".NOE\n I 7 X oops\n");
  EXPECT_EQ(deck.deck.records.size(), 0U);
  ASSERT_EQ(deck.deck.faulty.size(), 1U);
  EXPECT_EQ(deck.deck.faulty[0].id, 7);
}

TEST(DeckReader, LocationsOfFields) {
  const ReadDeck deck = read(".MCE\n I 1 GEAR N 1 2 Z 20 40 MN 3\n");
  const Record& gear = deck.deck.records[0];
  EXPECT_TRUE(gear.given("Z"));
  EXPECT_FALSE(gear.given("ALPHA"));
  EXPECT_EQ(gear.where("Z").column, 19);
  EXPECT_EQ(gear.where("Z").length, 5);
  EXPECT_EQ(gear.where("ALPHA").column, 2);
}

TEST(DeckReader, RecognisedButNotInThisVersion) {
  EXPECT_EQ(only_message(".ASE I 1 N 1 2 0 -3"), "`.ASE` is recognised but not in this version: assembly of super-elements");
  const std::string relation = "`.CLM LIA` is recognised but not in this version: linear relations between displacements";
  EXPECT_EQ(only_message(".CLM LIA 1 2 PRE V 3"), relation);
  EXPECT_EQ(only_message(".CLM FIX NOEUD 1 C 1 LIA 1 2 PRE V 3"), relation);
}

TEST(DeckReader, ObjectsStandBeforeTheirRecord) {
  const ReadDeck deck = read(
      ".CLM ADD\n GROUP \"Clamped(1)\" FIX C 1 2 3 4 5 6 \n STRU ACC VAL 0 -9810 0\n NOEUD 49 CHA  C 2 V -1500\n"
      " NOEUD 49 CHA  C 1 V 250\n NOEUD 1 A 3 GROUP 7 DEP C 1 V 2.\n NOEUD 4 C 2 V 1. CHA NOEUD 5 C 1 V 3 NOEUD 6 FIX C 1\n");
  EXPECT_EQ(deck.messages(), "");
  ASSERT_EQ(deck.deck.records.size(), 8U);
  EXPECT_EQ(deck.at<FixCard>(0).groups, std::vector<std::string>{"Clamped(1)"});
  EXPECT_EQ(deck.at<GravityCard>(1).acceleration[1], -9810);
  EXPECT_EQ(deck.at<LoadCard>(2).nodes, std::vector<int>{49});
  EXPECT_EQ(deck.at<LoadCard>(3).values, std::vector<double>{250});
  EXPECT_EQ(deck.at<DisplacementCard>(4).nodes, (std::vector<int>{1, 2, 3}));
  EXPECT_EQ(deck.at<DisplacementCard>(4).groups, std::vector<std::string>{"7"});
  EXPECT_EQ(deck.at<DisplacementCard>(5).nodes, std::vector<int>{4}) << "no other record is named";
  EXPECT_EQ(deck.at<LoadCard>(6).nodes, std::vector<int>{5});
  EXPECT_EQ(deck.at<FixCard>(7).nodes, std::vector<int>{6});
  EXPECT_EQ(only_message(".CLM NOEUD 4"), "`NOEUD` is not followed by a record of .CLM");
  EXPECT_EQ(only_message(".CLM NOEUD 4 FAX C 1"), "`FAX` starts no record of .CLM");
}

TEST(DeckReader, RowsOfGroups) {
  const ReadDeck deck =
      read(".SEL\n GROUP 2 NOEUDS NOM \"a (1): b\"\n I 1 J 7 K 3 \n I 95 \n I 98 J 99\n GROUP 3 MAILLE NOM \"c\"\n I 4\n");
  EXPECT_EQ(deck.messages(), "");
  EXPECT_EQ(deck.at<GroupCard>(0).ids, (std::vector<int>{1, 4, 7, 95, 98, 99}));
  EXPECT_EQ(deck.at<GroupCard>(0).name, "a (1): b");
  EXPECT_TRUE(deck.at<GroupCard>(1).kind.is("ELEMENTS"));
  EXPECT_EQ(deck.at<GroupCard>(1).ids, std::vector<int>{4});
}

TEST(DeckReader, PropertiesOfCells) {
  const ReadDeck deck = read(
      ".HYP MEMB BIDIM GROUP \"plate (1)\"\n.PHP\n GROUP \"plate (1)\" THICK VAL 0.5 ! Thickness \n GROUP 2 THICK 3.\n.AEL\n I 1 "
      "THETA "
      "12.5\n I 2 THETA -3.25\n\n I 1 J 7 K 3 MAT 1\n GROUP 2 MAT 4\n");
  EXPECT_EQ(deck.messages(), "");
  ASSERT_EQ(deck.deck.records.size(), 7U);
  EXPECT_EQ(deck.at<HypothesisCard>(0).formulation, "MEMB");
  EXPECT_EQ(deck.at<HypothesisCard>(0).variant, "BIDIM");
  EXPECT_EQ(deck.at<PropertyCard>(1).thickness, 0.5);
  EXPECT_EQ(deck.at<PropertyCard>(2).groups, std::vector<std::string>{"2"});
  EXPECT_EQ(deck.at<AssignmentCard>(4).theta, -3.25);
  EXPECT_EQ(deck.at<AssignmentCard>(5).cells, (std::vector<int>{1, 4, 7}));
  EXPECT_EQ(deck.at<AssignmentCard>(6).material, 4);
}

TEST(DeckReader, WhatIsSkippedIsSaidOnce) {
  const ReadDeck deck = read(
      "MODE M -1 LECTURE 40\n.ALGO\n AXER 1\n.ALGO\n AXER 2\n#INQ (/N,NOD,,MAX)\n#INQ (/E,ELE,,MAX)\n.SAI\n ARCHIVE STRUCTURE "
      "STYPE -221\n"
      " ARCHIVE STRUCTURE STYP 1411 77 78\n ARCHIVE STRUCTURE STYP 78 223\nRETURN\n");
  EXPECT_EQ(deck.diagnostics.errors(), 0) << deck.messages();
  EXPECT_EQ(deck.diagnostics.warnings(), 4) << deck.messages();
  EXPECT_NE(deck.messages().find("(and 1 more time)"), std::string::npos);
  EXPECT_NE(deck.messages().find("STYP 77 78 have no result here and are skipped"), std::string::npos) << deck.messages();
  EXPECT_EQ(deck.at<ArchiveCard>(0).codes, (std::vector<int>{1411, 223}));
}

/// Decks in a folder of their own.
class DeckFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(::testing::TempDir()) /
              ("deck_files_" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
    std::filesystem::create_directories(folder_ / "parts");
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) { std::ofstream(folder_ / name) << text; }
  ReadDeck read_main() {
    ReadDeck result;
    result.deck = read_file(folder_ / "main.dat", fake_catalogue(), result.sources, result.diagnostics);
    return result;
  }

  std::filesystem::path folder_;
};

TEST_F(DeckFiles, InputNestsAndReturns) {
  write("main.dat", ".NOE\n I 1\nINPUT \"parts/a\"\n I 4\n");
  write("parts/a.dat", " I 2\nINPUT \"b.txt\"\nRETURN\n I 9\n");
  write("parts/b.txt", " I 3\n");
  const ReadDeck deck = read_main();
  EXPECT_EQ(deck.diagnostics.errors(), 0) << deck.messages();
  EXPECT_EQ(deck.diagnostics.warnings(), 1) << "what stands behind RETURN";
  ASSERT_EQ(deck.deck.records.size(), 4U);
  for (int i = 0; i < 4; ++i) EXPECT_EQ(deck.deck.records[static_cast<std::size_t>(i)].id, i + 1);
}

TEST_F(DeckFiles, IncludeChainAndDeckOrder) {
  write("main.dat", ".NOE\nINPUT \"parts/a\"\n I x\n");
  write("parts/a.dat", "\n\n\n\n I 2 Q\n");
  const ReadDeck deck = read_main();
  const std::string messages = deck.messages();
  const std::size_t inner = messages.find("a.dat:5:6: error: `Q` is not a keyword of .NOE");
  const std::size_t chain = messages.find("= included from " + (folder_ / "main.dat").string() + ":2");
  const std::size_t outer = messages.find("main.dat:3:2: error");
  ASSERT_NE(outer, std::string::npos) << messages;
  EXPECT_LT(inner, chain) << messages;
  EXPECT_LT(chain, outer) << messages;
}

TEST_F(DeckFiles, CyclesAndDevicesAreErrors) {
  write("main.dat", "INPUT \"parts/a\"\nINPUT \"/dev/zero\"\nINPUT \"parts\"\nINPUT \"missing\"\n");
  write("parts/a.dat", "INPUT \"../main.dat\"\n");
  const ReadDeck deck = read_main();
  EXPECT_EQ(deck.diagnostics.errors(), 4) << deck.messages();
  EXPECT_NE(deck.messages().find("includes itself"), std::string::npos);
  EXPECT_NE(deck.messages().find("is not a plain file"), std::string::npos);
}

TEST_F(DeckFiles, MissingDeck) {
  const ReadDeck deck = read_main();
  EXPECT_EQ(deck.messages(), "error: the deck `" + (folder_ / "main.dat").string() + "` does not exist\n");
}

}  // namespace
}  // namespace engrane::deck

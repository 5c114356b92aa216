// SPDX-License-Identifier: BSD-3-Clause
// The language of section 1 of the manual: lines, abbreviations, arithmetic, commands, keywords.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "deck_testing.hpp"

namespace engrane::deck {
namespace {

using Point = std::array<double, 3>;

TEST(DeckLanguage, CommandsByThreeLettersAndAnyCase) {
  for (const char* word : {".NOE", ".NOEUDS", ".noe", ".Noeud", ".NODES"}) {
    const ReadDeck read_deck = read(std::string(word) + "\n I 1 X 1 2 3\n");
    EXPECT_EQ(read_deck.messages(), "") << word;
    ASSERT_EQ(read_deck.deck.records.size(), 1U) << word;
    EXPECT_EQ(read_deck.at<NodeCard>(0).x, (Point{1, 2, 3}));
  }
}

TEST(DeckLanguage, RecordsEndAtTheNextKey) {
  const ReadDeck deck = read(".NOE I 1 X 1 2 3 I 2\n X 4\n Y 5 I 3 Z $\n 6\n");
  EXPECT_EQ(deck.messages(), "");
  ASSERT_EQ(deck.deck.records.size(), 3U);
  EXPECT_EQ(deck.at<NodeCard>(1).x, (Point{4, 5, 0}));
}

TEST(DeckLanguage, MaterialOverFourLines) {
  const ReadDeck deck = read(".MAT\n I 1 NOM \"steel\"\n BEHA \"ELASTIC\"\n YT 2.1E+11\n NT .3 M 7850.\n");
  EXPECT_EQ(deck.messages(), "");
  EXPECT_EQ(deck.at<MaterialCard>(0).young, std::vector{2.1e11});
  EXPECT_EQ(deck.at<MaterialCard>(0).density, 7850);
}

TEST(DeckLanguage, RowsAndMissingCoordinates) {
  const ReadDeck deck = read(".NOE\n 12 0. 0. 5.\n 13 1\n 14\n I 15 X -10. Y -0.25\n");
  EXPECT_EQ(deck.messages(), "");
  ASSERT_EQ(deck.deck.records.size(), 4U);
  EXPECT_EQ(deck.at<NodeCard>(0).x, (Point{0, 0, 5}));
  EXPECT_EQ(deck.at<NodeCard>(1).x, (Point{1, 0, 0}));
  EXPECT_EQ(deck.at<NodeCard>(2).x, (Point{0, 0, 0}));
  EXPECT_EQ(deck.at<NodeCard>(3).x, (Point{-10, -0.25, 0}));
  EXPECT_EQ(deck.deck.records[3].id, 15);
}

TEST(DeckLanguage, PrefixesAndSynonyms) {
  const ReadDeck deck = read(".MCE\n I 1 ENGRENAGE NOEUDS 1 2 Z 20 40 MN 2 ALP 25\n I 2 CHARN NODES 0 1 AXE 0 1 0 MOT VIT\n");
  EXPECT_EQ(deck.messages(), "");
  EXPECT_EQ(deck.at<FakeGear>(0).pressure_angle, 25);
  EXPECT_EQ(deck.at<FakeHinge>(1).drive.tag, "SPEED");
  EXPECT_EQ(only_message(".MCE I 1 GEAR N 1 2 Z 20 40 MN 2 A 1"), "`A` is short for several keywords of GEAR");
  EXPECT_EQ(only_hint(".MCE I 1 GEAR N 1 2 Z 20 40 MN 2 A 1"), "write AXIS or ALPHA");
}

TEST(DeckLanguage, ChoicesTakeTheirFirstWordWhenAlone) {
  const ReadDeck deck = read(".MCE\n I 1 HINGE N 0 4 DRIVE NF 1\n I 2 GEAR N 1 2 Z 9 9 MN 1 ERR cos 1e-3 2\n");
  EXPECT_EQ(deck.messages(), "");
  EXPECT_EQ(deck.at<FakeHinge>(0).drive.tag, "ANGLE");
  EXPECT_EQ(deck.at<FakeHinge>(0).function, 1);
  EXPECT_EQ(deck.at<FakeGear>(1).error.values, (std::vector<double>{1e-3, 2}));
  EXPECT_EQ(only_message(".MCE I 2 GEAR N 1 2 Z 9 9 MN 1 ERR COS"), "ERR COS takes 1 to 2 values, none given");
  EXPECT_EQ(only_message(".MCE I 2 GEAR N 1 2 Z 9 9 MN 1 ERR COS 1 2 3"), "ERR COS takes 1 to 2 values, 3 given");
}

TEST(DeckLanguage, CommentsContinuationTabsAndLineEnds) {
  const ReadDeck deck = read(
      "\xef\xbb\xbf.TITRE \"a ! no comment $\" ! a comment with \"quotes' and ( \r\n.NOE\r\n\tI\t1 $ ! goes on\r\n X 1 $\r\n2 "
      "3\r\n");
  EXPECT_EQ(deck.messages(), "");
  EXPECT_EQ(deck.at<TitleCard>(0).text, "a ! no comment $");
  EXPECT_EQ(deck.at<NodeCard>(1).x, (Point{1, 2, 3}));
}

TEST(DeckLanguage, ColumnLimit) {
  const ReadDeck deck = read("MODE LECT 12\n.NOE\n I 1 X 1    2 3 ! lost\n I 2 X 2  ! a comment may be longer\n");
  EXPECT_EQ(deck.at<NodeCard>(0).x, (Point{1, 0, 0}));
  EXPECT_EQ(deck.messages(),
            "deck.dat:3:13: warning: text past column 12 is not read\n"
            "  3 |  I 1 X 1    2 3 ! lost\n"
            "    |             ^~~~~~~~~~\n"
            "    = MODE LECT n sets how many columns are read; `$` continues a line\n");
  const ReadDeck cut = read("MODE LECT 12\n.NOE\n I 1 X 1 2.345\n I 2 X 1 2.34 5\n");
  EXPECT_EQ(cut.messages(),
            "deck.dat:3:10: error: `2.345` reaches past column 12, the last that is read: `2.3` is left of it\n"
            "  3 |  I 1 X 1 2.345\n"
            "    |          ^~~~~\n"
            "    = MODE LECT n sets how many columns are read; `$` continues a line\n"
            "deck.dat:4:10: error: `2.34` reaches past column 12, the last that is read: `2.3` is left of it\n"
            "  4 |  I 2 X 1 2.34 5\n"
            "    |          ^~~~\n"
            "    = MODE LECT n sets how many columns are read; `$` continues a line\n");
  const std::string wide = ".NOE\n I 1 X 1" + std::string(300, ' ') + "2\n";
  EXPECT_EQ(read(wide).at<NodeCard>(0).x, (Point{1, 0, 0}));
  EXPECT_EQ(read("MODE LECT 400\n" + wide).at<NodeCard>(0).x, (Point{1, 2, 0}));
}

TEST(DeckLanguage, ArithmeticInParentheses) {
  const ReadDeck deck = read(".NOE I 1 X (2*(3+4)**2) (-atan2(1,1)*180/PI) ( $\n 1.5D1 / 3 )");
  EXPECT_EQ(deck.messages(), "");
  EXPECT_DOUBLE_EQ(deck.at<NodeCard>(0).x[0], 98);
  EXPECT_DOUBLE_EQ(deck.at<NodeCard>(0).x[1], -45);
  EXPECT_DOUBLE_EQ(deck.at<NodeCard>(0).x[2], 5);
  const ReadDeck bad = read(".NOE I 1 X (1 + sqrt(-1)) (3");
  EXPECT_EQ(bad.diagnostics.errors(), 2);
  EXPECT_EQ(bad.diagnostics.all()[0].location.column, 17);
  EXPECT_EQ(bad.diagnostics.all()[1].message, "this ( is not closed");
}

TEST(DeckLanguage, Abbreviations) {
  const ReadDeck deck = read("ABRE '/r' '3' '/radius' '7'\nABRE '/node' 'I /r X /radius /r'\n.NOE\n /node (/r*2)\n");
  EXPECT_EQ(deck.messages(), "");
  EXPECT_EQ(deck.deck.records[0].id, 3);
  EXPECT_EQ(deck.at<NodeCard>(0).x, (Point{7, 3, 6}));
  EXPECT_EQ(read("ABRE '/r' '4'\n.NOE I 1 X (10//r) ").at<NodeCard>(0).x[0], 2.5);
  EXPECT_EQ(read("ABRE '/r' '4'\n.TITRE \"/r\"").at<TitleCard>(0).text, "/r");
  EXPECT_EQ(only_message("ABRE '/a' '/b' '/b' '/a'\n.NOE I 1 X 0 /a"), "the abbreviation `/a` uses itself");
  EXPECT_EQ(only_message("ABRE '/r' '4'\n.NOE I 1 X (10/r)"), "the abbreviation `/r` would be pasted right behind `0`");
  EXPECT_EQ(only_message("ABRE '/r' '4'\n.NOE I 1 X 0 /s"), "no ABRE defines `/s`");
  EXPECT_EQ(only_message("ABRE '/r' '4'\n.NOE I 1 X /r2"), "`/r2` is read as the abbreviation `/r` followed by `2`");
}

TEST(DeckLanguage, AbbreviationsDoNotExplode) {
  std::string text;
  for (char c = 'a'; c < 'z'; ++c) text += std::string("ABRE '/") + c + "' '/" + char(c + 1) + "/" + char(c + 1) + "'\n";
  EXPECT_EQ(only_message(text + "ABRE '/z' ''\n.NOE I 1 X 0 /a"), "the abbreviation `/a` grows without bounds");
}

TEST(DeckLanguage, RangesOfIds) {
  const ReadDeck deck = read(".SEL\n GROUP 1 NOM \"a\" NOEUDS 1 A 4 9 I 20 J 30 K 5 I 41 J 42\n.CLM FIX I 1 J 3 C 1\n");
  EXPECT_EQ(deck.messages(), "");
  EXPECT_EQ(deck.at<GroupCard>(0).ids, (std::vector<int>{1, 2, 3, 4, 9, 20, 25, 30, 41, 42}));
  EXPECT_EQ(deck.at<FixCard>(1).nodes, (std::vector<int>{1, 2, 3}));
  EXPECT_EQ(only_message(".SEL GROUP 1 NOEUDS 5 A 1"), "this range ends before it starts or has no step forward");
  EXPECT_EQ(only_message(".SEL GROUP 1 NOEUDS 1 A 999999999"), "this range has more than 1000000 numbers");
}

TEST(DeckLanguage, RepeatCounts) {
  EXPECT_EQ(read(".NOE I 1 X 3*2.5").at<NodeCard>(0).x, (Point{2.5, 2.5, 2.5}));
  EXPECT_EQ(only_message(".NOE I 1 X 4*2.5"), "X takes 1 to 3 values, 4 given");
}

TEST(DeckLanguage, WordsSkippedWithOneWarningEach) {
  const ReadDeck deck = read("MODE IMPRES 2\n.DES plot 'it\n.ALGO 1 2\n.NOE\n & I 1 #INQ(NODE) X 1\n.SAI STYP 163 12345\n");
  EXPECT_EQ(deck.diagnostics.errors(), 0) << deck.messages();
  EXPECT_EQ(deck.diagnostics.warnings(), 6) << deck.messages();
  EXPECT_EQ(deck.at<ArchiveCard>(1).codes, std::vector<int>{163});
}

TEST(DeckLanguage, FinEndsTheDeck) {
  const ReadDeck deck = read(".NOE I 1\n.FIN 1\n\n! a comment\n.NOE I 2\n");
  EXPECT_EQ(deck.deck.records.size(), 1U);
  EXPECT_EQ(deck.diagnostics.warnings(), 1);
  EXPECT_EQ(deck.diagnostics.all()[0].location.line, 5);
}

TEST(DeckLanguage, AnyBytes) {
  std::string bytes;
  for (int i = 0; i < 256; ++i) bytes += static_cast<char>(i);
  const ReadDeck deck = read(bytes + "\n.NOE " + bytes + "\n" + bytes);
  EXPECT_TRUE(deck.diagnostics.has_errors());
  EXPECT_EQ(deck.messages().find('\x1b'), std::string::npos) << "no escape codes reach the terminal";
}

TEST(DeckLanguage, LatinOneAndUtf8Texts) {
  EXPECT_EQ(read(".TITRE \"engrenage h\xe9"
                 "lico\xef"
                 "dal\"")
                .at<TitleCard>(0)
                .text,
            "engrenage h\xe9"
            "lico\xef"
            "dal");
  EXPECT_EQ(read(".TITRE \"engrenage hélicoïdal\"").at<TitleCard>(0).text, "engrenage hélicoïdal");
}

}  // namespace
}  // namespace engrane::deck

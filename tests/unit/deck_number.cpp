// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "deck/language/number.hpp"

namespace engrane::deck {
namespace {

TEST(DeckNumber, FortranSpellings) {
  const std::pair<const char*, double> spellings[] = {{"3", 3},
                                                      {"-3", -3},
                                                      {"+3", 3},
                                                      {".5", 0.5},
                                                      {"3.", 3},
                                                      {"-.5", -0.5},
                                                      {"2.1E+08", 2.1e8},
                                                      {"1.5D3", 1500},
                                                      {"1.5d-3", 1.5e-3},
                                                      {"1.5+3", 1500},
                                                      {"1.5-3", 1.5e-3},
                                                      {"1e5", 1e5},
                                                      {"1E05", 1e5},
                                                      {"0", 0},
                                                      {"0.1", 0.1},
                                                      {"1.D0", 1},
                                                      {"-1-3", -1e-3},
                                                      {"00012", 12},
                                                      {"1.7976931348623157e308", 1.7976931348623157e308},
                                                      {"0e999", 0}};
  for (const auto& [word, value] : spellings) {
    const Number number = parse_number(word);
    EXPECT_TRUE(number.good()) << word << ": " << number.fault;
    EXPECT_EQ(number.value, value) << word;
    EXPECT_EQ(number.repeat, 1) << word;
  }
}

TEST(DeckNumber, RepeatCounts) {
  const Number number = parse_number("3*-1.5D2");
  EXPECT_TRUE(number.good());
  EXPECT_EQ(number.value, -150);
  EXPECT_EQ(number.repeat, 3);
  EXPECT_FALSE(parse_number("0*1").good());
  EXPECT_FALSE(parse_number("-2*1").good());
  EXPECT_FALSE(parse_number("2*").good());
  EXPECT_FALSE(parse_number("*2").good());
  EXPECT_FALSE(parse_number("2*3*4").good());
  EXPECT_FALSE(parse_number("99999999999*1").good());
  EXPECT_FALSE(parse_number("1000001*1").good());
}

TEST(DeckNumber, WholeWordOrNothing) {
  for (const char* word : {"",    ".",    "+",    "-",     "1.2.3", "12abc", "1e",  "1e+",      "1d", "--1", "+-1",
                           "1,5", "0x10", "1.5f", "1e5.0", "1_000", "nan",   "inf", "infinity", "1+", "e5",  ".e5"})
    EXPECT_FALSE(parse_number(word).good()) << word;
}

TEST(DeckNumber, OverflowAndUnderflowAreFaults) {
  EXPECT_EQ(parse_number("1e400").fault, "`1e400` is too large for a double");
  EXPECT_EQ(parse_number("-1D+999").fault, "`-1D+999` is too large for a double");
  EXPECT_EQ(parse_number("1-400").fault, "`1-400` is too small for a double");
  EXPECT_EQ(parse_number("1e99999999999999999999").fault, "`1e99999999999999999999` is too large for a double");
}

TEST(DeckNumber, TellsNumbersFromWords) {
  for (const char* word : {"1", "-1", ".5", "-.5", "+.5", "3*0", "12abc"}) EXPECT_TRUE(looks_like_number(word)) << word;
  for (const char* word : {"", "-", ".", ".NOE", "A1", "e5", "-x"}) EXPECT_FALSE(looks_like_number(word)) << word;
}

}  // namespace
}  // namespace engrane::deck

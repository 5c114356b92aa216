// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <sstream>
#include <string>

#include "base/diagnostics.hpp"

namespace engrane {
namespace {

std::string printed(const Diagnostics& diagnostics, const SourceMap& sources) {
  std::ostringstream out;
  diagnostics.print(out, sources);
  return out.str();
}

TEST(SourceMap, Lines) {
  SourceMap sources;
  const int file = sources.add("a.dat", "one\r\n\nthree");
  EXPECT_EQ(sources.line_count(file), 3);
  EXPECT_EQ(sources.line(file, 1), "one");
  EXPECT_EQ(sources.line(file, 2), "");
  EXPECT_EQ(sources.line(file, 3), "three");
  EXPECT_EQ(sources.line(file, 4), "");
  EXPECT_EQ(sources.line(file, 0), "");
  EXPECT_EQ(sources.line_count(sources.add("b.dat", "x\n")), 1);
  EXPECT_EQ(sources.line_count(sources.add("c.dat", "")), 0);
}

TEST(Diagnostics, LineCaretAndHint) {
  SourceMap sources;
  const int file = sources.add("a.dat", "\tI 1 GAER\n");
  Diagnostics diagnostics;
  diagnostics.error({file, 1, 6, 4}, "unknown element type `GAER`", "did you mean `GEAR`?");
  EXPECT_EQ(printed(diagnostics, sources),
            "a.dat:1:6: error: unknown element type `GAER`\n"
            "  1 |  I 1 GAER\n"
            "    |      ^~~~\n"
            "    = did you mean `GEAR`?\n");
}

TEST(Diagnostics, CaretCountsCharactersNotBytes) {
  SourceMap sources;
  const int file = sources.add("a.dat", "é\xe9 x\n");  // UTF-8, then Latin-1
  Diagnostics diagnostics;
  diagnostics.warning({file, 1, 5, 1}, "here");
  EXPECT_EQ(printed(diagnostics, sources), "a.dat:1:4: warning: here\n  1 | éé x\n    |    ^\n");
}

TEST(Diagnostics, DeckOrderWithIncludes) {
  SourceMap sources;
  const int outer = sources.add("a.dat", "1\n2\n3\n");
  const int inner = sources.add("b.dat", "x\n", {outer, 2, 1, 1});
  Diagnostics diagnostics;
  diagnostics.error({}, "no place");
  diagnostics.error({outer, 3, 1, 1}, "third");
  diagnostics.error({inner, 1, 1, 1}, "second");
  diagnostics.error({outer, 1, 1, 1}, "first");
  EXPECT_EQ(printed(diagnostics, sources),
            "a.dat:1:1: error: first\n  1 | 1\n    | ^\n"
            "b.dat:1:1: error: second\n  1 | x\n    | ^\n    = included from a.dat:2\n"
            "a.dat:3:1: error: third\n  3 | 3\n    | ^\n"
            "error: no place\n");
}

TEST(Diagnostics, LongLinesAreCutAroundTheCaret) {
  SourceMap sources;
  const int file = sources.add("a.dat", std::string(5000, 'a') + "B" + std::string(5000, 'c'));
  Diagnostics diagnostics;
  diagnostics.error({file, 1, 5001, 1}, "there");
  const std::string text = printed(diagnostics, sources);
  EXPECT_LT(text.size(), 500U);
  const std::size_t line = text.find("  1 | ");
  const std::size_t mark = text.find("    | ");
  EXPECT_EQ(text.find('B') - line, text.find('^') - mark);
}

TEST(Diagnostics, Cap) {
  SourceMap sources;
  const int file = sources.add("a.dat", "x\n");
  Diagnostics diagnostics;
  for (int i = 0; i < 150; ++i) diagnostics.error({file, 1, 1, 1}, "wrong");
  diagnostics.warning({file, 1, 1, 1}, "odd");
  EXPECT_NE(printed(diagnostics, sources).find("and 50 more errors\n"), std::string::npos);
  EXPECT_NE(printed(diagnostics, sources).find("warning: odd"), std::string::npos);
}

TEST(Nearest, SlipsOfThePen) {
  const std::vector<std::string> words{"GEAR", "HINGE", "RIGID", "ALPHA", "MN"};
  EXPECT_EQ(nearest("GAER", words), "GEAR");
  EXPECT_EQ(nearest("gear", words), "GEAR");
  EXPECT_EQ(nearest("HINGES", words), "HINGE");
  EXPECT_EQ(nearest("ALHPA", words), "ALPHA");
  EXPECT_EQ(nearest("XYZ", words), "");
  EXPECT_EQ(nearest("A", words), "");
  EXPECT_EQ(nearest(std::string(100000, 'G'), words), "");
}

}  // namespace
}  // namespace engrane

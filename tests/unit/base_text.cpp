// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "base/text.hpp"

namespace engrane {
namespace {

TEST(Text, Words) {
  EXPECT_EQ(upper("aZé1"), "AZé1");
  EXPECT_TRUE(same_word("Gear", "gEAR"));
  EXPECT_TRUE(begins_with_word("GEARBOX", "gear"));
  EXPECT_FALSE(begins_with_word("GE", "gear"));
  EXPECT_EQ(join({"a"}), "a");
  EXPECT_EQ(join({"a", "b", "c"}), "a, b and c");
  EXPECT_EQ(join({"a", "b"}, " or "), "a or b");
  EXPECT_EQ(counted(1, "value"), "1 value");
  EXPECT_EQ(counted(2, "value"), "2 values");
  EXPECT_EQ(format_number(0.1), "0.1");
  EXPECT_EQ(wrap("one two three", 7), (std::vector<std::string>{"one two", "three"}));
}

TEST(Text, CharactersOfAnyEncoding) {
  EXPECT_EQ(character_count("aé€😀"), 4U);
  EXPECT_EQ(character_count("\xe9\xff\xc3"), 3U);  // Latin-1, and a sequence cut short
  EXPECT_EQ(character_count("\xc0\xaf"), 2U);      // overlong forms are no characters
  EXPECT_EQ(character_count("\xed\xa0\x80"), 3U);  // nor are surrogates
  EXPECT_EQ(printable("a\tb\x1b[31m\xe9\x9b"), "a b?[31mé?");
  EXPECT_EQ(printable("a\xc2\x9b"
                      "b\xc3\xa9"),
            "a?bé")
      << "C1 codes in UTF-8";
}

TEST(Text, Json) { EXPECT_EQ(json_string("a\"b\\c\n\x01\xe9é"), "\"a\\\"b\\\\c\\n\\u0001éé\""); }

}  // namespace
}  // namespace engrane

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace engrane {

/// ASCII upper case; other bytes are left alone, so that Latin-1 and UTF-8 both survive.
std::string upper(std::string_view text);

/// Whether two words are equal apart from ASCII case.
bool same_word(std::string_view a, std::string_view b);

/// Whether `word` begins with `start`, ignoring ASCII case.
bool begins_with_word(std::string_view word, std::string_view start);

/// Whether `word` abbreviates `language`, a word of the language, to three or more letters; false if it is empty.
bool abbreviates(std::string_view word, std::string_view language);

/// `a, b and c`; `last` joins the final two.
std::string join(const std::vector<std::string>& words, std::string_view last = " and ");

/// The shortest spelling that reads back as exactly the same number: `0.1`, `2.1e+08`, `-3`.
std::string format_number(double value);
void append_number(std::string& text, double value);

/// `1 value`, `3 values`.
std::string counted(std::size_t count, std::string_view noun);

/// Number of bytes of the character that starts at `text[i]`: 1 to 4 for valid UTF-8, 1 for any other byte.
std::size_t character_size(std::string_view text, std::size_t i);

/// Number of characters as a terminal shows them: each UTF-8 sequence and each other byte counts as one.
std::size_t character_count(std::string_view text);

/// Converts to valid, printable UTF-8: stray bytes are read as Latin-1, control characters become `?`, tabs become blanks.
std::string printable(std::string_view text);

/// Returns the text as a JSON string, including the quotes.
std::string json_string(std::string_view text);

/// Text broken at blanks into lines of at most `width` characters (a longer word keeps a line to itself).
std::vector<std::string> wrap(std::string_view text, std::size_t width);

}  // namespace engrane

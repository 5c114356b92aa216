// SPDX-License-Identifier: BSD-3-Clause
#include "base/text.hpp"

#include <algorithm>
#include <array>
#include <charconv>

namespace engrane {

namespace {

char upper_letter(char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; }

unsigned char byte_at(std::string_view text, std::size_t i) { return static_cast<unsigned char>(text[i]); }

bool is_control(unsigned char c) { return c < 0x20 || c == 0x7f; }

void append_latin1(std::string& out, unsigned char c) {
  out += static_cast<char>(0xc0 | (c >> 6));
  out += static_cast<char>(0x80 | (c & 0x3f));
}

}  // namespace

std::string upper(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(), upper_letter);
  return result;
}

bool same_word(std::string_view a, std::string_view b) { return a.size() == b.size() && begins_with_word(a, b); }

bool begins_with_word(std::string_view word, std::string_view start) {
  if (start.size() > word.size()) return false;
  for (std::size_t i = 0; i < start.size(); ++i)
    if (upper_letter(word[i]) != upper_letter(start[i])) return false;
  return true;
}

bool abbreviates(std::string_view word, std::string_view language) {
  return word.size() >= 3 && begins_with_word(language, word);
}

std::string join(const std::vector<std::string>& words, std::string_view last) {
  std::string result;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) result += i + 1 == words.size() ? last : std::string_view(", ");
    result += words[i];
  }
  return result;
}

void append_number(std::string& text, double value) {
  std::array<char, 32> buffer{};
  const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  if (error == std::errc())
    text.append(buffer.data(), end);
  else
    text += '?';
}

std::string format_number(double value) {
  std::string text;
  append_number(text, value);
  return text;
}

std::string counted(std::size_t count, std::string_view noun) {
  return std::to_string(count) + " " + std::string(noun) + (count == 1 ? "" : "s");
}

std::size_t character_size(std::string_view text, std::size_t i) {
  const unsigned char lead = byte_at(text, i);
  const std::size_t size = lead < 0xc2 ? 1 : lead < 0xe0 ? 2 : lead < 0xf0 ? 3 : lead < 0xf5 ? 4 : 1;
  if (i + size > text.size()) return 1;
  for (std::size_t k = 1; k < size; ++k)
    if ((byte_at(text, i + k) & 0xc0) != 0x80) return 1;
  if (size > 2) {  // overlong forms, surrogates and code points past U+10FFFF are not characters
    const unsigned char second = byte_at(text, i + 1);
    if ((lead == 0xe0 && second < 0xa0) || (lead == 0xed && second > 0x9f) || (lead == 0xf0 && second < 0x90) ||
        (lead == 0xf4 && second > 0x8f))
      return 1;
  }
  return size;
}

std::size_t character_count(std::string_view text) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < text.size(); i += character_size(text, i)) ++count;
  return count;
}

std::string printable(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t size = character_size(text, i);
    const unsigned char c = byte_at(text, i);
    if (c == 0xc2 && size == 2 && byte_at(text, i + 1) < 0xa0) {
      result += '?';  // C1 codes control terminals as well
    } else if (size > 1) {
      result += text.substr(i, size);
    } else if (c == '\t') {
      result += ' ';
    } else if (is_control(c) || (c >= 0x80 && c < 0xa0)) {
      result += '?';
    } else if (c >= 0xa0) {
      append_latin1(result, c);
    } else {
      result += static_cast<char>(c);
    }
    i += size;
  }
  return result;
}

std::string json_string(std::string_view text) {
  static constexpr std::string_view hex = "0123456789abcdef";
  std::string result = "\"";
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t size = character_size(text, i);
    const unsigned char c = byte_at(text, i);
    if (size > 1) {
      result += text.substr(i, size);
    } else if (c == '"' || c == '\\') {
      result += '\\';
      result += static_cast<char>(c);
    } else if (c == '\n') {
      result += "\\n";
    } else if (is_control(c)) {
      result += "\\u00";
      result += hex[c >> 4];
      result += hex[c & 15];
    } else if (c >= 0x80) {
      append_latin1(result, c);
    } else {
      result += static_cast<char>(c);
    }
    i += size;
  }
  return result + "\"";
}

std::vector<std::string> wrap(std::string_view text, std::size_t width) {
  std::vector<std::string> lines;
  std::string line;
  std::size_t i = 0;
  while (i < text.size()) {
    const std::size_t end = std::min(text.find(' ', i), text.size());
    const std::string_view word = text.substr(i, end - i);
    if (!word.empty()) {
      if (!line.empty() && character_count(line) + 1 + character_count(word) > width) {
        lines.push_back(std::move(line));
        line.clear();
      }
      if (!line.empty()) line += ' ';
      line += word;
    }
    i = end + 1;
  }
  if (!line.empty()) lines.push_back(std::move(line));
  return lines;
}

}  // namespace engrane

// SPDX-License-Identifier: BSD-3-Clause
#include "deck/schema/field_text.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/text.hpp"

namespace engrane::deck {

namespace {

std::string noun(const Field& field) {
  switch (field.reference) {
    case Reference::node:
      return "node";
    case Reference::element:
      return "element";
    case Reference::function:
      return "function";
    case Reference::group:
      return "group";
    case Reference::frame:
      return "frame";
    case Reference::nothing:
      break;
  }
  if (field.type == FieldType::text) return "text";
  return field.type == FieldType::integer ? "whole number" : "number";
}

/// Writes numbers, with `n*v` for repeated ones and `a A b` for runs of ids.
void for_each_number(const std::vector<double>& numbers, bool ranges, const std::function<void(std::string_view)>& use) {
  std::string text;
  const auto number = [&](double value) {
    append_number(text, value);
    use(text);
    text.clear();
  };
  for (std::size_t i = 0; i < numbers.size();) {
    std::size_t same = i + 1;
    while (same < numbers.size() && numbers[same] == numbers[i] && std::signbit(numbers[same]) == std::signbit(numbers[i]))
      ++same;
    std::size_t run = i + 1;
    while (ranges && run < numbers.size() && numbers[run] == numbers[run - 1] + 1) ++run;
    if (run - i > 2) {
      number(numbers[i]);
      use("A");
      number(numbers[run - 1]);
      i = run;
    } else if (same - i > 3) {
      text = std::to_string(same - i) + "*";
      number(numbers[i]);
      i = same;
    } else {
      number(numbers[i++]);
    }
  }
}

}  // namespace

std::string value_kind(const Field& field) {
  if (field.type == FieldType::flag) return "no value";
  if (field.type == FieldType::choice) return "a word";
  const std::string name = noun(field);
  if (field.max_values == 1) return name == "text" ? name : (name == "element" ? "an " : "a ") + name;
  if (field.max_values >= any_number) {
    const std::string ids = field.reference == Reference::node || field.reference == Reference::element ? ", ranges" : "";
    return (field.min_values > 1 ? std::to_string(field.min_values) + " or more " : "") + name + "s" + ids;
  }
  const std::string least = field.min_values == field.max_values ? "" : std::to_string(field.min_values) + " to ";
  return least + std::to_string(field.max_values) + " " + name + "s";
}

std::vector<std::string> deck_words(const Field& field, const Field::Values& values, bool ranges) {
  std::vector<std::string> words;
  for_each_deck_word(field, values, ranges, [&words](std::string_view word) { words.emplace_back(word); });
  return words;
}

void for_each_deck_word(const Field& field, const Field::Values& values, bool ranges,
                        const std::function<void(std::string_view)>& use) {
  use(field.keyword);
  if (field.type == FieldType::text) {
    for (const std::string& text : values.texts) use("\"" + text + "\"");
    return;
  }
  if (field.type == FieldType::choice) use(values.tag);
  for_each_number(values.numbers, ranges, use);
}

bool within_range(const Field& field, const Field::Values& values) {
  return std::all_of(values.numbers.begin(), values.numbers.end(), [&field](double value) {
    const bool low = field.lower_open ? value <= field.lower : value < field.lower;
    const bool high = field.upper_open ? value >= field.upper : value > field.upper;
    return !low && !high;
  });
}

bool has_default(const Field& field, const Field::Values& defaults) {
  if (!defaults.present || field.type == FieldType::flag) return false;
  const bool none = field.reference != Reference::nothing && defaults.numbers == std::vector<double>{0};
  return !none && within_range(field, defaults) && !field.required;
}

std::string default_text(const Schema& schema, const Field& field) {
  const Field::Values defaults = field.load(schema.make());
  if (!has_default(field, defaults)) return {};
  std::vector<std::string> words = deck_words(field, defaults, false);
  std::string text;
  for (std::size_t i = 1; i < words.size(); ++i) text += (i > 1 ? " " : "") + words[i];
  return text;
}

std::string filler_text(const Field& field) {
  if (field.fillers.empty()) return {};
  std::string words;
  for (const std::string& word : field.fillers) words += (words.empty() ? "" : " or ") + word;
  return words + " may stand before the value";
}

namespace {

/// Numbers or texts, separated by commas.
void append_items(std::string& json, const Field::Values& values) {
  const char* separator = "";
  for (const double number : values.numbers) {
    json += separator;
    append_number(json, number);
    separator = ", ";
  }
  for (const std::string& text : values.texts) {
    json += separator;
    json += json_string(text);
    separator = ", ";
  }
}

}  // namespace

void append_json(std::string& json, const Field& field, const Field::Values& values) {
  const bool none = values.numbers.empty() && values.texts.empty();
  switch (field.type) {
    case FieldType::flag:
      json += "true";
      return;
    case FieldType::choice:
      if (none) {
        json += json_string(values.tag);
        return;
      }
      json += "{" + json_string(values.tag) + ": [";
      append_items(json, values);
      json += "]}";
      return;
    case FieldType::integer:
    case FieldType::real:
    case FieldType::text:
      break;
  }
  if (field.max_values > 1) {
    json += '[';
    append_items(json, values);
    json += ']';
  } else if (none) {
    json += "null";
  } else if (!values.numbers.empty()) {
    append_number(json, values.numbers.front());
  } else {
    json += json_string(values.texts.front());
  }
}

std::string json_value(const Field& field, const Field::Values& values) {
  std::string json;
  append_json(json, field, values);
  return json;
}

}  // namespace engrane::deck

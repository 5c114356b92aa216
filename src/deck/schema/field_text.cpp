// SPDX-License-Identifier: BSD-3-Clause
#include "deck/schema/field_text.hpp"

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

/// Numbers, with `n*v` for repeated ones and `a A b` for runs of ids.
void append_numbers(std::vector<std::string>& words, const std::vector<double>& numbers, bool ranges) {
  for (std::size_t i = 0; i < numbers.size();) {
    std::size_t same = i + 1;
    while (same < numbers.size() && numbers[same] == numbers[i] && std::signbit(numbers[same]) == std::signbit(numbers[i]))
      ++same;
    std::size_t run = i + 1;
    while (ranges && run < numbers.size() && numbers[run] == numbers[run - 1] + 1) ++run;
    if (run - i > 2) {
      words.insert(words.end(), {format_number(numbers[i]), "A", format_number(numbers[run - 1])});
      i = run;
    } else if (same - i > 3) {
      words.push_back(std::to_string(same - i) + "*" + format_number(numbers[i]));
      i = same;
    } else {
      words.push_back(format_number(numbers[i++]));
    }
  }
}

}  // namespace

std::string value_kind(const Field& field) {
  if (field.type == FieldType::flag) return "no value";
  if (field.type == FieldType::choice) return "a word";
  const std::string name = noun(field);
  if (field.max_values == 1) return name == "text" ? name : (name == "element" ? "an " : "a ") + name;
  if (field.max_values >= detail::any_number) {
    const std::string ids = field.reference == Reference::node || field.reference == Reference::element ? ", ranges" : "";
    return (field.min_values > 1 ? std::to_string(field.min_values) + " or more " : "") + name + "s" + ids;
  }
  const std::string least = field.min_values == field.max_values ? "" : std::to_string(field.min_values) + " to ";
  return least + std::to_string(field.max_values) + " " + name + "s";
}

std::vector<std::string> deck_words(const Field& field, const Field::Values& values, bool ranges) {
  std::vector<std::string> words{field.keyword};
  if (field.type == FieldType::text) {
    for (const std::string& text : values.texts) words.push_back("\"" + text + "\"");
    return words;
  }
  if (field.type == FieldType::choice) words.push_back(values.tag);
  append_numbers(words, values.numbers, ranges);
  return words;
}

bool has_default(const Field& field, const Field::Values& defaults) {
  if (!defaults.present || field.type == FieldType::flag) return false;
  const bool none = field.reference != Reference::nothing && defaults.numbers == std::vector<double>{0};
  return !none && !field.required;
}

std::string default_text(const Schema& schema, const Field& field) {
  const Field::Values defaults = field.load(schema.make());
  if (!has_default(field, defaults)) return {};
  std::vector<std::string> words = deck_words(field, defaults, false);
  std::string text;
  for (std::size_t i = 1; i < words.size(); ++i) text += (i > 1 ? " " : "") + words[i];
  return text;
}

std::string json_value(const Field& field, const Field::Values& values) {
  std::vector<std::string> items;
  for (double number : values.numbers) items.push_back(format_number(number));
  for (const std::string& text : values.texts) items.push_back(json_string(text));
  const std::string list = "[" + join(items, ", ") + "]";
  switch (field.type) {
    case FieldType::flag:
      return "true";
    case FieldType::choice:
      return items.empty() ? json_string(values.tag) : "{" + json_string(values.tag) + ": " + list + "}";
    case FieldType::integer:
    case FieldType::real:
    case FieldType::text:
      break;
  }
  if (field.max_values > 1) return list;
  return items.empty() ? "null" : items.front();
}

}  // namespace engrane::deck

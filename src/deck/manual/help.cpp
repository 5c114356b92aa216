// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "base/text.hpp"
#include "deck/manual/manual.hpp"
#include "deck/read/value_reader.hpp"
#include "deck/schema/field_text.hpp"
#include "deck/schema/matching.hpp"

namespace engrane::deck {

namespace {

constexpr std::size_t screen_width = 96;

void append_wrapped(std::string& out, const std::string& text, const std::string& indent) {
  for (const std::string& line : wrap(text, screen_width - indent.size())) out += indent + line + "\n";
}

std::string padded(std::string text, std::size_t width) {
  const std::size_t size = character_count(text);
  return text + std::string(size < width ? width - size : 1, ' ');
}

/// Appends cards by chapter, chapters in order of first occurrence.
void append_overview(std::string& out, const std::vector<const Schema*>& schemas) {
  std::vector<std::string> chapters;
  for (const Schema* schema : schemas)
    if (std::find(chapters.begin(), chapters.end(), schema->chapter) == chapters.end()) chapters.push_back(schema->chapter);
  for (const std::string& chapter : chapters) {
    out += "\n" + chapter + "\n";
    for (const Schema* schema : schemas) {
      if (schema->chapter != chapter) continue;
      std::vector<std::string> words = record_words(*schema);
      words.erase(words.begin());
      std::string name = schema->name;
      if (!words.empty()) name += " (" + join(words, ", ") + ")";
      out += "  " + padded(name, 42) + schema->summary + "\n";
    }
  }
}

/// Start of a record: `I <id> GEAR …`.
std::string record_start(const Schema& schema) {
  if (schema.command() == ".MCE") return " I <id> " + schema.name;
  if (schema.numbered) return " " + schema.record_key + " <id>";
  return schema.key().empty() ? std::string() : " " + std::string(schema.key());
}

std::string blank(const Field& field) {
  switch (field.type) {
    case FieldType::flag:
      return {};
    case FieldType::text:
      return "\"<text>\"";
    case FieldType::choice:
      return "<word>";
    case FieldType::integer:
      return field.reference == Reference::node ? "<node>" : "<whole>";
    case FieldType::real:
      break;
  }
  return "<number>";
}

/// The keyword with its default, or with placeholders to fill in.
std::string filled(const Schema& schema, const Field& field) {
  const std::string known = default_text(schema, field);
  if (!known.empty()) return field.keyword + " " + known;
  std::string text = field.keyword;
  const int shown = field.type == FieldType::flag ? 0 : std::clamp(field.min_values, 1, 6);
  for (int i = 0; i < shown; ++i) text += " " + blank(field);
  return text;
}

std::string explanation(const Field& field) {
  std::string text = field.help;
  for (const std::string& part : {documented_range(field).empty() ? deck_unit(field.dimension) : documented_range(field)})
    if (!part.empty()) text += "; " + part;
  if (field.type != FieldType::choice) return text;
  std::vector<std::string> names;
  for (const Option& option : field.options) names.push_back(option.name);
  return text + ": " + join(names, " or ");
}

}  // namespace

std::string help_overview(const Catalogue& catalogue) {
  std::string out = "Commands of a deck (three letters are enough; `engrane help NAME` tells more)\n";
  append_overview(out, catalogue.commands);
  out += "\nElements: .MCE, then I <id> <TYPE> N <nodes> <keyword values>\n";
  append_overview(out, catalogue.elements);
  out += "\nOrders to the reader, each on a line of its own: ";
  for (const Order& order : orders()) out += (&order == orders().data() ? "" : ", ") + std::string(order.form);
  out += "\n";
  return out;
}

std::string help_order(const Order& order) {
  std::string meaning(order.meaning), out = std::string(order.form) + "\n";
  std::erase(meaning, '`');
  append_wrapped(out, meaning, "  ");
  return out;
}

std::string help_card(const Schema& schema) {
  std::vector<std::string> words = schema.synonyms;
  std::string out = schema.name + (words.empty() ? "" : " (also " + join(words) + ")") + "\n  " + schema.summary + "\n";
  if (!schema.description.empty()) {
    out += "\n";
    append_wrapped(out, schema.description, "  ");
  }
  out += "\n";
  for (const Field& field : schema.fields) {
    out += "  " + padded(join(spellings(field), ", "), 30) + padded(value_kind(field), 26);
    const std::string known = default_text(schema, field);
    out += field.required ? "required" : known.empty() ? "" : "default " + known;
    while (out.back() == ' ') out.pop_back();
    out += "\n";
    std::string help = field.help;
    if (const std::string range = documented_range(field); !range.empty())
      help += "; " + range;
    else if (const std::string unit = deck_unit(field.dimension); !unit.empty())
      help += "; " + unit;
    if (const std::string fillers = filler_text(field); !fillers.empty()) help += "; " + fillers;
    if (field.positional) help += "; the keyword may be left out";
    append_wrapped(out, help, "      ");
    for (const Option& option : field.options) {
      std::string line = option.name;
      if (!option.synonyms.empty()) line += " (" + join(option.synonyms, ", ") + ")";
      if (option.max_values > 0) line += ", " + expected_count(option.min_values, option.max_values);
      if (const std::string unit = deck_unit(option.dimension); !unit.empty()) line += " " + unit;
      append_wrapped(out, line + ": " + option.help, "        ");
    }
    for (const Code& code : field.codes) out += "        " + std::to_string(code.number) + ": " + code.meaning + "\n";
  }
  if (!schema.examples.empty()) out += "\nExample\n";
  for (const std::string& example : schema.examples) out += example + "\n";
  return out;
}

std::string template_card(const Schema& schema) {
  std::string out = "! " + schema.summary + "\n" + std::string(schema.command());
  const std::string start = record_start(schema);
  out += start.empty() ? "\n" : "\n" + start + "\n";
  for (const Field& field : schema.fields) {
    if (!field.whole.empty()) continue;
    const bool optional = !field.required && default_text(schema, field).empty();
    const bool target = field.leads && field.type == FieldType::integer && &field == &schema.fields.front();
    const std::string words = (optional && !target ? "  ! " : "  ") + filled(schema, field);
    out += padded(words, 40) + "! " + explanation(field) + (optional && !target ? " (optional)" : "") + "\n";
  }
  return out;
}

}  // namespace engrane::deck

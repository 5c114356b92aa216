// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "base/text.hpp"
#include "deck/manual/manual.hpp"
#include "deck/schema/field_text.hpp"

namespace engrane::deck {

namespace {

std::string member(const std::string& name, const std::string& value) { return json_string(name) + ": " + value; }

std::string object(const std::vector<std::string>& members) { return "{" + join(members, ", ") + "}"; }

/// JSON schema of one value of a field.
std::string item(const Field& field) {
  std::vector<std::string> members;
  members.push_back(member("type", field.type == FieldType::text      ? "\"string\""
                                   : field.type == FieldType::integer ? "\"integer\""
                                                                      : "\"number\""));
  if (field.type != FieldType::text) {
    if (std::isfinite(field.lower))
      members.push_back(member(field.lower_open ? "exclusiveMinimum" : "minimum", format_number(field.lower)));
    if (std::isfinite(field.upper))
      members.push_back(member(field.upper_open ? "exclusiveMaximum" : "maximum", format_number(field.upper)));
  }
  return object(members);
}

/// A choice is its word, or an object with the word and its numbers.
std::string choice(const Field& field) {
  std::vector<std::string> alternatives;
  for (const Option& option : field.options) {
    if (option.min_values == 0)
      alternatives.push_back(
          object({member("const", json_string(option.name)), member("description", json_string(option.help))}));
    if (option.max_values == 0) continue;
    const std::string numbers = object({member("type", "\"array\""), member("items", "{\"type\": \"number\"}"),
                                        member("minItems", std::to_string(std::max(option.min_values, 1))),
                                        member("maxItems", std::to_string(option.max_values))});
    alternatives.push_back(
        object({member("type", "\"object\""), member("description", json_string(option.help)),
                member("properties", object({member(option.name, numbers)})),
                member("required", "[" + json_string(option.name) + "]"), member("additionalProperties", "false")}));
  }
  return "[" + join(alternatives, ", ") + "]";
}

std::string property(const Schema& schema, const Field& field) {
  std::vector<std::string> members{member("description", json_string(field.help))};
  if (const std::string unit = deck_unit(field.dimension); !unit.empty()) members.push_back(member("unit", json_string(unit)));
  const Field::Values defaults = field.load(schema.make());
  if (defaults.present && !field.required && within_range(field, defaults))
    members.push_back(member("default", json_value(field, defaults)));
  if (field.type == FieldType::flag) {
    members.push_back(member("type", "\"boolean\""));
  } else if (field.type == FieldType::choice) {
    members.push_back(member("oneOf", choice(field)));
  } else if (field.max_values == 1) {
    const std::string inner = item(field);
    members.push_back(inner.substr(1, inner.size() - 2));
  } else {
    members.push_back(member("type", "\"array\""));
    members.push_back(member("items", item(field)));
    // a shorter array is padded to the struct's size when read, so records show it in full
    members.push_back(member("minItems", std::to_string(field.required ? field.min_values : 0)));
    if (field.max_values < any_number) members.push_back(member("maxItems", std::to_string(field.max_values)));
  }
  return object(members);
}

std::string definition(const Schema& schema) {
  const bool has_id = schema.numbered || schema.command() == ".MCE";
  std::vector<std::string> properties{member("type", object({member("const", json_string(schema.name))}))};
  std::vector<std::string> required{"\"type\""};
  if (has_id) {
    properties.push_back(member("id", "{\"type\": \"integer\", \"minimum\": 1}"));
    required.emplace_back("\"id\"");
  }
  for (const Field& field : schema.fields) {
    if (!field.whole.empty()) continue;
    properties.push_back(member(field.keyword, property(schema, field)));
    if (field.required) required.push_back(json_string(field.keyword));
  }
  return object({member("title", json_string(schema.summary)), member("type", "\"object\""),
                 member("required", "[" + join(required, ", ") + "]"),
                 "\n      \"properties\": {\n        " +
                     [&] {
                       std::string text;
                       for (std::size_t i = 0; i < properties.size(); ++i) text += (i > 0 ? ",\n        " : "") + properties[i];
                       return text;
                     }() +
                     "}",
                 member("additionalProperties", "false")});
}

}  // namespace

std::string json_schema(const Catalogue& catalogue) {
  std::vector<const Schema*> all = catalogue.commands;
  all.insert(all.end(), catalogue.elements.begin(), catalogue.elements.end());
  std::string definitions;
  std::string references;
  for (const Schema* schema : all) {
    const std::string separator = schema == all.front() ? "" : ",\n";
    definitions += separator + "    " + member(schema->name, definition(*schema));
    references += separator + "    " + object({member("$ref", json_string("#/$defs/" + [&] {
                                                        std::string name = schema->name;
                                                        if (const std::size_t space = name.find(' '); space != std::string::npos)
                                                          name.replace(space, 1, "%20");
                                                        return name;
                                                      }()))});
  }
  return "{\n  \"$schema\": \"https://json-schema.org/draft/2020-12/schema\",\n"
         "  \"title\": \"The records of a deck, as the results file holds them\",\n"
         "  \"type\": \"array\",\n  \"items\": {\"oneOf\": [\n" +
         references +
         "]},\n"
         "  \"$defs\": {\n" +
         definitions + "}\n}\n";
}

}  // namespace engrane::deck

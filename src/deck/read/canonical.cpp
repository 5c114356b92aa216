// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstddef>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/text.hpp"
#include "deck/read/reader.hpp"
#include "deck/schema/field_text.hpp"
#include "deck/schema/matching.hpp"

namespace engrane::deck {

namespace {

constexpr std::size_t line_width = 100;
constexpr std::size_t columns_read = 256;  ///< default without MODE LECT

/// Writes words, breaking long lines with `$`.
class Writer {
 public:
  void line(std::string_view first) {
    end_line();
    line_ = first;
    width_ = character_count(first);
  }

  void word(std::string_view text) {
    const std::size_t size = character_count(text);
    if (width_ + 1 + size > line_width) {
      line_ += " $";
      width_ += 2;
      line("  ");
    }
    line_ += ' ';
    line_ += text;
    width_ += 1 + size;
  }

  void comment(const std::string& text) {
    for (const std::string& part : wrap(text, line_width)) line("  ! " + part);
  }

  std::string finish() {
    end_line();
    if (longest_ <= columns_read) return std::move(text_);
    return "MODE LECT " + std::to_string(longest_) + "\n" + text_;
  }

 private:
  void end_line() {
    if (line_.empty()) return;
    longest_ = std::max(longest_, width_);
    text_ += line_;
    text_ += '\n';
    line_.clear();
  }

  std::string text_;
  std::string line_;
  std::size_t width_ = 0;  ///< of the current line, in characters
  std::size_t longest_ = 0;
};

/// Writes the words after the record key, and the defaults in effect as a comment.
void write_fields(Writer& writer, const Record& record, bool ranges_allowed) {
  std::string defaults;
  for (const Field& field : record.schema->fields) {
    if (!field.whole.empty()) continue;
    Field::Values values = field.load(record.data);
    const bool ids =
        ranges_allowed && field.type == FieldType::integer && field.reference != Reference::nothing && field.max_values > 1;
    if (!record.given(field)) {
      if (!has_default(field, values)) continue;
      for_each_deck_word(field, values, ids, [&](std::string_view word) { defaults.append(word).append(1, ' '); });
      continue;
    }
    if (field.type == FieldType::text && values.texts.empty()) values.texts.emplace_back();  // an empty text was given
    if (!values.present && field.type != FieldType::text) continue;                          // all its codes were unknown
    for_each_deck_word(field, values, ids, [&](std::string_view word) { writer.word(word); });
  }
  if (!defaults.empty()) writer.comment("by default: " + defaults);
}

}  // namespace

std::string canonical_text(const Deck& deck) {
  Writer writer;
  std::string open;            // command of the current records
  std::set<std::string> seen;  // commands opened before: those that drop earlier records need ADD
  const Schema* last = nullptr;
  bool ranges_allowed = false;  // for the last schema; cached, as meshes have very many records of few schemas
  for (const Record& record : deck.records) {
    const Schema& schema = *record.schema;
    const std::string command(schema.command());
    const bool has_key = schema.numbered || command == ".MCE" || !schema.key().empty();
    const bool leads = std::any_of(schema.fields.begin(), schema.fields.end(), [](const Field& field) { return field.leads; });
    if (command != open || (!has_key && !leads)) {
      writer.line(schema.redefines && seen.contains(command) ? command + " ADD" : command);
      open = command;
      seen.insert(command);
    }
    if (command == ".MCE") {
      writer.line(" I " + std::to_string(record.id) + " " + schema.name);
    } else if (schema.numbered) {
      writer.line(" " + schema.record_key + " " + std::to_string(record.id));
    } else if (!schema.key().empty()) {
      writer.line(" " + std::string(schema.key()));
    } else if (leads) {
      writer.line(" ");
    }
    if (std::exchange(last, &schema) != &schema) ranges_allowed = !match_field(schema, "A").exact;
    write_fields(writer, record, ranges_allowed);
  }
  return writer.finish();
}

std::string record_json(const Record& record) {
  std::string text = "{";
  if (record.id != 0) text += "\"id\": " + std::to_string(record.id) + ", ";
  text += "\"type\": " + json_string(record.schema->name);
  for (const Field& field : record.schema->fields) {
    const Field::Values values = field.load(record.data);
    if (!values.present) continue;
    text.append(", ").append(json_string(field.keyword)).append(": ");
    append_json(text, field, values);
  }
  return text + "}";
}

}  // namespace engrane::deck

// SPDX-License-Identifier: BSD-3-Clause
#include "deck/read/record_reader.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "base/text.hpp"
#include "deck/schema/matching.hpp"

namespace engrane::deck {

namespace {

std::string list_of_keywords(const Schema& schema) {
  constexpr std::size_t most_listed = 24;
  std::vector<std::string> names;
  for (const Field& field : schema.fields) names.push_back(field.keyword);
  if (names.empty()) return "it takes no keywords";
  return names.size() > most_listed ? "`engrane help " + schema.name + "` lists its keywords" : "it has " + join(names);
}

}  // namespace

/// A record during reading.
struct RecordReader::Reading {
  Record& record;
  const Schema& schema;
  const RecordKeys& keys;
  bool past_leads = false;  ///< a keyword that does not lead has been given
};

std::string record_title(const Schema& schema, int id) { return id == 0 ? schema.name : schema.name + " " + std::to_string(id); }

void RecordReader::read(Record& record, const RecordKeys& keys, const std::vector<Heading>& headings,
                        const std::vector<Heading>& object) {
  given_.clear();
  locations_.clear();
  Reading reading{record, *record.schema, keys};
  take_object(reading, object);
  while ((!at_boundary(tokens_, keys) && !begins_next(reading)) || names_field(reading)) read_item(reading);
  for (const Heading& heading : headings) {
    if (given(*heading.field)) continue;
    heading.field->store(record.data, heading.values);
    locate(*heading.field, heading.where);
  }
  record.field_locations = locations_;
  finish(reading);
}

bool RecordReader::read_object(const RecordKeys& keys, const Schema& schema, std::vector<Heading>& object) {
  bool good = true;
  while (const Field* field = named_object(keys, tokens_.peek())) {
    if (std::any_of(object.begin(), object.end(), [&](const Heading& one) { return one.field == field; })) break;
    const Token keyword = tokens_.take();
    FieldReading& result = values_.read(*field, schema, keys, keyword.where);
    good = good && !result.faulty;
    object.push_back({field, result.values, result.where});
  }
  return good;
}

void RecordReader::take_object(Reading& reading, const std::vector<Heading>& object) {
  for (const Heading& one : object) {
    const Field* field = reading.schema.find(one.field->keyword);
    if (!field) {
      diagnostics_.error(one.where, reading.schema.name + " takes no " + one.field->keyword);
      reading.record.faulty = true;
      continue;
    }
    given_.push_back({field, one.where, one.values.numbers.size()});
    locate(*field, one.where);
    field->store(reading.record.data, one.values);
  }
}

const RecordReader::Given* RecordReader::given(const Field& field) const {
  const auto found = std::find_if(given_.begin(), given_.end(), [&](const Given& one) { return one.field == &field; });
  return found == given_.end() ? nullptr : &*found;
}

/// Records the location of a keyword's values; the last one counts.
void RecordReader::locate(const Field& field, const Location& where) {
  for (FieldLocation& known : locations_)
    if (known.field == &field) {
      known.where = where;
      return;
    }
  locations_.push_back({&field, where});
}

/// `ARETE I 57 3 PRE V 5.`: PRE, which starts a record of its own in `GROUP "flank" PRE V 5.`, is a keyword of this record.
bool RecordReader::names_field(const Reading& reading) const {
  const Token& token = tokens_.peek();
  if (!keyed_schema(reading.keys, token)) return false;
  const Field* field = match_field(reading.schema, token.text).entry;
  return field && !given(*field);
}

/// `FIX NOEUD 1 C 1 NOEUD 2 C 3`: the second NOEUD starts another FIX.
bool RecordReader::begins_next(const Reading& reading) {
  const Token& token = tokens_.peek();
  if (named_object(reading.keys, token) && !match_field(reading.schema, token.text).entry) return true;
  if (!token.is_word() || !reading.past_leads || reading.schema.numbered) return false;
  const Match<Field> match = match_field(reading.schema, token.text);
  if (!match.entry || !match.entry->leads) return false;
  return std::any_of(given_.begin(), given_.end(), [](const Given& one) { return one.field->leads; });
}

/// The first positional field not yet given that accepts the token.
const Field* RecordReader::positional_field(const Reading& reading, const Token& token) const {
  for (const Field& field : reading.schema.fields) {
    if (!field.positional || (given(field) && !field.repeats)) continue;
    const bool text = field.type == FieldType::text;
    if (token.kind == Token::Kind::text && text) return &field;
    if (token.is_number() && (field.type == FieldType::integer || field.type == FieldType::real)) return &field;
    if (token.is_number() && text && field.reference == Reference::group) return &field;
    if (!token.is_word()) continue;
    if (text) return &field;
    if (field.type == FieldType::choice && match_option(field, token.text).entry) return &field;
    const bool ids = field.type == FieldType::integer && field.reference != Reference::nothing;
    if (ids && same_word(token.text, "I") && tokens_.peek(1).is_number()) return &field;  // the range I a J b K c
  }
  return nullptr;
}

void RecordReader::read_item(Reading& reading) {
  const Token token = tokens_.peek();
  if (token.fault && token.is_word()) {
    tokens_.take();
    reading.record.faulty = true;
    return;
  }
  Match<Field> match;
  if (token.is_word()) match = match_field(reading.schema, token.text);
  if (match.exact) {
    tokens_.take();
    return read_field(reading, *match.entry, &token);
  }
  if (!match.entry && tokens_.mend_command()) return;
  if (const Field* field = positional_field(reading, token)) return read_field(reading, *field, nullptr);
  if (match.entry) {
    tokens_.take();
    return read_field(reading, *match.entry, &token);
  }
  unknown_item(reading);
}

void RecordReader::read_field(Reading& reading, const Field& field, const Token* keyword) {
  const Location start = keyword ? keyword->where : tokens_.peek().where;
  FieldReading& result = values_.read(field, reading.schema, reading.keys, start);
  if (!field.leads) reading.past_leads = true;
  if (appends(reading, field) || (field.repeats && given(field))) {
    const std::vector<double> before = field.load(reading.record.data).numbers;
    result.values.numbers.insert(result.values.numbers.begin(), before.begin(), before.end());
    std::erase_if(given_, [&](const Given& one) { return one.field == &field; });
  } else if (given_twice(reading, field, result.values.numbers.size(), start)) {
    return;
  }
  given_.push_back({&field, start, result.values.numbers.size()});
  locate(field, result.where);
  if (!field.whole.empty()) {
    const Field* whole = reading.schema.find(field.whole);
    if (std::none_of(locations_.begin(), locations_.end(), [&](const FieldLocation& one) { return one.field == whole; }))
      locate(*whole, result.where);
  }
  Record& record = reading.record;
  if (result.faulty)
    record.faulty = true;
  else
    field.store(record.data, result.values);
}

/// `NOEUD 3 C 1 A 2. NOEUD 4 C 1 A -1.` in a numbered record: the lists continue term by term.
bool RecordReader::appends(const Reading& reading, const Field& field) const {
  const auto leads = [](const Field& other) { return other.leads; };
  return reading.schema.numbered && field.max_values == any_number && given(field) &&
         std::any_of(reading.schema.fields.begin(), reading.schema.fields.end(), leads);
}

/// Also detects `X 0 1 2 Y 3`, which gives the second coordinate twice.
bool RecordReader::given_twice(Reading& reading, const Field& field, std::size_t count, const Location& where) {
  const Given* clash = given(field);
  for (const Given& other : given_) {
    if (other.field->whole == field.keyword && count > static_cast<std::size_t>(other.field->part)) clash = &other;
    if (field.whole == other.field->keyword && other.count > static_cast<std::size_t>(field.part)) clash = &other;
  }
  if (!clash) return false;
  const std::string line = std::to_string(clash->start.line);
  diagnostics_.error(
      where, field.keyword + " is given twice in " + record_title(reading.schema, reading.record.id),
      clash->field == &field ? "first in line " + line : "already given by " + clash->field->keyword + " in line " + line);
  reading.record.faulty = true;
  return true;
}

void RecordReader::unknown_item(Reading& reading) {
  const Token token = tokens_.take();
  reading.record.faulty = true;
  if (token.is_word()) return unknown_word(reading, token);
  if (token.fault) return;
  diagnostics_.error(token.where,
                     token.quoted() + " belongs to no keyword of " + record_title(reading.schema, reading.record.id));
  skip_values(reading);
}

void RecordReader::unknown_word(Reading& reading, const Token& token) {
  const std::string what = token.quoted() + " is ";
  const std::string no_keyword = what + "not a keyword of " + reading.schema.name;
  if (token.text.front() == '.') {
    diagnostics_.error(token.where, no_keyword, "a command must be the first word of its line");
    while (!at_boundary(tokens_, reading.keys) && !tokens_.peek().starts_line) tokens_.skip();
    return;
  }
  if (token.starts_line) {  // more likely a misspelt record key than a keyword of the previous record
    const std::string key = did_you_mean(token.text, schema_words(reading.keys.keyed));
    if (!key.empty()) {
      diagnostics_.error(token.where, token.quoted() + " starts no record of " + reading.keys.command, key);
      return skip_to_line(reading.keys);
    }
  }
  const Match<Field> match = match_field(reading.schema, token.text);
  if (match.ambiguous()) {
    diagnostics_.error(token.where, what + "short for several keywords of " + reading.schema.name,
                       "write " + join(candidate_names(match), " or "));
    if (tokens_.peek().is_word() && !tokens_.peek().starts_line && !at_boundary(tokens_, reading.keys) &&
        !match_field(reading.schema, tokens_.peek().text).entry)
      tokens_.skip();  // the word of a choice
  } else if (token.text.find('=') != std::string_view::npos) {
    diagnostics_.error(token.where, no_keyword, "values follow their keyword behind a blank, without `=`");
  } else {
    std::string hint = did_you_mean(token.text, field_words(reading.schema));
    diagnostics_.error(token.where, no_keyword, hint.empty() ? list_of_keywords(reading.schema) : hint);
    skip_filler(reading);
  }
  skip_values(reading);
}

void RecordReader::skip_filler(const Reading& reading) {
  const Token& next = tokens_.peek();
  for (const Field& field : reading.schema.fields)
    for (const std::string& filler : field.fillers)
      if (next.is_word() && same_word(filler, next.text)) return tokens_.skip();
}

/// Skips the values of an unknown keyword. Invalid tokens are still reported.
void RecordReader::skip_values(const Reading& reading) {
  while (!tokens_.peek().is_word() && !at_boundary(tokens_, reading.keys)) tokens_.take();
}

void RecordReader::finish(Reading& reading) {
  Record& record = reading.record;
  std::vector<std::string> missing;
  std::vector<std::string> explained;
  for (const Field& field : reading.schema.fields) {
    if (!field.required || record.given(field)) continue;
    missing.push_back(field.keyword);
    explained.push_back(field.keyword + ": " + field.help);
  }
  if (!missing.empty() && !record.faulty) {
    diagnostics_.error(record.location, record_title(reading.schema, record.id) + " lacks " + join(missing),
                       join(explained, "; "));
    record.faulty = true;
  }
  if (!record.faulty && reading.schema.finish) {
    const int before = diagnostics_.errors();
    reading.schema.finish(record, diagnostics_);
    record.faulty = diagnostics_.errors() > before;
  }
}

std::vector<Heading> RecordReader::read_headings(const Schema& schema, const RecordKeys& keys) {
  std::vector<Heading> headings;
  while (!at_boundary(tokens_, keys)) {
    const Token& next = tokens_.peek();
    const Match<Field> match = next.is_word() ? match_field(schema, next.text) : Match<Field>{};
    const bool heads = match.entry && match.entry->heading;
    if (!heads && tokens_.mend_command()) break;
    const Token token = tokens_.take();
    if (heads) {
      FieldReading& result = values_.read(*match.entry, schema, keys, token.where);
      if (!result.faulty) headings.push_back({match.entry, std::move(result.values), result.where});
      continue;
    }
    if (!token.fault)
      diagnostics_.error(token.where,
                         "expected `" + keys.number_key + "` and a number instead of `" + std::string(token.text) + "`",
                         "a record of " + std::string(schema.command()) + " starts with `" + keys.number_key + " 1`");
    skip_record(keys);
  }
  return headings;
}

void RecordReader::skip_to_line(const RecordKeys& keys) {
  while (!at_boundary(tokens_, keys) && !(tokens_.peek().is_word() && tokens_.peek().starts_line)) tokens_.take();
}

void RecordReader::skip_record(const RecordKeys& keys) {
  while (!at_boundary(tokens_, keys)) tokens_.take();
}

}  // namespace engrane::deck

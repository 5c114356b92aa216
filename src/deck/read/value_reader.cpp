// SPDX-License-Identifier: BSD-3-Clause
#include "deck/read/value_reader.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "base/text.hpp"
#include "deck/language/number.hpp"
#include "deck/schema/matching.hpp"
#include "deck/schema/thesaurus.hpp"

namespace engrane::deck {

namespace {

/// Limit on the values produced by all repeat counts of a deck together.
constexpr int most_produced = 20'000'000;

bool is_integer(double value) { return std::floor(value) == value && std::abs(value) <= std::numeric_limits<int>::max(); }

bool has_exact_field(const Schema& schema, std::string_view word) { return match_field(schema, word).exact; }

/// Whether the next word is short for a keyword: `MI 0`, but not the `ANGLE` of `DRIVE ANGLE NF 1` where ANGLE0 takes a number.
bool shortens_keyword(TokenStream& tokens, const Schema& schema) {
  const Field* field = match_field(schema, tokens.peek().text).entry;
  if (!field || field->type != FieldType::real) return field;
  const Token& next = tokens.peek(1);
  return next.is_number() || (next.is_word() && std::any_of(field->fillers.begin(), field->fillers.end(),
                                                            [&](const auto& filler) { return same_word(filler, next.text); }));
}

/// What is said elsewhere of a word that a keyword of this card does not know.
std::string advice_on(std::string_view word, const Schema& schema) {
  for (const Concept* c : find_concepts(word))
    if (!c->advice.empty() && std::find(c->cards.begin(), c->cards.end(), schema.name) != c->cards.end())
      return ". " + std::string(c->advice);
  return {};
}

/// Node 0 is the ground, and number 0 of other objects means "none"; negative numbers do not exist.
double lower_bound(const Field& field) {
  return field.reference == Reference::nothing ? field.lower : std::max(field.lower, 0.0);
}

}  // namespace

/// State of the field being read.
struct ValueReader::Work {
  const Field& field;
  const Schema& schema;
  const RecordKeys& keys;
  Location keyword;
  FieldReading& result;
  Location surplus{};  ///< location of the first surplus value
  bool any = false;    ///< a value has been taken
};

bool at_number_key(TokenStream& tokens, const RecordKeys& keys) {
  const Token& token = tokens.peek();
  if (keys.rows && token.is_number() && token.may_start_row) return true;
  if (keys.number_key.empty() || !token.is_word()) return false;
  if (same_word(token.text, keys.number_key)) return true;
  return keys.number_key == "GROUP" && (same_word(token.text, "GR") || same_word(token.text, "GROUPE"));
}

const Field* named_object(const RecordKeys& keys, const Token& token) {
  if (!token.is_word()) return nullptr;
  for (const Field* object : keys.objects)
    for (const std::string& spelling : object->spellings)
      if (same_word(token.text, spelling)) return object;
  return nullptr;
}

const Schema* keyed_schema(const RecordKeys& keys, const Token& token) {
  if (!token.is_word()) return nullptr;
  const Match<Schema> match = match_schema(keys.keyed, token.text);
  return match.exact || token.text.size() >= 3 ? match.entry : nullptr;
}

bool at_boundary(TokenStream& tokens, const RecordKeys& keys) {
  const Token& token = tokens.peek();
  if (token.is_end() || token.is_command() || at_number_key(tokens, keys) || keyed_schema(keys, token)) return true;
  return token.is_word() && std::any_of(keys.elsewhere.begin(), keys.elsewhere.end(),
                                        [&](RecognisedKey key) { return starts_recognised(token.text, key); });
}

std::string expected_count(int least, int most) {
  if (most >= any_number) return "at least " + counted(static_cast<std::size_t>(least), "value");
  if (least == most) return counted(static_cast<std::size_t>(least), "value");
  return std::to_string(least) + " to " + counted(static_cast<std::size_t>(most), "value");
}

std::string range_text(const Field& field) {
  const double lower = lower_bound(field);
  const bool below = std::isfinite(lower);
  const bool above = std::isfinite(field.upper);
  std::string text;
  if (below && above && !field.lower_open && !field.upper_open) {
    text = "from " + format_number(lower) + " to " + format_number(field.upper);
  } else {
    if (below) text = (field.lower_open ? "greater than " : "at least ") + format_number(lower);
    if (below && above) text += " and ";
    if (above) text += (field.upper_open ? "less than " : "at most ") + format_number(field.upper);
  }
  const std::string unit = deck_unit(field.dimension);
  return text.empty() || unit.empty() ? text : text + " " + unit;
}

std::string documented_range(const Field& field) {
  return field.reference == Reference::function ? std::string() : range_text(field);
}

FieldReading& ValueReader::read(const Field& field, const Schema& schema, const RecordKeys& keys, Location keyword) {
  reading_.values.numbers.clear();
  reading_.values.texts.clear();
  reading_.values.tag.clear();
  reading_.values.present = true;
  reading_.where = keyword;
  reading_.faulty = false;
  Work work{field, schema, keys, keyword, reading_};
  if (field.type == FieldType::flag) return reading_;
  const Token& next = tokens_.peek();
  if (next.is_word() && std::any_of(field.fillers.begin(), field.fillers.end(),
                                    [&](const std::string& filler) { return same_word(filler, next.text); }))
    take(work);
  work.any = false;
  switch (field.type) {
    case FieldType::flag:
      break;
    case FieldType::integer:
    case FieldType::real:
      read_numbers(work);
      check_count(work, field.min_values, field.max_values);
      break;
    case FieldType::text:
      read_texts(work);
      break;
    case FieldType::choice:
      read_choice(work);
      break;
  }
  if (!field.codes.empty()) skip_unknown_codes(work);
  return reading_;
}

Token ValueReader::take(Work& work) {
  Token token = tokens_.take();
  FieldReading& result = work.result;
  if (token.fault) result.faulty = true;
  if (!work.any) {
    result.where = token.where;
  } else if (token.where.file == result.where.file && token.where.line == result.where.line) {
    result.where.length = token.where.column + token.where.length - result.where.column;
  }
  work.any = true;
  return token;
}

void ValueReader::error(Work& work, const Location& where, std::string message, std::string hint) {
  diagnostics_.error(where, std::move(message), std::move(hint));
  work.result.faulty = true;
}

bool ValueReader::at_value_number(const Work& work) {
  const Token& token = tokens_.peek();
  return token.is_number() && !(work.keys.rows && token.may_start_row);
}

void ValueReader::read_numbers(Work& work) {
  const bool list = work.field.max_values > 1;
  for (;;) {
    if (list && read_range(work)) continue;
    if (!at_value_number(work)) return;
    const Token token = take(work);
    check_number(work, token);
    append(work, token.value, token.repeat, token.where);
  }
}

/// Reads `751 A 2249`, `I 1 J 5000 K 1` or `I 1` in a list of ids. A keyword of the card with the same spelling takes
/// precedence.
bool ValueReader::read_range(Work& work) {
  if (work.field.type != FieldType::integer || work.field.reference == Reference::nothing) return false;
  const auto word_then_number = [&](std::size_t at, std::string_view word) {
    return tokens_.peek(at).is_word() && same_word(tokens_.peek(at).text, word) && tokens_.peek(at + 1).is_number() &&
           !has_exact_field(work.schema, word);
  };
  if (at_value_number(work) && word_then_number(1, "A")) {
    const Token first = take(work);
    take(work);
    append_range(work, first, take(work), 1);
    return true;
  }
  const bool after_keyword = work.field.keyword == "I" && at_value_number(work) && word_then_number(1, "J");
  if (!after_keyword && (work.keys.number_key == "I" || !word_then_number(0, "I"))) return false;
  if (!after_keyword) take(work);
  const Token first = take(work);
  if (!word_then_number(0, "J")) {
    check_number(work, first);
    append(work, first.value, first.repeat, first.where);
    return true;
  }
  take(work);
  const Token last = take(work);
  double step = 1;
  if (word_then_number(0, "K")) {
    take(work);
    step = take(work).value;
  }
  append_range(work, first, last, step);
  return true;
}

void ValueReader::append_range(Work& work, const Token& first, const Token& last, double step) {
  check_number(work, first);
  check_number(work, last);
  if (work.result.faulty) return;
  if (last.value < first.value || step < 1 || !is_integer(step))
    return error(work, last.where, "this range ends before it starts or has no step forward",
                 "write the smaller number first, and a step of 1 or more");
  const double count = std::floor((last.value - first.value) / step) + 1;
  if (count > most_repeated)
    return error(work, last.where, "this range has more than " + std::to_string(most_repeated) + " numbers");
  for (int i = 0; i < static_cast<int>(count) && !work.result.faulty; ++i) append(work, first.value + i * step, 1, first.where);
}

void ValueReader::append(Work& work, double value, int count, const Location& where) {
  auto& numbers = work.result.values.numbers;
  if (count > 1 && (repeated_ += count) > most_produced) {
    repeated_ = most_produced;
    return error(work, where, "the repeat counts and ranges of this deck make too many values");
  }
  const int most = work.field.type == FieldType::choice ? any_number : work.field.max_values;
  if (!work.surplus.known() && numbers.size() + static_cast<std::size_t>(count) > static_cast<std::size_t>(most))
    work.surplus = where;
  numbers.insert(numbers.end(), static_cast<std::size_t>(count), value);
}

void ValueReader::check_number(Work& work, const Token& token) {
  const Field& field = work.field;
  if (token.fault) return;
  if (field.type == FieldType::integer && !is_integer(token.value)) {
    const bool large = std::floor(token.value) == token.value;
    return error(work, token.where,
                 field.keyword + " (" + field.help + ") takes whole numbers" + (large ? " of at most 9 digits" : ""));
  }
  const double lower = lower_bound(field);
  const bool low = field.lower_open ? token.value <= lower : token.value < lower;
  const bool high = field.upper_open ? token.value >= field.upper : token.value > field.upper;
  if (low || high)
    error(work, token.where, field.keyword + " = " + format_number(token.value) + " is out of range",
          field.keyword + " (" + field.help + ") is " + range_text(field));
}

/// `option`: the word of a choice that precedes the numbers.
void ValueReader::check_count(Work& work, int least, int most, const Option* option) {
  if (work.result.faulty) return;
  const std::size_t count = work.result.values.numbers.size();
  if (count >= static_cast<std::size_t>(least) && count <= static_cast<std::size_t>(most)) return;
  const std::string& keyword = work.field.keyword;
  const std::string name = !option || option->name == keyword ? keyword : keyword + " " + option->name;
  const std::string what = name + " takes " + expected_count(least, most);
  const std::string given = what + ", " + (count == 0 ? "none" : std::to_string(count)) + " given";
  if (count > static_cast<std::size_t>(most)) return error(work, work.surplus.known() ? work.surplus : work.result.where, given);
  if (!at_stray_value(work)) return error(work, work.keyword, given);
  const Token stray = take(work);
  if (!stray.fault) error(work, stray.where, stray.quoted() + " is not a number", what);
  while (at_value_number(work)) take(work);
}

/// Whether the next token is on the same line and can only be meant as a value of this field.
bool ValueReader::at_stray_value(const Work& work) {
  const Token& next = tokens_.peek();
  if (at_boundary(tokens_, work.keys) || next.starts_line || next.is_number()) return false;
  if (!next.is_word()) return true;
  const Match<Field> match = match_field(work.schema, next.text);
  return !match.entry && !match.ambiguous() && next.text.front() != '.';
}

/// Reads texts in double quotes; a single bare word is also accepted where it cannot be a keyword. Groups may be given by
/// number.
void ValueReader::read_texts(Work& work) {
  const Field& field = work.field;
  auto& texts = work.result.values.texts;
  const auto most = static_cast<std::size_t>(field.max_values);
  while (texts.size() < most) {
    const Token& next = tokens_.peek();
    if (next.kind == Token::Kind::text) {
      texts.emplace_back(take(work).text);
    } else if (field.reference == Reference::group && at_value_number(work)) {
      const Token number = take(work);
      if (!number.fault && (!is_integer(number.value) || number.value < 1 || number.repeat != 1))
        error(work, number.where, "the number of a group is a whole number, 1 or more");
      texts.push_back(format_number(number.value));
    } else if (next.is_word() && texts.empty() && !at_boundary(tokens_, work.keys) &&
               (field.positional || !match_field(work.schema, next.text).entry)) {
      texts.emplace_back(take(work).text);
      if (most == 1) refuse_more_words(work);
    } else {
      break;
    }
  }
  if (texts.size() >= static_cast<std::size_t>(std::max(field.min_values, 1)) || work.result.faulty) return;
  const std::string needs = field.keyword + " (" + field.help + ") needs a text in double quotes";
  if (!at_value_number(work)) return error(work, work.keyword, needs);
  const Token number = take(work);
  if (!number.fault) error(work, number.where, number.quoted() + " is not a text", needs);
}

/// `.TITRE spur gear pair`: reports one error instead of one for each word.
void ValueReader::refuse_more_words(Work& work) {
  const auto more = [&] { return tokens_.peek().is_word() && at_stray_value(work); };
  const auto& fields = work.schema.fields;
  const auto takes_words = [&](const Field& field) { return field.positional && &field != &work.field; };
  if (!more() || std::any_of(fields.begin(), fields.end(), takes_words)) return;
  error(work, tokens_.peek().where, "a text of several words stands in double quotes");
  while (more()) tokens_.skip();
}

void ValueReader::read_choice(Work& work) {
  const Field& field = work.field;
  const Option* option = nullptr;
  const Token next = tokens_.peek();
  const Match<Option> match = next.is_word() ? match_option(field, next.text) : Match<Option>{};
  const bool keyword =
      next.is_word() && !match.exact && (at_boundary(tokens_, work.keys) || has_exact_field(work.schema, next.text));
  if (match.entry && !keyword) {
    option = match.entry;
    take(work);
  } else if (match.ambiguous() && !keyword) {
    take(work);
    error(work, next.where, next.quoted() + " is short for several words of " + field.keyword,
          "give one of " + join(candidate_names(match), " or "));
  } else if (!field.options.empty() && field.options.front().min_values == 0 &&
             (keyword || !next.is_word() || shortens_keyword(tokens_, work.schema))) {
    option = &field.options.front();  // the keyword stands alone
  } else {
    std::vector<std::string> names;
    for (const Option& known : field.options) names.push_back(known.name);
    std::string hint = next.is_word() ? did_you_mean(next.text, option_words(field)) : "";
    if (hint.empty()) hint = "give " + join(names, " or ") + (next.is_word() ? advice_on(next.text, work.schema) : "");
    if (next.is_word() && !keyword) take(work);
    error(work, next.is_word() && !keyword ? next.where : work.keyword,
          next.is_word() && !keyword ? field.keyword + " does not know " + next.quoted() : field.keyword + " needs a word", hint);
  }
  if (!option) {
    while (at_value_number(work)) take(work);
    return;
  }
  work.result.values.tag = option->name;
  while (option->max_values > 0 && at_value_number(work)) {
    const Token token = take(work);
    const auto& numbers = work.result.values.numbers;
    if (numbers.size() + static_cast<std::size_t>(token.repeat) > static_cast<std::size_t>(option->max_values) &&
        !work.surplus.known())
      work.surplus = token.where;
    append(work, token.value, token.repeat, token.where);
  }
  check_count(work, option->min_values, option->max_values, option);
}

/// Result codes that translators write but that stand for no result of this version must not make a deck invalid.
void ValueReader::skip_unknown_codes(Work& work) {
  if (work.result.faulty) return;
  auto& numbers = work.result.values.numbers;
  const auto unknown = [&](double number) {
    return std::none_of(work.field.codes.begin(), work.field.codes.end(),
                        [&](const Code& code) { return code.number == static_cast<int>(number); });
  };
  for (double number : numbers)
    if (number > 0 && unknown(number)) {  // a negative code means not to archive
      UnknownCodes& all = unknown_codes_.try_emplace(work.field.keyword, UnknownCodes{work.result.where, {}}).first->second;
      all.codes.insert(static_cast<int>(number));
    }
  numbers.erase(std::remove_if(numbers.begin(), numbers.end(), unknown), numbers.end());
}

void ValueReader::report_unknown_codes() {
  for (const auto& [keyword, unknown] : unknown_codes_) {
    std::string list;
    for (const int code : unknown.codes) list += " " + std::to_string(code);
    diagnostics_.warning(unknown.where, keyword + list + (unknown.codes.size() == 1 ? " has" : " have") + " no result here and " +
                                            (unknown.codes.size() == 1 ? "is" : "are") + " skipped");
  }
  unknown_codes_.clear();
}

}  // namespace engrane::deck

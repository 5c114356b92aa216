// SPDX-License-Identifier: BSD-3-Clause
#include "deck/read/reader.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

#include "base/text.hpp"
#include "deck/language/token_stream.hpp"
#include "deck/read/numbers_given.hpp"
#include "deck/read/recognised.hpp"
#include "deck/read/record_reader.hpp"
#include "deck/schema/matching.hpp"
#include "deck/schema/orders.hpp"

namespace engrane::deck {

namespace {

/// Maximum number of records that `I a J b K c` may stand for.
constexpr double most_copies = 1'000'000;

/// A dot command and the cards its records may belong to.
struct Command {
  std::string name;
  std::vector<const Schema*> schemas;
  RecordKeys keys;
  bool elements = false;

  const Schema& only() const { return *schemas.front(); }
  /// Whether `--card` may replace it: it occurs once in a deck, or its records are merged into one.
  bool replaceable() const { return only().once || name == ".SAI"; }
  bool keyed() const { return !keys.keyed.empty(); }
  bool numbered() const { return !keys.number_key.empty(); }
  bool redefines() const {
    return std::any_of(schemas.begin(), schemas.end(), [](const Schema* s) { return s->redefines; });
  }
};

/// All commands of a catalogue by the significant part of their words.
class CommandTable {
 public:
  explicit CommandTable(const Catalogue& catalogue) {
    for (const Schema* schema : catalogue.commands) add(*schema);
    Command mechanism;
    mechanism.name = ".MCE";
    mechanism.schemas = catalogue.elements;
    mechanism.keys.command = mechanism.name;
    mechanism.keys.number_key = "I";
    mechanism.elements = true;
    for (const char* word : {".MCE", ".MECHANISM"}) index_[significant(word)] = commands_.size();
    words_.insert(words_.end(), {".MCE", ".MECHANISM", ".FIN", ".DEL"});
    commands_.push_back(std::move(mechanism));
  }

  const Command* find(std::string_view word) const {
    const auto found = index_.find(significant(word));
    return found == index_.end() ? nullptr : &commands_[found->second];
  }

  const std::vector<std::string>& words() const { return words_; }

  /// Names of the cards that `--card` may replace.
  std::vector<std::string> replaceable() const {
    std::vector<std::string> names;
    for (const Command& command : commands_)
      for (const Schema* schema : command.schemas)
        if (schema->once || command.replaceable()) names.push_back(schema->name);
    return names;
  }

 private:
  void add(const Schema& schema) {
    const std::vector<std::string> words = command_words(schema);
    const auto [entry, fresh] = index_.try_emplace(significant(words.front()), commands_.size());
    if (fresh) commands_.emplace_back().name = words.front();
    for (const std::string& word : words) {
      index_.try_emplace(significant(word), entry->second);
      words_.push_back(word);
    }
    Command& command = commands_[entry->second];
    command.schemas.push_back(&schema);
    command.keys.command = command.name;
    for (const Field& field : schema.fields) {
      if (schema.key().empty() || !field.leads || (field.reference != Reference::node && field.reference != Reference::group))
        continue;
      const auto same = [&](const Field* object) { return object->keyword == field.keyword; };
      std::vector<const Field*>& objects = command.keys.objects;
      if (std::none_of(objects.begin(), objects.end(), same)) objects.push_back(&field);
    }
    if (!schema.key().empty()) {
      command.keys.keyed.push_back(&schema);
      command.keys.elsewhere = recognised_keys(command.name);
    }
    if (schema.numbered) command.keys.number_key = schema.record_key;
    command.keys.rows = command.keys.rows || schema.rows;
  }

  std::vector<Command> commands_;
  std::map<std::string, std::size_t, std::less<>> index_;
  std::vector<std::string> words_;
};

/// Reads a deck command by command.
class Reader {
 public:
  Reader(const Catalogue& catalogue, TokenStream& tokens, Diagnostics& diagnostics)
      : catalogue_(catalogue), commands_(catalogue), tokens_(tokens), diagnostics_(diagnostics), records_(tokens, diagnostics) {
    std::vector<std::string> words = commands_.words();
    std::erase_if(words, [](const std::string& word) { return word == ".FIN" || word == ".DEL"; });
    tokens_.know_commands(std::move(words));
  }

  Deck run(const std::vector<std::string>& cards) {
    read_commands();
    for (const std::string& card : cards) read_instead(card);
    records_.report_skipped();
    unite_records();
    check_skipped(settings_, deck_.records, diagnostics_);
    set_faulty_apart();
    for (const Record& record : deck_.faulty) deck_.incomplete.emplace(record.schema->command());
    return std::move(deck_);
  }

 private:
  void read_commands() {
    bool complained = false;
    while (!tokens_.peek().is_end()) {
      if (tokens_.peek().is_command()) {
        read_command();
        continue;
      }
      if (tokens_.mend_command()) continue;
      const Token token = tokens_.peek();
      tokens_.skip();
      deck_.incomplete.insert(".*");
      if (!complained)
        diagnostics_.error(token.where, "`" + std::string(token.text) + "` stands before the first command",
                           "a deck starts with a command such as .NOE");
      complained = true;
    }
  }

  /// Reads a card that replaces the deck's. It may use the deck's abbreviations.
  void read_instead(const std::string& card) {
    const bool one_line = card.find_first_of("\r\n") == std::string::npos;
    const std::string_view name = std::string_view(card).substr(0, card.find_first_of(" \t"));
    const Command* command = commands_.find(name);
    if (!one_line || !command || command->schemas.size() != 1 || !command->replaceable()) {
      diagnostics_.error({}, "--card takes one card that a deck has once, on one line, not `" + card + "`",
                         "--card \".SUB TF 0.1 H 1E-4\", or another of " + join(commands_.replaceable()));
      return;
    }
    forget(command);
    tokens_.open_text("--card", card);
    read_commands();
  }

  void unite_records() {
    std::map<const Schema*, std::vector<Record*>> all;
    for (Record& record : deck_.records)
      if (record.schema->unite && !record.faulty) all[record.schema].push_back(&record);
    for (const auto& [schema, records] : all) schema->unite(records, diagnostics_);
  }

  void set_faulty_apart() {
    const auto good = [](const Record& record) { return !record.faulty; };
    if (std::all_of(deck_.records.begin(), deck_.records.end(), good)) return;
    const auto first_faulty = std::stable_partition(deck_.records.begin(), deck_.records.end(), good);
    std::move(first_faulty, deck_.records.end(), std::back_inserter(deck_.faulty));
    deck_.records.erase(first_faulty, deck_.records.end());
  }

  void read_command() {
    const Token word = tokens_.take();
    if (begins_with_word(word.text, ".DEL")) return delete_records(word);
    const Command* command = commands_.find(word.text);
    if (!command) return unknown_command(word);
    open_again(*command, word);
    if (command->elements || command->numbered()) return read_numbered(*command);
    if (command->keyed()) return read_keyed(*command);
    read_plain(*command, word);
  }

  void unknown_command(const Token& word) {
    if (const Recognised* known = find_recognised(word.text)) {
      report(*known, word);
      if (known->skipped()) return skip_settings(*known);
    } else {
      std::string hint = did_you_mean_card(word.text, commands_.words());
      if (const Order* order = find_order(word.text))
        hint = std::string(order->word) + " is written without a dot";
      else if (hint.empty())
        hint = "`engrane help` lists the commands; its data is skipped";
      diagnostics_.error(word.where, "unknown command " + word.quoted(), hint);
      deck_.incomplete.insert(".*");
    }
    skip_command();
  }

  void skip_command() {
    while (!tokens_.peek().is_end() && !tokens_.peek().is_command()) tokens_.skip();
  }

  /// Skips a command without meaning here, and notes its words for check_skipped(). `TEMP 0` is as if it were not there.
  void skip_settings(const Recognised& known) {
    while (!tokens_.peek().is_end() && !tokens_.peek().is_command()) {
      const Token word = tokens_.peek();
      tokens_.skip();
      const Token& value = tokens_.peek();
      if (word.is_word() && !(value.is_number() && value.value == 0))
        settings_.push_back({known.name, std::string(word.text), word.where});
    }
  }

  void report(const Recognised& known, const Token& word) {
    if (known.skipped())
      diagnostics_.warning_once(known.name, word.where,
                                "`" + known.name + "` (" + known.meaning + ") is not used by engrane and is skipped");
    else
      diagnostics_.error(word.where, "`" + known.name + "` is recognised but not in this version: " + known.meaning, known.cure);
  }

  /// `.DEL.CLM` deletes the records of `.CLM` so far, `.DEL.*` all records.
  void delete_records(const Token& word) {
    const std::string_view target = word.text.substr(4);
    const Command* command = target.empty() ? nullptr : commands_.find(target);
    if (target == ".*")
      forget(nullptr);
    else if (command)
      forget(command);
    else if (target.empty() || !find_recognised(target))
      diagnostics_.error(word.where, word.quoted() + " does not say which command to delete",
                         target.empty() ? "write .DEL.CLM, or .DEL.* for all" : did_you_mean_card(target, commands_.words()));
    const Token rest = tokens_.peek();
    if (rest.is_end() || rest.is_command()) return;
    diagnostics_.error(rest.where, "nothing may follow `" + upper(word.text) + "`");
    skip_command();
  }

  int forget(const Command* command) {
    const auto gone = [&](const Record& record) { return !command || record.schema->command() == command->name; };
    const auto removed = std::erase_if(deck_.records, gone);
    std::erase_if(once_, [&](const auto& entry) { return !command || entry.first->command() == command->name; });
    if (command) {
      ids_.erase(command->name);
    } else {
      ids_.clear();
      settings_.clear();
    }
    return static_cast<int>(removed);
  }

  /// `.CLM ADD` adds to earlier records, `.CLM` alone drops them. Other commands add anyway, unless a deck has them once.
  void open_again(const Command& command, const Token& word) {
    if (!command.elements && command.only().once) return;
    const Token& next = tokens_.peek();
    if (next.is_word() && !next.starts_line && (same_word(next.text, "ADD") || same_word(next.text, "AJOUT")))
      return tokens_.skip();
    if (!command.redefines()) return;
    if (const int dropped = forget(&command); dropped > 0)
      diagnostics_.warning(
          word.where,
          command.name + " starts afresh: " + counted(static_cast<std::size_t>(dropped), "earlier record") + " dropped",
          "`" + command.name + " ADD` adds to them");
  }

  /// Reads records `I <id> …` of one card or, in `.MCE`, of the card whose TYPE follows the id.
  void read_numbered(const Command& command) {
    std::vector<Heading> headings;
    if (command.elements)
      expect_key(command);
    else
      headings = records_.read_headings(command.only(), command.keys);
    for (const Heading& heading : headings)
      if (heading.field->mesh_file) read_mesh(heading);
    std::erase_if(headings, [](const Heading& heading) { return heading.field->mesh_file; });
    while (at_number_key(tokens_, command.keys)) {
      Record record;
      std::vector<int> copies;
      if (!read_id(command, record, copies)) {
        deck_.incomplete.insert(command.name);
        records_.skip_record(command.keys);
        continue;
      }
      record.schema = command.elements ? element_type(command, record) : &command.only();
      if (!record.schema) {
        deck_.incomplete.insert(command.name);
        records_.skip_record(command.keys);
        continue;
      }
      record.data = record.schema->make();
      check_new_id(record, copies);
      records_.read(record, command.keys, headings);
      for (int id : copies) {
        deck_.records.push_back(record);
        deck_.records.back().id = id;
      }
      deck_.records.push_back(std::move(record));
      if (!copies.empty())
        std::rotate(deck_.records.rbegin(), deck_.records.rbegin() + 1,
                    deck_.records.rbegin() + static_cast<std::ptrdiff_t>(copies.size()) + 1);
    }
  }

  /// Inserts the records of a mesh where the deck names it. Of duplicate numbers, only the first in a file is reported.
  void read_mesh(const Heading& heading) {
    const std::filesystem::path path = tokens_.beside(heading.where, heading.values.texts.front());
    const int errors = diagnostics_.errors();
    std::vector<Record> records;
    if (catalogue_.read_mesh) {
      records = catalogue_.read_mesh(path, catalogue_, heading.where, diagnostics_);
      deck_.meshes.push_back(path);
    } else {
      diagnostics_.error(heading.where, "a mesh cannot be named here");
    }
    for (Record& record : records) {
      if (diagnostics_.errors() == errors) check_new_id(record, {});
      deck_.records.push_back(std::move(record));
    }
    if (diagnostics_.errors() > errors) deck_.incomplete.insert({".NOE", ".MAI", ".SEL"});
  }

  void expect_key(const Command& command) {
    if (at_boundary(tokens_, command.keys) || tokens_.mend_command()) return;
    deck_.incomplete.insert(command.name);
    const Token token = tokens_.take();
    if (!token.fault)
      diagnostics_.error(token.where, "expected `I` and a number instead of `" + std::string(token.text) + "`",
                         "an element is given as I 1 GEAR N 1 2 …");
    records_.skip_record(command.keys);
  }

  bool read_id(const Command& command, Record& record, std::vector<int>& copies) {
    Token token = tokens_.peek();
    record.location = token.where;
    if (!token.is_number()) {
      tokens_.skip();
      if (!tokens_.peek().is_number()) {
        diagnostics_.error(token.where, token.quoted() + " needs a number behind it",
                           "records are numbered: " + command.keys.number_key + " 1");
        return false;
      }
    }
    token = tokens_.take();
    if (token.fault) return false;
    record.id = id_of(token);
    if (record.id == 0) return false;
    span(record.location, token.where);
    const auto word_then_number = [&](std::string_view word) {
      return tokens_.peek().is_word() && same_word(tokens_.peek().text, word) && tokens_.peek(1).is_number();
    };
    if (command.elements || !command.only().repeated_ids || !word_then_number("J")) return true;
    tokens_.skip();
    const Token last = tokens_.take();
    double step = 1;
    if (word_then_number("K")) {
      tokens_.skip();
      step = tokens_.take().value;
    }
    const int end = id_of(last);
    if (end == 0) return false;
    if (end < record.id || step < 1 || step > end || (end - record.id) / step > most_copies) {
      diagnostics_.error(last.where, "this range of numbers is empty or too long", "I 1 J 9 K 2 stands for 1, 3, 5, 7 and 9");
      return false;
    }
    for (int id = record.id + static_cast<int>(step); id <= end; id += static_cast<int>(step)) copies.push_back(id);
    return true;
  }

  /// The number of a record; 0 with an error if it is invalid.
  int id_of(const Token& token) {
    if (token.value >= 1 && token.value <= 999'999'999 && token.value == static_cast<int>(token.value) && token.repeat == 1)
      return static_cast<int>(token.value);
    diagnostics_.error(token.where, token.quoted() + " cannot number a record", "numbers are whole, from 1 to 999999999");
    return 0;
  }

  static void span(Location& location, const Location& end) {
    if (end.file == location.file && end.line == location.line) location.length = end.column + end.length - location.column;
  }

  const Schema* element_type(const Command& command, Record& record) {
    const Token& next = tokens_.peek();
    const bool keyword =
        next.is_word() && (same_word(next.text, "N") || same_word(next.text, "NOEUDS") || same_word(next.text, "NODES"));
    if (!next.is_word() || next.is_command() || keyword) {
      diagnostics_.error(record.location, "element " + std::to_string(record.id) + " has no type",
                         "an element is given as I 1 GEAR N 1 2 …");
      return nullptr;
    }
    const Token word = tokens_.take();
    if (word.fault) return nullptr;
    const std::vector<const Schema*>& elements = command.schemas;
    const Match<Schema> match = match_schema(elements, word.text);
    span(record.location, word.where);
    if (match.entry) return match.entry;
    if (match.ambiguous()) {
      diagnostics_.error(word.where, word.quoted() + " is short for several element types",
                         "write " + join(candidate_names(match), " or "));
      return nullptr;
    }
    std::string hint = did_you_mean_card(word.text, schema_words(elements));
    if (hint.empty()) hint = "`engrane help` lists the element types";
    diagnostics_.error(word.where, "unknown element type " + word.quoted(), hint);
    return nullptr;
  }

  void check_new_id(Record& record, const std::vector<int>& copies) {
    if (record.schema->unite) return;
    const std::string command(record.schema->command());
    auto& known = ids_[command];
    const auto check = [&](int id) {
      const std::optional<int> first = known.add(id, record.location.line);
      if (!first) return true;
      diagnostics_.error(record.location, command + " " + std::to_string(id) + " is given twice",
                         "first in line " + std::to_string(*first));
      return false;
    };
    bool good = check(record.id);
    for (int id : copies) good = good && check(id);
    if (!good) record.faulty = true;
  }

  /// Reads records with a key: `NOEUD 1 FIX C 1 2 3`, or `FIX NOEUD 1 C 1 2 3`. A leading keyword repeated after the key starts
  /// another record: `FIX NOEUD 1 C 1 NOEUD 2 C 3`.
  void read_keyed(const Command& command) {
    const Schema* current = nullptr;
    for (;;) {
      const Token token = tokens_.peek();
      if (token.is_end() || token.is_command()) return;
      std::vector<Heading> object;
      const bool good = records_.read_object(command.keys, command.only(), object);
      const Token key = tokens_.peek();
      const Schema* next = keyed_schema(command.keys, key);
      const std::string_view leading = !object.empty() ? object.front().field->keyword : token.is_word() ? token.text : "";
      const Field* lead = current && !leading.empty() ? match_field(*current, leading).entry : nullptr;
      if (!next && !(lead && lead->leads)) {
        if (!good)
          skip_faulty_object(command);
        else if (object.empty() || find_recognised(command.name, key.text))
          unknown_key(command, key);
        else
          refuse_object(command, token);
        continue;
      }
      if (next) {
        tokens_.skip();
        current = next;
      }
      read_record(*current, command, token.where, object, good);
    }
  }

  void skip_faulty_object(const Command& command) {
    deck_.incomplete.insert(command.name);
    records_.skip_to_line(command.keys);
  }

  /// Reports an object without a record: `NOEUD 4 C 1` does not say what to do with the node.
  void refuse_object(const Command& command, const Token& object) {
    const Token key = tokens_.peek();
    std::vector<std::string> names;
    for (const Schema* schema : command.keys.keyed) names.emplace_back(schema->key());
    const bool stray = key.is_word() && !key.is_command() && !key.fault;
    std::string hint = stray ? did_you_mean_card(key.text, schema_words(command.keys.keyed), command.name) : "";
    if (hint.empty()) hint = "`" + std::string(object.text) + " 4 " + names.front() + " …`; records are " + join(names, " or ");
    diagnostics_.error(stray ? key.where : object.where,
                       stray ? key.quoted() + " starts no record of " + command.name
                             : object.quoted() + " is not followed by a record of " + command.name,
                       hint);
    skip_faulty_object(command);
  }

  void unknown_key(const Command& command, const Token& token) {
    if (tokens_.mend_command()) return;
    deck_.incomplete.insert(command.name);
    const bool faulty = token.fault != nullptr;
    tokens_.take();
    if (const Recognised* known = token.is_word() ? find_recognised(command.name, token.text) : nullptr)
      report(*known, token);
    else if (!faulty)
      diagnostics_.error(token.where, "`" + std::string(token.text) + "` starts no record of " + command.name,
                         key_hint(command, token.text));
    records_.skip_to_line(command.keys);
  }

  static std::string key_hint(const Command& command, std::string_view word) {
    std::string hint = did_you_mean_card(word, schema_words(command.keys.keyed), command.name);
    if (!hint.empty()) return hint;
    std::vector<std::string> names;
    for (const Schema* schema : command.keys.keyed) names.emplace_back(schema->key());
    return "its records start with " + join(names, " or ");
  }

  /// Reads a command with one card and no keys: `.SAM` is one record, `.CHK` one for each ELEMENT, NODE or RUN.
  void read_plain(const Command& command, const Token& word) {
    const Schema& schema = command.only();
    const bool several = std::any_of(schema.fields.begin(), schema.fields.end(), [](const Field& field) { return field.leads; });
    if (!several) return read_record(schema, command, word.where);
    while (!at_boundary(tokens_, command.keys)) read_record(schema, command, tokens_.peek().where);
  }

  void read_record(const Schema& schema, const Command& command, const Location& where, const std::vector<Heading>& object = {},
                   bool good = true) {
    Record record;
    record.schema = &schema;
    record.location = where;
    record.data = schema.make();
    if (schema.once) {
      const auto [first, fresh] = once_.try_emplace(&schema, where);
      if (!fresh) {
        diagnostics_.error(where, schema.name + " is given twice", "first in line " + std::to_string(first->second.line));
        record.faulty = true;
      }
    }
    records_.read(record, command.keys, {}, object);
    if (!good) record.faulty = true;
    deck_.records.push_back(std::move(record));
  }

  const Catalogue& catalogue_;
  CommandTable commands_;
  TokenStream& tokens_;
  Diagnostics& diagnostics_;
  RecordReader records_;
  Deck deck_;
  std::map<std::string, NumbersGiven> ids_;  ///< by command
  std::vector<SkippedSetting> settings_;
  std::map<const Schema*, Location> once_;  ///< locations of the cards that a deck may have only once
};

}  // namespace

const Schema* Catalogue::find(std::string_view name) const {
  for (const auto* list : {&commands, &elements})
    for (const Schema* schema : *list) {
      const auto words = record_words(*schema);
      if (same_word(schema->name, name) ||
          std::any_of(words.begin(), words.end(), [&](const std::string& word) { return same_word(word, name); }))
        return schema;
    }
  for (const Schema* schema : commands)
    for (const std::string& word : command_words(*schema))
      if (name.find(' ') == name.npos && significant(word) == significant(name.starts_with('.') ? name : "." + std::string(name)))
        return schema;
  const Match<Schema> command = match_schema(commands, name), element = match_schema(elements, name);
  if (command.candidates.size() + element.candidates.size() > 1) return nullptr;
  return command.entry ? command.entry : element.entry;
}

namespace {

Deck read(TokenStream& tokens, const Catalogue& catalogue, const SourceMap& sources, Diagnostics& diagnostics,
          const std::vector<std::string>& cards = {}) {
  Deck deck = Reader(catalogue, tokens, diagnostics).run(cards);
  for (int file = 0; file < sources.size(); ++file)
    deck.folders.push_back(std::filesystem::path(sources.path(file)).parent_path().string());
  return deck;
}

}  // namespace

Deck read_file(const std::filesystem::path& path, const Catalogue& catalogue, SourceMap& sources, Diagnostics& diagnostics,
               const Overrides& overrides) {
  TokenStream tokens(sources, diagnostics);
  tokens.overrule(overrides.definitions);
  if (!tokens.open_file(path)) return {};
  Deck deck = read(tokens, catalogue, sources, diagnostics, overrides.cards);
  const std::vector<std::string> known = tokens.abbreviations();
  for (const auto& [name, text] : overrides.definitions) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    const std::string near = nearest(name, known);
    diagnostics.error({}, "-D " + name.substr(1) + ": " + path.string() + " has no abbreviation `" + name + "`",
                      known.empty()  ? "it has none at all; ABRE '" + name + "' '" + text + "' would make it one"
                      : near.empty() ? "it has " + join(known)
                                     : "did you mean " + near.substr(1) + "? It has " + join(known));
  }
  return deck;
}

Deck read_text(std::string name, std::string text, const Catalogue& catalogue, SourceMap& sources, Diagnostics& diagnostics) {
  TokenStream tokens(sources, diagnostics);
  tokens.open_text(std::move(name), std::move(text));
  return read(tokens, catalogue, sources, diagnostics);
}

}  // namespace engrane::deck

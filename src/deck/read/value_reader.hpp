// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostics.hpp"
#include "deck/language/token_stream.hpp"
#include "deck/read/recognised.hpp"
#include "deck/schema/schema.hpp"

namespace engrane::deck {

/// The tokens that end a record within a command.
struct RecordKeys {
  std::string command;                   ///< `.CLM`
  std::string number_key;                ///< `I`, or `GROUP` in `.SEL`; empty if records are not numbered
  bool rows = false;                     ///< a number at the start of a line starts a record
  std::vector<const Schema*> keyed;      ///< `FIX`, `DEP`, … of `.CLM`
  std::vector<const Field*> objects;     ///< `NOEUD`, `GROUP`: what records apply to, before or after the record key
  std::vector<RecognisedKey> elsewhere;  ///< `PRE`: records of the command in BACON that this version does not implement
};

/// Whether the next token is the key of a numbered record, or the number of a row.
bool at_number_key(TokenStream& tokens, const RecordKeys& keys);

/// The object that a word names by a full spelling; nullptr if there is none.
const Field* named_object(const RecordKeys& keys, const Token& token);

/// Whether the next token starts another record or command, or ends the deck.
bool at_boundary(TokenStream& tokens, const RecordKeys& keys);

/// The card named by a record key: a full spelling, or a prefix of at least three letters.
const Schema* keyed_schema(const RecordKeys& keys, const Token& token);

/// The values read for one field.
struct FieldReading {
  Field::Values values;
  Location where;       ///< from the first value to the last, or the keyword if there is none
  bool faulty = false;  ///< an error was reported
};

/// Reads the values after a keyword and checks their count, type and range.
class ValueReader {
 public:
  ValueReader(TokenStream& tokens, Diagnostics& diagnostics) : tokens_(tokens), diagnostics_(diagnostics) {}

  /// `keyword` is the location of the field's keyword (or of its first value, for a positional field). The result is valid
  /// until the next call.
  FieldReading& read(const Field& field, const Schema& schema, const RecordKeys& keys, Location keyword);

  /// Warns of all unknown codes, once per keyword.
  void report_unknown_codes();

 private:
  struct Work;

  Token take(Work& work);
  void error(Work& work, const Location& where, std::string message, std::string hint = {});
  bool at_value_number(const Work& work);
  bool at_stray_value(const Work& work);
  void read_numbers(Work& work);
  bool read_range(Work& work);
  void append_range(Work& work, const Token& first, const Token& last, double step);
  void append(Work& work, double value, int count, const Location& where);
  void read_texts(Work& work);
  void refuse_more_words(Work& work);
  void read_choice(Work& work);
  void check_number(Work& work, const Token& token);
  void check_count(Work& work, int least, int most, const Option* option = nullptr);
  void skip_unknown_codes(Work& work);

  /// Codes of a keyword that are unknown to this version.
  struct UnknownCodes {
    Location where;
    std::set<int> codes;
  };

  TokenStream& tokens_;
  Diagnostics& diagnostics_;
  std::map<std::string, UnknownCodes> unknown_codes_;  ///< by keyword
  FieldReading reading_;                               ///< of the field being read; a member to reuse its memory
  int repeated_ = 0;                                   ///< number of values produced by repeat counts in this deck
};

/// `3 values`, `1 to 3 values`, `at least 1 value`.
std::string expected_count(int least, int most);

/// `greater than 0`, `from 0 to 1`, with the unit; empty if there is no limit.
std::string range_text(const Field& field);
/// The same for help and manual: none for a function, where it would read as the range of the function's values.
std::string documented_range(const Field& field);

}  // namespace engrane::deck

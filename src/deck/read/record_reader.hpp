// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "base/diagnostics.hpp"
#include "deck/language/token_stream.hpp"
#include "deck/read/value_reader.hpp"
#include "deck/schema/schema.hpp"

namespace engrane::deck {

/// A value given before the first record of a command, which applies to all its records.
struct Heading {
  const Field* field;
  Field::Values values;
  Location where;
};

/// Name of a record in messages: `GEAR 1`, `.NOE 12`, `.CLM FIX`.
std::string record_title(const Schema& schema, int id);

/// Reads the fields of one record, up to the next record key, command or end.
class RecordReader {
 public:
  RecordReader(TokenStream& tokens, Diagnostics& diagnostics)
      : tokens_(tokens), diagnostics_(diagnostics), values_(tokens, diagnostics) {}

  /// Reads fields into `record`, whose schema, id, location and default data are set, and checks that none is missing.
  /// `object`: the objects the record applies to, if given before its key.
  void read(Record& record, const RecordKeys& keys, const std::vector<Heading>& headings,
            const std::vector<Heading>& object = {});

  /// Reads the objects before a record's key: `GROUP "frame"` in `GROUP "frame" FIX C 1`. Returns false if an error was
  /// reported.
  bool read_object(const RecordKeys& keys, const Schema& schema, std::vector<Heading>& object);

  /// Reports what was skipped in the whole deck.
  void report_skipped() { values_.report_unknown_codes(); }

  /// Reads the keywords before the first record. Anything not allowed there is an error.
  std::vector<Heading> read_headings(const Schema& schema, const RecordKeys& keys);

  /// Skips a record with an unknown key: up to the next key, or a word at the start of a line that may be meant as a key.
  void skip_to_line(const RecordKeys& keys);

  /// Skips tokens that belong to no record, up to the next record key or command.
  void skip_record(const RecordKeys& keys);

 private:
  struct Reading;

  bool names_field(const Reading& reading) const;
  bool begins_next(const Reading& reading);
  void take_object(Reading& reading, const std::vector<Heading>& object);
  void read_item(Reading& reading);
  const Field* positional_field(const Reading& reading, const Token& token) const;
  void read_field(Reading& reading, const Field& field, const Token* keyword);
  void locate(const Field& field, const Location& where);
  bool appends(const Reading& reading, const Field& field) const;
  bool given_twice(Reading& reading, const Field& field, std::size_t count, const Location& where);
  void unknown_item(Reading& reading);
  void unknown_word(Reading& reading, const Token& token);
  void skip_filler(const Reading& reading);
  void skip_values(const Reading& reading);
  void finish(Reading& reading);

  /// A keyword of the record being read.
  struct Given {
    const Field* field;
    Location start;     ///< of the keyword
    std::size_t count;  ///< number of numeric values
  };

  const Given* given(const Field& field) const;

  TokenStream& tokens_;
  Diagnostics& diagnostics_;
  ValueReader values_;
  std::vector<Given> given_;              ///< of the record being read
  std::vector<FieldLocation> locations_;  ///< likewise
};

}  // namespace engrane::deck

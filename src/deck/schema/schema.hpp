// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <any>
#include <array>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/diagnostics.hpp"
#include "base/dimension.hpp"

namespace engrane::deck {

/// A word of a fixed list followed by numbers: `ERR COS 0.004`, `DRIVE SPEED`, `TYPE STATIC`.
struct Tagged {
  std::string tag;             ///< canonical (English, upper case) name of the option; empty if not given
  std::vector<double> values;  ///< numbers after it

  bool given() const { return !tag.empty(); }
  bool is(std::string_view name) const { return tag == name; }
};

struct Record;

/// Type of a keyword's values in the deck.
enum class FieldType { flag, integer, real, text, choice };

/// What the integers of a field refer to. The model resolves these references, not the reader.
enum class Reference { nothing, node, element, function, group, frame };

/// One word of a choice field.
struct Option {
  std::string name;
  std::vector<std::string> synonyms;
  std::string help;
  int min_values = 0;  ///< minimum number of values after the word
  int max_values = 0;  ///< maximum number
  Dimension dimension{};
};

/// Meaning of an integer code (`STYP 163`).
struct Code {
  int number;
  std::string meaning;
};

/// Maximum number of values of a list unless declared otherwise.
inline constexpr int any_number = 1 << 20;

/// A member of a card's struct that a keyword sets; spans refer to arrays.
using Member =
    std::variant<std::monostate, bool*, int*, double*, std::string*, Tagged*, std::optional<int>*, std::optional<double>*,
                 std::vector<int>*, std::vector<double>*, std::vector<std::string>*, std::span<int>, std::span<double>,
                 std::optional<std::array<double, 2>>*, std::optional<std::array<double, 3>>*>;

/// A keyword of a card, with all data needed for reading, help, templates, manual and JSON schema.
struct Field {
  // Defined in the .cpp file so that sources that declare cards do not each instantiate them. The same applies to Schema.
  Field();
  Field(const Field&);
  Field(Field&&) noexcept;
  Field& operator=(const Field&);
  Field& operator=(Field&&) noexcept;
  ~Field();

  std::string keyword;
  std::vector<std::string> synonyms;
  std::vector<std::string> spellings;  ///< keyword, synonyms, and those BACON has for it everywhere; set by Card
  std::string help;
  FieldType type = FieldType::real;
  int min_values = 1;
  int max_values = 1;
  Dimension dimension{};
  Reference reference = Reference::nothing;
  bool required = false;
  bool positional = false;  ///< its values may be given without the keyword, to the first such field not yet given
  bool leads = false;       ///< if repeated, starts the next record (NOEUD, GROUP); in a numbered record the lists continue
  bool heading = false;     ///< may precede the first record of the command and then applies to all of them
  bool repeats = false;     ///< if repeated in a record, its list continues
  bool mesh_file = false;   ///< names a file that stands for records; only before the first record
  std::string whole;        ///< keyword of the array of which this field is one entry (X for Y and Z); otherwise empty
  int part = 0;             ///< which entry, from 0
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  bool lower_open = false;  ///< the bound itself is not allowed
  bool upper_open = false;
  std::vector<std::string> fillers;  ///< words without meaning that may precede the values (`ACC VAL …`)
  std::vector<Code> codes;           ///< known codes; others are skipped with a warning
  std::vector<Option> options;       ///< of a choice; the first is taken if the keyword stands alone and it needs no value

  /// Values as given in the deck. Depending on the type, only one vector is used (a choice uses `tag` and `numbers`).
  struct Values {
    std::vector<double> numbers;
    std::vector<std::string> texts;
    std::string tag;
    bool present = false;
  };
  std::function<Member(std::any&)> bind;  ///< returns the member of the card's struct; empty for a file that stands for records

  void store(std::any& data, const Values& values) const;  ///< writes the values into the card's struct
  Values load(const std::any& data) const;                 ///< reads them back, for defaults, canonical decks and JSON
};

/// A card independent of its struct's type, as used by reader, help and manual.
struct Schema {
  Schema();
  Schema(const Schema&);
  Schema(Schema&&) noexcept;
  Schema& operator=(const Schema&);
  Schema& operator=(Schema&&) noexcept;
  ~Schema();

  std::string name;                   ///< `GEAR`, or `.CLM FIX`, `.SAM`
  std::vector<std::string> synonyms;  ///< `ENGRENAGE`
  std::string summary;                ///< one sentence
  std::string chapter;                ///< of the manual
  std::string description;            ///< paragraphs, may be empty
  std::vector<std::string> examples;  ///< deck lines
  std::vector<Field> fields;
  bool numbered = false;           ///< the record starts with `I <id>`
  std::string record_key = "I";    ///< the word before the number (`GROUP` in `.SEL`)
  bool repeated_ids = false;       ///< ranges of ids `I a J b K c` are allowed
  bool rows = false;               ///< a line that starts with a number is a record: id, then positional values
  bool once = false;               ///< a second record is an error
  bool redefines = false;          ///< reopening the command without ADD drops its earlier records
  std::function<std::any()> make;  ///< creates the struct a record starts from
  /// Checks across fields and derives values, after the record has been read without a fault; may be empty.
  std::function<void(Record&, Diagnostics&)> finish;
  /// Unites the records of a deck that add up, given in its order; those that contradict become faulty. If empty, a number that
  /// is given twice is an error.
  std::function<void(const std::vector<Record*>&, Diagnostics&)> unite;

  const Field* find(std::string_view keyword) const;  ///< exact canonical keyword
  std::string_view command() const;                   ///< `.CLM` of `.CLM FIX`; `.MCE` for elements
  std::string_view key() const;                       ///< `FIX` of `.CLM FIX`; empty if the command has only one kind of record
};

/// All spellings of a field: keyword, declared synonyms, and those that BACON accepts for this keyword everywhere (V = VAL).
inline const std::vector<std::string>& spellings(const Field& field) { return field.spellings; }

/// Computes Field::spellings.
std::vector<std::string> collect_spellings(const Field& field);

/// Faults of a schema itself (reserved or duplicate words, missing help, a default that is not an option), for unit tests.
std::vector<std::string> schema_faults(const Schema& schema);

/// Unit of a number in a deck: as UnitSystem::label, but degrees for angles.
std::string deck_unit(Dimension dimension);

/// Location of a keyword's values.
struct FieldLocation {
  const Field* field = nullptr;
  Location where;
};

/// One record of a deck, read, checked against its schema and stored in its struct. Decks may have hundreds of thousands of
/// records, so its size matters.
struct Record {
  const Schema* schema = nullptr;
  int id = 0;           ///< number after `I`; 0 if the card has none
  bool faulty = false;  ///< an error was reported for it; it is then moved to Deck::faulty
  Location location;
  std::vector<FieldLocation> field_locations;  ///< of the given keywords, each once
  std::any data;

  /// The card's struct; nullptr if the record belongs to another card.
  template <class Data>
  const Data* get() const {
    return std::any_cast<Data>(&data);
  }
  bool given(std::string_view keyword) const { return find(keyword) != nullptr; }
  bool given(const Field& field) const;
  /// Location of the keyword's values; of the record if the keyword was not given.
  Location where(std::string_view keyword) const;

 private:
  const FieldLocation* find(std::string_view keyword) const;
};

}  // namespace engrane::deck

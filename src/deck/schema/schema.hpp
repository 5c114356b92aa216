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
  std::string tag;             ///< canonical (English, upper case) name of the option; empty when not given
  std::vector<double> values;  ///< the numbers behind it

  bool given() const { return !tag.empty(); }
  bool is(std::string_view name) const { return tag == name; }
};

struct Record;

/// What a keyword's values look like in the deck.
enum class FieldType { flag, integer, real, text, choice };

/// What the integers of a field point at; the reader leaves the look-up to the model, which knows what exists.
enum class Reference { nothing, node, element, function, group, frame };

/// One word of a choice field.
struct Option {
  std::string name;
  std::vector<std::string> synonyms;
  std::string help;
  int min_values = 0;  ///< how many numbers must follow the word
  int max_values = 0;  ///< how many may
  Dimension dimension{};
};

/// One meaning of an integer that is a code (`STYP 163`).
struct Code {
  int number;
  std::string meaning;
};

/// Number of values a list may take when the declaration does not say.
inline constexpr int any_number = 1 << 20;

/// A member of a card's struct that a keyword sets; the spans are arrays.
using Member =
    std::variant<std::monostate, bool*, int*, double*, std::string*, Tagged*, std::optional<int>*, std::optional<double>*,
                 std::vector<int>*, std::vector<double>*, std::vector<std::string>*, std::span<int>, std::span<double>,
                 std::optional<std::array<double, 2>>*, std::optional<std::array<double, 3>>*>;

/// One keyword of a card: everything that reading, help, template, manual and JSON schema need to know.
struct Field {
  // Compiled once: what declares cards would else have them anew in each source. So it is with Schema.
  Field();
  Field(const Field&);
  Field(Field&&) noexcept;
  Field& operator=(const Field&);
  Field& operator=(Field&&) noexcept;
  ~Field();

  std::string keyword;
  std::vector<std::string> synonyms;
  std::vector<std::string> spellings;  ///< keyword, synonyms and those that BACON gives the keyword everywhere; by the Card
  std::string help;
  FieldType type = FieldType::real;
  int min_values = 1;
  int max_values = 1;
  Dimension dimension{};
  Reference reference = Reference::nothing;
  bool required = false;
  bool positional = false;  ///< its values may come without the keyword: the first field not yet given takes them
  bool leads = false;       ///< given again it starts the next record (NOEUD, GROUP); in a numbered one the lists go on
  bool heading = false;     ///< may stand before the first record of the command and then holds for all of them
  bool repeats = false;     ///< given again in a record, its list goes on
  bool mesh_file = false;   ///< names a file that stands for records; before the first record only
  std::string whole;        ///< the keyword whose array this field is one entry of (Y and Z of X); empty otherwise
  int part = 0;             ///< which entry, from 0
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  bool lower_open = false;  ///< the bound itself is not allowed
  bool upper_open = false;
  std::vector<std::string> fillers;  ///< words without meaning that may stand before the values (`ACC VAL …`)
  std::vector<Code> codes;           ///< the integers that mean something; others are skipped with a warning
  std::vector<Option> options;       ///< of a choice; the first is taken when the keyword stands alone and needs no value

  /// Values as the deck gives them; exactly one vector is in use, by type (a choice uses `tag` and `numbers`).
  struct Values {
    std::vector<double> numbers;
    std::vector<std::string> texts;
    std::string tag;
    bool present = false;
  };
  std::function<Member(std::any&)> bind;  ///< the member of the card's struct; none for a name that stands for records

  void store(std::any& data, const Values& values) const;  ///< writes the values into the card's struct
  Values load(const std::any& data) const;                 ///< reads them back: defaults, canonical deck, JSON
};

/// A card without its struct's type: what reader, help and manual work with.
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
  bool repeated_ids = false;       ///< `I a J b K c` ranges of ids make sense
  bool rows = false;               ///< a line that starts with a number is a record: id, then the positional values
  bool once = false;               ///< a second record is an error
  bool redefines = false;          ///< opening the command again without ADD drops its earlier records
  std::function<std::any()> make;  ///< a default-constructed struct
  /// Checks across fields and values that follow from others, once the record is read without a fault; may be empty.
  std::function<void(Record&, Diagnostics&)> finish;

  const Field* find(std::string_view keyword) const;  ///< exact canonical keyword
  std::string_view command() const;                   ///< `.CLM` of `.CLM FIX`; `.MCE` for elements
  std::string_view key() const;                       ///< `FIX` of `.CLM FIX`; empty when the command has one kind of record only
};

/// Every spelling of a field: keyword, declared synonyms, and those that BACON gives this keyword everywhere (V = VAL).
inline const std::vector<std::string>& spellings(const Field& field) { return field.spellings; }

/// What Field::spellings is to be.
std::vector<std::string> collect_spellings(const Field& field);

/// What is wrong with a schema itself (reserved or doubled words, missing help, a default out of range): for unit tests.
std::vector<std::string> schema_faults(const Schema& schema);

/// The unit a number has in a deck: as UnitSystem::label, but angles are in degrees.
std::string deck_unit(Dimension dimension);

/// Where a keyword's values stand.
struct FieldLocation {
  const Field* field = nullptr;
  Location where;
};

/// One record of a deck, read, checked against its schema and stored in its struct. Decks have records by the hundred thousand:
/// what a record holds is counted in bytes.
struct Record {
  const Schema* schema = nullptr;
  int id = 0;           ///< the number behind `I`; 0 when the card has none
  bool faulty = false;  ///< an error was reported for it; it is then in Deck::faulty
  Location location;
  std::vector<FieldLocation> field_locations;  ///< of the keywords given, each once
  std::any data;

  /// The card's struct, or nullptr when the record is of another card.
  template <class Data>
  const Data* get() const {
    return std::any_cast<Data>(&data);
  }
  bool given(std::string_view keyword) const { return find(keyword) != nullptr; }
  bool given(const Field& field) const;
  /// Where the keyword's values stand; the record itself when the keyword was not given.
  Location where(std::string_view keyword) const;

 private:
  const FieldLocation* find(std::string_view keyword) const;
};

}  // namespace engrane::deck

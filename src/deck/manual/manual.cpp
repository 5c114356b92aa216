// SPDX-License-Identifier: BSD-3-Clause
#include "deck/manual/manual.hpp"

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "base/text.hpp"
#include "deck/read/recognised.hpp"
#include "deck/read/value_reader.hpp"
#include "deck/schema/field_text.hpp"
#include "deck/schema/matching.hpp"

namespace engrane::deck {

namespace {

constexpr const char* preface = R"(# Reference manual of the deck

This manual is written by `engrane manual` from the same declarations that read a deck and check it.

## How a deck is written

A deck is a text of **commands** and **records**, in the style of SAMCEF BACON and MECANO.

- A **command** is a word that starts with a dot, at the start of a line: `.NOE`. Three letters behind the dot count, four when the
  first is a digit; longer spellings and small letters are accepted (`.NOEUDS`, `.noe`). A command stays open until the next one;
  its data may start on its own line.
- A **record** starts with its key: `I` and a number for what is numbered (`I 7 GEAR …`), a word such as `FIX` or `GROUP` elsewhere.
  It ends where the next record starts, not at the end of the line, so that a record may span as many lines as it likes.
- Inside a record **keywords** and their values come in any order. A keyword may be cut to any beginning that no other keyword of
  the card shares, and has the synonyms listed here; a full spelling goes before an abbreviation. A keyword given twice is an error.
- `!` starts a **comment**, except inside quotes. `$` at the end of a line **continues** it: words of one expression or row may then
  stand on two lines.
- **Texts** stand in double quotes on one line. The texts of `ABRE` stand in single quotes.
- **Numbers** are written in any way of Fortran: `3`, `.5`, `3.`, `2.1E+08`, `1.5D3`, `1.5d-3`, `1.5+3`. `3*0.` stands for three
  zeros. The whole word must be a number; what does not fit a double is an error.
- **Arithmetic** stands in parentheses, with `+ - * / **`, `PI` and the functions sin, cos, tan, asin, acos, atan, atan2, sqrt, exp, log,
  tanh, abs, min, max, sign and if; the functions take and give radians: `(1000/cos(20*PI/180))`. `sign(a)` is -1, 0 or 1 and
  `sign(a, b)`, as in Fortran, |a| with the sign of b; `if(c, a, b)` is a where c is not 0 and b elsewhere. Comparisons
  `< <= > >= == /=` (or `.LT. .LE. .GT. .GE. .EQ. .NE.`) and `.NOT.`, `.AND.`, `.OR.` give 1 where they hold and 0 where not:
  `EXPR "if(T < 1, T**2, 1) + 2"`.
- **Ranges** of numbers: `751 A 2249`, or `I 1 J 5000 K 2` (from, to, step), where a list of nodes or elements is expected.
- **Angles** are in degrees, in the deck; angular velocities are in radians per unit of time.
- A **node 0**, where an element allows it, is the ground.

**Orders** to the reader stand at the start of a line:

%ORDERS%
A lone `&` and `#INQ(...)` are skipped with a warning.

All errors of a deck are reported in one run, each with file, line and column; the exit status is then 1 and no results are written.

### What is BACON and what is ours

The rules above, the commands `.UNIT`, `.NOE`, `.FRAME`, `.SEL`, `.MAT`, `.CLM`, `.FCT`, `.INI`, `.SAM`, `.SUB`, `.SAI`, `.MCE`, `.DEL` and `.FIN`,
the records FIX, DEP, CHA and STRU with the keywords NOEUD, GROUP, C, V and NF, the properties YT, NT, M and A, the shape
`I <id> <TYPE> N <nodes>` of an element and the result codes STYP follow public descriptions and decks of SAMCEF. **Our own choice**, because nothing about them is public, are:
the types and keywords of the elements of `.MCE`, the keywords of `.SAM`, `.SUB`, `.SAI` (other than STYP), `.FRAME` and `.INI`, the shapes of
`.FCT`, and all of `.CHK`. `.TITRE` is ours, too.
)";

std::string preface_with_orders() {
  std::string table = "| order | meaning |\n|---|---|\n", text = preface;
  for (const Order& order : orders()) table += "| `" + std::string(order.form) + "` | " + std::string(order.meaning) + " |\n";
  constexpr std::string_view place = "%ORDERS%\n";
  return text.replace(text.find(place), place.size(), table + "\n");
}

std::string cell(const std::string& text) {
  std::string result;
  for (char c : printable(text)) {
    if (c == '|') result += '\\';
    result += c;
  }
  return result;
}

std::string code(const std::string& text) { return text.empty() ? "" : "`" + text + "`"; }

std::string codes(const std::vector<std::string>& words) {
  std::vector<std::string> quoted;
  for (const std::string& word : words) quoted.push_back(code(word));
  return join(quoted, ", ");
}

std::string meaning(const Field& field) {
  std::string text = field.help;
  if (const std::string fillers = filler_text(field); !fillers.empty()) text += "; " + fillers;
  if (field.positional) text += "; the keyword may be left out";
  if (field.heading) text += "; may stand before the first record and then holds for all";
  for (const Option& option : field.options) {
    text += "<br>" + codes([&] {
              std::vector<std::string> words{option.name};
              words.insert(words.end(), option.synonyms.begin(), option.synonyms.end());
              return words;
            }());
    if (option.max_values > 0) text += " and " + expected_count(option.min_values, option.max_values);
    if (const std::string unit = deck_unit(option.dimension); !unit.empty()) text += " " + unit;
    text += ": " + option.help;
  }
  for (const Code& known : field.codes) text += "<br>" + code(std::to_string(known.number)) + ": " + known.meaning;
  return text;
}

/// The range without its unit, which has its own column.
std::string bare_range(Field field) {
  field.dimension = {};
  return documented_range(field);
}

void append_card(std::string& out, const Schema& schema) {
  out += "\n### " + schema.name + "\n\n" + schema.summary + ".";
  if (!schema.synonyms.empty()) out += " Also " + codes(schema.synonyms) + ".";
  out += "\n";
  if (!schema.description.empty()) out += "\n" + schema.description + "\n";
  if (!schema.fields.empty()) {
    out += "\n| keyword | synonyms | values | unit | default | range | meaning |\n|---|---|---|---|---|---|---|\n";
    for (const Field& field : schema.fields) {
      std::vector<std::string> synonyms = spellings(field);
      synonyms.erase(synonyms.begin());
      const std::string fallback = field.required ? "required" : code(default_text(schema, field));
      out += "| " + code(field.keyword) + " | " + codes(synonyms) + " | " + value_kind(field) + " | " +
             deck_unit(field.dimension) + " | " + fallback + " | " + bare_range(field) + " | " + cell(meaning(field)) + " |\n";
    }
  }
  if (schema.examples.empty()) return;
  out += "\n```\n";
  for (const std::string& example : schema.examples) out += example + "\n";
  out += "```\n";
}

void append_chapters(std::string& out, const std::vector<const Schema*>& schemas, const std::string& prefix) {
  std::vector<std::string> chapters;
  for (const Schema* schema : schemas)
    if (std::find(chapters.begin(), chapters.end(), schema->chapter) == chapters.end()) chapters.push_back(schema->chapter);
  for (const std::string& chapter : chapters) {
    out += "\n## " + prefix + chapter + "\n";
    for (const Schema* schema : schemas)
      if (schema->chapter == chapter) append_card(out, *schema);
  }
}

void append_recognised(std::string& out) {
  out +=
      "\n## Recognised, not in this version\n\nThese parts of BACON are known to the reader, which says what to do instead.\n\n"
      "| command | meaning | instead |\n|---|---|---|\n";
  for (const Recognised& entry : recognised_commands())
    out += "| " + code(entry.name) + " | " + entry.meaning + " | " + (entry.skipped() ? "skipped with a warning" : entry.cure) +
           " |\n";
}

}  // namespace

std::string manual_markdown(const Catalogue& catalogue) {
  std::string out = preface_with_orders();
  append_chapters(out, catalogue.commands, "");
  out +=
      "\n## Elements of mechanisms: `.MCE`\n\nA record is `I <id> <TYPE> N <nodes> <keyword values>`; TYPE is the name of a "
      "section below or a "
      "synonym of it. `.MCE` may be opened several times.\n";
  append_chapters(out, catalogue.elements, "Elements: ");
  append_recognised(out);
  return out;
}

}  // namespace engrane::deck

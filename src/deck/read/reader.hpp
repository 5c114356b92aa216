// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "base/diagnostics.hpp"
#include "deck/language/abbreviations.hpp"
#include "deck/schema/schema.hpp"

namespace engrane::deck {

struct Catalogue;

/// What reads a file of a mesh: the records that stand for it, located at `where`. Whether their numbers are new is for the deck
/// to ask. Faults go to the diagnostics, also at `where`.
using MeshReader = std::function<std::vector<Record>(const std::filesystem::path& file, const Catalogue& catalogue,
                                                     const Location& where, Diagnostics& diagnostics)>;

/// All cards that a deck may hold: the general commands and the mechanism elements of `.MCE`.
struct Catalogue {
  std::vector<const Schema*> commands;  ///< names like `.NOE`, `.CLM FIX`
  std::vector<const Schema*> elements;  ///< names like `GEAR`
  MeshReader read_mesh = nullptr;       ///< nullptr: a deck that names a mesh is refused

  const Schema* find(std::string_view name) const;  ///< by name, synonym or unambiguous prefix; nullptr otherwise
};

/// A deck as read: records in the order of the file, `.DEL.*` already carried out.
struct Deck {
  std::vector<Record> records;
  /// Records about which an error was reported, apart: whoever builds a model from the good ones neither trips over them
  /// nor complains again. That something refers to their numbers is no fault of its own.
  std::vector<Record> faulty;
  /// Commands of which something could not be read (`.NOE`), `.*` for one that is none: what is missing of them was perhaps
  /// given.
  std::set<std::string, std::less<>> incomplete;
  std::vector<std::filesystem::path> meshes;  ///< files that stand for records
  std::vector<std::string> folders;           ///< in which each file of the SourceMap stands; empty: the working directory
};

/// What somebody else than the deck says.
struct Overrides {
  Definitions definitions;  ///< for the texts of the deck's own ABRE; one that the deck has no ABRE for is an error
  std::vector<std::string>
      cards;  ///< each in the place of the deck's card of that name, which a deck has once: `.SUB TF 1 H 0.1`
};

/// Reads a deck and everything it includes. All faults go to `diagnostics`; never throws on bad input. Faults of `overrides`
/// stand in texts that bear the names of the options, `-D` and `--card`.
Deck read_file(const std::filesystem::path& path, const Catalogue& catalogue, SourceMap& sources, Diagnostics& diagnostics,
               const Overrides& overrides = {});

/// The same for a text in memory, as `name`; INPUT is looked up in the working directory.
Deck read_text(std::string name, std::string text, const Catalogue& catalogue, SourceMap& sources, Diagnostics& diagnostics);

/// The deck written out again, record by record in one spelling. Defaults that hold because nothing was given follow in
/// a comment, so that reading the text gives the same records, down to what was given and what was not.
std::string canonical_text(const Deck& deck);

/// A JSON object of one record: {"id": 1, "type": "GEAR", "Z": [50, 10], …} with defaults, for the results file.
std::string record_json(const Record& record);

}  // namespace engrane::deck

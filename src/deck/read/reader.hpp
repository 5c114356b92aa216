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

/// Reads a mesh file and returns the records it stands for, located at `where`. The caller checks that their numbers are new.
/// Faults go to `diagnostics`, also at `where`.
using MeshReader = std::function<std::vector<Record>(const std::filesystem::path& file, const Catalogue& catalogue,
                                                     const Location& where, Diagnostics& diagnostics)>;

/// All cards of the deck language: general commands and the mechanism elements of `.MCE`.
struct Catalogue {
  std::vector<const Schema*> commands;  ///< names like `.NOE`, `.CLM FIX`
  std::vector<const Schema*> elements;  ///< names like `GEAR`
  MeshReader read_mesh = nullptr;       ///< nullptr: a mesh file in a deck is an error

  const Schema* find(std::string_view name) const;  ///< by name, synonym or unambiguous prefix; nullptr otherwise
};

/// A parsed deck: records in file order, with `.DEL.*` already executed.
struct Deck {
  std::vector<Record> records;
  /// Records for which an error was reported, kept apart: code that builds a model from the good ones does not fail on them or
  /// report them again. A reference to one of their numbers is not an error.
  std::vector<Record> faulty;
  /// Commands with parts that could not be read (`.NOE`); `.*` for an unknown command. Objects of these commands that are
  /// missing may have been given there.
  std::set<std::string, std::less<>> incomplete;
  std::vector<std::filesystem::path> meshes;  ///< mesh files that stand for records
  std::vector<std::string> folders;           ///< folder of each file of the SourceMap; empty: the working directory
};

/// Changes to the deck from the command line.
struct Overrides {
  Definitions definitions;         ///< replace texts of the deck's own ABRE; a name that the deck does not define is an error
  std::vector<std::string> cards;  ///< replace the deck's cards of these names: `.SUB TF 1 H 0.1`
};

/// Reads a deck and all files it includes. All faults go to `diagnostics`; never throws on bad input. Faults in `overrides` are
/// located in texts named after the options, `-D` and `--card`.
Deck read_file(const std::filesystem::path& path, const Catalogue& catalogue, SourceMap& sources, Diagnostics& diagnostics,
               const Overrides& overrides = {});

/// The same for a text in memory called `name`; INPUT is relative to the working directory.
Deck read_text(std::string name, std::string text, const Catalogue& catalogue, SourceMap& sources, Diagnostics& diagnostics);

/// Writes the deck record by record in a uniform spelling. Default values follow in a comment, so that reading the text yields
/// the same records, including which keywords were given.
std::string canonical_text(const Deck& deck);

/// One record as a JSON object with its defaults, for the results file: {"id": 1, "type": "GEAR", "Z": [50, 10], …}.
std::string record_json(const Record& record);

}  // namespace engrane::deck

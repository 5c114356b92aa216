// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "model/model.hpp"

namespace engrane::app {

/// A deck as read, with its diagnostics and the model it describes. The records are kept, because elements do not store their
/// texts.
struct Reading {
  SourceMap sources;
  Diagnostics diagnostics;
  deck::Deck deck;
  Model model;
  std::size_t wanted = 0;  ///< number of checks from `--result`, last in model.commands.checks; these only ask for a value

  /// A sentence about defaults used because the deck does not specify the analysis or its stepping; empty if it does.
  std::string assumptions() const;
  bool good() const { return !diagnostics.has_errors(); }
  /// Whether the analysis is linear statics, the default when no card asks for an analysis: a single solution, which no other
  /// run can continue.
  bool is_one_solution() const;
  /// Frees the records of nodes and cells, and clears the record of each part of the model. They are needed only to build the
  /// model and to create the results file.
  void forget_mesh();
};

/// Additions to a deck from the command line.
struct Wishes {
  deck::Overrides overrides;         ///< `-D NAME=VALUE` and `--card ".SUB TF 1 H 0.1"`
  std::vector<std::string> results;  ///< `--result "ELEMENT 3 NORMAL_FORCE MAX"`: beginnings of .CHK records
};

/// Reads a deck and builds its model. All errors are in `diagnostics`.
Reading read_deck(const std::string& path, const Wishes& wishes = {});

}  // namespace engrane::app

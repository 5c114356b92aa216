// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "model/model.hpp"

namespace engrane::app {

/// A deck that was read and found good, with the model it describes. The records stay: elements keep no texts of their own.
struct Reading {
  SourceMap sources;
  Diagnostics diagnostics;
  deck::Deck deck;
  Model model;
  std::size_t wanted = 0;  ///< the last of model.commands.checks only ask for a number: what `--result` names

  /// A sentence about what holds because the deck says nothing of it; empty when it says all.
  std::string assumptions() const;
  bool good() const { return !diagnostics.has_errors(); }
  /// Linear statics, which no card asks for: it is over once it is solved, and no other run continues it.
  bool is_one_solution() const;
  /// Forgets the records of nodes and cells, and which record each part of the model is from: only building the model and the
  /// results file ask for them.
  void forget_mesh();
};

/// What the command line has to say about a deck.
struct Wishes {
  deck::Overrides overrides;         ///< `-D NAME=VALUE` and `--card ".SUB TF 1 H 0.1"`
  std::vector<std::string> results;  ///< `--result "ELEMENT 3 NORMAL_FORCE MAX"`: the beginnings of records of .CHK
};

/// Reads a deck and builds its model. Everything wrong is in `diagnostics`.
Reading read_deck(const std::string& path, const Wishes& wishes = {});

}  // namespace engrane::app

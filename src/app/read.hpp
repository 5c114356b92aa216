// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "model/model.hpp"

namespace engrane::app {

/// A deck that was read and found good, with the model it describes. The records stay: elements keep no texts of their own.
struct Reading {
  SourceMap sources;
  Diagnostics diagnostics;
  deck::Deck deck;
  Model model;

  bool good() const { return !diagnostics.has_errors(); }
};

/// Reads a deck and builds its model. Everything wrong is in `diagnostics`.
Reading read_deck(const std::string& path);

}  // namespace engrane::app

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "deck/read/reader.hpp"
#include "elements/suite.hpp"
#include "model/model.hpp"

namespace engrane::suite {

/// The model of a deck without faults.
struct DeckModel {
  explicit DeckModel(const std::string& text) {
    Diagnostics diagnostics;
    SourceMap sources;
    deck = deck::read_text("test", text, catalogue(element_types()), sources, diagnostics);
    model = build_model(deck, element_types(), diagnostics);
    for (const Diagnostic& d : diagnostics.all()) ADD_FAILURE() << d.message;
  }
  NodeMap nodes() const {
    NodeMap places;
    for (const auto& node : model.nodes) places[node.id] = node.x;
    return places;
  }
  deck::Deck deck;
  Model model;
};

}  // namespace engrane::suite

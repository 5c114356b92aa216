// SPDX-License-Identifier: BSD-3-Clause
// Gear pairs built from the text of a deck.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "deck/read/reader.hpp"
#include "elements/gears/gear_pair.hpp"
#include "model/model.hpp"

namespace engrane::gear_deck {

using namespace elements::gears;

/// The model of `.NOE` nodes and `.MCE` elements.
struct Deck {
  deck::Catalogue cards = catalogue(element_types());
  SourceMap sources;
  Diagnostics diagnostics;
  deck::Deck records;  // the elements' functions look at them while the model is built
  Model model;

  Deck(const std::string& nodes, const std::string& elements) {
    records = deck::read_text("test", ".NOE\n" + nodes + "\n.MCE\n" + elements + "\n.SAM TYPE STATIC\n.FIN 1\n", cards, sources,
                              diagnostics);
    model = build_model(records, element_types(), diagnostics);
  }

  /// The pair of a number; a failure, with what is wrong, when it was not built.
  const GearPair& pair(int id) const {
    for (const Model::Part& part : model.parts)
      if (part.element->id() == id) return dynamic_cast<const GearPair&>(*part.element);
    std::string why;
    for (const Diagnostic& d : diagnostics.all()) why += d.message + "; " + d.hint + "\n";
    throw std::runtime_error("no pair " + std::to_string(id) + "\n" + why);
  }
  Vec3 node(int id) const { return model.nodes[static_cast<std::size_t>(model.node_index(id))].x; }
  bool warned(const std::string& words) const {
    for (const Diagnostic& d : diagnostics.all())
      if (d.severity == Severity::warning && d.message.find(words) != std::string::npos) return true;
    return false;
  }
};

}  // namespace engrane::gear_deck

// SPDX-License-Identifier: BSD-3-Clause
// Reads decks from texts and gives the messages as they would be printed.
#pragma once

#include <sstream>
#include <string>

#include "fake_elements.hpp"

namespace engrane::deck {

struct ReadDeck {
  Deck deck;
  SourceMap sources;
  Diagnostics diagnostics;

  std::string messages() const {
    std::ostringstream out;
    diagnostics.print(out, sources);
    return out.str();
  }
  std::string json() const {
    std::string text;
    for (const Record& record : deck.records) text += record_json(record) + "\n";
    return text;
  }
  /// The struct of record `i`.
  template <class Data>
  const Data& at(std::size_t i) const {
    return *deck.records.at(i).get<Data>();
  }
};

inline ReadDeck read(const std::string& text) {
  ReadDeck result;
  result.deck = read_text("deck.dat", text, fake_catalogue(), result.sources, result.diagnostics);
  return result;
}

/// The message of the only diagnostic, without its place.
inline std::string only_message(const std::string& text) {
  const ReadDeck result = read(text);
  if (result.diagnostics.all().size() != 1) return result.messages();
  return result.diagnostics.all().front().message;
}

inline std::string only_hint(const std::string& text) {
  const ReadDeck result = read(text);
  return result.diagnostics.all().size() == 1 ? result.diagnostics.all().front().hint : result.messages();
}

}  // namespace engrane::deck

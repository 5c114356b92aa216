// SPDX-License-Identifier: BSD-3-Clause
// Cards that stand for several records of others.
#pragma once

#include <any>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "model/model.hpp"

namespace engrane {

/// A record of a short form while the records that it stands for are written in its place.
class ShortForm {
 public:
  /// The next numbers that no record of the deck has.
  struct FreeNumbers {
    int node = 1, profile = 1;
  };

  ShortForm(const deck::Record& of, const deck::Deck& deck, const deck::Catalogue& cards, const NodePositions& places,
            FreeNumbers& free, std::vector<deck::Record>& made, Diagnostics& faults)
      : record(of), nodes(places), diagnostics(faults), deck_(deck), cards_(cards), free_(free), made_(made) {}

  const deck::Record& record;
  const NodePositions& nodes;  ///< of the deck, in the reference configuration
  Diagnostics& diagnostics;

  const std::vector<deck::Record>& records() const { return deck_.records; }
  /// Adds a record of a card, `.NOE` or `BEAM`. Keywords that both cards have keep their places in the deck.
  void add(std::string_view card, int id, std::any data);
  int new_node() { return free_.node++; }
  int new_profile() { return free_.profile++; }
  /// Whether elements may have the numbers from that of the record on; else with an error.
  bool has_numbers(int count) const;
  void error(std::string_view keyword, std::string message, std::string hint = {}) const {
    diagnostics.error(record.where(keyword), std::move(message), std::move(hint));
  }

 private:
  const deck::Deck& deck_;
  const deck::Catalogue& cards_;
  FreeNumbers& free_;
  std::vector<deck::Record>& made_;
};

/// The deck with the records that its short forms stand for in their places; nullptr where it has none. `nodes` get those that
/// short forms name: what is written out from them holds only where they are.
std::shared_ptr<const deck::Deck> write_out(const deck::Deck& deck, const std::vector<ElementType>& types, std::set<int>& nodes,
                                            Diagnostics& diagnostics);

/// Ties a card to the function that writes it out: the body of `x_type()` of a short form.
template <class Data>
ElementType short_form(const deck::Card<Data>& card, void (*expand)(const Data&, ShortForm&)) {
  ElementType type{card.schema(), nullptr, 0, nullptr, nullptr};
  type.expand = [expand](ShortForm& form) { expand(*form.record.get<Data>(), form); };
  return type;
}

/// Lets the card of an element be a short form where `applies` says so.
template <class Data>
void short_where(ElementType& type, bool (*applies)(const Data&), void (*expand)(const Data&, ShortForm&)) {
  type.is_short = [applies](const deck::Record& record) { return applies(*record.get<Data>()); };
  type.expand = [expand](ShortForm& form) { expand(*form.record.get<Data>(), form); };
}

}  // namespace engrane

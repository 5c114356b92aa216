// SPDX-License-Identifier: BSD-3-Clause
// Cards that expand to several records of other cards.
#pragma once

#include <any>
#include <array>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "model/model.hpp"

namespace engrane {

/// Whether the nodes that a record names exist; if not, reports errors. All of them are added to `named`.
bool has_nodes_named(const deck::Record& record, const NodePositions& nodes, Diagnostics& diagnostics,
                     std::set<int>* named = nullptr);

/// A node made by a short form: where it stands between two nodes of the deck, as a fraction of the way. Temperatures in between
/// are interpolated.
struct MadeNode {
  int id;
  std::array<int, 2> between;
  double part;
  Location location;  ///< of the short form
};

/// A record of a short form during its expansion.
class ShortForm {
 public:
  /// The lowest numbers above all those used in the deck.
  struct FreeNumbers {
    int node = 1, profile = 1;
  };

  ShortForm(const deck::Record& of, const deck::Deck& deck, const deck::Catalogue& cards, const NodePositions& places,
            FreeNumbers& free, std::vector<deck::Record>& made, std::vector<MadeNode>& made_nodes, Diagnostics& faults)
      : record(of),
        nodes(places),
        diagnostics(faults),
        deck_(deck),
        cards_(cards),
        free_(free),
        made_(made),
        made_nodes_(made_nodes) {}

  const deck::Record& record;
  const NodePositions& nodes;  ///< of the deck, in the reference configuration
  Diagnostics& diagnostics;

  const std::vector<deck::Record>& records() const { return deck_.records; }
  /// Adds a record of a card, such as `.NOE` or `BEAM`. Keywords that both cards have keep their locations in the deck.
  void add(std::string_view card, int id, std::any data);
  /// Adds a node at `place`, which stands where MadeNode says; returns its number.
  int add_node(const Vec3& place, std::array<int, 2> between, double part);
  int new_profile() { return free_.profile++; }
  /// Whether `count` element numbers from that of the record on are free; otherwise reports an error.
  bool has_numbers(int count) const;
  void error(std::string_view keyword, std::string message, std::string hint = {}) const {
    diagnostics.error(record.where(keyword), std::move(message), std::move(hint));
  }

 private:
  const deck::Deck& deck_;
  const deck::Catalogue& cards_;
  FreeNumbers& free_;
  std::vector<deck::Record>& made_;
  std::vector<MadeNode>& made_nodes_;
};

/// A deck with its short forms expanded in place.
struct WrittenOut {
  std::shared_ptr<const deck::Deck> deck;  ///< nullptr if the deck has no short forms
  std::set<int> named;                     ///< nodes that short forms name; the expansion depends on their positions
  std::vector<MadeNode> made;
};
WrittenOut write_out(const deck::Deck& deck, const std::vector<ElementType>& types, Diagnostics& diagnostics);

/// Connects a card with the function that expands it: the body of `x_type()` of a short form.
template <class Data>
ElementType short_form(const deck::Card<Data>& card, void (*expand)(const Data&, ShortForm&)) {
  ElementType type{card.schema(), nullptr, 0, nullptr, nullptr};
  type.expand = [expand](ShortForm& form) { expand(*form.record.get<Data>(), form); };
  return type;
}

/// Makes the card of an element a short form where `applies` is true.
template <class Data>
void short_where(ElementType& type, bool (*applies)(const Data&), void (*expand)(const Data&, ShortForm&)) {
  type.is_short = [applies](const deck::Record& record) { return applies(*record.get<Data>()); };
  type.expand = [expand](ShortForm& form) { expand(*form.record.get<Data>(), form); };
}

}  // namespace engrane

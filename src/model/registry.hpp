// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <typeindex>
#include <utility>
#include <vector>

#include "deck/cards/cards.hpp"
#include "deck/schema/card.hpp"
#include "model/block.hpp"
#include "model/element.hpp"
#include "model/function.hpp"
#include "model/node_positions.hpp"
#include "model/temperatures.hpp"

namespace engrane {

/// What elements find out about all of their kind, such as the trains that gear pairs make: found once while a model is built
/// and shared by all of them.
class BuildNotes {
 public:
  /// The note of a type; `make` gives it to whoever asks first.
  template <class Note, class Make>
  const Note& get(const Make& make) {
    std::shared_ptr<void>& note = notes_[typeid(Note)];
    if (!note) note = std::make_shared<Note>(make());
    return *static_cast<const Note*>(note.get());
  }

 private:
  std::map<std::type_index, std::shared_ptr<void>> notes_;
};

/// What an element may look up while it is built from its record. Faults of the deck go to `diagnostics`, at the
/// location of the keyword that is wrong (`record.where("MN")`); an element that cannot be built is nullptr.
struct BuildContext {
  const NodePositions& nodes;  ///< in the reference configuration; the ground, node 0, is at the origin
  const std::map<int, std::unique_ptr<Function>>& functions;
  Diagnostics& diagnostics;
  const deck::Record& record;
  /// Moment of inertia that the elements of the deck give to a node about a unit axis; 0 when none does.
  std::function<double(int node, const Vec3& axis)> wheel_inertia;
  /// All records of the deck, for elements that depend on others of their kind; nullptr: this one stands alone.
  const std::vector<deck::Record>* records = nullptr;
  /// An element of `.MCE` by its number, for elements of stage 1. No record: there is none of that number.
  struct Found {
    const deck::Record* record = nullptr;
    const Element* element = nullptr;  ///< those of stage 0
    bool faulty = false;               ///< of stage 0, and could not be built
  };
  std::function<Found(int id)> find_element = nullptr;
  /// Where elements of a kind meet in blocks; nullptr: each is alone in its own.
  BlockStore* blocks = nullptr;
  BuildNotes* notes = nullptr;  ///< of this model; nullptr: everyone finds out alone
  /// Of the element: that of its record or, where the card has none, one after those of all others.
  int number = 0;
  std::set<const Function*>* of_time = nullptr;  ///< functions of time that elements use; nullptr: nobody asks
  const Temperatures* temperatures = nullptr;    ///< of nodes (`.CLM TEMP`); nullptr: there are none
  /// What a record makes beyond the element that it gives back: of one without a number numbered on from `number`, else the parts
  /// of the one element, which have its number.
  std::vector<std::unique_ptr<Element>>* more = nullptr;
  /// Node ids of a target of this record, ascending, each once; what does not exist is reported. No function: there are no
  /// groups.
  std::function<std::vector<int>(const deck::NodeTarget&)> nodes_of = nullptr;

  /// The function a keyword names, or nullptr with an error when it does not exist.
  const Function* function(int id, std::string_view keyword) const;
  /// The same of a function of time: steps that follow their error end at its corners.
  const Function* function_of_time(int id, std::string_view keyword) const;
  void error(std::string_view keyword, std::string message, std::string hint = {}) const {
    diagnostics.error(record.where(keyword), std::move(message), std::move(hint));
  }
};

/// A node that an element puts where it needs it, before anything else looks at the nodes.
struct NodePlacement {
  int node = 0;
  int from = 0;  ///< the node from which its place was found
  Vec3 x = Vec3::Zero();
};

class ShortForm;

/// An element of the deck language: its card and how to build it.
struct ElementType {
  deck::Schema schema;
  std::function<std::unique_ptr<Element>(BuildContext&)> build;
  int stage = 0;  ///< elements of stage 1 are built last and may ask what the others give (`wheel_inertia`)
  /// May place a node. Faults that hinder it are left to `build`: diagnostics of this call are thrown away.
  std::function<std::optional<NodePlacement>(const BuildContext&)> place = nullptr;
  /// Of a short form: puts the records that stand for the card's; such a card is never built.
  std::function<void(ShortForm&)> expand = nullptr;
  /// Of a card that is a short form with some keywords only: whether this record is. None: always.
  std::function<bool(const deck::Record&)> is_short = nullptr;
};

/// All elements, in the order of the manual; written by CMake's add_element().
const std::vector<ElementType>& element_types();

/// Ties a card to the function that builds its element: the body of every `x_type()`.
template <class Data>
ElementType element_type(const deck::Card<Data>& card, std::unique_ptr<Element> (*build)(const Data&, BuildContext&),
                         int stage = 0, std::optional<NodePlacement> (*place)(const Data&, const BuildContext&) = nullptr) {
  ElementType type{card.schema(), [build](BuildContext& context) { return build(*context.record.get<Data>(), context); }, stage,
                   nullptr};
  if (place) type.place = [place](const BuildContext& context) { return place(*context.record.get<Data>(), context); };
  return type;
}

}  // namespace engrane

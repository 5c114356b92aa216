// SPDX-License-Identifier: BSD-3-Clause
// What reading a deck and building its model costs: memory and allocations, counted, per record and at two sizes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <functional>
#include <new>
#include <string>

#include "deck/read/reader.hpp"
#include "model/model.hpp"

namespace {

struct Counters {
  std::size_t allocations = 0;
  std::size_t bytes = 0;  ///< in use
  std::size_t peak = 0;
};
Counters counters;

/// In front of every block: its size. As large as any alignment that plain new gives.
constexpr std::size_t header = alignof(std::max_align_t);
static_assert(header >= sizeof(std::size_t));

void release(void* block) noexcept {
  if (!block) return;
  void* const start = static_cast<char*>(block) - header;
  counters.bytes -= *static_cast<std::size_t*>(start);
  std::free(start);
}

}  // namespace

void* operator new(std::size_t size) {
  void* const start = std::malloc(size + header);
  if (!start) throw std::bad_alloc();
  *static_cast<std::size_t*>(start) = size;
  ++counters.allocations;
  counters.bytes += size;
  counters.peak = std::max(counters.peak, counters.bytes);
  return static_cast<char*>(start) + header;
}
// the sanitizers have one of their own, which would not count
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  try {
    return operator new(size);
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}
void operator delete(void* block) noexcept { release(block); }
void operator delete(void* block, const std::nothrow_t&) noexcept { release(block); }
void operator delete(void* block, std::size_t) noexcept { release(block); }

namespace engrane {
namespace {

struct Cost {
  double allocations = 0;
  double peak = 0;  ///< bytes
};

Cost cost_of(const std::string& text) {
  static const deck::Catalogue cards = catalogue(element_types());
  const Counters before = counters;
  counters.peak = counters.bytes;
  SourceMap sources;
  Diagnostics diagnostics;
  const deck::Deck deck = deck::read_text("test", std::string(text), cards, sources, diagnostics);
  const Model model = build_model(deck, element_types(), diagnostics);
  EXPECT_FALSE(diagnostics.has_errors());
  return {static_cast<double>(counters.allocations - before.allocations), static_cast<double>(counters.peak - before.bytes)};
}

/// What one record more costs, between two sizes of a deck.
struct Scaling {
  Cost small, large;  ///< per record
};

Scaling scaling_of(const std::function<std::string(int)>& deck) {
  constexpr int few = 1000, many = 8000;
  cost_of(deck(few));  // what is made once is made here
  const Cost a = cost_of(deck(few)), b = cost_of(deck(many));
  return {{a.allocations / few, a.peak / few}, {b.allocations / many, b.peak / many}};
}

void expect_linear(const Scaling& scaling) {
  EXPECT_LT(scaling.large.allocations, 1.1 * scaling.small.allocations);
  EXPECT_LT(scaling.large.peak, 1.3 * scaling.small.peak);  // vectors grow by doubling
}

std::string nodes(int count) {
  std::string text = ".NOE\n";
  for (int i = 1; i <= count; ++i) text += " I " + std::to_string(i) + " X " + std::to_string(i) + " Y 0.25 Z 0\n";
  return text;
}

TEST(DeckCost, Nodes) {
  const Scaling scaling = scaling_of(nodes);
  expect_linear(scaling);
  EXPECT_LT(scaling.large.peak, 300);
  EXPECT_LT(scaling.large.allocations, 4);
  RecordProperty("bytes", static_cast<int>(scaling.large.peak));
}

TEST(DeckCost, RowsOfNodes) {
  const Scaling scaling = scaling_of([](int count) {
    std::string text = ".NOE\n";
    for (int i = 1; i <= count; ++i) text += std::to_string(i) + " " + std::to_string(i) + ". 0.25 0.\n";
    return text;
  });
  expect_linear(scaling);
  EXPECT_LT(scaling.large.peak, 250);
}

TEST(DeckCost, FixedNodes) {
  expect_linear(scaling_of([](int count) {
    std::string text = nodes(count) + ".CLM\n";
    for (int i = 1; i <= count; ++i) text += " FIX NOEUD " + std::to_string(i) + " C 1 2 3\n";
    return text;
  }));
}

TEST(DeckCost, Springs) {
  const Scaling scaling = scaling_of([](int count) {
    std::string text = nodes(count + 1) + ".MCE\n";
    for (int i = 1; i <= count; ++i)
      text += " I " + std::to_string(i) + " SPRING N " + std::to_string(i) + " " + std::to_string(i + 1) + " K 1000 C 1\n";
    return text;
  });
  expect_linear(scaling);
  RecordProperty("bytes", static_cast<int>(scaling.large.peak));
}

/// Each group unites the one before it with a node: the last has all nodes, and together they would have their square.
TEST(DeckCost, NestedGroups) {
  expect_linear(scaling_of([](int count) {
    std::string text = nodes(count) + ".SEL\n GROUP 1 NOEUDS 1\n";
    for (int i = 2; i <= count; ++i)
      text += " GROUP " + std::to_string(i) + " UNION " + std::to_string(i - 1) + " NOEUDS " + std::to_string(i) + "\n";
    return text + ".CLM\n FIX GROUP " + std::to_string(count) + " C 1 2 3\n";
  }));
}

TEST(DeckCost, LoadsOnListedNodes) {
  expect_linear(
      scaling_of([](int count) { return nodes(count) + ".CLM\n CHA NOEUD 1 A " + std::to_string(count) + " C 1 V 2\n"; }));
}

}  // namespace
}  // namespace engrane

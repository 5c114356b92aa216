// SPDX-License-Identifier: BSD-3-Clause
// Every deck of the project, the wrong ones too, is read and its elements evaluated once: under the sanitizers this looks into
// all corners of the reader, the builder and the elements.
#include <gtest/gtest.h>

#include <filesystem>

#include "deck/read/reader.hpp"
#include "model/element_at_rest.hpp"
#include "model/registry.hpp"

namespace engrane {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> decks_under(const fs::path& folder) {
  std::vector<fs::path> all;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.path().extension() == ".dat") all.push_back(entry.path());
  std::sort(all.begin(), all.end());
  return all;
}

/// Residual, tangent, energies and output of every element in the reference configuration; returns how many there are.
int evaluate_elements(const Model& model) {
  int count = 0;
  for (const Model::Part& part : model.parts) {
    const Layout& layout = part.element->layout();
    ElementAtRest rest(model, part);
    rest.multipliers.assign(rest.multipliers.size(), 1.0);
    const State state = rest.view();
    const auto n = static_cast<std::size_t>(layout.slots());
    std::vector<double> r(n), k(n * n), values(part.element->channels().size());
    std::vector<Switch> switches(layout.switches.size());
    part.element->residual(state, r);
    part.element->tangent(state, {1, 10, 100}, r, k);
    (void)part.element->energies(state);
    part.element->observe(state, values);
    part.element->switches(state, switches);
    ++count;
  }
  return count;
}

struct Outcome {
  bool good = false;
  int elements = 0;
};

Outcome read(const fs::path& file) {
  static const deck::Catalogue cards = catalogue(element_types());
  SourceMap sources;
  Diagnostics diagnostics;
  const deck::Deck deck = deck::read_file(file, cards, sources, diagnostics);
  const Model model = build_model(deck, element_types(), diagnostics);
  if (diagnostics.has_errors()) return {};
  return {true, evaluate_elements(model)};
}

TEST(AllDecks, AreReadAndTheirElementsAnswer) {
  int elements = 0, built = 0;
  for (const fs::path& file : decks_under(fs::path(ENGRANE_SOURCE_DIR) / "decks")) {
    const Outcome outcome = read(file);
    built += outcome.good;
    elements += outcome.elements;
  }
  EXPECT_GT(built, 100);  // parts of others, and decks whose user library is not at hand, are not built
  EXPECT_GT(elements, 500);
}

TEST(AllDecks, WrongOnesEndInMessages) {
  int wrong = 0;
  for (const char* folder : {"deck", "model"})
    for (const fs::path& file : decks_under(fs::path(ENGRANE_SOURCE_DIR) / "tests/errors" / folder)) wrong += !read(file).good;
  EXPECT_GT(wrong, 80);
}

}  // namespace
}  // namespace engrane

// SPDX-License-Identifier: BSD-3-Clause
// libFuzzer target: the reader survives any bytes, and the canonical text of a good deck reads back as the same deck.
//
//   clang++ -std=c++20 -g -O1 -fsanitize=fuzzer,address,undefined -Isrc \
//     tests/fuzz/deck_fuzz.cpp src/base/*.cpp src/deck/*.cpp src/math/expression.cpp -o deck_fuzz
//   mkdir empty && cd empty && ../deck_fuzz -max_len=4096 <a copy of tests/fuzz/corpus>
//
// Run it in an empty folder: INPUT then finds no file.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <string>

#include "../unit/fake_elements.hpp"
#include "deck/manual/manual.hpp"
#include "deck/read/reader.hpp"

namespace {

std::string records_json(const engrane::deck::Deck& deck) {
  std::string text;
  for (const engrane::deck::Record& record : deck.records) text += engrane::deck::record_json(record) + "\n";
  return text;
}

[[noreturn]] void fail(const char* what, const std::string& first, const std::string& second) {
  std::fprintf(stderr, "%s\n--- first\n%s\n--- second\n%s\n", what, first.c_str(), second.c_str());
  std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace engrane;
  const deck::Catalogue& catalogue = deck::fake_catalogue();
  SourceMap sources;
  Diagnostics diagnostics;
  const std::string text(reinterpret_cast<const char*>(data), size);
  const deck::Deck read = deck::read_text("fuzz.dat", text, catalogue, sources, diagnostics);
  std::ostringstream messages;
  diagnostics.print(messages, sources);
  if (diagnostics.has_errors()) return 0;

  const std::string canonical = deck::canonical_text(read);
  SourceMap sources_again;
  Diagnostics again;
  const deck::Deck reread = deck::read_text("canonical.dat", canonical, catalogue, sources_again, again);
  std::ostringstream complaints;
  again.print(complaints, sources_again);
  if (again.has_errors()) fail("the canonical text does not read", canonical, complaints.str());
  if (deck::canonical_text(reread) != canonical)
    fail("the canonical text is not stable", canonical, deck::canonical_text(reread));
  if (records_json(reread) != records_json(read)) fail("the records differ", records_json(read), records_json(reread));
  return 0;
}

// SPDX-License-Identifier: BSD-3-Clause
#include "app/agreement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <utility>
#include <vector>

#include "assembly/petsc.hpp"
#include "base/foreign.hpp"
#include "base/text.hpp"

namespace engrane::app {

namespace {

constexpr const char* advice_on_ranks = "Every rank reads the deck: keep it on a file system that all nodes see";

/// The first error of a deck, with its position, on one line.
std::string first_error(const Reading& reading) {
  for (const Diagnostic& d : reading.diagnostics.all()) {
    if (d.severity != Severity::error) continue;
    if (!d.location.known()) return d.message;
    const int file = d.location.file;
    return fmt::format("{}:{}: {}", reading.sources.path(file), d.location.line,
                       reading.sources.foreign(file) ? without_quotes(d.message) : d.message);
  }
  return {};
}

/// "rank 3", or "rank 3 and 2 others".
std::string name_of_ranks(int first, int count) {
  std::string name = fmt::format("rank {}", first);
  if (count > 1) name += " and " + counted(static_cast<std::size_t>(count - 1), "other");
  return name;
}

}  // namespace

void ContentHash::mix(std::string_view bytes) {
  for (const char byte : bytes) value_ = (value_ ^ static_cast<unsigned char>(byte)) * 0x100000001b3;
}

void ContentHash::add(std::string_view text) {
  mix(text);
  mix(std::to_string(text.size()) + ";");
}

void ContentHash::add_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::vector<char> part(1 << 16);
  std::size_t size = 0;
  while (file) {
    file.read(part.data(), static_cast<std::streamsize>(part.size()));
    const auto read = static_cast<std::size_t>(file.gcount());
    mix({part.data(), read});
    size += read;
  }
  mix(std::to_string(size) + ";");
}

Agreement agree(Account own, MPI_Comm comm) {
  int ranks = 1;
  MPI_Comm_size(comm, &ranks);
  std::vector<std::array<std::uint64_t, 2>> all(static_cast<std::size_t>(ranks));
  const std::array<std::uint64_t, 2> mine{own.trouble.empty() ? 0U : 1U, own.contents};
  MPI_Allgather(mine.data(), 2, MPI_UINT64_T, all.data(), 2, MPI_UINT64_T, comm);
  const auto failed = [](const auto& account) { return account[0] != 0; };
  const auto different = [&](const auto& account) { return account[1] != all.front()[1]; };
  Agreement result;
  result.first_failed = failed(all.front());
  result.failed = static_cast<int>(std::count_if(all.begin(), all.end(), failed));
  if (result.failed > 0)
    result.rank = static_cast<int>(std::find_if(all.begin(), all.end(), failed) - all.begin());
  else if (result.different = static_cast<int>(std::count_if(all.begin(), all.end(), different)); result.different > 0)
    result.rank = static_cast<int>(std::find_if(all.begin(), all.end(), different) - all.begin());
  if (result.failed > 0) result.trouble = text_of_rank(result.rank, std::move(own.trouble), comm);
  return result;
}

std::string deck_disagreement(const std::string& path, const Reading& reading, MPI_Comm comm, bool& agreed) {
  agreed = reading.good();
  int ranks = 1;
  MPI_Comm_size(comm, &ranks);
  if (ranks == 1) return {};
  Account own;
  if (!reading.good()) own.trouble = first_error(reading);
  ContentHash hash;
  for (int file = 0; file < reading.sources.size(); ++file) hash.add(reading.sources.text(file));
  for (const auto& mesh : reading.deck.meshes) hash.add_file(mesh.string());
  own.contents = hash.value();
  const Agreement agreement = agree(std::move(own), comm);
  agreed = agreement.reached();
  if (agreed || agreement.first_failed) return {};
  if (agreement.failed > 0)
    return fmt::format("{} cannot read the deck: {}. {}", name_of_ranks(agreement.rank, agreement.failed), agreement.trouble,
                       advice_on_ranks);
  return fmt::format("{} {} another deck {} than rank 0, or other files that it names. {}",
                     name_of_ranks(agreement.rank, agreement.different), agreement.different > 1 ? "read" : "reads", path,
                     advice_on_ranks);
}

}  // namespace engrane::app

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <petscsys.h>

#include <cstdint>
#include <string>
#include <string_view>

#include "app/read.hpp"

namespace engrane::app {

/// Hash of texts and files, to tell whether ranks have read the same: FNV-1a with 64 bits (Fowler, Noll, Vo, Eastlake and
/// Hansen, The FNV Non-Cryptographic Hash Algorithm, RFC 9923).
class ContentHash {
 public:
  /// Adds a text with its size, so that a text is not mistaken for the end of another.
  void add(std::string_view text);
  /// Adds the contents of a file. One that cannot be read counts as empty.
  void add_file(const std::string& path);
  std::uint64_t value() const { return value_; }

 private:
  void mix(std::string_view bytes);
  std::uint64_t value_ = 0xcbf29ce484222325;
};

/// Outcome of reading on one rank.
struct Account {
  std::string trouble;         ///< why it failed, one line; empty if it did not
  std::uint64_t contents = 0;  ///< hash of what was read
};

/// Whether all ranks read the same, and if not, which ranks are the odd ones. The same on all ranks.
struct Agreement {
  bool first_failed = false;  ///< rank 0 failed
  int failed = 0;             ///< number of ranks that failed
  int different = 0;          ///< number of ranks that read something else than rank 0; 0 if any rank failed
  int rank = -1;              ///< the lowest rank that failed or, if none did, that differs; -1 if all agree
  std::string trouble;        ///< of that rank

  bool reached() const { return rank < 0; }
};

/// Compares the accounts of all ranks. Collective: a rank that stops by itself would leave the others waiting.
Agreement agree(Account own, MPI_Comm comm);

/// Says why the ranks cannot go on with a deck that rank 0 could read; empty if they can, or if rank 0 has errors of its own to
/// show. `agreed`: whether all ranks read the same deck without errors. Collective.
std::string deck_disagreement(const std::string& path, const Reading& reading, MPI_Comm comm, bool& agreed);

}  // namespace engrane::app

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "user/library.hpp"

namespace engrane::user {

/// What a routine is used as; the numbers of engrane_user.h.
enum class Kind : int { function = ENGRANE_FUNCTION, force = ENGRANE_FORCE, mesh = ENGRANE_MESH, friction = ENGRANE_FRICTION };

inline constexpr std::size_t most_arguments = 3, most_results = 4;
using Arguments = std::array<double, most_arguments>;  ///< those a kind does not have are zero
using Results = std::array<double, most_results>;      ///< in the order of engrane_user.h

/// A routine of a library with its parameters, before it is known what it is used as.
struct Source {
  std::shared_ptr<const Library> library;
  std::string name;
  engrane_routine* address = nullptr;
  std::vector<double> parameters;
  std::vector<double> scale;  ///< of the arguments, as the deck gives it; those missing are chosen by who uses it

  std::string label() const { return name + " of " + library->file(); }
};

struct Signature;  ///< arguments and results of a kind

/// A routine used as one kind. It answers with the value and all derivatives: those the routine leaves alone come from central
/// differences, of fourth order over ±2e-3 of the scale where derivatives are part of the answer (functions, the course of a
/// mesh), of second order over 1e-5 of the scale or of the argument where only iterations use them.
class Routine {
 public:
  /// `scale`: over how much each argument changes before the result does so by as much as itself; positive.
  Routine(std::shared_ptr<const Source> source, Kind kind, Arguments scale);

  /// Value and derivatives; none of them a number when the routine fails or answers with anything not finite. Why is then what
  /// last_failure() says. Safe from several threads if the routine is.
  Results at(const Arguments& x) const noexcept;

  /// Tries the routine at `samples`, the first of which it must answer: is it of this kind, does it give a value that depends
  /// on nothing but its arguments, and are its derivatives those of its value?
  Fault check(const std::vector<Arguments>& samples) const;

  /// Does the routine itself give result `i`?
  bool gives(std::size_t i, const Arguments& x) const;
  const Source& source() const { return *source_; }
  const Arguments& scale() const { return scale_; }

 private:
  int call(const Arguments& x, Results& y) const noexcept;
  bool complete(const Arguments& x, Results& y) const noexcept;
  Fault check_derivatives(const Arguments& x, const Results& y) const;

  std::shared_ptr<const Source> source_;
  Kind kind_;
  const Signature* signature_;
  Arguments scale_;
};

/// What the user calls a kind ("force law") and its arguments.
std::string describe(Kind kind);

/// What the last failing call of this process complained of; empty when none did since forget_failures().
std::string last_failure();
void forget_failures();

}  // namespace engrane::user

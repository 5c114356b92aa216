// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "user/library.hpp"

namespace engrane::user {

/// What a routine computes; values of engrane_user.h.
enum class Kind : int { function = ENGRANE_FUNCTION, force = ENGRANE_FORCE, mesh = ENGRANE_MESH, friction = ENGRANE_FRICTION };

inline constexpr std::size_t most_arguments = 3, most_results = 4;
using Arguments = std::array<double, most_arguments>;  ///< those a kind does not use are zero
using Results = std::array<double, most_results>;      ///< in the order of engrane_user.h

/// A routine of a library with its parameters, not yet bound to a kind.
struct Source {
  std::shared_ptr<const Library> library;
  std::string name;
  engrane_routine* address = nullptr;
  std::vector<double> parameters;
  std::vector<double> scale;  ///< of the arguments, as given in the deck; missing ones are chosen by the caller

  std::string label() const { return name + " of " + library->file(); }
};

struct Signature;  ///< names of the arguments and results of a kind

/// A routine bound to one kind. It returns the value and all derivatives. Derivatives that the routine leaves unset come from
/// differences of five values over ±2e-3 of the scale where derivatives are part of the result (functions, mesh stiffness along
/// the pitch), and of three values with a step of 1e-5 of the scale or of the argument, whichever is larger, where only the
/// Newton iteration uses them. The values are on both sides of the argument alike, except near the end of the range that an
/// argument is promised to have, and of the one where the routine is good.
class Routine {
 public:
  /// `scale`: positive; for each argument, the change over which the result changes by as much as its own magnitude.
  Routine(std::shared_ptr<const Source> source, Kind kind, Arguments scale);

  /// Value and derivatives. All are NaN if the routine fails or returns anything not finite; last_failure() then says why.
  /// Thread-safe if the routine is.
  Results at(const Arguments& x) const noexcept;

  /// Calls the routine at `samples`, of which it must accept the first. Checks that it is of this kind, that its value depends
  /// on its arguments only, and that its derivatives agree with finite differences of its value.
  Fault check(const std::vector<Arguments>& samples) const;

  /// Whether the routine itself sets result `i`.
  bool gives(std::size_t i, const Arguments& x) const;
  const Source& source() const { return *source_; }
  const Arguments& scale() const { return scale_; }

 private:
  int call(const Arguments& x, Results& y) const noexcept;
  /// An answer that is no use: a status, or, if that is fine, a result that is missing or not finite.
  struct Refusal {
    int status = ENGRANE_FINE;
    Arguments at{};
    bool beside = false;  ///< not where the derivative is wanted
  };
  /// Finds the derivatives that the routine has left unset. Returns why they or other results are not known.
  std::optional<Refusal> complete(const Arguments& x, Results& y) const noexcept;
  /// The first derivatives of result `base`, which is `value` at x, by argument `by`: from values in steps of h, `beside` of them
  /// on either side or all of these on one.
  std::optional<Refusal> differentiate(const Arguments& x, double value, std::size_t base, std::size_t by, double h, int beside,
                                       Results& derivatives) const noexcept;
  Fault check_derivatives(const Arguments& x, const Results& y) const;

  std::shared_ptr<const Source> source_;
  Kind kind_;
  const Signature* signature_;
  Arguments scale_;
};

/// Name of a kind for messages ("force law").
std::string describe(Kind kind);

/// Message of the latest failed call in this process; empty if none has failed since forget_failures().
std::string last_failure();
void forget_failures();

}  // namespace engrane::user

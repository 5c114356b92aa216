// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "assembly/assembler.hpp"
#include "model/filled.hpp"

namespace engrane {

/// What fills the elements of this rank, and its work. With the content N, the volume V and the work L(N₀, N₁, V) of filling at
/// constant volume, the pressure being N/V, integration by parts gives the work between two instants as
///
///     L(N₀, N₁, V₁) + ∫ (N − N₀) V̇/V dt,
///
/// whose integrand is continuous at corners of the content.
class Fillings {
 public:
  using At = std::vector<Filled::Filling>;  ///< of the elements of this rank

  explicit Fillings(Assembler& assembler);
  bool any() const { return !parts_.empty(); }
  At at(const Configuration& c) const;
  /// L, element by element, with a volume of `volumes`.
  std::vector<double> works(const At& from, const At& to, const At& volumes) const;
  /// Sum of L with the geometric mean of the volumes at both ends: the integral is then of the third order of the step.
  double work(const At& from, const At& to) const;
  /// Sum of L with the volumes of `to`.
  double work_at_end(const At& from, const At& to) const;
  /// Sum of the integrands at `at`, if the interval begins at `begin`.
  static double integrand(const At& begin, const At& at);
  /// Sum of the powers.
  static double power(const At& at);

 private:
  struct Part {
    int part = 0;
    const Filled* filled = nullptr;
  };
  Assembler& assembler_;
  std::vector<Part> parts_;
};

}  // namespace engrane

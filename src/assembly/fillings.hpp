// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "assembly/assembler.hpp"
#include "model/filled.hpp"

namespace engrane {

/// √5, which the points of Lobatto quadrature and what belongs to them are made of.
inline constexpr double sqrt5 = 2.2360679774997896964;

/// What fills the elements of this rank, and its work: with g and L, the work at constant size, of each element
///
///     L(q₀, q₁, s₁) + ∫ (g(q, s) − g(q, s₁)) dq.
class Fillings {
 public:
  using At = std::vector<Filled::Filling>;  ///< of the elements of this rank

  explicit Fillings(Assembler& assembler);
  bool any() const { return !parts_.empty(); }
  At at(const Configuration& c) const;
  /// L, element by element, with the sizes of `sizes`.
  std::vector<double> works(const At& from, const At& to, const At& sizes) const;
  /// Sum of the work between two instants; its error is of the third order of the step.
  double work(const At& from, const At& to) const;
  /// Sum of the work from the first of the points of Lobatto quadrature to the point `end`, with the weights of the powers there.
  double work(const std::array<const At*, 4>& points, std::size_t end, const std::array<double, 4>& weights) const;
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

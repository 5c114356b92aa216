// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "math/expression.hpp"
#include "math/taylor.hpp"
#include "model/element.hpp"
#include "model/function.hpp"

namespace engrane::elements {

/// Switch functions at the corners of a spring or damper law, so that dynamics can end a time step there. Corners are those of
/// a table (Function::corners), in every period if it is periodic, and the points where a comparison, sign, absolute value,
/// minimum or maximum in a formula changes branch. Laws with more than twenty corners (measured curves) and user routines have
/// none.
class LawCorners {
 public:
  LawCorners() = default;
  explicit LawCorners(const Function& function);
  explicit LawCorners(const Expression& formula);
  /// Corners at `places`, repeated in each period if there is one.
  explicit LawCorners(std::vector<double> places, double period = 0);

  std::size_t count() const { return formula_ ? formula_->decisions().size() : places_.size(); }
  /// Appends the names of the switches, one per corner; `law` is the keyword used in them.
  void name(std::vector<SwitchNames>& names, const std::string& law) const;
  /// Writes the switch values for the law's variable (D in a formula) `x`, with two time derivatives. `size` is the magnitude
  /// of the terms whose difference is `x`, for the rounding error. Returns the number of switches.
  std::size_t switches(const Taylor& x, double time, double size, std::span<Switch> values) const;

 private:
  std::vector<double> places_;
  double period_ = 0;  ///< period of the corners; 0: not periodic
  const Expression* formula_ = nullptr;
};

}  // namespace engrane::elements

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

/// Where the law of a spring or damper is not smooth, as switches, for dynamics to place ends of steps there: at the corners of a
/// table (Function::corners), in each of its periods where it repeats, and where a comparison, sign, absolute value, minimum or
/// maximum of a formula decides otherwise. None of a law that has more than twenty of them: a measured curve; nor of a routine.
class LawCorners {
 public:
  LawCorners() = default;
  explicit LawCorners(const Function& function);
  explicit LawCorners(const Expression& formula);

  std::size_t count() const { return formula_ ? formula_->decisions().size() : places_.size(); }
  /// A switch for each corner; `law` is the keyword in its words.
  void name(std::vector<SwitchNames>& names, const std::string& law) const;
  /// Their values where the law's variable, or its D, is `x` with two derivatives; `size` is that of the terms which it is the
  /// difference of. Tells how many there are.
  std::size_t switches(const Taylor& x, double time, double size, std::span<Switch> values) const;

 private:
  std::vector<double> places_;
  double period_ = 0;  ///< of the places; 0: none
  const Expression* formula_ = nullptr;
};

}  // namespace engrane::elements

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "model/element.hpp"

namespace engrane {

/// An element with teeth that deform along the circumference by one of its scalars.
class ElasticTeeth {
 public:
  /// Index of that scalar; -1 if the teeth are rigid.
  virtual int tooth_deformation() const = 0;
  /// How far the flank that carries load is pressed in, a length along the circumference; 0 within the backlash.
  virtual double tooth_deflection(const State& state) const = 0;
  /// Length to which deflections are compared: the normal module, or the backlash if it is wider.
  virtual double tooth_size() const = 0;

 protected:
  ~ElasticTeeth() = default;
};

}  // namespace engrane

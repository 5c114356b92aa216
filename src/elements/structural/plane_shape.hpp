// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "model/element.hpp"

namespace engrane::elements::structural {

/// Returns `make.template operator()<S>()` for the shape S of a plane cell.
template <class Make>
auto with_plane_shape(CellShape shape, const Make& make) {
  switch (shape) {
    case CellShape::triangle:
      return make.template operator()<CellShape::triangle>();
    case CellShape::triangle6:
      return make.template operator()<CellShape::triangle6>();
    case CellShape::quadrilateral:
      return make.template operator()<CellShape::quadrilateral>();
    default:
      return make.template operator()<CellShape::quadrilateral8>();
  }
}

}  // namespace engrane::elements::structural

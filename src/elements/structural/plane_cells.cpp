// SPDX-License-Identifier: BSD-3-Clause
#include "elements/structural/cells.hpp"
#include "elements/structural/make_cell.hpp"

namespace engrane::elements::structural {

bool is_regular_plane(CellShape shape, const std::vector<Vec3>& places) {
  switch (shape) {
    case CellShape::triangle:
      return is_regular<CellShape::triangle>(places);
    case CellShape::triangle6:
      return is_regular<CellShape::triangle6>(places);
    case CellShape::quadrilateral:
      return is_regular<CellShape::quadrilateral>(places);
    default:
      return is_regular<CellShape::quadrilateral8>(places);
  }
}

std::unique_ptr<Element> make_plane_cell(const CellPlan& plan, BlockStore* blocks) {
  const bool axi = plan.section->hypothesis == materials::Hypothesis::axisymmetric;
  const auto add = [&]<CellShape S>() { return axi ? add_cell<S, true>(plan, blocks) : add_cell<S, false>(plan, blocks); };
  switch (plan.shape) {
    case CellShape::triangle:
      return add.operator()<CellShape::triangle>();
    case CellShape::triangle6:
      return add.operator()<CellShape::triangle6>();
    case CellShape::quadrilateral:
      return add.operator()<CellShape::quadrilateral>();
    default:
      return add.operator()<CellShape::quadrilateral8>();
  }
}

}  // namespace engrane::elements::structural

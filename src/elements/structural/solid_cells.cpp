// SPDX-License-Identifier: BSD-3-Clause
#include "elements/structural/cells.hpp"
#include "elements/structural/make_cell.hpp"

namespace engrane::elements::structural {

bool is_regular_solid(CellShape shape, const std::vector<Vec3>& places) {
  switch (shape) {
    case CellShape::tetrahedron:
      return is_regular<CellShape::tetrahedron>(places);
    case CellShape::tetrahedron10:
      return is_regular<CellShape::tetrahedron10>(places);
    case CellShape::wedge:
      return is_regular<CellShape::wedge>(places);
    case CellShape::wedge15:
      return is_regular<CellShape::wedge15>(places);
    case CellShape::hexahedron:
      return is_regular<CellShape::hexahedron>(places);
    default:
      return is_regular<CellShape::hexahedron20>(places);
  }
}

std::unique_ptr<Element> make_solid_cell(const CellPlan& plan, BlockStore* blocks) {
  switch (plan.shape) {
    case CellShape::tetrahedron:
      return add_cell<CellShape::tetrahedron, false>(plan, blocks);
    case CellShape::tetrahedron10:
      return add_cell<CellShape::tetrahedron10, false>(plan, blocks);
    case CellShape::wedge:
      return add_cell<CellShape::wedge, false>(plan, blocks);
    case CellShape::wedge15:
      return add_cell<CellShape::wedge15, false>(plan, blocks);
    case CellShape::hexahedron:
      return add_cell<CellShape::hexahedron, false>(plan, blocks);
    default:
      return add_cell<CellShape::hexahedron20, false>(plan, blocks);
  }
}

}  // namespace engrane::elements::structural

// SPDX-License-Identifier: BSD-3-Clause
#include "elements/structural/cell_topology.hpp"
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

double handedness(CellShape shape, const std::vector<Vec3>& places) {
  const auto corner = [&places](int i) { return places[static_cast<std::size_t>(i)]; };
  if (!is_solid(shape)) {
    double area = 0;                           // twice the signed area of the polygon of corners
    for (const auto& [a, b] : sides(shape)) {  // from corner 0, as products of places far from the origin are rounding
      const Vec3 p = corner(a) - corner(0), q = corner(b) - corner(0);
      area += p[0] * q[1] - p[1] * q[0];
    }
    return area;
  }
  Vec3 base = Vec3::Zero(), centre = Vec3::Zero();  // twice the area vector of the base; centre of the corners
  const int corners = corner_count(shape);
  for (int i = 0; i < corners; ++i) centre += corner(i) / corners;
  const std::vector<int> under = face_nodes(shape, 0);
  const std::size_t count = has_middles(shape) ? under.size() / 2 : under.size();
  for (std::size_t i = 0; i < count; ++i) base += (corner(under[i]) - centre).cross(corner(under[(i + 1) % count]) - centre);
  return base.dot(corner(under.front()) - centre);
}

}  // namespace engrane::elements::structural

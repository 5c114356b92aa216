// SPDX-License-Identifier: BSD-3-Clause
#include "elements/structural/cells.hpp"
#include "elements/structural/make_cell.hpp"
#include "elements/structural/plane_shape.hpp"

namespace engrane::elements::structural {

bool is_regular_plane(CellShape shape, const std::vector<Vec3>& places) {
  return with_plane_shape(shape, [&]<CellShape S>() { return is_regular<S>(places); });
}

std::unique_ptr<Element> make_plane_cell(const CellPlan& plan, BlockStore* blocks) {
  const bool axi = plan.section->hypothesis == materials::Hypothesis::axisymmetric;
  return with_plane_shape(
      plan.shape, [&]<CellShape S>() { return axi ? add_cell<S, true>(plan, blocks) : add_cell<S, false>(plan, blocks); });
}

}  // namespace engrane::elements::structural

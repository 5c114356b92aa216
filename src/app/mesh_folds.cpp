// SPDX-License-Identifier: BSD-3-Clause
#include "app/mesh_folds.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <vector>

#include "elements/structural/cell_topology.hpp"
#include "elements/structural/make_cell.hpp"

namespace engrane::app {

namespace {

namespace structural = elements::structural;

/// Corners at the other ends of the sides that meet at a corner of a solid, in right-handed order if the cell is right-handed.
std::array<int, 3> neighbours(CellShape shape, int corner) {
  const int corners = structural::corner_count(shape);
  if (corners == 4 && corner == 3) return {0, 2, 1};  // the top of a tetrahedron
  const int base = corners == 4 ? 3 : corners / 2, at = corner % base, next = (at + 1) % base, before = (at + base - 1) % base;
  if (corner >= base) return {base + before, base + next, at};
  return {next, before, corners == 4 ? 3 : base + at};
}

/// Node in the middle of the side between two corners; -1 if the cell has none.
int middle_of(CellShape shape, int a, int b) {
  if (!structural::has_middles(shape)) return -1;
  const auto sides = structural::sides(shape);
  const auto joins = [a, b](const auto& side) { return std::minmax(side.first, side.second) == std::minmax(a, b); };
  return structural::corner_count(shape) + static_cast<int>(std::find_if(sides.begin(), sides.end(), joins) - sides.begin());
}

/// First corner at which the Jacobian determinant of a cell is negative, counted from 1; 0: none. The columns of the Jacobian are
/// the tangents of the sides that meet there, here divided by the length of the side.
int folded_corner(CellShape shape, const std::vector<Vec3>& places) {
  constexpr double rounding = 1e-6;  // middles at a quarter of a side, as at the tip of a crack, make it zero
  const auto at = [&places](int node) -> const Vec3& { return places[static_cast<std::size_t>(node)]; };
  const auto tangent = [&](int from, int to) -> Vec3 {
    const Vec3 chord = at(to) - at(from);
    const int middle = middle_of(shape, from, to);
    const Vec3 along = middle < 0 ? chord : Vec3(4 * (at(middle) - at(from)) - chord);
    return chord.isZero(0) ? chord : Vec3(along / chord.norm());
  };
  const int corners = structural::corner_count(shape);
  const bool solid = structural::is_solid(shape);
  const double hand = solid ? structural::handedness(shape, places) : 1;
  Vec3 area = Vec3::Zero();
  for (int i = 0; !solid && i < corners; ++i) area += (at(i) - at(0)).cross(at((i + 1) % corners) - at(0));
  for (int corner = 0; corner < corners; ++corner) {
    double determinant = 0;
    if (solid) {
      const auto [a, b, c] = neighbours(shape, corner);
      determinant = tangent(corner, a).cross(tangent(corner, b)).dot(tangent(corner, c)) * (hand < 0 ? -1 : 1);
    } else {
      determinant = tangent(corner, (corner + 1) % corners).cross(tangent(corner, (corner + corners - 1) % corners)).dot(area) /
                    area.norm();
    }
    if (determinant < -rounding) return corner + 1;
  }
  return 0;
}

/// Straight triangles and tetrahedra are the same everywhere.
bool varies(CellShape shape) {
  return shape != CellShape::none && shape != CellShape::triangle && shape != CellShape::tetrahedron;
}

}  // namespace

void warn_of_folded_corners(const Model& model, Diagnostics& diagnostics) {
  const Model::Part* first = nullptr;
  int corner = 0;
  std::size_t count = 0;
  std::vector<Vec3> places;
  for (const Model::Part& part : model.parts) {
    if (!part.is_cell() || !varies(part.element->cell_shape())) continue;
    places.clear();
    for (const int node : part.nodes) places.push_back(model.nodes[static_cast<std::size_t>(node)].x);
    const int folded = folded_corner(part.element->cell_shape(), places);
    if (folded == 0) continue;
    if (count++ > 0) continue;
    first = &part;
    corner = folded;
  }
  if (!first) return;
  const CellShape shape = first->element->cell_shape();
  diagnostics.warning(first->location,
                      fmt::format("cell {} is turned inside out at its corner {}, node {}{}: stresses near it mean little",
                                  first->element->id(), corner, first->element->node_ids()[static_cast<std::size_t>(corner - 1)],
                                  count > 1 ? fmt::format(" (the first of {} such cells)", count) : ""),
                      structural::has_middles(shape)
                          ? "the middle of a side lies between a quarter and three quarters of it, on the "
                            "side or close to it"
                          : "no corner may point inwards");
}

}  // namespace engrane::app

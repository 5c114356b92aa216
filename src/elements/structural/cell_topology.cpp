// SPDX-License-Identifier: BSD-3-Clause
#include "elements/structural/cell_topology.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>

namespace engrane::elements::structural {

namespace {

using Side = std::pair<int, int>;
constexpr std::array<Side, 3> of_triangle{{{0, 1}, {1, 2}, {2, 0}}};
constexpr std::array<Side, 4> of_quadrilateral{{{0, 1}, {1, 2}, {2, 3}, {3, 0}}};
constexpr std::array<Side, 6> of_tetrahedron{{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};
constexpr std::array<Side, 9> of_wedge{{{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}}};
constexpr std::array<Side, 12> of_hexahedron{
    {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}};

/// Number of corners of the base of a solid.
int base_corners(CellShape shape) { return shape == CellShape::hexahedron || shape == CellShape::hexahedron20 ? 4 : 3; }

bool is_tetrahedron(CellShape shape) { return shape == CellShape::tetrahedron || shape == CellShape::tetrahedron10; }

/// A polygon with or without mid-side nodes.
struct Polygon {
  std::vector<int> corners, middles;
};

/// Nothing if mid-side nodes are given but do not alternate with the corners.
std::optional<Polygon> polygon(std::span<const int> written) {
  Polygon found;
  for (std::size_t i = 0; i < written.size(); ++i) {
    const bool middle = written[i] < 0;
    if (middle && i % 2 == 0) return {};
    (middle ? found.middles : found.corners).push_back(std::abs(written[i]));
  }
  if (!found.middles.empty() && found.middles.size() != found.corners.size()) return {};
  return found;
}

void append(std::vector<int>& nodes, const std::vector<int>& more) { nodes.insert(nodes.end(), more.begin(), more.end()); }

std::optional<CellShape> plane_shape(const Polygon& p) {
  const bool middles = !p.middles.empty();
  if (p.corners.size() == 3) return middles ? CellShape::triangle6 : CellShape::triangle;
  if (p.corners.size() == 4) return middles ? CellShape::quadrilateral8 : CellShape::quadrilateral;
  return {};
}

std::optional<CellShape> solid_shape(const Polygon& base, const Polygon& top, std::size_t upright) {
  const bool middles = !base.middles.empty(), point = top.corners.size() == 1;
  const std::size_t corners = base.corners.size();
  if (corners != 3 && corners != 4) return {};
  if (point ? corners != 3 : top.corners.size() != corners || top.middles.size() != base.middles.size()) return {};
  if (upright != (middles ? corners : 0)) return {};
  if (point) return middles ? CellShape::tetrahedron10 : CellShape::tetrahedron;
  if (corners == 3) return middles ? CellShape::wedge15 : CellShape::wedge;
  return middles ? CellShape::hexahedron20 : CellShape::hexahedron;
}

}  // namespace

std::optional<std::vector<int>> line_of(std::span<const int> written) {
  const bool is_line =
      (written.size() == 2 || (written.size() == 3 && written[1] < 0)) && written.front() > 0 && written.back() > 0;
  if (!is_line) return {};
  std::vector<int> nodes;
  for (const int node : written) nodes.push_back(std::abs(node));
  return nodes;
}

std::optional<Connectivity> connectivity(std::span<const int> written) {
  std::vector<std::span<const int>> pieces;
  for (auto first = written.begin(); first != written.end();) {
    const auto end = std::find(first, written.end(), 0);
    if (end != first) pieces.emplace_back(first, end);
    first = end == written.end() ? end : end + 1;
  }
  if (pieces.empty() || pieces.size() > 3) return {};
  const std::optional<Polygon> base = polygon(pieces.front());
  if (!base) return {};
  Connectivity found;
  if (pieces.size() == 1) {
    const auto shape = plane_shape(*base);
    if (!shape) return {};
    found.shape = *shape;
    append(found.nodes, base->corners);
    append(found.nodes, base->middles);
    return found;
  }
  std::vector<int> upright;
  if (pieces.size() == 3)
    for (const int node : pieces[1]) {
      if (node > 0) return {};
      upright.push_back(-node);
    }
  const std::optional<Polygon> top = polygon(pieces.back());
  const auto shape = top ? solid_shape(*base, *top, upright.size()) : std::nullopt;
  if (!shape) return {};
  found.shape = *shape;
  append(found.nodes, base->corners);
  append(found.nodes, top->corners);
  append(found.nodes, base->middles);
  append(found.nodes, top->middles);
  append(found.nodes, upright);
  return found;
}

bool is_solid(CellShape shape) { return shape >= CellShape::tetrahedron; }

bool has_middles(CellShape shape) {
  switch (shape) {
    case CellShape::triangle6:
    case CellShape::quadrilateral8:
    case CellShape::tetrahedron10:
    case CellShape::wedge15:
    case CellShape::hexahedron20:
      return true;
    default:
      return false;
  }
}

std::span<const std::pair<int, int>> sides(CellShape shape) {
  switch (shape) {
    case CellShape::triangle:
    case CellShape::triangle6:
      return of_triangle;
    case CellShape::quadrilateral:
    case CellShape::quadrilateral8:
      return of_quadrilateral;
    case CellShape::tetrahedron:
    case CellShape::tetrahedron10:
      return of_tetrahedron;
    case CellShape::wedge:
    case CellShape::wedge15:
      return of_wedge;
    case CellShape::hexahedron:
    case CellShape::hexahedron20:
      return of_hexahedron;
    default:
      return {};
  }
}

int corner_count(CellShape shape) {
  if (!is_solid(shape)) return static_cast<int>(sides(shape).size());
  return is_tetrahedron(shape) ? 4 : 2 * base_corners(shape);
}

int face_count(CellShape shape) {
  if (!is_solid(shape)) return corner_count(shape);
  return base_corners(shape) + (is_tetrahedron(shape) ? 1 : 2);
}

std::vector<int> face_nodes(CellShape shape, int face) {
  std::vector<int> corners;
  const int base = base_corners(shape), next = face % base;
  if (!is_solid(shape))
    corners = {face, (face + 1) % corner_count(shape)};
  else if (face == 0)  // reversed: seen from outside, the order of the base is clockwise
    for (int i = 0; i < base; ++i) corners.push_back((base - i) % base);
  else if (face > base)
    for (int i = 0; i < base; ++i) corners.push_back(base + i);
  else if (is_tetrahedron(shape))
    corners = {face - 1, next, 3};
  else
    corners = {face - 1, next, base + next, base + face - 1};
  std::vector<int> nodes = corners;
  if (!has_middles(shape)) return nodes;
  const auto all = sides(shape);
  const std::size_t count = corners.size() == 2 ? 1 : corners.size();
  for (std::size_t i = 0; i < count; ++i) {
    const int a = corners[i], b = corners[(i + 1) % corners.size()];
    const auto side = std::find_if(all.begin(), all.end(), [a, b](const Side& s) {
      return (s.first == a && s.second == b) || (s.first == b && s.second == a);
    });
    nodes.push_back(corner_count(shape) + static_cast<int>(side - all.begin()));
  }
  return nodes;
}

}  // namespace engrane::elements::structural

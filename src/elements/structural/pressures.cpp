// SPDX-License-Identifier: BSD-3-Clause
#include "elements/structural/pressures.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <numbers>
#include <numeric>

#include "elements/structural/cell.hpp"
#include "elements/structural/make_cell.hpp"

namespace engrane::elements::structural {

namespace {

/// Samples of a plane shape used as a face.
template <CellShape S>
std::vector<FaceSample> samples_of(const QuadratureRule& rule) {
  std::vector<FaceSample> samples;
  for (const auto& s : tabulate<S>(rule)) {
    FaceSample& sample = samples.emplace_back(FaceSample{s.weight, {}, {}});
    for (Eigen::Index i = 0; i < CellTraits<S>::nodes; ++i) {
      sample.value.push_back(s.value[i]);
      sample.slope.push_back({s.slope(0, i), s.slope(1, i)});
    }
  }
  return samples;
}

}  // namespace

std::vector<FaceSample> face_samples(bool solid, std::size_t nodes) {
  if (!solid) {
    std::vector<FaceSample> samples;
    for (const EdgeSample& s : edge_samples(nodes)) {
      FaceSample& sample = samples.emplace_back(FaceSample{s.weight, {}, {}});
      for (std::size_t i = 0; i < nodes; ++i) {
        sample.value.push_back(s.value[i]);
        sample.slope.push_back({s.slope[i], 0});
      }
    }
    return samples;
  }
  switch (nodes) {  // six-node triangles need degree 4: N_i times the normal of a curved face
    case 3:
      return samples_of<CellShape::triangle>(CellTraits<CellShape::triangle>::load_points());
    case 6:
      return samples_of<CellShape::triangle6>(CellTraits<CellShape::triangle6>::mass_points());
    case 4:
      return samples_of<CellShape::quadrilateral>(CellTraits<CellShape::quadrilateral>::load_points());
    default:
      return samples_of<CellShape::quadrilateral8>(CellTraits<CellShape::quadrilateral8>::load_points());
  }
}

template <int D>
void Pressures<D>::push(const Face& face, const State& state, double sign, std::span<double> f, std::span<double> k) const {
  using Square = Eigen::Matrix<double, D, D>;
  const std::size_t nodes = layout_.nodes.size(), n = width();
  std::fill(f.begin(), f.end(), 0.0);
  std::fill(k.begin(), k.end(), 0.0);
  const CellSection& section = *face.section;
  const bool axi = section.hypothesis == materials::Hypothesis::axisymmetric, follows = face.follows();
  std::vector<Vector> x = face.places;
  for (std::size_t i = 0; i < nodes && follows; ++i) x[i] = state.nodes[i].x.template head<D>();
  const double factor = sign * face.pressure * (face.function ? face.function->at(state.time).f : 1) *
                        (D == 2 ? section.thickness : 1) * (axi ? 2 * std::numbers::pi : 1);
  for (const FaceSample& s : samples_) {
    Vector along[2] = {Vector::Zero(), Vector::Zero()};
    double radius = 0;
    for (std::size_t i = 0; i < nodes; ++i) {
      for (std::size_t c = 0; c + 1 < D; ++c) along[c] += s.slope[i][c] * x[i];
      radius += s.value[i] * x[i][0];
    }
    // normal times area; its derivative by the position of node j is turn[0] s_j (+ turn[1] t_j), with s_j, t_j the slopes
    Vector normal;
    Square turn[2] = {Square::Zero(), Square::Zero()};
    if constexpr (D == 2) {
      turn[0] << 0, 1, -1, 0;
      normal = turn[0] * along[0];
    } else {
      normal = along[0].cross(along[1]);
      for (int c = 0; c < 3; ++c) {
        turn[0].col(c) = Vector::Unit(c).cross(along[1]);
        turn[1].col(c) = along[0].cross(Vector::Unit(c));
      }
    }
    const double around = axi ? radius : 1;
    for (std::size_t i = 0; i < nodes; ++i) {
      const double share = factor * s.weight * s.value[i];
      Eigen::Map<Vector>(&f[D * i]) -= share * around * normal;
      if (k.empty() || !follows) continue;
      for (std::size_t j = 0; j < nodes; ++j) {
        Square change = around * s.slope[j][0] * turn[0];
        if constexpr (D == 3) change += s.slope[j][1] * turn[1];
        if (axi) change.col(0) += s.value[j] * normal;
        for (std::size_t a = 0; a < D; ++a)
          for (std::size_t b = 0; b < D; ++b)
            k[(D * i + a) * n + D * j + b] -= share * change(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b));
      }
    }
  }
}

template class Pressures<2>;
template class Pressures<3>;

namespace {

template <int D>
std::unique_ptr<Element> add(const PressureOn& on, const Connectivity& cell, int number,
                             const std::shared_ptr<const CellSection>& section, BuildContext& context) {
  typename Pressures<D>::Face face{{}, {}, on.pressure, on.function, on.dead, section};
  std::vector<int> indices(cell.nodes.size());
  std::iota(indices.begin(), indices.end(), 0);
  if (!section->skin) indices = face_nodes(cell.shape, on.face - 1);
  for (const int i : indices) {
    const int id = cell.nodes[static_cast<std::size_t>(i)];
    face.nodes.push_back(id);
    face.places.push_back(context.nodes.at(id).template head<D>());
  }
  std::vector<Vec3> places;
  for (const int id : cell.nodes) places.push_back(context.nodes.at(id));
  if (section->skin)
    face.pressure = -face.pressure;  // acts towards the side from which the corners appear counterclockwise
  else if (handedness(cell.shape, places) < 0)
    face.pressure = -face.pressure;
  const std::size_t count = face.nodes.size();
  BlockStore alone;
  const auto block = (context.blocks ? *context.blocks : alone).block<Pressures<D>>(std::to_string(count), count);
  return std::make_unique<BlockMember>(number, block, block->add(std::move(face)));
}

}  // namespace

std::unique_ptr<Element> make_pressure(const PressureOn& on, int number, const char* keyword, const CellBook& book,
                                       BuildContext& context) {
  const deck::Record* record = book.record(on.cell);
  if (!record) {
    context.diagnostics.missing(".MAI", context.record.where(keyword), fmt::format("cell {} does not exist", on.cell),
                                "a face is given by the number of a cell of .MAI and its own");
    return nullptr;
  }
  const auto cell = connectivity(record->get<CellData>()->nodes);
  const std::shared_ptr<const CellSection> section = book.section(on.cell);
  // errors of the cell are reported when it is built
  if (!cell || !section) return nullptr;
  for (const int id : cell->nodes)
    if (!context.nodes.contains(id)) return nullptr;
  const int faces = section->skin ? 1 : face_count(cell->shape);
  if (on.face >= 1 && on.face <= faces)
    return is_solid(cell->shape) || section->skin ? add<3>(on, *cell, number, section, context)
                                                  : add<2>(on, *cell, number, section, context);
  const bool solid = is_solid(cell->shape);
  if (section->skin) {
    context.error(keyword, fmt::format("membrane {} has no face {}", on.cell, on.face), "its face is 1");
    return nullptr;
  }
  context.error(keyword, fmt::format("cell {} has no {} {}", on.cell, solid ? "face" : "edge", on.face),
                solid ? fmt::format("its faces are 1 to {}: the base, those on its sides in turn, the top", faces)
                      : fmt::format("its edges are 1 to {}: edge k begins at its corner k", faces));
  return nullptr;
}

}  // namespace engrane::elements::structural

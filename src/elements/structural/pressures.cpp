// SPDX-License-Identifier: BSD-3-Clause
#include "elements/structural/pressures.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <numbers>

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

/// `nodes` go round the face; a positive `pressure` acts against the normal that this gives.
template <int D>
std::unique_ptr<Element> add(const PressureOn& on, double pressure, const std::vector<int>& nodes, int number,
                             const std::shared_ptr<const CellSection>& section, BuildContext& context) {
  typename Pressures<D>::Face face{nodes, {}, pressure, on.function, on.dead, section};
  for (const int id : nodes) face.places.push_back(context.nodes.at(id).template head<D>());
  const std::size_t count = nodes.size();
  BlockStore alone;
  const auto block = (context.blocks ? *context.blocks : alone).block<Pressures<D>>(std::to_string(count), count);
  return std::make_unique<BlockMember>(number, block, block->add(std::move(face)));
}

bool are_known(const std::vector<int>& nodes, const BuildContext& context) {
  return std::all_of(nodes.begin(), nodes.end(), [&context](int id) { return context.nodes.contains(id); });
}

/// On a membrane, whose face is 1: towards the side from which the corners appear counterclockwise.
std::unique_ptr<Element> on_membrane(const PressureOn& on, const std::vector<int>& nodes, int number, const char* keyword,
                                     const std::shared_ptr<const CellSection>& section, BuildContext& context) {
  if (on.face == 1) return add<3>(on, -on.pressure, nodes, number, section, context);
  context.error(keyword, fmt::format("membrane {} has no face {}", on.cell, on.face), "its face is 1");
  return nullptr;
}

/// Section of elements MEMBRANE, as far as a pressure needs it.
std::shared_ptr<const CellSection> section_of_elements() {
  CellSection section{materials::Hypothesis::plane_stress, {}};
  section.linear = false;
  section.skin.emplace();
  return std::make_shared<const CellSection>(std::move(section));
}

}  // namespace

std::unique_ptr<Element> make_pressure(const PressureOn& on, int number, const char* keyword, const CellBook& book,
                                       BuildContext& context) {
  const deck::Record* record = book.record(on.cell);
  const std::vector<int>* membrane = record ? nullptr : book.membrane(on.cell);
  if (!record && !membrane) {
    context.diagnostics.missing(".MAI", context.record.where(keyword), fmt::format("cell {} does not exist", on.cell),
                                "a face is given by the number of a cell of .MAI, or of a MEMBRANE, and its own");
    return nullptr;
  }
  if (membrane) {  // errors of the membrane are reported when it is built
    const std::size_t count = membrane->size();
    const bool whole = are_known(*membrane, context) && (count <= 4 || count == 6 || count == 8);
    return whole ? on_membrane(on, *membrane, number, keyword, section_of_elements(), context) : nullptr;
  }
  const auto cell = connectivity(record->get<CellData>()->nodes);
  const std::shared_ptr<const CellSection> section = book.section(on.cell);
  // errors of the cell are reported when it is built
  if (!cell || !section || !are_known(cell->nodes, context)) return nullptr;
  if (section->skin) return on_membrane(on, cell->nodes, number, keyword, section, context);
  const int faces = face_count(cell->shape);
  const bool solid = is_solid(cell->shape);
  if (on.face >= 1 && on.face <= faces) {
    std::vector<Vec3> places;
    for (const int id : cell->nodes) places.push_back(context.nodes.at(id));
    const double pressure = handedness(cell->shape, places) < 0 ? -on.pressure : on.pressure;
    std::vector<int> nodes;
    for (const int i : face_nodes(cell->shape, on.face - 1)) nodes.push_back(cell->nodes[static_cast<std::size_t>(i)]);
    return solid ? add<3>(on, pressure, nodes, number, section, context) : add<2>(on, pressure, nodes, number, section, context);
  }
  context.error(keyword, fmt::format("cell {} has no {} {}", on.cell, solid ? "face" : "edge", on.face),
                solid ? fmt::format("its faces are 1 to {}: the base, those on its sides in turn, the top", faces)
                      : fmt::format("its edges are 1 to {}: edge k begins at its corner k", faces));
  return nullptr;
}

}  // namespace engrane::elements::structural

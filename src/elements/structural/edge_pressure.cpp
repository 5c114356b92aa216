// SPDX-License-Identifier: BSD-3-Clause
#include "elements/structural/edge_pressure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "elements/structural/cell.hpp"
#include "elements/structural/cell_book.hpp"
#include "elements/structural/cell_shapes.hpp"

namespace engrane::elements::structural {

namespace {

/// Pressures on edges of 2 or 3 nodes. The force on node i is −p ∫ N_i n t ds with n the outward normal, consistent with the
/// shape functions of the cell. With large displacements it follows the edge (thickness as in the beginning), and then its
/// derivative is not symmetric.
class EdgePressures final : public Block {
 public:
  explicit EdgePressures(std::size_t nodes) : samples_(edge_samples(nodes)) {
    layout_.nodes.assign(nodes, -1);
    layout_.needs.assign(nodes, NodeNeed::in_plane);
  }

  struct Edge {
    std::array<int, 3> nodes;  ///< ends in the order of the cell, then the middle
    std::array<Eigen::Vector2d, 3> places;
    double pressure = 0;  ///< times +1 where the cell is to the left of the edge, −1 where it is to the right
    const Function* function = nullptr;
    std::shared_ptr<const CellSection> section;
  };

  std::size_t add(Edge edge) {
    edges_.push_back(std::move(edge));
    return edges_.size() - 1;
  }

  std::size_t size() const override { return edges_.size(); }
  const Layout& layout() const override { return layout_; }
  bool in_mesh() const override { return false; }
  std::span<const int> node_ids(std::size_t e) const override { return std::span(edges_[e].nodes).first(layout_.nodes.size()); }

  void residual(std::size_t first, std::span<const State> states, std::span<double> r) const override {
    const std::size_t n = 2 * layout_.nodes.size();
    for (std::size_t i = 0; i < states.size(); ++i) push(edges_[first + i], states[i], -1, r.subspan(i * n, n), {});
  }

  void tangent(std::size_t first, std::span<const State> states, Weights weights, std::span<double> r,
               std::span<double> k) const override {
    const std::size_t n = 2 * layout_.nodes.size();
    for (std::size_t i = 0; i < states.size(); ++i) {
      push(edges_[first + i], states[i], -1, r.subspan(i * n, n), k.subspan(i * n * n, n * n));
      for (double& entry : k.subspan(i * n * n, n * n)) entry *= weights.q;
    }
  }

  void constraint_rates(std::size_t, const State&, std::span<double>, std::span<double>, std::span<double>) const override {}

  bool is_linear(std::size_t e) const override { return edges_[e].section->linear; }

  Energies energies(std::size_t e, const State& state) const override {
    std::array<double, 6> forces{};
    push(edges_[e], state, 1, std::span(forces).first(2 * layout_.nodes.size()), {});
    Energies energies;
    for (std::size_t i = 0; i < layout_.nodes.size(); ++i)
      energies.external += forces[2 * i] * state.nodes[i].v[0] + forces[2 * i + 1] * state.nodes[i].v[1];
    return energies;
  }

  bool applied(std::size_t e, const State& state, std::span<double> forces) const override {
    push(edges_[e], state, 1, forces, {});
    return true;
  }

 private:
  /// `sign` times the forces, and their derivative where `k` is not empty.
  void push(const Edge& edge, const State& state, double sign, std::span<double> f, std::span<double> k) const {
    const std::size_t nodes = layout_.nodes.size(), n = 2 * nodes;
    std::fill(f.begin(), f.end(), 0.0);
    std::fill(k.begin(), k.end(), 0.0);
    const CellSection& section = *edge.section;
    const bool axi = section.hypothesis == materials::Hypothesis::axisymmetric;
    std::array<Eigen::Vector2d, 3> x = edge.places;
    for (std::size_t i = 0; i < nodes && !section.linear; ++i) x[i] = state.nodes[i].x.head<2>();
    const double factor = sign * edge.pressure * (edge.function ? edge.function->at(state.time).f : 1) * section.thickness *
                          (axi ? 2 * std::numbers::pi : 1);
    for (const EdgeSample& s : samples_) {
      Eigen::Vector2d slope = Eigen::Vector2d::Zero();
      double radius = 0;
      for (std::size_t i = 0; i < nodes; ++i) {
        slope += s.slope[i] * x[i];
        radius += s.value[i] * x[i][0];
      }
      const double around = axi ? radius : 1;
      for (std::size_t i = 0; i < nodes; ++i) {
        // the outward normal is (y', −x') where the cell is to the left
        const double share = factor * s.weight * s.value[i];
        f[2 * i] -= share * around * slope[1];
        f[2 * i + 1] += share * around * slope[0];
        if (k.empty() || section.linear) continue;
        for (std::size_t j = 0; j < nodes; ++j) {
          k[2 * i * n + 2 * j + 1] -= share * around * s.slope[j];
          k[(2 * i + 1) * n + 2 * j] += share * around * s.slope[j];
          if (!axi) continue;
          k[2 * i * n + 2 * j] -= share * s.value[j] * slope[1];
          k[(2 * i + 1) * n + 2 * j] += share * s.value[j] * slope[0];
        }
      }
    }
  }

  Layout layout_;
  std::array<EdgeSample, 3> samples_;
  std::vector<Edge> edges_;
};

std::unique_ptr<Element> build(const EdgePressureData& data, BuildContext& context) {
  const auto [cell, side] = data.edge;
  const Function* function = nullptr;
  if (data.function != 0 && !(function = context.function(data.function, "NF"))) return nullptr;
  const std::shared_ptr<const CellBook> book = CellBook::of(context);
  const deck::Record* record = book->record(cell);
  if (!record) {
    context.diagnostics.missing(".MAI", context.record.where("I"), fmt::format("cell {} does not exist", cell),
                                "ARETE I cell edge: the number of a cell of .MAI, then that of its edge");
    return nullptr;
  }
  const auto cell_nodes = connectivity(record->get<CellData>()->nodes);
  const std::shared_ptr<const CellSection> section = book->section(cell);
  if (!cell_nodes || !section) return nullptr;  // the cell has faults of its own
  const auto& [shape, nodes] = *cell_nodes;
  const int faces = face_count(shape);
  if (is_solid(shape)) {
    context.error("I", fmt::format("cell {} is a solid", cell), "pressure on a solid acts on a face: FACE I cell face PRE V p");
    return nullptr;
  }
  if (side < 1 || side > faces) {
    context.error("I", fmt::format("cell {} has no edge {}", cell, side),
                  fmt::format("its edges are 1 to {}: edge k begins at its corner k", faces));
    return nullptr;
  }
  for (const int id : nodes)
    if (!context.nodes.contains(id)) return nullptr;
  EdgePressures::Edge edge{{}, {}, data.pressure, function, section};
  const std::vector<int> places = face_nodes(shape, side - 1);
  const std::size_t count = places.size();
  const auto at = [&](int i) { return Eigen::Vector2d(context.nodes.at(nodes[static_cast<std::size_t>(i)]).head<2>()); };
  for (std::size_t i = 0; i < count; ++i) {
    edge.nodes[i] = nodes[static_cast<std::size_t>(places[i])];
    edge.places[i] = at(places[i]);
  }
  double area = 0;  // of the polygon of the corners, twice
  for (const auto& [first, last] : sides(shape)) {
    const Eigen::Vector2d a = at(first), b = at(last);
    area += a[0] * b[1] - a[1] * b[0];
  }
  if (area < 0) edge.pressure = -edge.pressure;
  BlockStore alone;
  const auto block = (context.blocks ? *context.blocks : alone).block<EdgePressures>(count == 2 ? "2" : "3", count);
  return std::make_unique<BlockMember>(context.number, block, block->add(std::move(edge)));
}

}  // namespace

ElementType edge_pressure_type() {
  deck::Card<EdgePressureData> card(".CLM ARETE", {".BOUNDARY", "EDGE"}, "Pressure on an edge of a plane cell");
  card.chapter("Boundary conditions, loads and functions")
      .redefines()
      .describe(
          "Edge k of a cell goes from its corner k to the next. A positive pressure pushes into the cell, with its thickness. "
          "With large displacements it follows the edge.")
      .example(".CLM\n ARETE I 57 3 PRE V 1000.\n ARETE I 58 3 PRE V 1000. NF 2");
  card.add("I", &EdgePressureData::edge, "number of the cell and of its edge").at_least(1).required().leads();
  card.add("PRE", &EdgePressureData::pressure, "pressure, positive into the cell")
      .synonyms({"PRESSION", "PRESSURE"})
      .unit(dimension::pressure)
      .filler({"V", "VAL"})
      .required();
  card.add("NF", &EdgePressureData::function, "number of the function of time; 0: constant")
      .refers(deck::Reference::function)
      .at_least(0);
  return element_type(card, build);
}

}  // namespace engrane::elements::structural

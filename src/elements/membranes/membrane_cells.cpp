// SPDX-License-Identifier: BSD-3-Clause
#include "elements/membranes/membrane_cells.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

#include "elements/structural/cell_shapes.hpp"
#include "elements/structural/plane_shape.hpp"

namespace engrane::elements::membranes {

namespace {

using structural::CellTraits;
using structural::tabulate;

/// Block of membranes of one shape; either all of them can wrinkle or none. Total Lagrangian, in an orthonormal frame of the
/// reference surface at each point (Bonet, Wood, Mahaney and Heywood 2000, Comput. Methods Appl. Mech. Eng. 190, 579).
template <CellShape S>
class Membranes final : public Block {
  using Traits = CellTraits<S>;
  static constexpr int N = Traits::nodes;
  using Places = Eigen::Matrix<double, 3, N>;
  using Square = Eigen::Matrix<double, 3 * N, 3 * N, Eigen::RowMajor>;
  using Shape = Eigen::Matrix<double, N, 1>;

  /// Quadrature point on the reference surface.
  struct Point {
    Shape value;
    Eigen::Matrix<double, 2, N> gradient;  ///< derivatives of the shape functions along the axes of the frame
    double area;                           ///< including the quadrature weight
  };

  struct Cell {
    std::array<int, static_cast<std::size_t>(N)> nodes;
    Places places;
    std::shared_ptr<const MembraneSection> section;
    NodeWarmth warmth;
  };

  /// Current state at a point.
  struct Local {
    Eigen::Matrix<double, 3, 2> F;  ///< deformation gradient: images of the frame's vectors
    SkinResponse response;
    Eigen::Matrix2d stress() const {
      const Plane& s = response.stress;
      return (Eigen::Matrix2d() << s[0], s[2], s[2], s[1]).finished();
    }
  };

 public:
  explicit Membranes(bool wrinkles) : wrinkles_(wrinkles) {
    layout_.nodes.assign(N, -1);
    layout_.needs.assign(N, NodeNeed::translation);
  }

  std::optional<std::size_t> add(const std::vector<int>& nodes, const std::vector<Vec3>& places,
                                 const std::shared_ptr<const MembraneSection>& section, const NodeWarmth& warmth) {
    Cell cell;
    std::copy_n(nodes.begin(), N, cell.nodes.begin());
    for (Eigen::Index i = 0; i < N; ++i) cell.places.col(i) = places[static_cast<std::size_t>(i)];
    cell.section = section;
    cell.warmth = warmth;
    if (!is_regular(cell.places)) return {};
    cells_.push_back(std::move(cell));
    return cells_.size() - 1;
  }

  std::size_t size() const override { return cells_.size(); }
  const Layout& layout() const override { return layout_; }
  std::span<const int> node_ids(std::size_t e) const override { return cells_[e].nodes; }
  CellShape cell_shape() const override { return S; }
  const char* why_not_finite() const override {
    return "has stretched so far that its stress is no number: take smaller steps H";
  }

  void residual(std::size_t first, std::span<const State> states, std::span<double> r) const override {
    for (std::size_t i = 0; i < states.size(); ++i) resist(cells_[first + i], states[i], {}, r.data() + i * 3 * N, nullptr);
  }

  void tangent(std::size_t first, std::span<const State> states, Weights weights, std::span<double> r,
               std::span<double> k) const override {
    for (std::size_t i = 0; i < states.size(); ++i)
      resist(cells_[first + i], states[i], weights, r.data() + i * 3 * N, k.data() + i * 9 * N * N);
  }

  void constraint_rates(std::size_t, const State&, std::span<double>, std::span<double>, std::span<double>) const override {}

  Energies energies(std::size_t e, const State& state) const override {
    const Cell& cell = cells_[e];
    const MembraneSection& section = *cell.section;
    const Places x = places_of(state), v = rates_of(state);
    const double pressure = section.pressure_at(state.time), mass = section.density * section.thickness;
    Energies sum;
    for (const Sample& s : samples()) {
      const Point p = point(cell.places, s);
      const Local local = this->local(cell, state.time, x, p);
      sum.strain += p.area * section.thickness * local.response.energy;
      sum.external += p.area * section.thickness * local.response.by_growth * section.law.expansion *
                      rise_rate_at(cell.warmth, p.value, state.time);
      sum.add_weight(state, p.area * mass, x * p.value, v * p.value);
      sum.kinetic += p.area * mass / 2 * (v * p.value).squaredNorm();
      sum.external += p.area * pressure * normal(local).dot(v * p.value);
    }
    sum.potential += sum.strain;
    return sum;
  }

  const std::vector<Field>& fields() const override {
    const auto at_points = [](const char* name, Dimension dimension, const char* help, std::vector<std::string> components = {}) {
      return Field{{name, dimension, help}, Field::Place::point, std::move(components), static_cast<int>(samples().size())};
    };
    static const std::vector<Field> all = {
        at_points("MEMBRANE_STRESS", dimension::pressure, "principal true stresses in the surface, the larger first", {"1", "2"}),
        at_points("THINNING", dimension::none, "thickness over that of the reference configuration"),
        at_points("TAUTNESS", dimension::none, "2 taut, 1 wrinkled, 0 slack")};
    static const std::vector<Field> without_wrinkles(all.begin(), all.end() - 1);
    return wrinkles_ ? all : without_wrinkles;
  }

  void evaluate_fields(std::size_t e, const State& state, std::span<double> values) const override {
    const Cell& cell = cells_[e];
    const Places x = places_of(state);
    const std::size_t count = samples().size();
    for (std::size_t i = 0; i < count; ++i) {
      const Local local = this->local(cell, state.time, x, point(cell.places, samples()[i]));
      // σ = F S Fᵀ/J has the same principal values as S FᵀF/J
      const Eigen::Matrix2d C = local.F.transpose() * local.F;
      const Eigen::Matrix2d mixed = local.stress() * C / (local.response.area * local.response.thinning);
      const double middle = mixed.trace() / 2, radius = std::sqrt(std::max(middle * middle - mixed.determinant(), 0.0));
      values[2 * i] = middle + radius;
      values[2 * i + 1] = middle - radius;
      values[2 * count + i] = local.response.thinning;
      if (wrinkles_) values[3 * count + i] = static_cast<double>(local.response.state);
    }
  }

 private:
  using Sample = typename Traits::Sample;
  static const std::vector<Sample>& samples() {
    static const auto all = tabulate<S>(Traits::load_points());
    return all;
  }

  static Places places_of(const State& state) {
    Places x;
    for (Eigen::Index i = 0; i < N; ++i) x.col(i) = state.nodes[static_cast<std::size_t>(i)].x;
    return x;
  }
  static Places rates_of(const State& state) {
    Places v;
    for (Eigen::Index i = 0; i < N; ++i) v.col(i) = state.nodes[static_cast<std::size_t>(i)].v;
    return v;
  }

  static Point point(const Places& places, const Sample& s) {
    const Vec3 g1 = places * s.slope.row(0).transpose(), g2 = places * s.slope.row(1).transpose();
    // e₁ along the first tangent, e₂ perpendicular to it in the surface
    const double length = g1.norm(), across = g2.dot(g1) / length, height = std::sqrt(g2.squaredNorm() - across * across);
    Point p{s.value, {}, s.weight * length * height};
    p.gradient.row(0) = s.slope.row(0) / length;
    p.gradient.row(1) = (s.slope.row(1) - across * p.gradient.row(0)) / height;
    return p;
  }

  /// Whether the surface has an area and is not folded.
  static bool is_regular(const Places& places) {
    constexpr double rounding = 1e-9;
    const double size = (places.colwise() - places.col(0)).squaredNorm();
    Vec3 first = Vec3::Zero();
    for (const auto& s : samples()) {
      const Eigen::Matrix<double, 3, 2> G = places * s.slope.transpose();
      const Vec3 n = cross(Vec3(G.col(0)), Vec3(G.col(1)));
      if (first.isZero(0)) first = n;
      if (!(n.norm() > rounding * size) || !(n.dot(first) > 0)) return false;
    }
    return true;
  }

  static Vec3 normal(const Local& local) { return cross(Vec3(local.F.col(0)), Vec3(local.F.col(1))); }

  static Local local(const Cell& cell, double time, const Places& x, const Point& p) {
    Local l;
    l.F.noalias() = x * p.gradient.transpose();
    const Plane strain((l.F.col(0).squaredNorm() - 1) / 2, (l.F.col(1).squaredNorm() - 1) / 2, l.F.col(0).dot(l.F.col(1)));
    const MembraneLaw& law = cell.section->law;
    l.response = respond(law, strain, law.expansion * rise_at(cell.warmth, p.value, time));
    return l;
  }

  /// Residual, and the tangent unless `k` is nullptr.
  static void resist(const Cell& cell, const State& state, Weights weights, double* r, double* k) {
    const MembraneSection& section = *cell.section;
    const double pressure = section.pressure_at(state.time), mass = section.density * section.thickness;
    const Places x = places_of(state);
    Places a;
    for (Eigen::Index i = 0; i < N; ++i) a.col(i) = state.nodes[static_cast<std::size_t>(i)].a - state.gravity;
    Eigen::Map<Places> out(r);
    out.setZero();
    if (k) Eigen::Map<Square>(k).setZero();
    Symmetric sum;
    if (k) sum.fill(Mat3::Zero());
    for (const Sample& s : samples()) {
      const Point p = point(cell.places, s);
      const Local local = Membranes::local(cell, state.time, x, p);
      const double volume = p.area * section.thickness;
      const Eigen::Matrix<double, 2, N> pulled = local.stress() * p.gradient;
      out.noalias() += (volume * local.F).lazyProduct(pulled);
      if (pressure != 0) out.noalias() -= (p.area * pressure * normal(local)).lazyProduct(p.value.transpose());
      if (mass != 0) out.noalias() += (p.area * mass * (a * p.value)).lazyProduct(p.value.transpose());
      if (!k) continue;
      add_symmetric(p, local, pulled, weights.q * volume, weights.a * p.area * mass, sum);
      if (pressure != 0) add_pressure(p, local, weights.q * p.area * pressure, k);
    }
    if (!k) return;
    Eigen::Map<Square> tangent(k);
    for (Eigen::Index j = 0, at = 0; j < N; ++j)
      for (Eigen::Index i = 0; i <= j; ++i, ++at) {
        const Mat3& block = sum[static_cast<std::size_t>(at)];
        tangent.template block<3, 3>(3 * i, 3 * j) += block;
        if (i != j) tangent.template block<3, 3>(3 * j, 3 * i) += block.transpose();
      }
  }

  /// Blocks of the node pairs i ≤ j, ordered by j, then i.
  using Symmetric = std::array<Mat3, static_cast<std::size_t>(N*(N + 1) / 2)>;

  /// Adds the contribution of a point's stresses and mass to the tangent. `volume` and `mass` include the factors of Weights.
  static void add_symmetric(const Point& p, const Local& local, const Eigen::Matrix<double, 2, N>& pulled, double volume,
                            double mass, Symmetric& sum) {
    const Mat3 moduli = volume * local.response.moduli;
    std::array<Mat3, static_cast<std::size_t>(N)> strains;  // derivatives by a node's displacement; columns 11, 22, 12
    for (Eigen::Index j = 0, at = 0; j < N; ++j) {
      const double d1 = p.gradient(0, j), d2 = p.gradient(1, j);
      Mat3& b = strains[static_cast<std::size_t>(j)];
      b.col(0) = d1 * local.F.col(0);
      b.col(1) = d2 * local.F.col(1);
      b.col(2) = d1 * local.F.col(1) + d2 * local.F.col(0);
      const Mat3 stresses = moduli * b.transpose();
      const double s1 = volume * pulled(0, j), s2 = volume * pulled(1, j), m = mass * p.value[j];
      for (Eigen::Index i = 0; i <= j; ++i, ++at) {
        Mat3& block = sum[static_cast<std::size_t>(at)];
        block.noalias() += strains[static_cast<std::size_t>(i)] * stresses;
        block.diagonal().array() += s1 * p.gradient(0, i) + s2 * p.gradient(1, i) + m * p.value[i];
      }
    }
  }

  /// Adds the tangent of the pressure, from the derivative of the normal f₁ × f₂.
  static void add_pressure(const Point& p, const Local& local, double pressure, double* k) {
    Eigen::Map<Square> out(k);
    const Vec3 f1 = local.F.col(0), f2 = local.F.col(1);
    for (Eigen::Index j = 0; j < N; ++j) {
      const Vec3 u = pressure * (p.gradient(1, j) * f1 - p.gradient(0, j) * f2);
      for (Eigen::Index i = 0; i < N; ++i) {  // −N_i u × ·
        const Vec3 w = p.value[i] * u;
        out(3 * i, 3 * j + 1) += w[2];
        out(3 * i, 3 * j + 2) -= w[1];
        out(3 * i + 1, 3 * j) -= w[2];
        out(3 * i + 1, 3 * j + 2) += w[0];
        out(3 * i + 2, 3 * j) += w[1];
        out(3 * i + 2, 3 * j + 1) -= w[0];
      }
    }
  }

  bool wrinkles_;
  Layout layout_;
  std::vector<Cell> cells_;
};

}  // namespace

std::unique_ptr<Element> make_membrane(int id, CellShape shape, const std::vector<int>& nodes, const std::vector<Vec3>& places,
                                       const std::shared_ptr<const MembraneSection>& section, const NodeWarmth& warmth,
                                       BlockStore* blocks) {
  return structural::with_plane_shape(shape, [&]<CellShape S>() -> std::unique_ptr<Element> {
    BlockStore alone;
    const bool wrinkles = section->law.wrinkling.has_value();
    const auto block = (blocks ? *blocks : alone).block<Membranes<S>>(wrinkles ? "wrinkles" : "", wrinkles);
    const auto index = block->add(nodes, places, section, warmth);
    return index ? std::make_unique<BlockMember>(id, block, *index) : nullptr;
  });
}

}  // namespace engrane::elements::membranes

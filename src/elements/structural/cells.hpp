// SPDX-License-Identifier: BSD-3-Clause
// Blocks of cells of one shape, in the plane, round an axis or in space.
#pragma once

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <functional>
#include <numbers>
#include <optional>

#include "elements/structural/cell_kernel.hpp"
#include "elements/structural/make_cell.hpp"

namespace engrane::elements::structural {

/// Cells of one shape; `Axi`: round the y axis.
template <CellShape S, bool Axi>
class Cells final : public Block {
  using Kernel = CellKernel<S, Axi>;
  using Traits = CellTraits<S>;
  using Sample = typename Traits::Sample;
  using Places = typename Kernel::Places;
  using Law = typename Kernel::Law;
  static constexpr int N = Traits::nodes, D = Traits::dimension;
  using Vector = Eigen::Matrix<double, D * N, 1>;
  using Square = Eigen::Matrix<double, D * N, D * N>;
  using Stress = materials::Voigt;

 public:
  Cells() {
    layout_.nodes.assign(N, -1);
    layout_.needs.assign(N, D == 2 ? NodeNeed::in_plane : NodeNeed::translation);
  }

  std::size_t add(const CellPlan& plan) {
    Cell& cell = cells_.emplace_back();
    std::copy_n(plan.nodes.begin(), N, cell.nodes.begin());
    for (Eigen::Index i = 0; i < N; ++i) cell.places.col(i) = plan.places[static_cast<std::size_t>(i)].template head<D>();
    cell.section = plan.section;
    cell.warmth = plan.warmth;
    return cells_.size() - 1;
  }

  std::size_t size() const override { return cells_.size(); }
  const Layout& layout() const override { return layout_; }
  std::span<const int> node_ids(std::size_t e) const override { return cells_[e].nodes; }
  CellShape cell_shape() const override { return S; }
  bool is_linear(std::size_t e) const override { return cells_[e].section->linear; }

  void residual(std::size_t first, std::span<const State> states, std::span<double> r) const override {
    for (std::size_t i = 0; i < states.size(); ++i) {
      typename Kernel::Condensed sum;
      resist(cells_[first + i], states[i], false, sum, r.data() + i * D * N);
    }
  }

  void tangent(std::size_t first, std::span<const State> states, Weights weights, std::span<double> r,
               std::span<double> k) const override {
    for (std::size_t i = 0; i < states.size(); ++i) {
      const Cell& cell = cells_[first + i];
      typename Kernel::Condensed sum;
      resist(cell, states[i], true, sum, r.data() + i * D * N);
      // symmetric, so that rows and columns need no care
      Eigen::Map<Square> tangent(k.data() + i * D * D * N * N);
      tangent = weights.q * sum.tangent;
      if (weights.a != 0) add_mass(cell, weights.a, tangent);
    }
  }

  void constraint_rates(std::size_t, const State&, std::span<double>, std::span<double>, std::span<double>) const override {}

  Energies energies(std::size_t e, const State& state) const override {
    const Cell& cell = cells_[e];
    const CellSection& section = *cell.section;
    const Kernel kernel(cell.places, section.thickness);
    typename Kernel::Condensed sum;
    const Law law = law_of(cell, state);
    const Places moved = displacements(cell, state);
    kernel.condense(law, moved, false, sum);
    Energies energies;
    for (int i = 0; i < kernel.count(); ++i) {
      const double volume = kernel.point(i).volume;
      const auto strain = Kernel::elastic(law, i, Kernel::strain(kernel.deformation(kernel.point(i), sum.moves), law.linear));
      const typename Kernel::Strain stress = law.stiffness * strain;
      energies.strain += volume / 2 * strain.dot(stress);
      if (!law.is_warm) continue;
      // V also depends on the warmth ΔT: its change does the work ∂V/∂ΔT dΔT
      const Sample& s = Kernel::samples()[static_cast<std::size_t>(i)];
      const double held = section.law.held * section.law.expansion[2] * section.law.expansion[2], warmer = rise(cell, state, s);
      energies.strain += volume / 2 * held * warmer * warmer;
      energies.external += volume * (held * warmer - Kernel::reduced(section.law.growth).dot(stress)) * rise_rate(cell, state, s);
    }
    Vector weight;
    energies.potential = energies.strain;
    if (weigh(cell, state, weight)) energies.potential -= weight.dot(moved.reshaped());
    if (section.law.density != 0) {
      Places v;
      for (Eigen::Index i = 0; i < N; ++i) v.col(i) = state.nodes[static_cast<std::size_t>(i)].v.template head<D>();
      if (!v.isZero(0))
        for_each_point(cell, masses(), [&](const Sample& s, double volume) {
          energies.kinetic += section.law.density * volume / 2 * (v * s.value).squaredNorm();
        });
    }
    return energies;
  }

  bool applied(std::size_t e, const State& state, std::span<double> forces) const override {
    Vector weight;
    if (!weigh(cells_[e], state, weight)) return false;
    std::copy_n(weight.data(), D * N, forces.begin());
    return true;
  }

  const std::vector<Field>& fields() const override {
    static const std::vector<Field> all = [] {
      const std::vector<std::string> components = D == 2 ? std::vector<std::string>{"XX", "YY", "ZZ", "XY"}
                                                         : std::vector<std::string>{"XX", "YY", "ZZ", "XY", "YZ", "ZX"};
      const std::vector<std::string> principal =
          D == 2 ? std::vector<std::string>{"1", "2", "ZZ"} : std::vector<std::string>{"1", "2", "3"};
      const int points = static_cast<int>(Kernel::result_samples().size());
      const auto at_points = [points](Named named, std::vector<std::string> of) {
        return Field{std::move(named), Field::Place::point, std::move(of), points};
      };
      return std::vector<Field>{
          at_points(
              {"STRESS", dimension::pressure, D == 2 ? "true stress; ZZ: normal to the plane, or round the axis" : "true stress"},
              components),
          at_points({"STRAIN", dimension::none, "strain of Green and Lagrange, shear half the angle"}, components),
          at_points({"VON_MISES", dimension::pressure, "equivalent stress of von Mises"}, {}),
          at_points({"PRINCIPAL", dimension::pressure,
                     D == 2 ? "principal stresses in the plane, and ZZ" : "principal stresses, the largest first"},
                    principal),
          at_points({"STRAIN_ENERGY_DENSITY", dimension::pressure, "strain energy per volume"}, {})};
    }();
    return all;
  }

  void evaluate_fields(std::size_t e, const State& state, std::span<double> values) const override {
    const Cell& cell = cells_[e];
    constexpr std::size_t width = D == 2 ? 4 : 6;
    const std::vector<AtPoint> points = at_points(cell, state);
    double* out = values.data();
    const auto put = [&out, &points](std::size_t row, const auto& value) {
      for (std::size_t i = 0; i < points.size(); ++i) {
        const auto found = value(points[i]);
        out = std::copy_n(found.data(), row, out);
      }
    };
    put(width, [](const AtPoint& p) { return p.stress; });
    put(width, [](const AtPoint& p) -> Stress {
      return (Stress() << p.strain.template head<3>(), p.strain.template tail<3>() / 2).finished();
    });
    put(1, [](const AtPoint& p) { return std::array{von_mises(p.stress)}; });
    put(3, [](const AtPoint& p) { return principal(p.stress); });
    put(1, [](const AtPoint& p) { return std::array{p.energy}; });
  }

 private:
  struct Cell {
    std::array<int, static_cast<std::size_t>(N)> nodes;
    Places places;
    std::shared_ptr<const CellSection> section;
    std::shared_ptr<const std::vector<Warmth>> warmth;  ///< of each node; none: no change of temperature
  };

  /// Stresses and strains where results are given, in all six components.
  struct AtPoint {
    Stress stress, strain;
    double energy;
  };

  static const std::vector<Sample>& masses() {
    static const auto samples = tabulate<S>(Traits::mass_points());
    return samples;
  }

  static Places displacements(const Cell& cell, const State& state) {
    Places u;
    for (Eigen::Index i = 0; i < N; ++i)
      u.col(i) = state.nodes[static_cast<std::size_t>(i)].x.template head<D>() - cell.places.col(i);
    return u;
  }

  static Law law_of(const Cell& cell, const State& state) {
    const materials::Elasticity& material = cell.section->law;
    Law law{Kernel::reduced(material.stiffness), {}, cell.warmth != nullptr, cell.section->linear};
    for (std::size_t i = 0; law.is_warm && i < Kernel::samples().size(); ++i)
      law.free[i] = rise(cell, state, Kernel::samples()[i]) * Kernel::reduced(material.growth);
    return law;
  }

  /// How much warmer a point is than in the reference configuration, and how fast it gets warmer.
  static double rise(const Cell& cell, const State& state, const Sample& s) {
    return between_nodes(cell, s, [&state](const Warmth& w) { return w.at(state.time); });
  }
  static double rise_rate(const Cell& cell, const State& state, const Sample& s) {
    return between_nodes(cell, s, [&state](const Warmth& w) { return w.rate(state.time); });
  }
  template <class Of>
  static double between_nodes(const Cell& cell, const Sample& s, const Of& of) {
    if (!cell.warmth) return 0;
    double sum = 0;
    for (Eigen::Index i = 0; i < N; ++i) sum += s.value[i] * of((*cell.warmth)[static_cast<std::size_t>(i)]);
    return sum;
  }

  std::vector<AtPoint> at_points(const Cell& cell, const State& state) const {
    const CellSection& section = *cell.section;
    const materials::Elasticity& material = section.law;
    const Kernel kernel(cell.places, section.thickness);
    typename Kernel::Condensed sum;
    kernel.condense(law_of(cell, state), displacements(cell, state), false, sum);
    std::vector<AtPoint> points;
    std::optional<Kernel> others;
    if (Traits::result_points()) others.emplace(cell.places, section.thickness, Kernel::result_samples());
    const Kernel& at = others ? *others : kernel;
    for (int i = 0; i < at.count(); ++i) {
      const auto now = at.deformation(at.point(i), sum.moves);
      AtPoint& p = points.emplace_back();
      p.strain.setZero();
      p.strain(Kernel::components) = Kernel::strain(now, section.linear);
      const double warmer = rise(cell, state, Kernel::result_samples()[static_cast<std::size_t>(i)]);
      Stress elastic = p.strain - warmer * material.expansion;
      const Stress second = material.stiffness * elastic;
      if (section.hypothesis == materials::Hypothesis::plane_stress)
        p.strain[2] = material.transverse.dot(elastic) + warmer * material.expansion[2];
      p.energy = second.dot(elastic) / 2;
      p.stress = section.linear ? second : true_stress(now, second, p.strain[2]);
    }
    return points;
  }

  /// The residual goes to `r`; `sum` has what resists, and its tangent where that is wanted.
  static void resist(const Cell& cell, const State& state, bool wants_tangent, typename Kernel::Condensed& sum, double* r) {
    Eigen::Map<Vector> out(r);
    const Places moved = displacements(cell, state);
    if (wants_tangent || cell.warmth || !moved.isZero(0)) {
      const Kernel kernel(cell.places, cell.section->thickness);
      kernel.condense(law_of(cell, state), moved, wants_tangent, sum);
      out = sum.forces;
    } else {
      out.setZero();  // as it is asked when masses are found
    }
    add_inertia_and_weight(cell, state, out);
  }

  /// `use(sample, volume)` at the points of a rule, in the reference configuration.
  template <class Use>
  static void for_each_point(const Cell& cell, const std::vector<Sample>& samples, const Use& use) {
    for (const Sample& s : samples) {
      const typename Kernel::Square jacobian = s.slope * cell.places.transpose();
      double volume = s.weight * std::abs(jacobian.determinant()) * cell.section->thickness;
      if constexpr (Axi) volume *= 2 * std::numbers::pi * cell.places.row(0).dot(s.value);
      use(s, volume);
    }
  }

  /// Weight on the nodes; false when there is none.
  static bool weigh(const Cell& cell, const State& state, Vector& weight) {
    const double density = cell.section->law.density;
    const Eigen::Matrix<double, D, 1> gravity = state.gravity.template head<D>();
    if (density == 0 || gravity.isZero(0)) return false;
    // round an axis the radius makes one degree more
    static const auto samples = tabulate<S>(Axi ? Traits::mass_points() : Traits::load_points());
    Eigen::Matrix<double, N, 1> share = Eigen::Matrix<double, N, 1>::Zero();
    for_each_point(cell, samples, [&share](const Sample& s, double volume) { share += volume * s.value; });
    for (Eigen::Index i = 0; i < N; ++i) weight.template segment<D>(D * i) = density * share[i] * gravity;
    return true;
  }

  static void add_inertia_and_weight(const Cell& cell, const State& state, Eigen::Map<Vector>& r) {
    const double density = cell.section->law.density;
    if (density == 0) return;
    if (Vector weight; weigh(cell, state, weight)) r -= weight;
    Places a;
    for (Eigen::Index i = 0; i < N; ++i) a.col(i) = state.nodes[static_cast<std::size_t>(i)].a.template head<D>();
    if (a.isZero(0)) return;
    Places inertia = Places::Zero();
    for_each_point(cell, masses(),
                   [&](const Sample& s, double volume) { inertia += density * volume * (a * s.value) * s.value.transpose(); });
    r += inertia.reshaped();
  }

  static void add_mass(const Cell& cell, double factor, Eigen::Map<Square>& k) {
    const double density = cell.section->law.density;
    if (density == 0) return;
    Eigen::Matrix<double, N, N> mass = Eigen::Matrix<double, N, N>::Zero();
    for_each_point(cell, masses(),
                   [&](const Sample& s, double volume) { mass += factor * density * volume * s.value * s.value.transpose(); });
    for (Eigen::Index i = 0; i < N; ++i)
      for (Eigen::Index j = 0; j < N; ++j)
        for (Eigen::Index c = 0; c < D; ++c) k(D * i + c, D * j + c) += mass(i, j);
  }

  static Mat3 tensor(const Stress& s) { return (Mat3() << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2]).finished(); }

  /// σ = F S Fᵀ / det F; in the plane with the stretch along z that the strain there is.
  static Stress true_stress(const typename Kernel::Deformation& d, const Stress& second, double strain_z) {
    Mat3 F = Mat3::Zero();
    F.topLeftCorner<D, D>() = d.F;
    if constexpr (D == 2) F(2, 2) = Axi ? d.hoop : std::sqrt(std::max(1 + 2 * strain_z, 0.0));
    const Mat3 sigma = F * tensor(second) * F.transpose() / F.determinant();
    return (Stress() << sigma.diagonal(), sigma(0, 1), sigma(1, 2), sigma(2, 0)).finished();
  }

  static double von_mises(const Stress& s) {
    const double xy = s[0] - s[1], yz = s[1] - s[2], zx = s[2] - s[0];
    return std::sqrt((xy * xy + yz * yz + zx * zx) / 2 + 3 * s.tail<3>().squaredNorm());
  }

  static std::array<double, 3> principal(const Stress& s) {
    if constexpr (D == 2) {
      const double middle = (s[0] + s[1]) / 2, radius = std::hypot((s[0] - s[1]) / 2, s[3]);
      return {middle + radius, middle - radius, s[2]};
    }
    const Vec3 values = Eigen::SelfAdjointEigenSolver<Mat3>(tensor(s), Eigen::EigenvaluesOnly).eigenvalues();
    return {values[2], values[1], values[0]};
  }

  Layout layout_;
  std::vector<Cell> cells_;
};

template <CellShape S, bool Axi>
std::unique_ptr<Element> add_cell(const CellPlan& plan, BlockStore* blocks) {
  BlockStore alone;
  const auto block = (blocks ? *blocks : alone).block<Cells<S, Axi>>("");
  return std::make_unique<BlockMember>(plan.id, block, block->add(plan));
}

/// Whether the determinants at the points of a rule have the sign of the first of all, in `sign`, and are none of rounding.
template <CellShape S>
bool is_regular(const std::vector<Vec3>& places, const QuadratureRule& points, double& sign) {
  constexpr int D = CellTraits<S>::dimension;
  constexpr double rounding = 1e-12;
  Eigen::Matrix<double, D, CellTraits<S>::nodes> x;
  for (Eigen::Index i = 0; i < x.cols(); ++i) x.col(i) = places[static_cast<std::size_t>(i)].template head<D>();
  const double size = (x.colwise() - x.col(0)).norm();
  for (const QuadraturePoint& p : points) {
    const Eigen::Matrix<double, D, D> jacobian = CellTraits<S>::sample(p).slope * x.transpose();
    const double determinant = jacobian.determinant();
    if (sign == 0) sign = determinant > 0 ? 1 : -1;
    if (!(sign * determinant > rounding * std::pow(size, D))) return false;
  }
  return true;
}

template <CellShape S>
bool is_regular(const std::vector<Vec3>& places) {
  double sign = 0;
  return is_regular<S>(places, CellTraits<S>::stiffness_points(), sign) &&
         is_regular<S>(places, CellTraits<S>::load_points(), sign);
}

}  // namespace engrane::elements::structural

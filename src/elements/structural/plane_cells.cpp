// SPDX-License-Identifier: BSD-3-Clause
#include "elements/structural/plane_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "elements/structural/cell_kernel.hpp"

namespace engrane::elements::structural {

namespace {

using materials::Hypothesis;

/// Cells of N nodes under one hypothesis, in the plane or (`Axi`) round the y axis.
template <int N, bool Axi>
class PlaneCells final : public Block {
  using Kernel = CellKernel<N, Axi>;
  using Traits = CellTraits<N>;
  using Places = typename Kernel::Places;
  using Vector = Eigen::Matrix<double, 2 * N, 1>;
  using Square = Eigen::Matrix<double, 2 * N, 2 * N>;

 public:
  PlaneCells() {
    layout_.nodes.assign(N, -1);
    layout_.needs.assign(N, NodeNeed::in_plane);
  }

  std::size_t add(std::span<const int> nodes, const std::vector<Eigen::Vector2d>& places,
                  std::shared_ptr<const CellSection> section) {
    Cell& cell = cells_.emplace_back();
    std::copy_n(nodes.begin(), N, cell.nodes.begin());
    for (Eigen::Index i = 0; i < N; ++i) cell.places.col(i) = places[static_cast<std::size_t>(i)];
    cell.section = std::move(section);
    return cells_.size() - 1;
  }

  std::size_t size() const override { return cells_.size(); }
  const Layout& layout() const override { return layout_; }
  std::span<const int> node_ids(std::size_t e) const override { return cells_[e].nodes; }
  CellShape cell_shape() const override { return Traits::shape; }
  bool is_linear(std::size_t e) const override { return cells_[e].section->linear; }

  void residual(std::size_t first, std::span<const State> states, std::span<double> r) const override {
    for (std::size_t i = 0; i < states.size(); ++i) {
      const Cell& cell = cells_[first + i];
      typename Kernel::Condensed sum;
      resist(cell, states[i], false, sum);
      Eigen::Map<Vector> out(r.data() + i * 2 * N);
      out = sum.forces;
      add_inertia_and_weight(cell, states[i], out);
    }
  }

  void tangent(std::size_t first, std::span<const State> states, Weights weights, std::span<double> r,
               std::span<double> k) const override {
    for (std::size_t i = 0; i < states.size(); ++i) {
      const Cell& cell = cells_[first + i];
      typename Kernel::Condensed sum;
      resist(cell, states[i], true, sum);
      Eigen::Map<Vector> out(r.data() + i * 2 * N);
      out = sum.forces;
      add_inertia_and_weight(cell, states[i], out);
      // symmetric, so that rows and columns need no care
      Eigen::Map<Square> tangent(k.data() + i * 4 * N * N);
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
    const auto law = Kernel::reduced(section.law.stiffness);
    const Places moved = displacements(cell, state);
    kernel.condense(law, section.linear, moved, false, sum);
    Energies energies;
    for (int i = 0; i < kernel.count(); ++i) {
      const auto strain = Kernel::strain(kernel.deformation(kernel.point(i), sum.moves), section.linear);
      energies.strain += kernel.point(i).volume / 2 * strain.dot(law * strain);
    }
    Vector weight;
    energies.potential = energies.strain;
    if (weigh(cell, state, weight)) energies.potential -= weight.dot(moved.reshaped());
    if (section.law.density != 0) {
      Places v;
      for (Eigen::Index i = 0; i < N; ++i) v.col(i) = state.nodes[static_cast<std::size_t>(i)].v.template head<2>();
      if (!v.isZero(0))
        for_each_point(cell, masses(), [&](const ShapeSample<N>& s, double volume) {
          energies.kinetic += section.law.density * volume / 2 * (v * s.value).squaredNorm();
        });
    }
    return energies;
  }

  bool applied(std::size_t e, const State& state, std::span<double> forces) const override {
    Vector weight;
    if (!weigh(cells_[e], state, weight)) return false;
    std::copy_n(weight.data(), 2 * N, forces.begin());
    return true;
  }

  const std::vector<Field>& fields() const override {
    static const std::vector<Field> all = [] {
      const std::vector<std::string> components{"XX", "YY", "ZZ", "XY"};
      const int points = static_cast<int>(Kernel::points().size());
      const auto at_points = [points](Named named, std::vector<std::string> of) {
        return Field{std::move(named), Field::Place::point, std::move(of), points};
      };
      return std::vector<Field>{
          at_points({"STRESS", dimension::pressure, "true stress; ZZ: normal to the plane, or round the axis"}, components),
          at_points({"STRAIN", dimension::none, "strain of Green and Lagrange, shear half the angle"}, components),
          at_points({"VON_MISES", dimension::pressure, "equivalent stress of von Mises"}, {}),
          at_points({"PRINCIPAL", dimension::pressure, "principal stresses in the plane, and ZZ"}, {"1", "2", "ZZ"}),
          at_points({"STRAIN_ENERGY_DENSITY", dimension::pressure, "strain energy per volume"}, {})};
    }();
    return all;
  }

  void evaluate_fields(std::size_t e, const State& state, std::span<double> values) const override {
    const Cell& cell = cells_[e];
    const CellSection& section = *cell.section;
    const Kernel kernel(cell.places, section.thickness);
    typename Kernel::Condensed sum;
    kernel.condense(Kernel::reduced(section.law.stiffness), section.linear, displacements(cell, state), false, sum);
    const auto points = static_cast<std::size_t>(kernel.count());
    for (std::size_t i = 0; i < points; ++i) {
      const auto now = kernel.deformation(kernel.point(static_cast<int>(i)), sum.moves);
      const auto found = Kernel::strain(now, section.linear);
      Eigen::Vector4d strain = Eigen::Vector4d::Zero();
      strain[0] = found[0];
      strain[1] = found[1];
      strain[3] = found[Kernel::strains - 1];
      if constexpr (Axi) strain[2] = found[2];
      const Eigen::Vector4d second = section.law.stiffness * strain;
      if (section.hypothesis == Hypothesis::plane_stress) strain[2] = section.law.expansion.dot(strain);
      const Eigen::Vector4d stress = section.linear ? second : true_stress(now, second, strain[2]);
      const double middle = (stress[0] + stress[1]) / 2, radius = std::hypot((stress[0] - stress[1]) / 2, stress[3]);
      double* out = values.data();
      const auto put = [&out, points, i](std::initializer_list<double> row) {
        std::copy(row.begin(), row.end(), out + i * row.size());
        out += points * row.size();
      };
      put({stress[0], stress[1], stress[2], stress[3]});
      put({strain[0], strain[1], strain[2], strain[3] / 2});
      put({von_mises(stress)});
      put({middle + radius, middle - radius, stress[2]});
      put({second.dot(strain) / 2});
    }
  }

 private:
  struct Cell {
    std::array<int, static_cast<std::size_t>(N)> nodes;
    Places places;
    std::shared_ptr<const CellSection> section;
  };

  static const std::vector<ShapeSample<N>>& masses() {
    static const auto samples = tabulate<N>(Traits::mass_points());
    return samples;
  }

  static Places displacements(const Cell& cell, const State& state) {
    Places u;
    for (Eigen::Index i = 0; i < N; ++i)
      u.col(i) = state.nodes[static_cast<std::size_t>(i)].x.template head<2>() - cell.places.col(i);
    return u;
  }

  static void resist(const Cell& cell, const State& state, bool wants_tangent, typename Kernel::Condensed& sum) {
    const CellSection& section = *cell.section;
    const Kernel kernel(cell.places, section.thickness);
    kernel.condense(Kernel::reduced(section.law.stiffness), section.linear, displacements(cell, state), wants_tangent, sum);
  }

  /// `use(sample, volume)` at the points of a rule, in the reference configuration.
  template <class Use>
  static void for_each_point(const Cell& cell, const std::vector<ShapeSample<N>>& samples, const Use& use) {
    for (const ShapeSample<N>& s : samples) {
      const Eigen::Matrix2d jacobian = s.slope * cell.places.transpose();
      double volume = s.weight * std::abs(jacobian.determinant()) * cell.section->thickness;
      if constexpr (Axi) volume *= 2 * std::numbers::pi * cell.places.row(0).dot(s.value);
      use(s, volume);
    }
  }

  /// Weight on the nodes; false when there is none.
  static bool weigh(const Cell& cell, const State& state, Vector& weight) {
    const double density = cell.section->law.density;
    const Eigen::Vector2d gravity = state.gravity.template head<2>();
    if (density == 0 || gravity.isZero(0)) return false;
    // round an axis the radius makes one degree more
    static const auto samples = tabulate<N>(Axi ? Traits::mass_points() : Traits::load_points());
    Eigen::Matrix<double, N, 1> share = Eigen::Matrix<double, N, 1>::Zero();
    for_each_point(cell, samples, [&share](const ShapeSample<N>& s, double volume) { share += volume * s.value; });
    for (Eigen::Index i = 0; i < N; ++i) weight.template segment<2>(2 * i) = density * share[i] * gravity;
    return true;
  }

  static void add_inertia_and_weight(const Cell& cell, const State& state, Eigen::Map<Vector>& r) {
    const double density = cell.section->law.density;
    if (density == 0) return;
    if (Vector weight; weigh(cell, state, weight)) r -= weight;
    Places a;
    for (Eigen::Index i = 0; i < N; ++i) a.col(i) = state.nodes[static_cast<std::size_t>(i)].a.template head<2>();
    if (a.isZero(0)) return;
    Places inertia = Places::Zero();
    for_each_point(cell, masses(), [&](const ShapeSample<N>& s, double volume) {
      inertia += density * volume * (a * s.value) * s.value.transpose();
    });
    r += inertia.reshaped();
  }

  static void add_mass(const Cell& cell, double factor, Eigen::Map<Square>& k) {
    const double density = cell.section->law.density;
    if (density == 0) return;
    Eigen::Matrix<double, N, N> mass = Eigen::Matrix<double, N, N>::Zero();
    for_each_point(cell, masses(), [&](const ShapeSample<N>& s, double volume) {
      mass += factor * density * volume * s.value * s.value.transpose();
    });
    for (Eigen::Index i = 0; i < N; ++i)
      for (Eigen::Index j = 0; j < N; ++j)
        for (Eigen::Index c = 0; c < 2; ++c) k(2 * i + c, 2 * j + c) += mass(i, j);
  }

  /// σ = F S Fᵀ / det F, with the stretch along z that the strain there is.
  static Eigen::Vector4d true_stress(const typename Kernel::Deformation& d, const Eigen::Vector4d& S, double strain_z) {
    const double stretch = Axi ? d.hoop : std::sqrt(std::max(1 + 2 * strain_z, 0.0));
    Eigen::Matrix2d second;
    second << S[0], S[3], S[3], S[1];
    const double volume = d.F.determinant() * stretch;
    const Eigen::Matrix2d sigma = d.F * second * d.F.transpose() / volume;
    return {sigma(0, 0), sigma(1, 1), S[2] * stretch * stretch / volume, sigma(0, 1)};
  }

  static double von_mises(const Eigen::Vector4d& s) {
    const double xy = s[0] - s[1], yz = s[1] - s[2], zx = s[2] - s[0];
    return std::sqrt((xy * xy + yz * yz + zx * zx) / 2 + 3 * s[3] * s[3]);
  }

  Layout layout_;
  std::vector<Cell> cells_;
};

template <int N, bool Axi>
std::unique_ptr<Element> add_cell(int id, std::span<const int> nodes, const std::vector<Eigen::Vector2d>& places,
                                  const std::shared_ptr<const CellSection>& section, BlockStore& blocks) {
  const auto block = blocks.block<PlaneCells<N, Axi>>("");
  return std::make_unique<BlockMember>(id, block, block->add(nodes, places, section));
}

/// Whether the determinants at the points of a rule have the sign of the first of all, in `sign`, and are none of rounding.
template <int N>
bool is_regular(const std::vector<Eigen::Vector2d>& places, const std::vector<QuadraturePoint>& points, double& sign) {
  constexpr double rounding = 1e-12;
  Eigen::Matrix<double, 2, N> x;
  for (Eigen::Index i = 0; i < N; ++i) x.col(i) = places[static_cast<std::size_t>(i)];
  const double size = (x.colwise() - x.col(0)).squaredNorm();
  for (const QuadraturePoint& p : points) {
    const Eigen::Matrix2d jacobian = CellTraits<N>::sample(p).slope * x.transpose();
    const double determinant = jacobian.determinant();
    if (sign == 0) sign = determinant > 0 ? 1 : -1;
    if (!(sign * determinant > rounding * size)) return false;
  }
  return true;
}

template <int N>
bool is_regular(const std::vector<Eigen::Vector2d>& places) {
  double sign = 0;
  return is_regular<N>(places, CellTraits<N>::stiffness_points(), sign) &&
         is_regular<N>(places, CellTraits<N>::load_points(), sign);
}

}  // namespace

bool has_area(const std::vector<Eigen::Vector2d>& places) {
  switch (places.size()) {
    case 3:
      return is_regular<3>(places);
    case 6:
      return is_regular<6>(places);
    case 4:
      return is_regular<4>(places);
    default:
      return is_regular<8>(places);
  }
}

std::unique_ptr<Element> make_plane_cell(int id, std::span<const int> nodes, const std::vector<Eigen::Vector2d>& places,
                                         const std::shared_ptr<const CellSection>& section, BlockStore* blocks) {
  BlockStore alone;
  BlockStore& store = blocks ? *blocks : alone;
  const bool axi = section->hypothesis == Hypothesis::axisymmetric;
  switch (nodes.size()) {
    case 3:
      return axi ? add_cell<3, true>(id, nodes, places, section, store) : add_cell<3, false>(id, nodes, places, section, store);
    case 6:
      return axi ? add_cell<6, true>(id, nodes, places, section, store) : add_cell<6, false>(id, nodes, places, section, store);
    case 4:
      return axi ? add_cell<4, true>(id, nodes, places, section, store) : add_cell<4, false>(id, nodes, places, section, store);
    default:
      return axi ? add_cell<8, true>(id, nodes, places, section, store) : add_cell<8, false>(id, nodes, places, section, store);
  }
}

}  // namespace engrane::elements::structural

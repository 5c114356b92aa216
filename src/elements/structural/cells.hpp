// SPDX-License-Identifier: BSD-3-Clause
// Blocks of plane, axisymmetric or solid cells of one shape.
#pragma once

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <functional>
#include <numbers>
#include <optional>

#include "elements/structural/cell_damping.hpp"
#include "elements/structural/cell_kernel.hpp"
#include "elements/structural/cell_recovery.hpp"
#include "elements/structural/columns.hpp"
#include "elements/structural/make_cell.hpp"
#include "math/stress.hpp"

namespace engrane::elements::structural {

/// Block of cells of one shape. `Axi`: axisymmetric about the y axis.
template <CellShape S, bool Axi>
class Cells final : public Block {
  using Kernel = CellKernel<S, Axi>;
  using Traits = CellTraits<S>;
  using Sample = typename Traits::Sample;
  using Places = typename Kernel::Places;
  using Law = typename Kernel::Law;
  using Damping = CellDamping<S, Axi>;
  static constexpr int N = Traits::nodes, D = Traits::dimension;
  using Shape = Eigen::Matrix<double, N, 1>;
  using Stress = materials::Voigt;
  static constexpr int width = D == 2 ? 4 : 6;  ///< components of stress among the results

 public:
  Cells() {
    layout_.nodes.assign(N, -1);
    layout_.needs.assign(N, D == 2 ? NodeNeed::in_plane : NodeNeed::translation);
  }

  std::size_t add(const CellPlan& plan) {
    Cell& cell = cells_.emplace_back();
    std::copy_n(plan.nodes.begin(), N, cell.nodes.begin());
    for (Eigen::Index i = 0; i < N; ++i) column(cell.places, i) = plan.places[static_cast<std::size_t>(i)].template head<D>();
    cell.section = plan.section;
    cell.warmth = plan.warmth;
    cell.rotation = plan.rotation;
    return cells_.size() - 1;
  }

  std::size_t size() const override { return cells_.size(); }
  const Layout& layout() const override { return layout_; }
  std::span<const int> node_ids(std::size_t e) const override { return cells_[e].nodes; }
  CellShape cell_shape() const override { return S; }
  bool keeps_shape() const override { return true; }
  bool sees_remainders() const override { return true; }
  const char* why_not_finite() const override {
    return "is turned inside out, or distorted so far that its forces are no numbers: smaller steps H, loads that grow from "
           "zero (NF), or a finer mesh";
  }
  bool is_linear(std::size_t e) const override { return cells_[e].section->linear; }

  void residual(std::size_t first, std::span<const State> states, std::span<double> r) const override {
    for (std::size_t i = 0; i < states.size(); ++i) resist(cells_[first + i], states[i], r.data() + i * D * N, nullptr, nullptr);
  }

  void tangent(std::size_t first, std::span<const State> states, Weights weights, std::span<double> r,
               std::span<double> k) const override {
    for (std::size_t i = 0; i < states.size(); ++i) {
      const Cell& cell = cells_[first + i];
      double* tangent = k.data() + i * Kernel::nodal * Kernel::nodal;
      resist(cell, states[i], r.data() + i * D * N, &weights, tangent);
      if (weights.a != 0) add_mass(cell, weights.a, Mat3::Identity(), tangent);
      if (cell.rotation && !cell.section->linear) {
        const double speed = cell.rotation->speed_at(states[i].time);
        add_mass(cell, -weights.q * speed * speed, cell.rotation->projection(), tangent);
      }
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
    if (section.law.damping > 0) energies.dissipated = damping_of(cell, state, kernel, sum.moves).power();
    for (int i = 0; i < kernel.count(); ++i) {
      const double volume = kernel.point(i).volume;
      const auto response = Kernel::respond(law, i, kernel.deformation(kernel.point(i), sum.moves));
      energies.strain += volume * response.energy;
      if (!law.is_warm) continue;
      // the strain energy V also depends on ΔT: a change of temperature supplies ∂V/∂ΔT dΔT
      const Sample& s = Kernel::samples()[static_cast<std::size_t>(i)];
      const double heating = volume * rise_rate(cell, state, s);
      if (section.law.neo_hookean) {
        energies.external += heating * response.by_growth * section.law.expansion[0];
        continue;
      }
      const materials::Elasticity material = material_at(cell, s);
      const double held = material.held * material.expansion[2] * material.expansion[2], warmer = rise(cell, state, s);
      energies.strain += volume / 2 * held * warmer * warmer;
      energies.external += heating * (held * warmer - Kernel::reduced(material.growth).dot(response.stress));
    }
    energies.potential = energies.strain;
    const Places v = rates(state);
    if (Places weight; weigh(cell, state.steady_gravity(), weight)) energies.potential -= entries(weight).dot(entries(moved));
    if (Places load; state.varying && weigh(cell, state.varying->acceleration, load))
      energies.external += entries(load).dot(entries(v));
    if (Places outward = zero<Places>(); add_centrifugal(cell, state, outward))
      energies.external += entries(outward).dot(entries(v));
    if (section.law.density != 0 && !entries(v).isZero(0))
      for_each_mass(
          cell, [&](const Shape& shape, double mass) { energies.kinetic += mass / 2 * interpolated(v, shape).squaredNorm(); });
    return energies;
  }

  bool applied(std::size_t e, const State& state, std::span<double> forces) const override {
    auto sum = zero<Places>();
    const bool heavy = weigh(cells_[e], state.gravity, sum), turns = add_centrifugal(cells_[e], state, sum);
    if (heavy || turns) std::copy_n(sum.data(), D * N, forces.begin());
    return heavy || turns;
  }

  const std::vector<Field>& fields() const override {
    static const std::vector<Field> all = [] {
      const std::vector<std::string> components = D == 2 ? std::vector<std::string>{"XX", "YY", "ZZ", "XY"}
                                                         : std::vector<std::string>{"XX", "YY", "ZZ", "XY", "YZ", "ZX"};
      const std::vector<std::string> principal =
          D == 2 ? std::vector<std::string>{"1", "2", "ZZ"} : std::vector<std::string>{"1", "2", "3"};
      const int points = static_cast<int>(Kernel::result_samples().size());
      const auto at_points = [points](Named named, std::vector<std::string> of, bool averaged = false) {
        return Field{std::move(named), Field::Place::point, std::move(of), points, averaged};
      };
      return std::vector<Field>{
          at_points(
              {"STRESS", dimension::pressure, D == 2 ? "true stress; ZZ: normal to the plane, or round the axis" : "true stress"},
              components, true),
          at_points({"STRAIN", dimension::none, "strain of Green and Lagrange, shear half the angle"}, components, true),
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
    put(1, [](const AtPoint& p) { return std::array{von_mises(shown(p.stress))}; });
    put(3, [](const AtPoint& p) { return principal_stresses(shown(p.stress)); });
    put(1, [](const AtPoint& p) { return std::array{p.energy}; });
  }

  int section(std::size_t e) const override { return cells_[e].section->number; }

  const Eigen::MatrixXd* extrapolation() const override {
    static const Eigen::MatrixXd all =
        structural::extrapolation<S>(Traits::result_points() ? *Traits::result_points() : Kernel::points());
    return &all;
  }

  /// With large displacements, the given true stresses are pulled back to second Piola–Kirchhoff stresses at each point.
  StressEnergies stress_energies(std::size_t e, const State& state, std::span<const double> at_nodes) const override {
    const Cell& cell = cells_[e];
    const CellSection& section = *cell.section;
    const auto given = [&at_nodes](Eigen::Index node) {
      return Eigen::Map<const Eigen::Matrix<double, width, 1>>(at_nodes.data() + width * node);
    };
    std::optional<Kernel> kernel;  // cells with modes only; others use the mass points
    if constexpr (Kernel::modes > 0) kernel.emplace(cell.places, section.thickness);
    typename Kernel::Moves moves;
    if constexpr (Kernel::modes > 0)
      moves = moves_of(cell, state, *kernel);
    else
      moves = displacements(cell, state);
    typename Kernel::Moves rates;
    if (section.law.damping > 0) rates = rates_of(cell, state, kernel ? &*kernel : nullptr, moves);
    Eigen::LLT<typename Kernel::Stiffness> moduli(Kernel::reduced(section.law.stiffness));
    const auto energy = [&moduli](const Stress& stress) {
      return moduli.matrixL().solve(Kernel::reduced(stress)).squaredNorm() / 2;
    };
    // integrates the squared difference exactly in straight-sided cells
    const auto& samples = Kernel::modes > 0 ? Kernel::samples() : masses();
    StressEnergies sum;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      std::optional<Kernel> other;
      if constexpr (Kernel::modes == 0) other.emplace(cell.places, section.thickness, std::span(samples).subspan(i, 1));
      const typename Kernel::Point& point = other ? other->point(0) : kernel->point(static_cast<int>(i));
      const AtPoint p = at_point(cell, state, samples[i], other ? *other : *kernel, point, moves, rates);
      if (section.curved) moduli.compute(Kernel::reduced(material_at(cell, samples[i]).stiffness));
      Stress wanted = Stress::Zero();
      for (Eigen::Index n = 0; n < N; ++n) wanted.template head<width>() += samples[i].value[n] * given(n);
      if (!section.linear) {
        const Mat3 back = p.F.inverse();
        wanted = components_of(p.F.determinant() * back * symmetric_tensor(shown(wanted)) * back.transpose());
      }
      sum.stress += point.volume * energy(p.second);
      sum.difference += point.volume * energy(wanted - p.second);
    }
    return sum;
  }

 private:
  struct Cell {
    std::array<int, static_cast<std::size_t>(N)> nodes;
    Places places;
    std::shared_ptr<const CellSection> section;
    NodeWarmth warmth;
    std::shared_ptr<const CellRotation> rotation;  ///< nullptr: it does not rotate
  };

  /// All six components of stress and strain at a point.
  struct AtPoint {
    Stress stress, strain;
    Stress second;  ///< second Piola–Kirchhoff stress; equals `stress` with small displacements
    double energy = 0;
    Mat3 F;  ///< including the third direction; not set with small displacements
  };

  static const std::vector<Sample>& masses() {
    static const auto samples = tabulate<S>(Traits::mass_points());
    return samples;
  }

  static Places displacements(const Cell& cell, const State& state) {
    Places u;
    for (Eigen::Index i = 0; i < N; ++i)
      column(u, i) = state.nodes[static_cast<std::size_t>(i)].x.template head<D>() - column(cell.places, i) +
                     state.nodes.rest(static_cast<std::size_t>(i)).template head<D>();
    return u;
  }

  static Law law_of(const Cell& cell, const State& state) {
    const CellSection& section = *cell.section;
    const materials::Elasticity& material = section.law;
    Law law{{section.linear, material.neo_hookean ? &*material.neo_hookean : nullptr, section.hypothesis},
            {Kernel::reduced(material.stiffness), {}},
            cell.warmth != nullptr};
    const auto& samples = Kernel::samples();
    if (section.curved) {
      for (std::size_t i = 0; i < samples.size(); ++i) {
        const materials::Elasticity here = material_at(cell, samples[i]);
        law.moduli.each.push_back(Kernel::reduced(here.stiffness));
        if (law.is_warm) law.free[i] = expansion(here, rise(cell, state, samples[i]));
      }
    } else {
      for (std::size_t i = 0; law.is_warm && i < samples.size(); ++i)
        law.free[i] = expansion(material, rise(cell, state, samples[i]));
    }
    return law;
  }

  static materials::Elasticity material_at(const Cell& cell, const Sample& s) {
    const std::optional<CurvedLaw>& curved = cell.section->curved;
    if (!curved) return cell.section->law;
    Vec3 place(0, 0, curved->height);
    place.template head<D>() = interpolated(cell.places, s.value);
    return curved->at(place);
  }

  static typename Kernel::Expansion expansion(const materials::Elasticity& material, double rise) {
    return {rise * Kernel::reduced(material.growth), rise * material.expansion[0]};
  }

  /// Damping of a cell whose material has some. `kernel` and `moves` must outlive it.
  static Damping damping_of(const Cell& cell, const State& state, const Kernel& kernel, const typename Kernel::Moves& moves) {
    const double time = cell.section->law.damping;
    typename Kernel::PointModuli moduli = law_of(cell, state).moduli;
    moduli.alike *= time;
    for (typename Kernel::Stiffness& each : moduli.each) each *= time;
    return {kernel, std::move(moduli), cell.section->linear, moves, rates(state)};
  }

  /// Temperature rise at a point over the reference configuration, and its rate.
  static double rise(const Cell& cell, const State& state, const Sample& s) { return rise_at(cell.warmth, s.value, state.time); }
  static double rise_rate(const Cell& cell, const State& state, const Sample& s) {
    return rise_rate_at(cell.warmth, s.value, state.time);
  }

  /// Displacements of the nodes and amplitudes of the modes.
  static typename Kernel::Moves moves_of(const Cell& cell, const State& state, const Kernel& kernel) {
    if constexpr (Kernel::modes == 0) return displacements(cell, state);
    typename Kernel::Condensed sum;
    kernel.condense(law_of(cell, state), displacements(cell, state), false, sum);
    return sum.moves;
  }

  /// Rates of the nodes and the modes of a cell whose material has damping. `kernel`: needed by cells with modes.
  static typename Kernel::Moves rates_of(const Cell& cell, const State& state, const Kernel* kernel,
                                         const typename Kernel::Moves& moves) {
    if constexpr (Kernel::modes == 0) return rates(state);
    return damping_of(cell, state, *kernel, moves).rates();
  }

  /// `at`, `point`: kernel and its point at the sample; `rates`: used only if the material has damping.
  static AtPoint at_point(const Cell& cell, const State& state, const Sample& s, const Kernel& at,
                          const typename Kernel::Point& point, const typename Kernel::Moves& moves,
                          const typename Kernel::Moves& rates) {
    const CellSection& section = *cell.section;
    const materials::Elasticity material = material_at(cell, s);
    const typename Kernel::Deformation now = at.deformation(point, moves);
    const double warmer = rise(cell, state, s);
    AtPoint p;
    p.strain.setZero();
    p.strain(Kernel::components) = Kernel::strain(now, section.linear);
    if (material.neo_hookean) {
      const materials::Response response =
          materials::respond(*material.neo_hookean, section.hypothesis, p.strain, warmer * material.expansion[0]);
      p.second = response.stress;
      p.strain[2] = response.transverse;
      p.energy = response.energy;
    } else {
      const Stress elastic = p.strain - warmer * material.expansion;
      p.second = material.stiffness * elastic;
      if (section.hypothesis == materials::Hypothesis::plane_stress)
        p.strain[2] = material.transverse.dot(elastic) + warmer * material.expansion[2];
      p.energy = p.second.dot(elastic) / 2;
    }
    if (material.damping > 0) {
      Stress rate = Stress::Zero();
      rate(Kernel::components) =
          Kernel::strain_rate(section.linear ? typename Kernel::Deformation{} : now, at.rate(point, rates));
      p.second += material.damping * (material.stiffness * rate);
    }
    p.stress = p.second;
    if (section.linear) return p;
    p.F.setZero();
    p.F.template topLeftCorner<D, D>() = now.F;
    // plane cells: the stretch along z follows from the strain along z
    if constexpr (D == 2) p.F(2, 2) = Axi ? now.hoop : std::sqrt(std::max(1 + 2 * p.strain[2], 0.0));
    p.stress = components_of(p.F * symmetric_tensor(shown(p.second)) * p.F.transpose() / p.F.determinant());
    return p;
  }

  static std::vector<AtPoint> at_points(const Cell& cell, const State& state) {
    const CellSection& section = *cell.section;
    const Kernel kernel(cell.places, section.thickness);
    const typename Kernel::Moves moves = moves_of(cell, state, kernel);
    typename Kernel::Moves rates;
    if (section.law.damping > 0) rates = rates_of(cell, state, &kernel, moves);
    std::vector<AtPoint> points;
    std::optional<Kernel> others;
    if (Traits::result_points()) others.emplace(cell.places, section.thickness, Kernel::result_samples());
    const Kernel& at = others ? *others : kernel;
    for (int i = 0; i < at.count(); ++i)
      points.push_back(
          at_point(cell, state, Kernel::result_samples()[static_cast<std::size_t>(i)], at, at.point(i), moves, rates));
    return points;
  }

  /// Writes the residual to `r` and, unless they are nullptr, the derivatives of the internal forces, times `weights`, to the
  /// row-major `k`.
  static void resist(const Cell& cell, const State& state, double* r, const Weights* weights, double* k) {
    Eigen::Map<Eigen::VectorXd> out(r, D * N);
    const CellSection& section = *cell.section;
    // damped cells with small displacements resist u + τ v as others resist u
    const double ahead = section.linear ? section.law.damping : 0;
    const bool is_damped = !section.linear && section.law.damping > 0;
    Places moved = displacements(cell, state);
    if (ahead > 0) {
      const Places v = rates(state);
      entries(moved) += ahead * entries(v);
    }
    if (k || cell.warmth || is_damped || !entries(moved).isZero(0)) {
      const Kernel kernel(cell.places, section.thickness);
      typename Kernel::Condensed sum;
      kernel.condense(law_of(cell, state), moved, k != nullptr, sum);
      std::copy_n(sum.forces.data(), D * N, r);
      if (k) {
        const double weight = weights->q + ahead * weights->v;
        constexpr std::size_t size = Kernel::nodal;
        for (std::size_t column = 0; column < size; ++column)
          for (std::size_t row = 0; row <= column; ++row)
            k[size * column + row] = k[size * row + column] = weight * sum.tangent[size * column + row];
      }
      if (is_damped) {
        const Damping damping = damping_of(cell, state, kernel, sum.moves);
        damping.add_forces(r);
        if (k) damping.add_tangent(*weights, sum.slopes.data(), k);
      }
    } else {
      out.setZero();  // shortcut for evaluations at rest, as when masses are determined
    }
    add_inertia_and_weight(cell, state, out);
  }

  /// Calls `use(sample, volume)` for the points of a rule, in the reference configuration.
  template <class Use>
  static void for_each_point(const Cell& cell, const std::vector<Sample>& samples, const Use& use) {
    for (const Sample& s : samples) {
      const typename Kernel::Square jacobian = dyads(s.slope, cell.places);
      double volume = s.weight * std::abs(jacobian.determinant()) * cell.section->thickness;
      if constexpr (Axi) volume *= 2 * std::numbers::pi * interpolated(cell.places, s.value)[0];
      use(s, volume);
    }
  }

  /// Nodal weight forces; false if there are none.
  static bool weigh(const Cell& cell, const Vec3& acceleration, Places& weight) {
    const double density = cell.section->law.density;
    const Eigen::Matrix<double, D, 1> gravity = acceleration.template head<D>();
    if (density == 0 || gravity.isZero(0)) return false;
    auto share = zero<Shape>();
    // the points of the mass: a body that falls freely has no stress, whatever the shape of its cells
    for_each_mass(cell, [&](const Shape& shape, double mass) { entries(share) += mass * entries(shape); });
    for (Eigen::Index i = 0; i < N; ++i) column(weight, i) = share[i] * gravity;
    return true;
  }

  /// Lumped nodal masses: the diagonal of the consistent mass matrix, scaled to the mass of the cell (Hinton, Rock and
  /// Zienkiewicz 1976, Earthquake Eng. Struct. Dyn. 4).
  static Shape lumped(const Cell& cell) {
    auto diagonal = zero<Shape>();
    double volume = 0;
    for_each_point(cell, masses(), [&](const Sample& s, double part) {
      for (Eigen::Index i = 0; i < N; ++i) diagonal[i] += part * s.value[i] * s.value[i];
      volume += part;
    });
    entries(diagonal) *= cell.section->law.density * volume / entries(diagonal).sum();
    return diagonal;
  }

  /// Calls `use(shape functions, mass)` for the points that carry the mass: quadrature points, or nodes if masses are lumped.
  template <class Use>
  static void for_each_mass(const Cell& cell, const Use& use) {
    if (cell.section->lumped) {
      const Shape mass = lumped(cell);
      for (Eigen::Index i = 0; i < N; ++i) {
        auto at_node = zero<Shape>();
        at_node[i] = 1;
        use(at_node, mass[i]);
      }
      return;
    }
    const double density = cell.section->law.density;
    for_each_point(cell, masses(), [&](const Sample& s, double volume) { use(s.value, density * volume); });
  }

  static Places rates(const State& state) {
    Places v;
    for (Eigen::Index i = 0; i < N; ++i) column(v, i) = state.nodes[static_cast<std::size_t>(i)].v.template head<D>();
    return v;
  }

  /// Adds ∫ N_i ρ ω² P (x − o) dV, with P the projection normal to the axis and o a point on it. False if there is none.
  static bool add_centrifugal(const Cell& cell, const State& state, Places& forces) {
    if (!cell.rotation || cell.section->law.density == 0) return false;
    const CellRotation& turn = *cell.rotation;
    const double speed = turn.speed_at(state.time);
    const Mat3 across = turn.projection();
    Places arms;
    for (Eigen::Index i = 0; i < N; ++i) {
      Vec3 x = state.nodes[static_cast<std::size_t>(i)].x;
      if (cell.section->linear) x.head<D>() = column(cell.places, i);
      column(arms, i) = (across * (x - turn.point)).template head<D>();
    }
    for_each_mass(cell, [&](const Shape& shape, double mass) {
      add_dyad(speed * speed * mass * interpolated(arms, shape), shape, forces.data());
    });
    return true;
  }

  static void add_inertia_and_weight(const Cell& cell, const State& state, Eigen::Map<Eigen::VectorXd>& r) {
    if (cell.section->law.density == 0) return;
    if (Places weight; weigh(cell, state.gravity, weight)) r -= entries(weight);
    if (auto outward = zero<Places>(); add_centrifugal(cell, state, outward)) r -= entries(outward);
    Places a;
    for (Eigen::Index i = 0; i < N; ++i) column(a, i) = state.nodes[static_cast<std::size_t>(i)].a.template head<D>();
    if (entries(a).isZero(0)) return;
    for_each_mass(cell, [&](const Shape& shape, double mass) { add_dyad(mass * interpolated(a, shape), shape, r.data()); });
  }

  /// Adds v times each shape function.
  static void add_dyad(const Eigen::Matrix<double, D, 1>& v, const Shape& shape, double* to) {
    for (Eigen::Index n = 0; n < N; ++n)
      for (Eigen::Index i = 0; i < D; ++i) to[D * n + i] += shape[n] * v[i];
  }

  /// Adds `factor` times the mass matrix, with `directions` (3 × 3) as its block for unit mass.
  static void add_mass(const Cell& cell, double factor, const Mat3& directions, double* k) {
    if (cell.section->law.density == 0) return;
    std::array<double, static_cast<std::size_t>(N * N)> matrix{};
    for_each_mass(cell, [&](const Shape& shape, double mass) {
      for (Eigen::Index j = 0; j < N; ++j)
        for (Eigen::Index i = 0; i < N; ++i) matrix[static_cast<std::size_t>(N * j + i)] += factor * mass * shape[i] * shape[j];
    });
    for (Eigen::Index j = 0; j < N; ++j)
      for (Eigen::Index i = 0; i < N; ++i)
        for (Eigen::Index b = 0; b < D; ++b)
          for (Eigen::Index a = 0; a < D; ++a)
            k[D * N * (D * j + b) + D * i + a] += matrix[static_cast<std::size_t>(N * j + i)] * directions(a, b);
  }

  /// The components reported as results.
  static std::span<const double> shown(const Stress& s) { return {s.data(), static_cast<std::size_t>(width)}; }

  Layout layout_;
  std::vector<Cell> cells_;
};

template <CellShape S, bool Axi>
std::unique_ptr<Element> add_cell(const CellPlan& plan, BlockStore* blocks) {
  BlockStore alone;
  const auto block = (blocks ? *blocks : alone).block<Cells<S, Axi>>("");
  return std::make_unique<BlockMember>(plan.id, block, block->add(plan));
}

/// Whether the Jacobian determinants at the points of a rule all have the sign `sign` and are above rounding error. A `sign`
/// of 0 is set from the first point.
template <CellShape S>
bool is_regular(const std::vector<Vec3>& places, const std::vector<typename CellTraits<S>::Sample>& samples, double& sign) {
  constexpr int D = CellTraits<S>::dimension;
  constexpr double rounding = 1e-12;
  Eigen::Matrix<double, D, CellTraits<S>::nodes> x;
  double size = 0;
  for (Eigen::Index i = 0; i < x.cols(); ++i) {
    column(x, i) = places[static_cast<std::size_t>(i)].template head<D>();
    size = std::max(size, (column(x, i) - column(x, 0)).norm());
  }
  for (const auto& sample : samples) {
    const Eigen::Matrix<double, D, D> jacobian = dyads(sample.slope, x);
    const double determinant = jacobian.determinant();
    if (sign == 0) sign = determinant > 0 ? 1 : -1;
    if (!(sign * determinant > rounding * std::pow(size, D))) return false;
  }
  return true;
}

template <CellShape S>
bool is_regular(const std::vector<Vec3>& places) {
  static const auto stiffness = tabulate<S>(CellTraits<S>::stiffness_points()), loads = tabulate<S>(CellTraits<S>::load_points());
  double sign = 0;
  return is_regular<S>(places, stiffness, sign) && is_regular<S>(places, loads, sign);
}

}  // namespace engrane::elements::structural

// SPDX-License-Identifier: BSD-3-Clause
// Patch tests: constant stresses are exact on distorted cells, and the nodes inside are in balance.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "elements/materials/neo_hookean.hpp"
#include "elements/structural/plane_cells.hpp"

namespace engrane::elements::structural::plane_cells {
namespace {

/// A patch of distorted cells of one kind on a 2 × 2 square, its inner corner out of the middle: nodes from (x, 0) on.
struct Patch {
  std::vector<std::vector<Eigen::Vector2d>> cells;

  Patch(std::size_t count, double x) {
    const std::vector<Eigen::Vector2d> grid{{0, 0}, {1.1, 0}, {2, 0}, {2, 0.8}, {2, 2}, {0.7, 2}, {0, 2}, {0, 1.2}, {1.3, 0.9}};
    const std::vector<std::vector<int>> quads{{0, 1, 8, 7}, {1, 2, 3, 8}, {8, 3, 4, 5}, {7, 8, 5, 6}};
    for (const std::vector<int>& quad : quads) {
      std::vector<std::vector<int>> all{quad};
      if (count == 3 || count == 6) all = {{quad[0], quad[1], quad[2]}, {quad[0], quad[2], quad[3]}};
      for (const std::vector<int>& corners : all) {
        std::vector<Eigen::Vector2d>& places = cells.emplace_back();
        for (const int i : corners) places.push_back(grid[static_cast<std::size_t>(i)] + Eigen::Vector2d(x, 0));
        for (std::size_t i = 0; count > corners.size() && i < corners.size(); ++i)
          places.emplace_back((places[i] + places[(i + 1) % corners.size()]) / 2);
      }
    }
  }
};

/// What the cells of a patch do together under one deformation.
struct PatchForces {
  std::map<std::pair<long, long>, Eigen::Vector2d> at;  ///< residual of each node, by its place in millionths
  double largest = 0, energy = 0;

  Eigen::Vector2d& node(const Eigen::Vector2d& x) {
    return at.try_emplace({std::lround(1e6 * x[0]), std::lround(1e6 * x[1])}, Eigen::Vector2d::Zero()).first->second;
  }
};

/// Calls `each(element, state)` for every cell.
template <class Move, class Each>
PatchForces forces_of(const Patch& patch, const std::shared_ptr<const CellSection>& of, double rise, const Move& move,
                      const Each& each) {
  PatchForces sum;
  for (const std::vector<Eigen::Vector2d>& places : patch.cells) {
    const auto element = cell(places, of, rise);
    const StateBuffer state = moved(*element, node_map(places), move);
    const auto r = residual_of(*element, state);
    for (std::size_t i = 0; i < places.size(); ++i) {
      const Eigen::Vector2d force(r[6 * i], r[6 * i + 1]);
      sum.largest = std::max(sum.largest, force.norm());
      sum.node(places[i]) += force;
    }
    sum.energy += element->energies(state.view()).strain;
    each(*element, state);
  }
  return sum;
}

/// Checks that the nodes inside the patch from (x, 0) to (x + 2, 2) are in balance.
void expect_balance(const PatchForces& sum, double x, const std::string& what) {
  int inner = 0;
  for (const auto& [place, force] : sum.at) {
    const double left = 1e-6 * static_cast<double>(place.first) - x, low = 1e-6 * static_cast<double>(place.second);
    if (std::min({left, low, 2 - left, 2 - low}) < 1e-3) continue;
    ++inner;
    EXPECT_LT(force.norm(), 1e-12 * young) << what;
  }
  EXPECT_GT(sum.largest, 0.1) << what;
  EXPECT_GE(inner, 1);
}

/// A stress without forces in the middle of a patch: the nodes where distorted cells meet stay in balance. Warm or not.
TEST(CellPatches, OfDistortedCellsAreInBalance) {
  Eigen::Matrix2d slope;
  slope << 0.03, -0.02, 0.07, 0.05;
  for (const Hypothesis hypothesis : {Hypothesis::plane_stress, Hypothesis::plane_strain})
    for (const Kind kind :
         {Kind{true}, Kind{false}, Kind{false, true}, Kind{true, false, false, 0, true}, Kind{false, true, false, 0, true}})
      for (const std::size_t count : {3U, 4U, 6U, 8U}) {
        const auto move = [&](const Eigen::Vector2d& x) { return Eigen::Vector2d(slope * x); };
        const auto none = [](const Element&, const StateBuffer&) {};
        const PatchForces sum = forces_of({count, 0}, section(hypothesis, kind), kind.warm ? 60 : 0, move, none);
        expect_balance(sum, 0, name_of(count, hypothesis, kind));
      }
}

/// Round an axis the strains that are in balance everywhere are u = c x, v = d y (with equal stresses along the radius and round
/// the axis): inner nodes of distorted patches are in balance, beside the axis and at it, the stresses are those of the law at
/// all points, and the energy is that of the ring. The ends are pushed by the resultant of the stress along the axis.
TEST(CellPatches, RoundAnAxisAreExact) {
  constexpr double c = 0.06, d = -0.04, rise = 60;
  const auto move = [](const Eigen::Vector2d& x) { return Eigen::Vector2d(c * x[0], d * x[1]); };
  for (const double inside : {0.0, 0.7})
    for (const Kind kind : {Kind{true}, Kind{false}, Kind{false, true}, Kind{true, false, false, 0, true},
                            Kind{false, false, false, 0, true}, Kind{false, true, false, 0, true}})
      for (const std::size_t count : {3U, 4U, 6U, 8U}) {
        const std::string name = name_of(count, Hypothesis::axisymmetric, kind);
        const auto of = section(Hypothesis::axisymmetric, kind);
        // second Piola–Kirchhoff stress and energy of the law
        const double growth = kind.warm ? expansion * rise : 0;
        materials::Voigt strain = materials::Voigt::Zero();
        strain.head<3>() << c, d, c;
        if (!kind.linear) strain.head<3>() += strain.head<3>().cwiseAbs2() / 2;
        materials::Voigt elastic = strain;
        elastic.head<3>().array() -= growth;
        materials::Voigt second = of->law.stiffness * elastic;
        double energy = second.dot(elastic) / 2;
        if (kind.rubber) {
          const auto found = materials::respond(*of->law.neo_hookean, Hypothesis::solid, strain, growth);
          second = found.stress;
          energy = found.energy;
        }
        const Vec3 stretch = kind.linear ? Vec3::Ones() : Vec3(1 + c, 1 + d, 1 + c);
        const Vec3 nominal = stretch.cwiseProduct(second.head<3>()), sigma = nominal.cwiseProduct(stretch) / stretch.prod();
        const PatchForces sum =
            forces_of({count, inside}, of, growth / expansion, move, [&](const Element& element, const StateBuffer& state) {
              const Eigen::MatrixXd stress = field_of(element, state, "STRESS");
              for (Eigen::Index p = 0; p < stress.rows(); ++p) {
                for (Eigen::Index k = 0; k < 3; ++k) EXPECT_NEAR(stress(p, k), sigma[k], 1e-12 * young) << name;
                EXPECT_NEAR(stress(p, 3), 0, 1e-12 * young) << name;
              }
            });
        expect_balance(sum, inside, name);
        const double outside = inside + 2, area = std::numbers::pi * (outside * outside - inside * inside);
        EXPECT_NEAR(sum.energy, 2 * area * energy, 1e-12 * young * area) << name;
        double top = 0;
        for (const auto& [place, force] : sum.at)
          if (place.second == 2'000'000) top += force[1];
        EXPECT_NEAR(top, area * nominal[1], 1e-12 * young * area) << name;
      }
}

}  // namespace
}  // namespace engrane::elements::structural::plane_cells

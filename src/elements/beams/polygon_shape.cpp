// SPDX-License-Identifier: BSD-3-Clause
// Torsion and shear of arbitrary polygons: Laplace's equation by boundary elements. The warping is singular at corners; panels
// graded geometrically towards them keep the error below about 2e-5.
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>

#include "elements/beams/section_shape.hpp"

namespace engrane::elements::beams {

namespace {

using Vec2 = SectionShape::Vec2;
using Mat2 = SectionShape::Mat2;
using Index = Eigen::Index;

constexpr Index order = 6;  // nodes per panel, at the Gauss points
using Powers = Eigen::Matrix<double, order, 1>;

/// Gauss points on [−1, 1] and their weights.
struct Rule {
  Powers place, weight;
  Eigen::Matrix<double, order, order> lagrange;  ///< (k, j): coefficient of t^k in the Lagrange polynomial of node j

  Rule() {
    place << -0.9324695142031521, -0.6612093864662645, -0.2386191860831969, 0.2386191860831969, 0.6612093864662645,
        0.9324695142031521;
    weight << 0.1713244923791703, 0.3607615730481386, 0.4679139345726910, 0.4679139345726910, 0.3607615730481386,
        0.1713244923791703;
    Eigen::Matrix<double, order, order> powers;
    for (Index k = 0; k < order; ++k) powers.col(k) = place.array().pow(static_cast<double>(k));
    lagrange = powers.inverse();
  }
};

/// Straight part of the boundary; the section is on its left.
struct Panel {
  Vec2 middle, along;  ///< midpoint; unit tangent
  double half;         ///< half its length
};

std::vector<Panel> panels_of(const std::vector<Loop>& loops) {
  std::size_t sides = 0;
  for (const Loop& loop : loops) sides += loop.size();
  constexpr std::size_t most_unknowns = 900;  // 40 ms
  constexpr double ratio = 0.25;
  const auto levels = std::clamp<std::size_t>(most_unknowns / order / sides / 2, 1, 5) - 1;
  std::vector<double> cuts = {0};  // of the first half of a side, then mirrored
  for (std::size_t k = levels; k > 0; --k) cuts.push_back(0.5 * std::pow(ratio, static_cast<double>(k)));
  cuts.push_back(0.5);
  for (std::size_t i = cuts.size() - 1; i-- > 0;) cuts.push_back(1 - cuts[i]);
  std::vector<Panel> panels;
  for (const Loop& loop : loops)
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vec2 from = loop[i], side = loop[(i + 1) % loop.size()] - from;
      for (std::size_t k = 0; k + 1 < cuts.size(); ++k)
        panels.push_back(
            {from + (cuts[k] + cuts[k + 1]) / 2 * side, side.normalized(), (cuts[k + 1] - cuts[k]) / 2 * side.norm()});
    }
  return panels;
}

/// Quadrature points, weights and outward normals of a boundary. Converts integrals over the section to boundary integrals.
class Boundary {
 public:
  explicit Boundary(const std::vector<Loop>& loops) : panels_(panels_of(loops)) {
    const auto count = static_cast<Index>(panels_.size()) * order;
    at_.resize(2, count), normal_.resize(2, count), weight_.resize(count);
    for (Index i = 0; i < count; ++i) {
      const Panel& panel = panels_[static_cast<std::size_t>(i / order)];
      at_.col(i) = panel.middle + panel.half * rule_.place[i % order] * panel.along;
      normal_.col(i) = Vec2(panel.along[1], -panel.along[0]);
      weight_[i] = panel.half * rule_.weight[i % order];
    }
    area_ = (at_.cwiseProduct(normal_) * weight_).sum() / 2;
    const Eigen::VectorXd outward = at_.cwiseProduct(normal_).colwise().sum();
    const Vec2 centroid = at_ * outward.cwiseProduct(weight_) / (3 * area_);
    at_.colwise() -= centroid;
    for (Panel& panel : panels_) panel.middle -= centroid;
    outward_ = at_.cwiseProduct(normal_).colwise().sum().transpose().cwiseProduct(weight_);
    centroid_ = centroid;
  }

  Index size() const { return weight_.size(); }
  Vec2 at(Index i) const { return at_.col(i); }  ///< relative to the centroid
  Vec2 normal(Index i) const { return normal_.col(i); }
  const Eigen::VectorXd& weight() const { return weight_; }
  double area() const { return area_; }
  const Vec2& centroid() const { return centroid_; }

  /// ∫ f dA of a homogeneous polynomial of degree `degree`, from its values on the boundary.
  template <class F>
  double integral(int degree, const F& f) const {
    double sum = 0;
    for (Index i = 0; i < size(); ++i) sum += f(at(i)) * outward_[i];
    return sum / (degree + 2);
  }
  /// ∫ r h dA of a harmonic function with boundary values `h` and normal derivatives `slope`: Green's identity with r |r|²/8.
  Vec2 moment(const Eigen::VectorXd& h, const Eigen::VectorXd& slope) const {
    Vec2 sum = Vec2::Zero();
    for (Index i = 0; i < size(); ++i) {
      const Vec2 r = at(i), n = normal(i);
      const double square = r.squaredNorm();
      sum += weight_[i] / 8 * (h[i] * (square * n + 2 * r.dot(n) * r) - slope[i] * square * r);
    }
    return sum;
  }

  /// Boundary values of the harmonic functions with the given normal derivatives, one per column, each up to a constant. Solves
  /// ½ u + ∫ u ∂G/∂n ds = ∫ G ∂u/∂n ds with G = −log |r|/2π.
  Eigen::MatrixXd harmonic(const Eigen::MatrixXd& slopes) const {
    Eigen::MatrixXd on_values(size(), size()), on_slopes(size(), size());
    for (Index p = 0; p < size() / order; ++p)
      for (Index i = 0; i < size(); ++i) {
        const Parts parts = integrals(panels_[static_cast<std::size_t>(p)], at(i), i / order == p);
        on_values.block<1, order>(i, order * p) = -parts.slope.transpose();
        on_slopes.block<1, order>(i, order * p) = parts.value.transpose();
      }
    on_values.diagonal().array() += 0.5;
    // fix the constant: zero mean along the boundary
    on_values.rowwise() += weight_.transpose() / weight_.sum();
    return on_values.partialPivLu().solve(on_slopes * slopes);
  }

 private:
  /// ∫ N_j G ds and −∫ N_j ∂G/∂n ds over a panel.
  struct Parts {
    Powers value, slope;
  };

  /// Integrals over a panel for the collocation point `seen`; `own`: the point lies on the panel. With t along the panel and z
  /// the collocation point, both scaled by half the panel length, ∫ t^k/(t − z) dt and ∫ t^k log |t − z| dt have closed forms.
  /// Far from the panel the Gauss rule is used.
  Parts integrals(const Panel& panel, const Vec2& seen, bool own) const {
    const Vec2 from = (seen - panel.middle) / panel.half;
    const double s = from.dot(panel.along), aside = own ? 0 : -from.dot(Vec2(panel.along[1], -panel.along[0]));
    const std::complex<double> z(s, aside);
    constexpr double two_pi = 2 * std::numbers::pi;
    Parts parts;
    constexpr double far = 4;
    if (std::abs(z) > far) {
      for (Index j = 0; j < order; ++j) {
        const std::complex<double> arm = rule_.place[j] - z;
        parts.value[j] = -rule_.weight[j] * panel.half * std::log(std::abs(arm) * panel.half) / two_pi;
        parts.slope[j] = rule_.weight[j] * (1.0 / arm).imag() / two_pi;
      }
      return parts;
    }
    const double log_1 = std::log(std::abs(1.0 - z)), log_0 = std::log(std::abs(-1.0 - z));
    double angle = 0;  // subtended by the panel at the collocation point
    if (aside != 0) angle = std::copysign(std::atan2(1 - s, std::abs(aside)) + std::atan2(1 + s, std::abs(aside)), aside);
    std::complex<double> pole(log_1 - log_0, angle);
    Powers values, slopes;
    for (Index k = 0; k < order; ++k) {
      const double even = k % 2 == 0 ? 1 : -1, k_1 = static_cast<double>(k + 1);  // (−1)^k
      slopes[k] = pole.imag();
      pole = z * pole + (1 + even) / k_1;  // ∫ t^(k+1)/(t − z) dt
      values[k] = (log_1 + even * log_0 - pole.real() + (1 + even) * std::log(panel.half)) / k_1;
    }
    parts.value = -panel.half / two_pi * (rule_.lagrange.transpose() * values);
    parts.slope = rule_.lagrange.transpose() * slopes / two_pi;
    return parts;
  }

  Rule rule_;
  std::vector<Panel> panels_;
  Eigen::Matrix2Xd at_, normal_;
  Eigen::VectorXd weight_, outward_;
  double area_ = 0;
  Vec2 centroid_;
};

}  // namespace

SectionShape polygon_shape(std::vector<Loop> loops, double poisson) {
  const Boundary boundary(loops);
  SectionShape shape;
  shape.area = boundary.area();
  for (Index i = 0; i < 2; ++i)
    for (Index j = 0; j < 2; ++j) shape.moments(i, j) = boundary.integral(2, [i, j](const Vec2& r) { return r[i] * r[j]; });
  shape.outline = std::move(loops.front());
  for (Vec2& corner : shape.outline) corner -= boundary.centroid();

  // Normal derivatives of the warping ω for unit twist (Timoshenko and Goodier 1970, art. 109), and of the harmonic part of the
  // axial displacement for unit shear forces along axes 2 and 3, times E; its particular solution is −(c·r) r²/4 (Cowper 1966)
  const Mat2 inverse = shape.moments.inverse();  // c = inverse · V
  Eigen::MatrixXd slopes(boundary.size(), 3);
  for (Index i = 0; i < boundary.size(); ++i) {
    const Vec2 r = boundary.at(i), n = boundary.normal(i);
    slopes(i, 0) = r[1] * n[0] - r[0] * n[1];
    for (Index k = 0; k < 2; ++k) {
      const Vec2 c = inverse.col(k);
      const Vec2 across = c.dot(r) * r - r.squaredNorm() / 2 * c;  // −E/ν times the Poisson contraction per unit length
      const Vec2 particular = -(r.squaredNorm() * c + 2 * c.dot(r) * r) / 4;
      slopes(i, 1 + k) = n.dot(poisson * across - particular);
    }
  }
  const Eigen::MatrixXd values = boundary.harmonic(slopes);
  shape.torsion = shape.moments.trace() - (values.col(0).cwiseProduct(slopes.col(0))).dot(boundary.weight());
  const Vec2 tilt = inverse * boundary.moment(values.col(0), slopes.col(0));
  shape.shear_center = Vec2(-tilt[1], tilt[0]);

  // E times the shear strains for unit forces: the mean slope of the axial displacement less the mean Poisson contraction
  Mat2 shears;
  for (Index k = 0; k < 2; ++k) {
    const Vec2 c = inverse.col(k);
    Vec2 sum = boundary.moment(values.col(1 + k), slopes.col(1 + k));
    for (Index i = 0; i < 2; ++i)
      sum[i] -= boundary.integral(4, [i, &c](const Vec2& r) { return r[i] * c.dot(r) * r.squaredNorm() / 4; });
    shears.col(k) = inverse * sum - poisson / shape.area * (shape.moments * c - shape.moments.trace() / 2 * c);
  }
  shears = (shears + shears.transpose()).eval() / 2;
  shape.shear_factors = 2 * (1 + poisson) / shape.area * shears.inverse();
  return shape;
}

}  // namespace engrane::elements::beams

// SPDX-License-Identifier: BSD-3-Clause
#include "elements/membranes/volume_shares.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>

namespace engrane::elements::membranes {

VolumeShares::VolumeShares(std::size_t nodes, bool rim, std::vector<Multiplier> multipliers)
    : rim_(rim), samples_(structural::face_samples(!rim, nodes)) {
  layout_.nodes.assign(nodes, -1);
  layout_.needs.assign(nodes, NodeNeed::translation);
  layout_.multipliers = std::move(multipliers);
  layout_.shares_multipliers = true;
}

std::size_t VolumeShares::add(Piece piece) {
  pieces_.push_back(std::move(piece));
  return pieces_.size() - 1;
}

std::vector<Vec3> VolumeShares::places(const Piece& piece, const State& state) const {
  std::vector<Vec3> x;
  for (std::size_t i = 0; i < layout_.nodes.size(); ++i) x.push_back(state.nodes[i].x - piece.origin);
  return x;
}

/// Integrates ⅓ x·(a × b), which is linear in each of x, a = ∂x/∂ξ and b = ∂x/∂η.
void VolumeShares::add_cell(const Piece&, const std::vector<Vec3>& nodes, bool second, Derivatives& out) const {
  for (const structural::FaceSample& s : samples_) {
    Vec3 x = Vec3::Zero(), a = x, b = x;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      x += s.value[i] * nodes[i];
      a += s.slope[i][0] * nodes[i];
      b += s.slope[i][1] * nodes[i];
    }
    const double w = s.weight / 3;
    const Vec3 of_x = w * a.cross(b), of_a = w * b.cross(x), of_b = w * x.cross(a);
    const Mat3 X = w * skew(x), A = w * skew(a), B = w * skew(b);
    out.value += x.dot(of_x);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const auto row = static_cast<Eigen::Index>(3 * i);
      const double n = s.value[i], f = s.slope[i][0], g = s.slope[i][1];
      out.gradient.segment<3>(row) += n * of_x + f * of_a + g * of_b;
      for (std::size_t j = 0; second && j < nodes.size(); ++j) {
        const double nj = s.value[j], fj = s.slope[j][0], gj = s.slope[j][1];
        out.hessian.block<3, 3>(row, static_cast<Eigen::Index>(3 * j)) +=
            (nj * f - n * fj) * B + (n * gj - nj * g) * A + (g * fj - f * gj) * X;
      }
    }
  }
}

/// Integrates ⅓ (m·x) m·(x × x′).
void VolumeShares::add_rim(const Piece& piece, const std::vector<Vec3>& nodes, bool second, Derivatives& out) const {
  const Vec3& m = piece.normal;
  for (const structural::FaceSample& s : samples_) {
    Vec3 x = Vec3::Zero(), along = x;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      x += s.value[i] * nodes[i];
      along += s.slope[i][0] * nodes[i];
    }
    const double w = s.weight / 3, height = m.dot(x), swept = m.dot(x.cross(along));
    const Vec3 of_x = along.cross(m), of_along = m.cross(x);
    out.value += w * height * swept;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const auto row = static_cast<Eigen::Index>(3 * i);
      const Vec3 q = s.value[i] * of_x + s.slope[i][0] * of_along;
      out.gradient.segment<3>(row) += w * (s.value[i] * swept * m + height * q);
      for (std::size_t j = 0; second && j < nodes.size(); ++j) {
        const Vec3 qj = s.value[j] * of_x + s.slope[j][0] * of_along;
        out.hessian.block<3, 3>(row, static_cast<Eigen::Index>(3 * j)) +=
            w * (s.value[i] * m * qj.transpose() + s.value[j] * q * m.transpose() +
                 height * (s.slope[i][0] * s.value[j] - s.value[i] * s.slope[j][0]) * skew(m));
      }
    }
  }
}

void VolumeShares::evaluate(const Piece& piece, const std::vector<Vec3>& x, bool second, Derivatives& out) const {
  const auto size = static_cast<Eigen::Index>(3 * x.size());
  out.value = 0;
  out.gradient.setZero(size);
  if (second) out.hessian.setZero(size, size);
  if (rim_)
    add_rim(piece, x, second, out);
  else
    add_cell(piece, x, second, out);
}

double VolumeShares::volume(const Piece& piece, const std::vector<Vec3>& x) const {
  std::vector<Vec3> from = x;
  for (Vec3& place : from) place -= piece.origin;
  Derivatives d;
  evaluate(piece, from, false, d);
  return d.value;
}

void VolumeShares::residual(std::size_t first, std::span<const State> states, std::span<double> r) const {
  const std::size_t n = 3 * layout_.nodes.size() + 1;
  Derivatives d;
  for (std::size_t e = 0; e < states.size(); ++e) {
    const Piece& piece = pieces_[first + e];
    evaluate(piece, places(piece, states[e]), false, d);
    const double force = states[e].multipliers[0] / piece.area;
    double* out = r.data() + e * n;
    for (std::size_t i = 0; i + 1 < n; ++i) out[i] = -force * d.gradient[static_cast<Eigen::Index>(i)];
    out[n - 1] = -d.value / piece.area;
  }
}

void VolumeShares::tangent(std::size_t first, std::span<const State> states, Weights weights, std::span<double> r,
                           std::span<double> k) const {
  residual(first, states, r);
  const std::size_t n = 3 * layout_.nodes.size() + 1;
  Derivatives d;
  for (std::size_t e = 0; e < states.size(); ++e) {
    const Piece& piece = pieces_[first + e];
    evaluate(piece, places(piece, states[e]), true, d);
    using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const auto size = static_cast<Eigen::Index>(n);
    Eigen::Map<Square> out(k.data() + e * n * n, size, size);
    out.topLeftCorner(size - 1, size - 1) = -weights.q * states[e].multipliers[0] / piece.area * d.hessian;
    out.topRightCorner(size - 1, 1) = -weights.multipliers / piece.area * d.gradient;
    out.bottomLeftCorner(1, size - 1) = -weights.q / piece.area * d.gradient.transpose();
    out(size - 1, size - 1) = 0;
  }
}

void VolumeShares::constraint_rates(std::size_t e, const State& state, std::span<double> phi, std::span<double> rate,
                                    std::span<double> second) const {
  const Piece& piece = pieces_[e];
  Derivatives d;
  evaluate(piece, places(piece, state), true, d);
  Eigen::VectorXd v(d.gradient.size()), a = v;
  for (std::size_t i = 0; i < layout_.nodes.size(); ++i) {
    v.segment<3>(static_cast<Eigen::Index>(3 * i)) = state.nodes[i].v;
    a.segment<3>(static_cast<Eigen::Index>(3 * i)) = state.nodes[i].a;
  }
  phi[0] = d.value / piece.area;
  rate[0] = d.gradient.dot(v) / piece.area;
  second[0] = (d.gradient.dot(a) + v.dot(d.hessian * v)) / piece.area;
}

}  // namespace engrane::elements::membranes

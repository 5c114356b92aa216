// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "model/templated_element.hpp"

namespace engrane {

/// Six constraints that hold a slave node rigidly to a master at a fixed offset (in the master's material axes). The
/// multipliers are the force and moment on the slave, at the slave, in the master's axes.
///
/// Orientation: the relative rotation's Rodrigues vector w = 2 tan(θ/2) n = 2 axial(A − Aᵀ)/(1 + tr A), A = R_masterᵀ R_slave.
/// Unlike the antisymmetric part alone (2 sinθ n), it has no zero at half a turn.
class RigidLink final : public TemplatedElement<RigidLink, 2, 18> {
 public:
  RigidLink(int id, int master, int slave, const Vec3& offset) : TemplatedElement(id), offset_(offset) {
    Layout layout;
    layout.nodes = {master, slave};
    layout.needs = {NodeNeed::both, NodeNeed::both};
    for (const char* c : {"X", "Y", "Z"})
      layout.multipliers.push_back({std::string("FORCE_") + c, dimension::length, "force on the slave, master's axes"});
    for (const char* c : {"X", "Y", "Z"})
      layout.multipliers.push_back({std::string("MOMENT_") + c, dimension::angle, "moment on the slave, master's axes"});
    set_layout(std::move(layout));
  }

  template <class T>
  void evaluate(const Motion<T, 2>& motion, const State&, Balance<T, 2>& balance) const {
    const auto& a = motion.node[0];
    const auto& b = motion.node[1];
    const Vec3T<T> arm = rotate_back(a.R, Vec3T<T>(b.x - a.x));
    const Vec3T<T> w = rodrigues(a.R, b.R);
    Vec3T<T> f, m;
    for (int c = 0; c < 3; ++c) {
      f[c] = balance.constraint(c, arm[c] - offset_[c]);
      m[c] = balance.constraint(3 + c, w[c]);
    }
    const Vec3T<T> force = rotate(a.R, f);
    balance.force(0, force);
    balance.force(1, Vec3T<T>(-force));
    // δw = (δθ_B − δθ_A) + ½ w×(δθ_B + δθ_A) + ¼ w w·(δθ_B − δθ_A), composition of Rodrigues vectors
    const Vec3T<T> even = m + w * (dot(w, m) * 0.25), odd = cross(w, m) * T(0.5);
    balance.moment(0, Vec3T<T>(even + odd + cross(arm, f)));
    balance.moment(1, Vec3T<T>(odd - even));
  }

 private:
  template <class T>
  static Vec3T<T> rodrigues(const Mat3T<T>& R_a, const Mat3T<T>& R_b) {
    const auto product = [&](int i, int j) { return R_a(0, i) * R_b(0, j) + R_a(1, i) * R_b(1, j) + R_a(2, i) * R_b(2, j); };
    const T factor = T(2) / (T(1) + product(0, 0) + product(1, 1) + product(2, 2));
    return {(product(2, 1) - product(1, 2)) * factor, (product(0, 2) - product(2, 0)) * factor,
            (product(1, 0) - product(0, 1)) * factor};
  }

  Vec3 offset_;
};

}  // namespace engrane

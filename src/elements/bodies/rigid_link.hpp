// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "elements/common/rotation_vector.hpp"
#include "model/templated_element.hpp"

namespace engrane::elements::bodies {

/// Six constraints that fix a slave node to a master at a constant offset (in the master's material axes). The multipliers are
/// the force and moment on the slave, at the slave, in the master's axes.
///
/// Orientation is constrained by the rotation vector of R_masterᵀ R_slave, whose only zero is coincidence.
class RigidLink final : public TemplatedElement<RigidLink, 2, 18> {
 public:
  RigidLink(int id, int master, int slave, const Vec3& offset) : TemplatedElement(id), offset_(offset) {
    Layout layout;
    layout.nodes = {master, slave};
    layout.needs = {NodeNeed::both, NodeNeed::both};
    for (const char* c : {"X", "Y", "Z"})
      layout.multipliers.push_back(
          {std::string("FORCE_") + c, dimension::length, "force on the slave, master's axes", Role::force});
    for (const char* c : {"X", "Y", "Z"})
      layout.multipliers.push_back(
          {std::string("MOMENT_") + c, dimension::angle, "moment on the slave, master's axes", Role::moment});
    set_layout(std::move(layout));
  }

  template <class T>
  void evaluate(const Motion<T, 2>& motion, const State&, Balance<T, 2>& balance) const {
    const auto& a = motion.node[0];
    const auto& b = motion.node[1];
    const Vec3T<T> arm = rotate_back(a.R, Vec3T<T>(b.x - a.x));
    Mat3T<T> relative;  // of the slave relative to the master, in the master's axes
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) relative(i, j) = a.R(0, i) * b.R(0, j) + a.R(1, i) * b.R(1, j) + a.R(2, i) * b.R(2, j);
    const auto turn = RotationVector<T>::of(relative);
    Vec3T<T> f, m;
    for (int c = 0; c < 3; ++c) {
      f[c] = balance.constraint(c, arm[c] - offset_[c]);
      m[c] = balance.constraint(3 + c, turn.theta[c]);
    }
    const Vec3T<T> force = rotate(a.R, f), moment = turn.moment(m);
    balance.force(0, force);
    balance.force(1, Vec3T<T>(-force));
    balance.moment(0, Vec3T<T>(moment + cross(arm, f)));
    balance.moment(1, Vec3T<T>(-rotate_back(relative, moment)));
  }

 private:
  Vec3 offset_;
};

}  // namespace engrane::elements::bodies

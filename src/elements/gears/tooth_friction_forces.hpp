// SPDX-License-Identifier: BSD-3-Clause
// Separation and friction of ToothContact, in numbers of any kind. Included by tooth_contact.hpp only.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

namespace engrane::elements::gears {

/// Where two toothed bodies meet: from the nodes to the point midway between the two contact points, and the directions there.
template <class T>
struct ToothMeeting {
  Vec3T<T> arm_a, arm_b;
  Vec3T<T> across, normal;  ///< means of η₂ and η₃
  Vec3T<T> v_a, v_b, spin_a, spin_b;

  ToothMeeting(const Motion<T, 2>& motion, const ToothedSide<T>& a, const ToothedSide<T>& b, const Vec3T<T>& gap) {
    for (int k = 0; k < 3; ++k) {
      arm_a[k] = a.arm[k] - 0.5 * gap[k];
      arm_b[k] = b.arm[k] + 0.5 * gap[k];
      across[k] = 0.5 * (a.eta_2[k] + b.eta_2[k]);
      normal[k] = 0.5 * (a.eta_3[k] + b.eta_3[k]);
    }
    const auto& node_a = motion.node[0];
    const auto& node_b = motion.node[1];
    v_a = node_a.v;
    v_b = node_b.v;
    spin_a = rotate(node_a.R, node_a.W);
    spin_b = rotate(node_b.R, node_b.W);
  }
  /// Velocity of A relative to B at an offset from the meeting point.
  Vec3T<T> slip(const Vec3T<T>& offset) const {
    return v_a + cross(spin_a, Vec3T<T>(arm_a + offset)) - v_b - cross(spin_b, Vec3T<T>(arm_b + offset));
  }
};

template <class T>
Vec3T<T> direction_of(const Vec3T<T>& v) {
  using std::sqrt;
  return v * T(1 / sqrt(dot(v, v)));
}

/// A pair of flanks that touch: at ζ from the pitch point along the line of action, with a share of the load.
template <class T>
struct FlankPair {
  T place, share;
};
template <class T>
struct FlankPairs {
  std::array<FlankPair<T>, 32> all;
  std::size_t count = 0;
  const FlankPair<T>* begin() const { return all.data(); }
  const FlankPair<T>* end() const { return all.data() + count; }
};

inline ToothContact::Path ToothContact::path(double sense) const {
  Path p;
  p.low = sense > 0 ? -geometry_.approach : -geometry_.recess;
  p.high = sense > 0 ? geometry_.recess : geometry_.approach;
  p.edge = std::min(0.05 * (p.high - p.low), 0.5 * (p.high - p.low - geometry_.base_pitch));
  return p;
}

template <class T>
FlankPairs<T> ToothContact::flanks(const T& psi_a, double sense) const {
  const auto [low, high, edge] = path(sense);
  const double pitch = geometry_.base_pitch;
  const T cycle = (psi_a * geometry_.teeth + law_.mesh.phase) * (0.5 / std::numbers::pi) + geometry_.flank * sense;
  // Those wholly on the path, and the part of one that comes and of one that goes, over `edge` about either end: half within
  // and half beyond, so that the mean over a pitch is that of flanks which come and go at once.
  FlankPairs<T> pairs;
  std::size_t whole = 0;
  std::array<T, 2> part{T(0), T(0)};  // of the one that comes and of the one that goes
  for (double j = std::ceil((low - 0.5 * edge) / pitch - value_of(cycle)); pairs.count < pairs.all.size(); ++j) {
    const T place = pitch * (cycle + j);
    const double at = value_of(place);
    if (at >= high + 0.5 * edge) break;
    T in(1);
    if (at < low + 0.5 * edge) {
      const Function::Jet up = smooth_step(at - low, edge);
      in = part[0] = compose(place, up.f, up.d1, up.d2);
    } else if (at > high - 0.5 * edge) {
      const Function::Jet down = smooth_step(high - at, edge);
      in = part[1] = compose(place, down.f, -down.d1, down.d2);
    } else {
      ++whole;
    }
    pairs.all[pairs.count++] = {place, in};
  }
  // The load is shared equally. The share of a flank is the mean of 1/number over whether those at the ends are there or not:
  // linear in each, so that a flank takes half of what it takes in full where it is half there.
  const double n = static_cast<double>(whole);
  const auto split = [](const T& p, double without, double with) { return T((1 - p) * without + p * with); };
  const T both = part[0] * part[1];
  const T of_whole =
      whole == 0 ? T(0) : T((1 - part[0] - part[1] + both) / n + (part[0] + part[1] - 2 * both) / (n + 1) + both / (n + 2));
  for (std::size_t j = 0; j < pairs.count; ++j) {
    FlankPair<T>& pair = pairs.all[j];
    const double at = value_of(pair.place);
    const int end = at < low + 0.5 * edge ? 0 : at > high - 0.5 * edge ? 1 : -1;
    if (end < 0)
      pair.share = of_whole;
    else
      pair.share *= split(part[static_cast<std::size_t>(1 - end)], 1 / (n + 1), 1 / (n + 2));
  }
  return pairs;
}

template <class T>
void ToothContact::rub(const Motion<T, 2>& motion, const ToothedSide<T>& a, const ToothedSide<T>& b, const Vec3T<T>& gap,
                       const T& force_1, const ToothGrip<T>& grip, ToothLoads<T>& loads, ContactReport* report) const {
  using std::abs;
  const bool radial = options_.separation && !(options_.running && elastic());
  if (!radial && !options_.friction && !report) return;
  const T load = abs(force_1);
  const ToothMeeting<T> at(motion, a, b, gap);
  const Vec3T<T> here(T(0), T(0), T(0));
  const auto add = [&](const Vec3T<T>& force, const Vec3T<T>& offset) {
    loads.body_force += force;
    loads.body_moment[0] += cross(Vec3T<T>(at.arm_a + offset), force);
    loads.body_moment[1] -= cross(Vec3T<T>(at.arm_b + offset), force);
  };

  Vec3T<T> separating = here;
  if (radial) {  // (34, 35); it does no work on ψ
    T size = sin_alpha_ * load;
    if (options_.running) {
      const T opening = -dot(gap, at.across);
      const Function::Jet d = geometry_.flank_opening(value_of(opening));
      size = cos_alpha_ * load * compose(opening, d.d1, d.d2, d.d3);
      if (report) report->opening = value_of(opening);
    }
    for (int k = 0; k < 3; ++k) separating[k] = -size * at.across[k];
    add(separating, here);
  }
  if (report) {
    const Vec3T<T> slip = at.slip(here);
    report->separation_power = value_of(dot(separating, slip));
    Vec3 v, n;
    for (int k = 0; k < 3; ++k) {
      v[k] = value_of(slip[k]);
      n[k] = value_of(at.normal[k]);
    }
    n.normalize();
    report->sliding_speed = (v - n * v.dot(n)).norm();
  }
  if (!options_.friction) return;

  const ToothFriction& friction = *options_.friction;
  // −μ(|v_s|) N v_s/|v_s|, v_s the part of the velocity in the plane whose normal is n
  const auto drag = [&](const Vec3T<T>& v, const Vec3T<T>& n, const FrictionLaw& law, const T& N) {
    const T v_n = dot(v, n);
    Vec3T<T> tangential;
    for (int k = 0; k < 3; ++k) tangential[k] = v[k] - v_n * n[k];
    const T speed_squared = dot(tangential, v);
    const T factor = N * law.over_speed(speed_squared, load);
    if (report) {
      report->friction_power += value_of(factor) * value_of(speed_squared);
      if (&law == &friction.law && value_of(speed_squared) > report->sliding.squaredNorm())
        for (int k = 0; k < 3; ++k) report->sliding[k] = value_of(tangential[k]);
    }
    Vec3T<T> force;
    for (int k = 0; k < 3; ++k) force[k] = -factor * tangential[k];
    return force;
  };
  const Vec3T<T> before = loads.body_force;
  const double sense = value_of(force_1) >= 0 ? 1 : -1;
  const auto flank_axes = [&] {  // the line of action, and the normal of the flanks
    const double cos_t = std::cos(geometry_.transverse_pressure_angle), sin_t = std::sin(geometry_.transverse_pressure_angle);
    std::array<Vec3T<T>, 2> axes;
    for (int k = 0; k < 3; ++k) {
      axes[0][k] = cos_t * 0.5 * (a.forward[k] - b.forward[k]) + sense * sin_t * at.across[k];
      axes[1][k] = cos_alpha_ * at.normal[k] + sense * sin_alpha_ * at.across[k];
    }
    return axes;
  };
  if (grip.free()) {
    if (!friction.profile) {
      add(drag(at.slip(here), at.normal, friction.law, load), here);
    } else {
      const auto [line, flank_normal] = flank_axes();
      for (const FlankPair<T>& pair : flanks(motion.scalar[0], sense)) {
        const Vec3T<T> offset = line * pair.place;
        add(drag(at.slip(offset), flank_normal, friction.law, T(load * pair.share)), offset);
      }
    }
  } else {
    // Flanks slide along the way that A's takes on B's when ψ_A grows, by `lever` for each unit of ψ_A. Friction against it is of
    // a known sign, and the force at rest is spread over flanks as its limit is.
    const double unit = grip_lever();
    const auto towards = [](const Vec3T<T>& v, const Vec3T<T>& n) {
      const T v_n = dot(v, n);
      return Vec3T<T>(v - n * v_n);
    };
    const auto against = [&](const Vec3T<T>& way, const Vec3T<T>& offset, const T& part) {
      if (grip.direction == 0) return;
      const T sliding = dot(way, at.slip(offset)) * grip.direction;
      const T drag = friction.law.at(T(value_of(part) < 0 ? T(-sliding) : sliding), load) * load * part;
      add(way * T(drag * -grip.direction), offset);
      if (report) report->friction_power += value_of(drag) * value_of(sliding);
    };
    const double at_rest = friction.law.static_coefficient(value_of(load)) * value_of(load);
    if (!friction.profile) {
      const Vec3T<T> way =
          direction_of(towards(cross(a.axle, at.arm_a) - cross(b.axle, at.arm_b) * T(geometry_.turn_ratio), at.normal));
      against(way, here, T(1));
      if (grip.holds) add(way * grip.force, here);
      if (report) report->grip_limit = at_rest;
    } else {
      const auto [line, flank_normal] = flank_axes();
      const Vec3T<T> rolling = a.axle - b.axle * T(geometry_.turn_ratio);
      const Vec3T<T> per_place = towards(cross(rolling, line), flank_normal), way = direction_of(per_place);
      const auto pairs = flanks(motion.scalar[0], sense);
      const double edge = path(sense).edge;
      // sliding changes its direction at the pitch point, over the same width as flanks come and go
      const auto part = [&](const FlankPair<T>& pair) {
        const Function::Jet s = smooth_step(value_of(pair.place), edge);
        return T(pair.share * (compose(pair.place, s.f, s.d1, s.d2) * 2.0 - 1.0));
      };
      T lever(1e-12 * geometry_.base_pitch);  // none where the only flank touches at the pitch point
      for (const FlankPair<T>& pair : pairs) lever += part(pair) * pair.place;
      lever *= dot(way, per_place);
      for (const FlankPair<T>& pair : pairs) {
        const Vec3T<T> offset = line * pair.place;
        against(way, offset, part(pair));
        if (grip.holds) add(way * T(grip.force * part(pair) * unit / lever), offset);
      }
      if (report) report->grip_limit = at_rest * value_of(lever) / unit;
    }
  }
  if (report) {
    double square = 0;
    for (int k = 0; k < 3; ++k) square += std::pow(value_of(loads.body_force[k] - before[k]), 2);
    report->friction_force = std::sqrt(square);
  }
  if (friction.rolling > 0) {
    FrictionLaw rolling;
    rolling.mu = friction.rolling;
    rolling.width = friction.law.width / geometry_.radius;
    const Vec3T<T> couple = drag(Vec3T<T>(at.spin_a - at.spin_b), at.normal, rolling, load);
    loads.body_moment[0] += couple;
    loads.body_moment[1] -= couple;
  }
}

}  // namespace engrane::elements::gears

// SPDX-License-Identifier: BSD-3-Clause
// Separation and friction of ToothContact, for any number type. Included by tooth_contact.hpp only.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

namespace engrane::elements::gears {

/// Meeting point of two toothed bodies: arms from the nodes to the midpoint of the two contact points, and the directions
/// there.
template <class T>
struct ToothMeeting {
  Vec3T<T> arm_a, arm_b;
  Vec3T<T> across, normal;  ///< means of η₂ and η₃

  ToothMeeting(const ToothedSide<T>& a, const ToothedSide<T>& b, const Vec3T<T>& gap) {
    for (int k = 0; k < 3; ++k) {
      arm_a[k] = a.arm[k] - 0.5 * gap[k];
      arm_b[k] = b.arm[k] + 0.5 * gap[k];
      across[k] = 0.5 * (a.eta_2[k] + b.eta_2[k]);
      normal[k] = 0.5 * (a.eta_3[k] + b.eta_3[k]);
    }
  }
};

/// Relative velocity of two toothed bodies.
template <class T>
struct ToothSlip {
  const Motion<T, 2>& motion;
  const ToothMeeting<T>& at;
  Vec3T<T> spin_a, spin_b;

  ToothSlip(const Motion<T, 2>& m, const ToothMeeting<T>& meeting)
      : motion(m), at(meeting), spin_a(rotate(m.node[0].R, m.node[0].W)), spin_b(rotate(m.node[1].R, m.node[1].W)) {}
  /// Velocity of A relative to B at the meeting point, and at an offset from it.
  Vec3T<T> here() const { return between(at.arm_a, at.arm_b); }
  Vec3T<T> off(const Vec3T<T>& offset) const { return between(at.arm_a + offset, at.arm_b + offset); }

 private:
  Vec3T<T> between(const Vec3T<T>& from_a, const Vec3T<T>& from_b) const {
    return motion.node[0].v + cross(spin_a, from_a) - motion.node[1].v - cross(spin_b, from_b);
  }
};

/// The part of v in the plane with normal n.
template <class T>
Vec3T<T> along_plane(const Vec3T<T>& v, const Vec3T<T>& n) {
  const T v_n = dot(v, n);
  Vec3T<T> part;
  for (int k = 0; k < 3; ++k) part[k] = v[k] - v_n * n[k];
  return part;
}

template <class T>
Vec3T<T> direction_of(const Vec3T<T>& v) {
  using std::sqrt;
  return v * T(1 / sqrt(dot(v, v)));
}

/// A pair of flanks in contact: its position ζ from the pitch point along the line of action, and its share of the load.
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
  // All pairs wholly on the path, and a fraction of the one that enters and of the one that leaves, over `edge` about either
  // end: half inside and half outside, so that the mean over a pitch is the same as with abrupt changes.
  FlankPairs<T> pairs;
  std::size_t whole = 0;
  std::array<T, 2> part{T(0), T(0)};  // fractions of the entering and of the leaving pair
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
  // The load is shared equally. A pair's share is the mean of 1/number over the presence or absence of the pairs at the ends:
  // linear in each fraction, so that a pair that is half present takes half its full share.
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
  const bool radial = separates_by_load();
  if (!radial && !options_.friction && !report) return;
  const T load = abs(force_1);
  const ToothMeeting<T> at(a, b, gap);
  const T opening = -dot(gap, at.across);
  if (report) report->opening = value_of(opening);
  const auto add = [&](const Vec3T<T>& force, const Vec3T<T>& from_a, const Vec3T<T>& from_b) {
    loads.body_force += force;
    loads.body_moment[0] += cross(from_a, force);
    loads.body_moment[1] -= cross(from_b, force);
  };
  const auto add_here = [&](const Vec3T<T>& force) { add(force, at.arm_a, at.arm_b); };
  const auto add_off = [&](const Vec3T<T>& force, const Vec3T<T>& offset) {
    add(force, Vec3T<T>(at.arm_a + offset), Vec3T<T>(at.arm_b + offset));
  };

  Vec3T<T> separating(T(0), T(0), T(0));
  if (radial) {  // (34, 35); does no work on ψ
    T size = sin_alpha_ * load;
    if (options_.running) {
      const Function::Jet d = geometry_.flank_opening(value_of(opening));
      size = cos_alpha_ * load * compose(opening, d.d1, d.d2, d.d3);
    }
    for (int k = 0; k < 3; ++k) separating[k] = -size * at.across[k];
    add_here(separating);
  }
  if (!options_.friction && !report) return;
  const ToothSlip<T> slip(motion, at);
  if (report) {
    const Vec3T<T> at_pitch_point = slip.here();
    report->separation_power = value_of(dot(separating, at_pitch_point));
    Vec3 v, n;
    for (int k = 0; k < 3; ++k) {
      v[k] = value_of(at_pitch_point[k]);
      n[k] = value_of(at.normal[k]);
    }
    n.normalize();
    report->sliding_speed = (v - n * v.dot(n)).norm();
  }
  if (!options_.friction) return;

  const ToothFriction& friction = *options_.friction;
  // −μ(|v_s|) N v_s/|v_s|, with v_s the part of the velocity in the plane with normal n
  const auto drag = [&](const Vec3T<T>& v, const Vec3T<T>& n, const FrictionLaw& law, const T& N) {
    const Vec3T<T> tangential = along_plane(v, n);
    const T speed_squared = dot(tangential, tangential);  // never below 0, as v·tangential may be by rounding
    const T factor = N * law.over_speed(speed_squared, load);
    if (report) {
      report->friction_power += value_of(factor) * value_of(dot(tangential, v));
      if (&law == &friction.law && value_of(speed_squared) > report->sliding.squaredNorm())
        for (int k = 0; k < 3; ++k) report->sliding[k] = value_of(tangential[k]);
    }
    Vec3T<T> force;
    for (int k = 0; k < 3; ++k) force[k] = -factor * tangential[k];
    return force;
  };
  const Vec3T<T> before = loads.body_force;
  const double sense = value_of(force_1) >= 0 ? 1 : -1;
  const auto flank_axes = [&] {  // line of action and normal of the flanks
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
      add_here(drag(slip.here(), at.normal, friction.law, load));
    } else {
      const auto [line, flank_normal] = flank_axes();
      for (const FlankPair<T>& pair : flanks(motion.scalar[0], sense)) {
        const Vec3T<T> offset = line * pair.place;
        add_off(drag(slip.off(offset), flank_normal, friction.law, T(load * pair.share)), offset);
      }
    }
  } else {
    // Flanks slide in the direction in which A moves on B when ψ_A increases, by `unit` per unit of ψ_A. Friction opposes
    // sliding in a known direction; the force at rest is distributed over the flanks like its limit.
    const double unit = grip_lever();
    const auto against = [&](const Vec3T<T>& way, const Vec3T<T>& velocity, const T& part) {
      const T sliding = dot(way, velocity) * grip.direction;
      const T friction_force = friction.law.at(T(value_of(part) < 0 ? T(-sliding) : sliding), load) * load * part;
      if (report) report->friction_power += value_of(friction_force) * value_of(sliding);
      return Vec3T<T>(way * T(friction_force * -grip.direction));
    };
    const double at_rest = friction.law.static_coefficient(value_of(load)) * value_of(load);
    if (!friction.profile) {
      const Vec3T<T> way =
          direction_of(along_plane<T>(cross(a.axle, at.arm_a) - cross(b.axle, at.arm_b) * T(geometry_.turn_ratio), at.normal));
      add_here(grip.holds ? Vec3T<T>(way * grip.force) : against(way, slip.here(), T(1)));
      if (report) report->grip_limit = at_rest;
    } else {
      const auto [line, flank_normal] = flank_axes();
      const Vec3T<T> rolling = a.axle - b.axle * T(geometry_.turn_ratio);
      const Vec3T<T> per_place = along_plane<T>(cross(rolling, line), flank_normal), way = direction_of(per_place);
      const auto pairs = flanks(motion.scalar[0], sense);
      const double edge = path(sense).edge;
      // sliding reverses at the pitch point, over the same width as flanks enter and leave
      const auto part = [&](const FlankPair<T>& pair) {
        const Function::Jet s = smooth_step(value_of(pair.place), edge);
        return T(pair.share * (compose(pair.place, s.f, s.d1, s.d2) * 2.0 - 1.0));
      };
      T lever(1e-12 * geometry_.base_pitch);  // avoids a zero lever if the only flank touches at the pitch point
      for (const FlankPair<T>& pair : pairs) lever += part(pair) * pair.place;
      lever *= dot(way, per_place);
      for (const FlankPair<T>& pair : pairs) {
        const Vec3T<T> offset = line * pair.place;
        const T share = part(pair);
        add_off(grip.holds ? Vec3T<T>(way * T(grip.force * share * unit / lever)) : against(way, slip.off(offset), share),
                offset);
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
    const Vec3T<T> couple = drag(Vec3T<T>(slip.spin_a - slip.spin_b), at.normal, rolling, load);
    loads.body_moment[0] += couple;
    loads.body_moment[1] -= couple;
  }
}

}  // namespace engrane::elements::gears

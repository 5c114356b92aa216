// SPDX-License-Identifier: BSD-3-Clause
// The forces of ToothContact, in numbers of any kind. Included by tooth_contact.hpp only.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

namespace engrane::elements::gears {

template <class T>
T ToothContact::act(const Motion<T, 2>& motion, const ToothedSide<T>& a, const ToothedSide<T>& b, const T& closing,
                    Balance<T, 2>& balance, const ToothGrip<T>& grip, ToothLoads<T>& loads, ContactReport* report) const {
  // (21) with the sign of external contact, (22) and (23) for both sides alike
  const T force_1 = balance.constraint(0, cos_alpha_ * (elastic() ? T(closing + motion.scalar[2]) : closing));
  Vec3T<T> gap, normal;  // x_C^A − x_C^B (10), mean of η₃
  for (int k = 0; k < 3; ++k) {
    gap[k] = motion.node[0].x[k] - motion.node[1].x[k] + a.arm[k] - b.arm[k];
    normal[k] = 0.5 * (a.eta_3[k] + b.eta_3[k]);
  }
  const T force_2 = balance.constraint(1, dot(gap, normal));
  const T moment_3 = balance.constraint(2, 0.5 * (dot(a.eta_2, b.eta_3) - dot(a.eta_3, b.eta_2)));

  // The gradients (24)–(26): a small turn θ of a side's frame changes its arm and η by θ ×.
  const Vec3T<T> lateral_a = cross(a.eta_3, gap), lateral_b = cross(b.eta_3, gap);
  const Vec3T<T> triads_a = cross(a.eta_2, b.eta_3), triads_b = cross(a.eta_3, b.eta_2);
  for (int k = 0; k < 3; ++k) loads.frame_force[k] += force_2 * normal[k];
  const Vec3T<T> along_a = cross(a.arm, loads.frame_force), along_b = cross(b.arm, loads.frame_force);
  for (int k = 0; k < 3; ++k) {
    const T couple = 0.5 * moment_3 * (triads_a[k] - triads_b[k]);
    loads.frame_moment[0][k] += along_a[k] + 0.5 * force_2 * lateral_a[k] + couple;
    loads.frame_moment[1][k] += -along_b[k] + 0.5 * force_2 * lateral_b[k] - couple;
  }

  if (elastic()) press(motion, a, b, gap, force_1, balance, loads, report);
  rub(motion, a, b, gap, force_1, grip, loads, report);

  const Vec3T<T> force = loads.frame_force + loads.body_force;
  balance.force(0, -force);
  balance.force(1, force);
  for (std::size_t i = 0; i < 2; ++i) {
    const Vec3T<T> moment = loads.frame_moment[i] + loads.body_moment[i];
    balance.moment(static_cast<int>(i), -rotate_back(motion.node[i].R, moment));
    if (!report) continue;
    for (int k = 0; k < 3; ++k) {
      report->force[i][k] = i == 0 ? value_of(force[k]) : -value_of(force[k]);
      report->moment[i][k] = value_of(moment[k]);
    }
  }
  return force_1;
}

template <class T>
void ToothContact::press(const Motion<T, 2>& motion, const ToothedSide<T>& a, const ToothedSide<T>& b, const Vec3T<T>& gap,
                         const T& force_1, Balance<T, 2>& balance, ToothLoads<T>& loads, ContactReport* report) const {
  const T &psi_a = motion.scalar[0], &psi_b = motion.scalar[1];
  const double contact_homotopy = balance.contact_homotopy(), k = (1 - contact_homotopy) * law_.stiffness;
  const Function::Jet error_a = law_.error.of_a(value_of(psi_a), law_.mesh),
                      error_b = law_.error.of_b(value_of(psi_b), law_.mesh);
  const T x = motion.scalar[2] + compose(psi_a, error_a.f, error_a.d1, error_a.d2) +
              compose(psi_b, error_b.f, error_b.d1, error_b.d2) + law_.mesh.misfit;

  // V = k f(τ) ∫[[x]] dx, and f with its derivative by ψ_A where the stiffness varies, at a place y along the face
  const double z = geometry_.teeth, twist = std::tan(geometry_.helix) / geometry_.radius;
  const auto course = [&](double y, T& factor, T& slope) {
    const Function::Jet f = law_.course.at(z * (value_of(psi_a) - twist * y) + law_.mesh.phase);
    factor = compose(psi_a, f.f, z * f.d1, z * z * f.d2);
    slope = compose(psi_a, z * f.d1, z * z * f.d2, z * z * z * f.d3);
  };
  T factor(1), factor_slope(0);
  if (law_.course.varies() && !law_.by_load()) course(0, factor, factor_slope);

  T net(0), by_turn(0);  // ∂V/∂x, ∂V/∂ψ_A at constant x
  T front = x, back = -law_.backlash - x;
  double potential = 0;
  if (law_.by_load()) {  // V = k ∫ f(τ, |[[x]]|) [[x]] dx, or the sum over pairs with relief; never with `running`
    const double tau = z * value_of(psi_a) + law_.mesh.phase;
    const ToothLaw::Pressed f = law_.pressed(tau, value_of(front)), g = law_.pressed(tau, value_of(back), true);
    const double by_phase = z * (f.by_phase - g.by_phase);
    net = k * (compose(x, f.force - g.force, std::max(f.by_depth + g.by_depth, ToothLaw::least_slope), 0) +
               compose(psi_a, 0, by_phase, 0));
    by_turn = k * (compose(x, z * (f.energy_by_phase + g.energy_by_phase), by_phase, 0) +
                   compose(psi_a, 0, z * z * (f.energy_by_phase_twice + g.energy_by_phase_twice), 0));
    potential = k * (f.energy + g.energy);
    const bool on_front = value_of(front) >= value_of(back);
    const user::Results& here = (on_front ? f : g).factor;
    const T& depth = on_front ? front : back;
    factor = compose(psi_a, here[0], z * here[1], 0) + compose(depth, 0, here[3] * law_.flank(value_of(depth)).d1, 0);
  } else if (!options_.running) {
    net = k * law_.elastic_deflection(x);
    const Function::Jet d = law_.deflection(value_of(x));
    const double energy = k * law_.deflection_integral(value_of(x));
    if (law_.course.varies()) {
      by_turn = compose(x, energy, k * d.f, k * d.d1) * factor_slope;
      net *= factor;
    }
    potential = value_of(factor) * energy;
  } else {
    // Each flank is a potential of its own, pressed in by ±x less what the opening of the wheels takes away: the separating
    // force is its derivative. A slice at y sees the axles' tilt: D = μ₁ − σ ξ₁ moves A's teeth along and across.
    Vec3T<T> across, along, tilt;
    for (int i = 0; i < 3; ++i) {
      across[i] = 0.5 * (a.eta_2[i] + b.eta_2[i]);
      along[i] = 0.5 * (a.forward[i] - b.forward[i]);
      tilt[i] = a.axle[i] - geometry_.axle_sense * b.axle[i];
    }
    const T opening = -dot(gap, across);
    const int n = options_.slices;
    const T tilt_across = n > 1 ? T(dot(tilt, across)) : T(0), tilt_along = n > 1 ? T(dot(tilt, along)) : T(0);
    T by_opening(0), by_across(0), by_along(0);
    for (int i = 0; i < n; ++i) {
      const double y = geometry_.width * ((i + 0.5) / n - 0.5);
      const T local = opening - y * tilt_across;
      const Function::Jet d = geometry_.flank_opening(value_of(local));
      const T open = compose(local, d.f, d.d1, d.d2), slope = compose(local, d.d1, d.d2, d.d3);
      const T shift = (y * cos_beta_) * tilt_along;
      const double crowned = slice_crown_ * std::pow(2 * y / geometry_.width, 2);
      const T in_front = x + shift - open - crowned, behind = -law_.backlash - x - shift - open - crowned;
      const auto flank = [&](const T& depth) {
        const Function::Jet f = law_.flank(value_of(depth));
        return T((k / n) * compose(depth, f.f, f.d1, f.d2));
      };
      const auto energy = [&](const T& depth) {
        const Function::Jet f = law_.flank(value_of(depth));
        return T((k / n) * compose(depth, law_.flank_integral(value_of(depth)), f.f, f.d1));
      };
      T push = flank(in_front), pull = flank(behind);
      if (value_of(push) == 0 && value_of(pull) == 0)  // a way across the gap for statics, as elastic_deflection()
        push = compose(x, 0, ToothLaw::least_slope * k / n, 0);
      double part = (k / n) * (law_.flank_integral(value_of(in_front)) + law_.flank_integral(value_of(behind)));
      if (law_.course.varies()) {
        T here = factor, here_slope = factor_slope;
        if (n > 1) course(y, here, here_slope);
        by_turn += (energy(in_front) + energy(behind)) * here_slope;
        push *= here;
        pull *= here;
        part *= value_of(here);
      }
      const T both = push + pull, difference = push - pull;
      net += difference;
      by_opening -= slope * both;
      by_across += y * (slope * both);
      by_along += (y * cos_beta_) * difference;
      potential += part;
      if (report) report->slices.push_back(value_of(difference));
    }
    const Function::Jet d = geometry_.flank_opening(value_of(opening));
    const T open = compose(opening, d.f, d.d1, d.d2);
    front -= open;
    back -= open;

    // forces −∂V/∂q: the opening is −gap·½(η₂^A + η₂^B), the tilts are products of D with directions that A and B carry
    Vec3T<T> out;
    for (int i = 0; i < 3; ++i) out[i] = by_opening * across[i];
    const Vec3T<T> out_a = cross(a.arm, out), out_b = cross(b.arm, out);
    const Vec3T<T> gap_a = cross(a.eta_2, gap), gap_b = cross(b.eta_2, gap);
    for (int i = 0; i < 3; ++i) {
      loads.frame_force[i] += out[i];
      loads.frame_moment[0][i] += out_a[i] + 0.5 * by_opening * gap_a[i];
      loads.frame_moment[1][i] += -out_b[i] + 0.5 * by_opening * gap_b[i];
    }
    if (n > 1) {
      Vec3T<T> way;  // V varies with the tilt D by D·way
      for (int i = 0; i < 3; ++i) way[i] = by_across * across[i] + by_along * along[i];
      const Vec3T<T> turn_a = cross(a.axle, way), turn_b = cross(b.axle, way);
      Vec3T<T> carried_a, carried_b;
      for (int i = 0; i < 3; ++i) {
        carried_a[i] = 0.5 * (by_across * a.eta_2[i] + by_along * a.forward[i]);
        carried_b[i] = 0.5 * (by_across * b.eta_2[i] - by_along * b.forward[i]);
      }
      const Vec3T<T> follow_a = cross(carried_a, tilt), follow_b = cross(carried_b, tilt);
      for (int i = 0; i < 3; ++i) {
        loads.frame_moment[0][i] -= turn_a[i] + follow_a[i];
        loads.frame_moment[1][i] -= -geometry_.axle_sense * turn_b[i] + follow_b[i];
      }
    }
    if (report) report->opening = value_of(opening);
  }

  if (contact_homotopy > 0) {
    net += contact_homotopy * law_.stiffness * x;
    potential += 0.5 * contact_homotopy * law_.stiffness * value_of(x) * value_of(x);
  }
  const T& rate = motion.scalar_rate[2];
  T damping(0);
  if (law_.damping > 0) {
    if (law_.mode == ToothLaw::Damping::always || (law_.backlash == 0 && !options_.running)) {
      damping = law_.damping * rate;
    } else {
      const auto alone = [&](const T& depth) {
        const Function::Jet f = law_.flank(value_of(depth));
        return T(k * factor * compose(depth, f.f, f.d1, f.d2));
      };
      damping = law_.damping_force(front, back, alone(front), alone(back), rate);
    }
  }
  balance.scalar(0, net * compose(psi_a, error_a.d1, error_a.d2, error_a.d3) + by_turn);  // (29)
  balance.scalar(1, net * compose(psi_b, error_b.d1, error_b.d2, error_b.d3));
  balance.scalar(2, net + damping - cos_alpha_ * force_1);
  if (!report) return;
  report->approach = value_of(x);
  report->front = value_of(front);
  report->back = value_of(back);
  report->stiffness_factor = value_of(factor);
  report->potential = potential;
  report->damping_power = value_of(damping) * value_of(rate);
}

template <class T>
void ToothContact::rub(const Motion<T, 2>& motion, const ToothedSide<T>& a, const ToothedSide<T>& b, const Vec3T<T>& gap,
                       const T& force_1, const ToothGrip<T>& grip, ToothLoads<T>& loads, ContactReport* report) const {
  using std::abs, std::sqrt;
  const bool radial = options_.separation && !(options_.running && elastic());
  if (!radial && !options_.friction && !report) return;
  const T load = abs(force_1);
  Vec3T<T> arm_a, arm_b, across, normal;
  for (int k = 0; k < 3; ++k) {
    arm_a[k] = a.arm[k] - 0.5 * gap[k];
    arm_b[k] = b.arm[k] + 0.5 * gap[k];
    across[k] = 0.5 * (a.eta_2[k] + b.eta_2[k]);
    normal[k] = 0.5 * (a.eta_3[k] + b.eta_3[k]);
  }
  const auto add = [&](const Vec3T<T>& force, const Vec3T<T>& from_a, const Vec3T<T>& from_b) {
    loads.body_force += force;
    loads.body_moment[0] += cross(from_a, force);
    loads.body_moment[1] -= cross(from_b, force);
  };

  Vec3T<T> separating(T(0), T(0), T(0));
  if (radial) {  // (34, 35), midway between the two contact points; it does no work on ψ
    T size = sin_alpha_ * load;
    if (options_.running) {
      const T opening = -dot(gap, across);
      const Function::Jet d = geometry_.flank_opening(value_of(opening));
      size = cos_alpha_ * load * compose(opening, d.d1, d.d2, d.d3);
      if (report) report->opening = value_of(opening);
    }
    for (int k = 0; k < 3; ++k) separating[k] = -size * across[k];
    add(separating, arm_a, arm_b);
  }
  if (!options_.friction && !report) return;

  const auto& node_a = motion.node[0];
  const auto& node_b = motion.node[1];
  const Vec3T<T> spin_a = rotate(node_a.R, node_a.W), spin_b = rotate(node_b.R, node_b.W);
  const auto slip = [&](const Vec3T<T>& from_a, const Vec3T<T>& from_b) {
    return Vec3T<T>(node_a.v + cross(spin_a, from_a) - node_b.v - cross(spin_b, from_b));
  };
  const Vec3T<T> at_pitch_point = slip(arm_a, arm_b);
  if (report) {
    report->separation_power = value_of(dot(separating, at_pitch_point));
    Vec3 v, n;
    for (int k = 0; k < 3; ++k) {
      v[k] = value_of(at_pitch_point[k]);
      n[k] = value_of(normal[k]);
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
  if (report && grips()) report->grip_limit = friction.law.static_coefficient(value_of(load)) * value_of(load);
  if (grip.direction != 0 || grip.holds) {
    // as A slides on B when ψ_A grows
    const Vec3T<T> turn_a = cross(a.axle, arm_a), turn_b = cross(b.axle, arm_b);
    Vec3T<T> way;
    for (int k = 0; k < 3; ++k) way[k] = turn_a[k] - geometry_.turn_ratio * turn_b[k];
    const T across_flanks = dot(way, normal);
    for (int k = 0; k < 3; ++k) way[k] -= across_flanks * normal[k];
    const T length = sqrt(dot(way, way));
    for (int k = 0; k < 3; ++k) way[k] = way[k] / length;
    const T sliding = dot(way, at_pitch_point);
    T along = grip.force;
    if (grip.direction != 0) {
      const T against = grip.direction * (friction.law.at(T(grip.direction * sliding), load) * load);
      along -= against;
      if (report) report->friction_power += value_of(against) * value_of(sliding);
    }
    Vec3T<T> force;
    for (int k = 0; k < 3; ++k) force[k] = along * way[k];
    add(force, arm_a, arm_b);
  } else if (!friction.profile) {
    add(drag(at_pitch_point, normal, friction.law, load), arm_a, arm_b);
  } else {
    // flanks that touch at ζ from the pitch point along the line of action
    const double sense = value_of(force_1) >= 0 ? 1 : -1;
    const double low = sense > 0 ? -geometry_.approach : -geometry_.recess;
    const double high = sense > 0 ? geometry_.recess : geometry_.approach;
    const double pitch = geometry_.base_pitch;
    const double edge = std::min(0.05 * (high - low), 0.5 * (high - low - pitch));
    const double cos_t = std::cos(geometry_.transverse_pressure_angle), sin_t = std::sin(geometry_.transverse_pressure_angle);
    Vec3T<T> line, flank_normal;
    for (int k = 0; k < 3; ++k) {
      line[k] = cos_t * 0.5 * (a.forward[k] - b.forward[k]) + sense * sin_t * across[k];
      flank_normal[k] = cos_alpha_ * normal[k] + sense * sin_alpha_ * across[k];
    }
    const T cycle = (motion.scalar[0] * geometry_.teeth + law_.mesh.phase) * (0.5 / std::numbers::pi) + geometry_.flank * sense;
    // Those wholly on the path, and the part of one that comes and of one that goes, over `edge` about either end: half within
    // and half beyond, so that the mean over a pitch is that of flanks which come and go at once.
    struct Flank {
      T place, share;
    };
    std::array<Flank, 32> flanks;
    std::size_t count = 0, whole = 0;
    std::array<T, 2> part{T(0), T(0)};  // of the one that comes and of the one that goes
    for (double j = std::ceil((low - 0.5 * edge) / pitch - value_of(cycle)); count < flanks.size(); ++j) {
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
      flanks[count++] = {place, in};
    }
    // The load is shared equally. The share of a flank is the mean of 1/number over whether those at the ends are there or not:
    // linear in each, so that a flank takes half of what it takes in full where it is half there.
    const double n = static_cast<double>(whole);
    const auto split = [](const T& p, double without, double with) { return T((1 - p) * without + p * with); };
    const T both = part[0] * part[1];
    const T of_whole =
        whole == 0 ? T(0) : T((1 - part[0] - part[1] + both) / n + (part[0] + part[1] - 2 * both) / (n + 1) + both / (n + 2));
    for (std::size_t j = 0; j < count; ++j) {
      const double at = value_of(flanks[j].place);
      const int end = at < low + 0.5 * edge ? 0 : at > high - 0.5 * edge ? 1 : -1;
      if (end < 0)
        flanks[j].share = of_whole;
      else
        flanks[j].share *= split(part[static_cast<std::size_t>(1 - end)], 1 / (n + 1), 1 / (n + 2));
    }
    for (std::size_t j = 0; j < count; ++j) {
      Vec3T<T> from_a, from_b;
      for (int k = 0; k < 3; ++k) {
        const T offset = flanks[j].place * line[k];
        from_a[k] = arm_a[k] + offset;
        from_b[k] = arm_b[k] + offset;
      }
      add(drag(slip(from_a, from_b), flank_normal, friction.law, T(load * flanks[j].share)), from_a, from_b);
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
    const Vec3T<T> couple = drag(Vec3T<T>(spin_a - spin_b), normal, rolling, load);
    loads.body_moment[0] += couple;
    loads.body_moment[1] -= couple;
  }
}

}  // namespace engrane::elements::gears

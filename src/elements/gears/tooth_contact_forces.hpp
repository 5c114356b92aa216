// SPDX-License-Identifier: BSD-3-Clause
// The forces of ToothContact, for any number type. Included by tooth_contact.hpp only.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

namespace engrane::elements::gears {

template <class T>
T ToothContact::act(const Motion<T, 2>& motion, const ToothedSide<T>& a, const ToothedSide<T>& b, const T& closing,
                    Balance<T, 2>& balance, const ToothGrip<T>& grip, ToothLoads<T>& loads, ContactReport* report) const {
  // (21) with the sign of external contact; (22) and (23) in the form that treats both sides alike
  const T force_1 = balance.constraint(0, cos_alpha_ * (elastic() ? T(closing + motion.scalar[2]) : closing));
  Vec3T<T> gap, normal;  // x_C^A − x_C^B (10), mean of η₃
  for (int k = 0; k < 3; ++k) {
    gap[k] = motion.node[0].x[k] - motion.node[1].x[k] + a.arm[k] - b.arm[k];
    normal[k] = 0.5 * (a.eta_3[k] + b.eta_3[k]);
  }
  const T force_2 = balance.constraint(1, dot(gap, normal));
  const T moment_3 = balance.constraint(2, 0.5 * (dot(a.eta_2, b.eta_3) - dot(a.eta_3, b.eta_2)));

  // gradients (24)–(26): a small rotation θ of a side's frame changes its arm and η by θ ×
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

  // V = k f(τ) ∫[[x]] dx; if the stiffness varies, f and its derivative with respect to ψ_A, at y along the face
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
  if (law_.by_load()) {  // V = k ∫ f(τ, |[[x]]|) [[x]] dx, or with relief the sum over pairs; never with `running`
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
    // Each flank has its own potential, with penetration ±x less the effect of the opening of the wheels; the separating force
    // is its derivative. A slice at y sees the tilt of the axles: D = μ₁ − σ ξ₁ moves A's teeth along and across.
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
      if (value_of(push) == 0 && value_of(pull) == 0)  // small slope in the backlash for statics, see elastic_deflection()
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
      if (report) report->slices.push_back({value_of(difference), value_of(in_front), value_of(behind)});
    }
    const Function::Jet d = geometry_.flank_opening(value_of(opening));
    const T open = compose(opening, d.f, d.d1, d.d2);
    front -= open;
    back -= open;

    // forces −∂V/∂q: the opening is −gap·½(η₂^A + η₂^B), the tilts are products of D with directions carried by A and B
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
      Vec3T<T> way;  // derivative of V with respect to the tilt D
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
  }

  if (contact_homotopy > 0) {
    // from where the front flank takes its first load: without load that is where it is found
    const T pressed = x + 0.5 * law_.onset;
    net += contact_homotopy * law_.stiffness * pressed;
    potential += 0.5 * contact_homotopy * law_.stiffness * value_of(pressed) * value_of(pressed);
  }
  const T slope_a = compose(psi_a, error_a.d1, error_a.d2, error_a.d3),
          slope_b = compose(psi_b, error_b.d1, error_b.d2, error_b.d3);
  T rate = motion.scalar_rate[2], damping(0), damping_by_turn(0);
  if (law_.damping > 0) {
    if (!limits_damping()) {
      damping = law_.damping * rate;
    } else {
      const auto alone = [&](const T& depth) {
        const Function::Jet f = law_.flank(value_of(depth));
        return T(k * factor * compose(depth, f.f, f.d1, f.d2));
      };
      // a damper along u_m would lift flanks that the error moves apart
      rate += slope_a * motion.scalar_rate[0] + slope_b * motion.scalar_rate[1];
      damping = law_.damping_force(front, back, alone(front), alone(back), rate);
      damping_by_turn = damping;
    }
  }
  balance.scalar(0, (net + damping_by_turn) * slope_a + by_turn);  // (29)
  balance.scalar(1, (net + damping_by_turn) * slope_b);
  balance.scalar(2, net + damping - cos_alpha_ * force_1);
  if (!report) return;
  report->approach = value_of(x);
  report->front = value_of(front);
  report->back = value_of(back);
  report->stiffness_factor = value_of(factor);
  report->potential = potential;
  report->load = value_of(net) + value_of(damping);
  report->damping_power = value_of(damping) * value_of(rate);
}

}  // namespace engrane::elements::gears

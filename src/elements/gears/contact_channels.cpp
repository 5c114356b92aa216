// SPDX-License-Identifier: BSD-3-Clause
#include "elements/gears/contact_channels.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace engrane::elements::gears {

void add_force_channels(std::vector<Channel>& list, const std::array<const char*, 2>& bodies) {
  for (const std::size_t body : {std::size_t{0}, std::size_t{1}})
    for (const char* kind : {"FORCE", "MOMENT"})
      for (const char* component : {"X", "Y", "Z"}) {
        const bool is_force = kind[0] == 'F';
        list.push_back({std::string(kind) + "_" + "AB"[body] + component, is_force ? dimension::force : dimension::moment,
                        std::string(is_force ? "tooth force" : "moment of the tooth forces about the centre") + " on " +
                            bodies[body] + ", global " + component});
      }
  for (const char* component : {"X", "Y", "Z"})
    list.push_back({std::string("CONTACT_") + component, dimension::length, std::string("contact point, global ") + component});
}

void put_force_channels(ChannelWriter& out, const ContactReport& report, const Vec3& contact) {
  for (std::size_t i = 0; i < 2; ++i) {
    out.put(report.force[i]);
    out.put(report.moment[i]);
  }
  out.put(contact);
}

void add_contact_channels(std::vector<Channel>& list, const ToothContact& contact) {
  using namespace dimension;
  const Dimension speed = dimension::velocity, watts = dimension::power;
  list.push_back({"SLIDING_SPEED", speed, "sliding speed of the flanks at the pitch point", Channel::Course::size});
  list.push_back({"POWER_A", watts, "power of the teeth on A, in the pair's frame"});
  list.push_back({"POWER_B", watts, "power of the teeth on B, in the pair's frame"});
  list.push_back({"EFFICIENCY", none, "1 less the part of the power through the teeth that is lost; 1 without power",
                  Channel::Course::ratio});
  if (contact.options().friction) {
    list.push_back({"FRICTION_FORCE", force, "size of the resultant of the friction on all flanks", Channel::Course::size});
    list.push_back({"FRICTION_POWER", watts, "power lost by sliding and rolling", Channel::Course::size});
  }
  if (contact.options().running) list.push_back({"PRESSURE_ANGLE", angle, "working pressure angle, transverse"});
  if (contact.elastic()) {
    list.push_back({"U_M", length, "departure of the wheels from their ratio, along the circumference, u_m"});
    list.push_back({"TRANSMISSION_ERROR", length,
                    "approach of the teeth, u_m + x_err; with errors of the teeth u_m is the transmission error"});
    list.push_back({"CONTACT", none, "contact: 1 where A drives, -1 on the other flank, 0 apart", Channel::Course::state});
    if (contact.law().course.varies()) list.push_back({"STIFFNESS", stiffness, "tooth stiffness along the circumference"});
  }
  if (const int n = contact.options().slices; n > 1) {
    list.push_back({"FACE_LOAD_FACTOR", none, "largest over mean load along the face width, K_H_beta", Channel::Course::ratio});
    list.push_back({"TILTING_MOMENT", moment, "moment of the load along the face about the middle of the face"});
    for (int i = 1; i <= n; ++i)
      list.push_back(
          {"LINE_LOAD_" + std::to_string(i), dimension::stiffness, "normal force per face width, slice " + std::to_string(i)});
  }
}

void put_contact_channels(ChannelWriter& out, const ToothContact& contact, const ContactReport& report,
                          const std::array<double, 2>& power, std::span<const double> scalars) {
  out.put(report.sliding_speed);
  for (const double p : power) out.put(p);
  // power through the teeth, part of which is lost: the power taken, or, when elastic teeth release energy, the power given
  // plus losses
  const double lost = report.friction_power + report.damping_power;
  const double taken = -std::min(power[0], 0.0) - std::min(power[1], 0.0);
  const double given = std::max(power[0], 0.0) + std::max(power[1], 0.0);
  const double through = std::max(taken, given + lost);
  out.put(through > 0 ? 1 - lost / through : 1);
  if (contact.options().friction) {
    out.put(report.friction_force);
    out.put(report.friction_power);
  }
  if (contact.options().running) out.put(contact.geometry().working_pressure_angle(report.opening));
  if (!contact.elastic()) return;
  out.put(scalars[2]);
  out.put(report.approach);
  out.put(contact.law().contact(report.front, report.back));
  if (contact.law().course.varies()) out.put(report.stiffness_factor * contact.law().stiffness);
  const std::size_t n = report.slices.size();
  if (n < 2) return;
  const double width = contact.geometry().width;
  double total = 0, largest = 0, tilting = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double normal = report.slices[i].force / contact.cos_alpha(),
                 y = width * ((static_cast<double>(i) + 0.5) / static_cast<double>(n) - 0.5);
    total += normal;
    tilting += y * normal;
    if (std::abs(normal) > std::abs(largest)) largest = normal;
  }
  out.put(total != 0 ? std::abs(largest * static_cast<double>(n) / total) : 1);
  out.put(tilting);
  for (const ContactReport::Slice& slice : report.slices)
    out.put(slice.force / contact.cos_alpha() * static_cast<double>(n) / width);
}

}  // namespace engrane::elements::gears

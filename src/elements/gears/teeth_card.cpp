// SPDX-License-Identifier: BSD-3-Clause
#include "elements/gears/teeth_card.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>

#include "elements/common/building.hpp"
#include "elements/common/friction_card.hpp"
#include "model/user_function.hpp"

namespace engrane::elements::gears {

namespace {

bool repeats(const Function& function, double period) {
  double size = 0, change = 0;
  for (int i = 0; i < 97; ++i) {
    const double x = period * (0.0203 * i - 1), f = function.at(x).f;
    size = std::max(size, std::abs(f));
    change = std::max(change, std::abs(function.at(x + period).f - f));
  }
  return change <= 1e-9 * size;
}

bool set_error(ToothLaw& law, const TeethData& data, const TeethOwner& owner, const BuildContext& context) {
  if (!data.error.given()) return true;
  TransmissionError& error = law.error;
  error.teeth = owner.teeth[0];
  if (data.error.is("COS")) {
    error.kind = TransmissionError::Kind::cosine;
    error.amplitude = data.error.values[0];
  } else if (data.error.is("FOURIER")) {
    error.kind = TransmissionError::Kind::fourier;
    error.coefficients = data.error.values;
    if (error.coefficients.size() % 2 != 0) {
      context.error("ERR", fmt::format("ERR FOURIER with {} coefficients: they come in pairs a_n b_n", error.coefficients.size()),
                    "give 0 for a missing sine");
      return false;
    }
  } else {
    error.kind = TransmissionError::Kind::table;
    if (!named_function(context, "ERR", data.error.values[0], error.function)) return false;
    if (!repeats(*error.function, 360)) {
      context.error("ERR", fmt::format("function {} does not repeat with each turn of wheel A", number(data.error.values[0])),
                    fmt::format("it is a function of A's angle in degrees: give it PERIOD 360, or PERIOD (360/{}) for one tooth",
                                owner.teeth[0]));
      return false;
    }
  }
  return true;
}

bool set_wheel_errors(ToothLaw& law, const TeethData& data, const BuildContext& context) {
  bool good = true;
  const std::array<const std::vector<double>*, 2> runout{&data.eccentricity_a, &data.eccentricity_b};
  const std::array<int, 2> pitch{data.pitch_a, data.pitch_b};
  for (const std::size_t i : {std::size_t{0}, std::size_t{1}}) {
    const char name = i == 0 ? 'A' : 'B';
    TransmissionError::Wheel& wheel = law.error.wheel[i];
    if (!runout[i]->empty()) wheel.eccentricity = runout[i]->front();
    if (runout[i]->size() > 1) wheel.phase = runout[i]->back() * degree;
    if (pitch[i] == 0) continue;
    const std::string keyword = std::string("PITCH") + name;
    wheel.pitch = context.function(pitch[i], keyword);
    if (wheel.pitch && !repeats(*wheel.pitch, 360))
      context.error(keyword, fmt::format("function {} does not repeat with each turn of wheel {}", pitch[i], name),
                    "it is a function of the wheel's angle in degrees: give it PERIOD 360");
    good = good && wheel.pitch && repeats(*wheel.pitch, 360);
  }
  return good;
}

/// Contact ratio of the path of contact; 0 if a wheel has no involute between its base and tip circles.
double contact_ratio_of(const TeethOwner& owner) {
  if (owner.cut && (owner.cut->without_involute(0) || owner.cut->without_involute(1))) return 0;
  return (owner.geometry.approach + owner.geometry.recess) / owner.geometry.base_pitch;
}

/// Warns of teeth outside the range for which the formulas of ISO 6336-1, 9.3, are given.
void warn_of_iso_range(const IsoMesh& mesh, const BuildContext& context) {
  constexpr double least_ratio = 1.2, least_shift = -0.5, most_shift = 2;
  const auto warn = [&](std::string message, std::string hint) {
    context.diagnostics.warning(context.record.where("STIFF"), std::move(message), std::move(hint));
  };
  if (mesh.contact_ratio < least_ratio)
    warn(fmt::format("contact ratio {:.4g}: the formula of STIFF ISO is given for {} or more", mesh.contact_ratio, least_ratio),
         "below that the teeth can be up to a tenth softer: give KM if it matters");
  const double sum = mesh.shift[0] + mesh.shift[1];
  if (!mesh.ring[0] && !mesh.ring[1] && (sum < least_shift - 1e-9 || sum > most_shift + 1e-9))
    warn(fmt::format("a sum of profile shifts of {}: the formula of STIFF ISO is given for {} to {}", number(sum), least_shift,
                     most_shift),
         "give the tooth stiffness KM itself if it matters");
}

/// Sets the mean stiffness by ISO 6336-1.
bool set_iso(ToothLaw& law, const TeethData& data, const TeethOwner& owner, const BuildContext& context) {
  const auto refuse = [&](std::string_view keyword, std::string message, std::string hint) {
    context.error(keyword, std::move(message), std::move(hint));
    return false;
  };
  const ContactGeometry& g = owner.geometry;
  if (data.stiffness) return refuse("KM", "both KM and STIFF ISO are given: each fixes the tooth stiffness", "keep one of them");
  if (!owner.parallel)
    return refuse("STIFF", "ISO 6336-1 is for wheels with parallel axles", "give the tooth stiffness KM itself");
  if (!data.width) return refuse("STIFF", "STIFF ISO needs the face width", "give WIDTH");
  if (data.moduli.empty()) return refuse("STIFF", "STIFF ISO needs Young's modulus in the units of the deck", "give E");
  IsoMesh mesh;
  mesh.teeth = owner.teeth;
  mesh.ring = {owner.ring[0], owner.ring[1] || owner.teeth[1] == 0};
  mesh.helix = g.helix;
  mesh.pressure_angle = g.pressure_angle;
  mesh.contact_ratio = contact_ratio_of(owner);
  mesh.width = *data.width;
  mesh.E = {data.moduli.front(), data.moduli.back()};
  if (!(mesh.contact_ratio > 1))
    return refuse("STIFF", fmt::format("contact ratio {:.3g}: teeth would lose touch", mesh.contact_ratio), "choose more teeth");
  if (owner.cut) {
    mesh.helix = owner.cut->helix[0];
    mesh.pressure_angle = owner.cut->pressure_angle;
    mesh.shift = owner.cut->shift;
    mesh.dedendum = owner.cut->dedendum;
    mesh.working_helix = g.helix;
    mesh.working_pressure_angle = g.transverse_pressure_angle;
  }
  warn_of_iso_range(mesh, context);
  law.stiffness = iso_mesh_stiffness(mesh);
  law.iso = iso_stiffness(mesh);
  return true;
}

/// Sets the stiffness factor over one pitch, and possibly of the deflection, from a user routine.
bool set_user_course(ToothLaw& law, const TeethData& data, const TeethOwner& owner, const BuildContext& context) {
  MeshStiffness& course = law.course;
  const double deflection = 1e-4 * owner.geometry.radius;
  std::vector<user::Arguments> samples;
  for (const double place : {0.0, 0.1173, 0.2871, 0.4619, 0.6337, 0.8211, 0.9503})
    for (const double part : {0.0, 0.5, 1.0}) samples.push_back({place, part * deflection, 0});
  course.kind = MeshStiffness::Kind::user;
  course.routine = user_routine(context, "STIFF", data.course.values[0], user::Kind::mesh, {0.05, deflection, 1}, samples);
  if (!course.routine) return false;
  for (const user::Arguments& x : samples)
    for (const double size : {0.1, 1.0, 10.0})
      course.loaded = course.loaded || course.routine->at({x[0], size * deflection, 0})[0] != course.routine->at({x[0], 0, 0})[0];
  const double begin = course.routine->at({0, 0, 0})[0], end = course.routine->at({1, 0, 0})[0];
  if (!(std::abs(end - begin) <= 1e-9 * std::abs(begin))) {
    context.error("STIFF",
                  fmt::format("{} gives {} at the beginning of a tooth pitch (0) and {} at its end (1)",
                              course.routine->source().label(), number(begin), number(end)),
                  "the factor repeats with each tooth, so both are the same place");
    return false;
  }
  if (!course.loaded) return true;
  for (const auto& [keyword, given] : {std::pair<std::string_view, bool>{"RUNNING", data.running},
                                       {"SLICES", data.slices > 1},
                                       {"EXPONENT", !data.exponent.empty()}})
    if (given) {
      context.error(keyword,
                    fmt::format("{} does not go with a stiffness that depends on the deflection ({})", keyword,
                                course.routine->source().label()),
                    fmt::format("leave {} out, or make the routine depend on the place in the pitch alone", keyword));
      return false;
    }
  return true;
}

bool set_course(ToothLaw& law, const TeethData& data, const TeethOwner& owner, const BuildContext& context) {
  MeshStiffness& course = law.course;
  const std::vector<double>& values = data.course.values;
  if (data.course.is("FOURIER")) {
    course.kind = MeshStiffness::Kind::fourier;
    course.coefficients = values;
    if (values.size() % 2 != 0) {
      context.error("STIFF", fmt::format("STIFF FOURIER with {} coefficients: they come in pairs a_n b_n", values.size()),
                    "give 0 for a missing sine");
      return false;
    }
  } else if (data.course.is("TABLE")) {
    course.kind = MeshStiffness::Kind::table;
    if (!named_function(context, "STIFF", values[0], course.function)) return false;
    if (!repeats(*course.function, 1)) {
      context.error("STIFF", fmt::format("function {} does not repeat with each tooth", number(values[0])),
                    "it is a factor on KM over one tooth pitch, from 0 to 1: give it PERIOD 1");
      return false;
    }
  } else if (data.course.is("USER")) {
    if (!set_user_course(law, data, owner, context)) return false;
  } else if (data.course.is("SQUARE")) {
    course.kind = MeshStiffness::Kind::square;
    const ContactGeometry& g = owner.geometry;
    if (values.empty() && !owner.parallel) {
      context.error("STIFF", "the contact ratio of these teeth is not known", "give it: STIFF SQUARE eps");
      return false;
    }
    course.contact_ratio = values.empty() ? contact_ratio_of(owner) : values[0];
    if (!(course.contact_ratio >= 1)) {
      context.error("STIFF", fmt::format("contact ratio {:.4g}: between two teeth nothing would touch", course.contact_ratio),
                    "a pair that runs has 1 or more: choose more teeth, or STIFF CONST");
      return false;
    }
    const double fraction = course.contact_ratio - std::floor(course.contact_ratio);
    const double edge = values.size() > 1 ? values[1] : 0.05;
    if (edge <= 0 || edge > 0.5) {
      context.error("STIFF", fmt::format("the stiffness cannot change over {} of a pitch", number(edge)), "give 0.01 to 0.5");
      return false;
    }
    course.edge = std::min({edge, fraction, 1 - fraction});
    // position, from the pitch point, of the later flank when both ends of the path are equally far away
    if (owner.cut && values.empty()) course.middle = 0.5 * fraction - g.approach / g.base_pitch - g.flank;
    if (course.edge < 1e-6) course.kind = MeshStiffness::Kind::constant;  // an integer number of pairs at all times
  }
  double least = 1;
  for (int i = 0; course.varies() && i < 720; ++i) least = std::min(least, course.at(i * std::numbers::pi / 360).f);
  if (least > 0) return true;
  context.error("STIFF", fmt::format("the tooth stiffness falls to {:.3g} of KM", least), "it must stay positive");
  return false;
}

/// Warns of a backlash wider than half the pitch along the tooth normal, where teeth and spaces are equally wide: no tooth
/// would be left.
void warn_of_wide_backlash(const ToothLaw& law, const TeethData& data, const TeethOwner& owner, const BuildContext& context) {
  const double gap = std::numbers::pi * owner.lever[0] / owner.teeth[0];
  if (law.backlash <= gap) return;
  const char* keyword = data.backlash ? "JEU" : data.normal_backlash ? "JEUN" : data.center_backlash ? "JEUA" : "ASN";
  context.diagnostics.warning(context.record.where(keyword),
                              fmt::format("a backlash of {} along the circumference is wider than the gap between two teeth, {}",
                                          number(law.backlash), number(gap)),
                              "is it in the deck's unit of length? Teeth have backlash of a few hundredths of the module");
}

/// The backlash that vanishes when the wheels come closer by `closing` across the teeth: each flank then opens by −b/2. With
/// axles that are not parallel 2Δa tanα_n.
std::optional<double> backlash_of_closing(double closing, const TeethOwner& owner, const BuildContext& context) {
  const ContactGeometry& g = owner.geometry;
  if (!owner.parallel) return 2 * closing * std::tan(g.pressure_angle);
  // inside a ring the centre distance grows when the teeth come closer, and a rack has no base circle
  if (const double room = g.center_distance - g.base_radii; g.base_radii > 0 && closing >= room) {
    context.error(
        "JEUA",
        fmt::format("wheels that come closer by {} have base circles that meet, from {} on", number(closing), number(room)),
        "JEUA is the reduction of the centre distance that takes the backlash up, a few hundredths of the module");
    return {};
  }
  return -2 * g.flank_opening(-closing).f;
}

/// Sets the backlash along the circumference, however it is given.
bool set_backlash(ToothLaw& law, const TeethData& data, const TeethOwner& owner, const BuildContext& context) {
  const int ways = (data.backlash ? 1 : 0) + (data.normal_backlash ? 1 : 0) + (data.center_backlash ? 1 : 0) +
                   (data.thickness_allowance.empty() ? 0 : 1);
  if (ways > 1) {
    context.error(!data.thickness_allowance.empty() ? "ASN"
                  : data.normal_backlash            ? "JEUN"
                                                    : "JEUA",
                  "JEU, JEUN, JEUA and ASN exclude each other: each fixes the backlash", "keep one of them");
    return false;
  }
  const double alpha = owner.geometry.pressure_angle;
  if (data.backlash) law.backlash = *data.backlash;
  if (data.normal_backlash) law.backlash = *data.normal_backlash / std::cos(alpha);
  if (data.center_backlash) {
    const auto backlash = backlash_of_closing(*data.center_backlash, owner, context);
    if (!backlash) return false;
    law.backlash = *backlash;
  }
  if (const auto& a = data.thickness_allowance; !a.empty()) {
    const double cut_alpha = owner.cut ? owner.cut->pressure_angle : alpha;
    law.backlash = -(a.front() + a.back()) * std::cos(cut_alpha) / std::cos(alpha);  // j_bn = −ΣA_sn cosα_n
  }
  warn_of_wide_backlash(law, data, owner, context);
  law.onset = data.onset.value_or(0);
  if (!data.onset || law.onset <= law.backlash) return true;
  context.error("SMOOTH", fmt::format("SMOOTH {} is wider than the backlash {}", number(law.onset), number(law.backlash)),
                law.backlash > 0 ? "give a small fraction of it" : "without JEU there is no onset of contact: leave SMOOTH out");
  return false;
}

bool set_damping(ToothLaw& law, const TeethData& data, const TeethOwner& owner, const BuildContext& context) {
  if (data.damping && data.damping_ratio) {
    context.error("CM", "both XI and CM are given: each fixes the damping of the teeth", "keep one of them");
    return false;
  }
  if (data.damping) law.damping = *data.damping;
  if (!data.damping_ratio || *data.damping_ratio == 0) return true;
  if (owner.teeth[1] == 0) {
    context.error("XI", "XI is measured against the inertia of two wheels", "give the damper of a rack's teeth itself with CM");
    return false;
  }
  std::array<double, 2> inertia{};
  bool good = true;
  for (const std::size_t wheel : {std::size_t{0}, std::size_t{1}}) {
    const int node = owner.nodes[wheel];
    inertia[wheel] = node == 0 ? std::numeric_limits<double>::infinity() : context.wheel_inertia(node, owner.axle[wheel]);
    if (inertia[wheel] > 0) continue;
    good = false;
    context.error("XI",
                  fmt::format("XI needs the inertia of both wheels about their axles (32, 33); node {} of wheel {} has none",
                              node, wheel == 0 ? "A" : "B"),
                  "give the damper itself with CM, or the wheel's inertia with INERTIA");
  }
  if (good && std::isinf(inertia[0]) && std::isinf(inertia[1])) {
    context.error("XI", "XI needs a wheel that can turn: the ground or supports hold both", "give the damper itself with CM");
    good = false;
  }
  if (good)
    law.damping = tooth_damping(*data.damping_ratio, law.stiffness, inertia[0], inertia[1], owner.lever[0], owner.lever[1]);
  return good;
}

/// Rejects data of elastic teeth on a card with rigid teeth.
bool refuse_of_rigid_teeth(const TeethData& data, const BuildContext& context) {
  const std::array<std::pair<std::string_view, bool>, 21> elastic{{{"XI", data.damping_ratio.has_value()},
                                                                   {"CM", data.damping.has_value()},
                                                                   {"JEU", data.backlash.has_value()},
                                                                   {"JEUN", data.normal_backlash.has_value()},
                                                                   {"JEUA", data.center_backlash.has_value()},
                                                                   {"ASN", !data.thickness_allowance.empty()},
                                                                   {"SMOOTH", data.onset.has_value()},
                                                                   {"DAMP", data.damping_mode.given()},
                                                                   {"ERR", data.error.given()},
                                                                   {"ECCA", !data.eccentricity_a.empty()},
                                                                   {"ECCB", !data.eccentricity_b.empty()},
                                                                   {"PITCHA", data.pitch_a != 0},
                                                                   {"PITCHB", data.pitch_b != 0},
                                                                   {"STIFF", data.course.given()},
                                                                   {"EXPONENT", !data.exponent.empty()},
                                                                   {"TIPRELA", !data.tip_relief_a.empty()},
                                                                   {"TIPRELB", !data.tip_relief_b.empty()},
                                                                   {"ROOTRELA", !data.root_relief_a.empty()},
                                                                   {"ROOTRELB", !data.root_relief_b.empty()},
                                                                   {"CROWN", data.crown.has_value()},
                                                                   {"SLICES", data.slices > 1}}};
  bool rigid = true;
  for (const auto& [keyword, given] : elastic)
    if (given) {
      rigid = false;
      context.error(keyword, fmt::format("{} describes elastic teeth, but these are rigid", keyword),
                    "give the tooth stiffness KM, or STIFF ISO");
    }
  return rigid;
}

bool set_friction(ContactOptions& options, const TeethData& data, const TeethOwner& owner, const BuildContext& context) {
  if (!data.friction.given()) {
    bool good = true;
    for (const auto& [keyword, given] : {std::pair<std::string_view, bool>{"VREG", data.friction_width.has_value()},
                                         {"STICK", data.sticks},
                                         {"SLIDING", data.sliding.given()},
                                         {"ROLLING", data.rolling > 0}})
      if (given) {
        good = false;
        context.error(keyword, fmt::format("{} describes friction, and there is none", keyword),
                      "give FRICTION (CONST 0 for rolling alone)");
      }
    return good;
  }
  ToothFriction friction;
  FrictionLaw& law = friction.law;
  law.rests = !data.friction_width;
  law.width = data.friction_width.value_or(0);
  if (!read_friction(context, data.friction, law)) return false;
  if ((data.friction.is("CONST") || data.friction.is("STRIBECK")) && law.mu > 1)
    context.diagnostics.warning(context.record.where("FRICTION"),
                                fmt::format("a coefficient of friction of {} between the flanks", number(law.mu)),
                                "lubricated teeth have 0.03 to 0.15, dry ones 0.2 to 0.5: is it in per cent?");
  friction.rolling = data.rolling;
  friction.profile = data.sliding.is("PROFILE");
  const ContactGeometry& g = owner.geometry;
  if (data.sticks && data.friction_width) {
    context.error("STICK", "STICK regularises nothing, VREG does", "remove one of them");
    return false;
  }
  if (law.rests && friction.rolling > 0) {
    context.error("ROLLING", "rolling resistance is regularised: it needs VREG", "VREG v, well below the speeds of interest");
    return false;
  }
  if (law.rests && owner.teeth[1] == 0 && !owner.parallel) {
    context.error("FRICTION", "the teeth of an oblique rack slide along each other; friction at rest is not modelled there",
                  "give VREG v, well below the speeds of interest");
    return false;
  }
  if (law.rests && !friction.profile && g.slip_per_turn == 0) {
    context.error("FRICTION", "these teeth do not slide at the pitch point: there is nothing to hold",
                  owner.path_known ? "with SLIDING PROFILE flanks slide before and behind it" : "give VREG");
    return false;
  }
  if (friction.profile && !owner.path_known) {
    context.error("SLIDING", "the path of contact is only known of axles that are parallel or meet",
                  "SLIDING PITCH slides at the pitch point, as most of the sliding of such teeth does");
    return false;
  }
  if (friction.profile && !(contact_ratio_of(owner) > 1.01)) {
    context.error("SLIDING", fmt::format("contact ratio {:.4g}: some flanks must touch at all times", contact_ratio_of(owner)),
                  "choose more teeth");
    return false;
  }
  options.friction = friction;
  return true;
}

bool set_options(ContactOptions& options, const TeethData& data, const TeethOwner& owner, const BuildContext& context) {
  options.separation = !data.separation.is("NO");
  options.running = data.running || data.slices > 1;
  options.slices = data.slices;
  bool good = set_friction(options, data, owner, context);
  if (!options.running) return good;
  const char* keyword = data.running ? "RUNNING" : "SLICES";
  if (!owner.parallel) {
    context.error(keyword, fmt::format("{} follows the involutes of parallel axles, and these cross or meet", keyword));
    good = false;
  }
  if (!options.separation) {
    context.error("SEPARATION", fmt::format("with {} the radial force belongs to the flanks and cannot be left out", keyword));
    good = false;
  }
  if (options.slices > 1 && !data.width) {
    context.error("SLICES", "slices need the face width", "give WIDTH");
    good = false;
  }
  return good;
}

}  // namespace

void warn_of_radians(double alpha, const BuildContext& context) {
  constexpr double least = 1;  // degree
  if (alpha <= 0 || alpha >= least) return;
  context.diagnostics.warning(context.record.where("ALPHA"), fmt::format("a pressure angle of {} degrees", number(alpha)),
                              fmt::format("angles are in degrees: {} radians are {:.4g} degrees", number(alpha), alpha / degree));
}

/// Sets relief and crowning: the material removed normal to the flanks, converted to the circumference.
bool set_relief(ToothLaw& law, const TeethData& data, const TeethOwner& owner, const BuildContext& context) {
  const ContactGeometry& g = owner.geometry;
  const double along = std::cos(g.helix) / std::cos(g.transverse_pressure_angle);
  struct Given {
    const char* keyword;
    const std::vector<double>& values;
    bool at_recess;
  };
  const std::array<Given, 4> all{{{"TIPRELA", data.tip_relief_a, true},
                                  {"ROOTRELB", data.root_relief_b, true},
                                  {"TIPRELB", data.tip_relief_b, false},
                                  {"ROOTRELA", data.root_relief_a, false}}};
  const auto refuse = [&](std::string_view keyword, std::string message, std::string hint) {
    context.error(keyword, std::move(message), std::move(hint));
    return false;
  };
  const char* first = nullptr;
  ToothRelief& relief = law.relief;
  relief.approach = g.approach;
  relief.recess = g.recess;
  relief.base_pitch = g.base_pitch;
  relief.flank = g.flank;
  const double path = g.approach + g.recess;
  for (const Given& one : all) {
    if (one.values.empty()) continue;
    if (!owner.parallel)
      return refuse(one.keyword, "relief follows the path of contact of parallel axles, and these cross or meet", "leave it out");
    first = one.keyword;
    const double exponent = one.values.size() > 2 ? one.values[2] : 2;
    if (exponent < 1 || exponent > 4)
      return refuse(one.keyword, fmt::format("relief that grows with the power {}", number(exponent)), "give 1 (linear) to 4");
    if (one.values[1] > path)
      return refuse(one.keyword,
                    fmt::format("relief over {}, and the path of contact is {} long", number(one.values[1]), number(path)),
                    "tip relief is usual over a fifth to a third of it");
    relief.ramps.push_back({one.at_recess, one.values[0] * along, one.values[1], exponent});
  }
  if (data.crown) {
    if (!owner.parallel) return refuse("CROWN", "crowning is for parallel axles, and these cross or meet", "leave it out");
    law.crown = *data.crown * along;
    if (!data.exponent.empty())
      return refuse("CROWN", "CROWN and EXPONENT both make the teeth softer at first", "keep one of them");
    if (law.course.loaded)
      return refuse("CROWN", "CROWN does not go with a stiffness that depends on the deflection", "keep one of them");
  }
  if (!relief.active()) return true;
  if (!(contact_ratio_of(owner) > 1))
    return refuse(first, fmt::format("contact ratio {:.4g}: between two teeth nothing would touch", contact_ratio_of(owner)),
                  "choose more teeth");
  relief.edge = std::min(0.05 * g.base_pitch, 0.5 * (path - g.base_pitch));
  for (const auto& [keyword, given] : {std::pair<std::string_view, bool>{"RUNNING", data.running},
                                       {"SLICES", data.slices > 1},
                                       {"EXPONENT", !data.exponent.empty()},
                                       {"STIFF", law.course.varies()}})
    if (given)
      return refuse(keyword,
                    fmt::format("{} does not go with {}: with relief each pair of teeth is a spring of its own", keyword, first),
                    fmt::format("leave {} out", keyword));
  return true;
}

std::optional<Teeth> read_teeth(const TeethData& data, const TeethOwner& owner, const BuildContext& context) {
  Teeth teeth;
  bool good = set_options(teeth.options, data, owner, context);
  ToothLaw& law = teeth.law;
  law.mesh = owner.mesh;
  if (data.phase) law.mesh.phase = *data.phase * degree;
  if (!data.stiffness && !data.course.is("ISO")) {
    good = refuse_of_rigid_teeth(data, context) && good;
    if (!good) return {};
    return teeth;
  }
  if (data.course.is("ISO"))
    good = set_iso(law, data, owner, context) && good;
  else
    law.stiffness = *data.stiffness;
  good = set_course(law, data, owner, context) && good;
  if (!data.exponent.empty()) {
    law.exponent = data.exponent[0];
    law.reference = data.exponent[1];
    if (law.exponent < 1 || law.exponent > 3) {
      context.error("EXPONENT", fmt::format("exponent {}: teeth have 1 to 3, line contact about 1.1", number(law.exponent)));
      good = false;
    }
  }
  good = set_backlash(law, data, owner, context) && good;
  law.mode = data.damping_mode.is("CONTACT") || (!data.damping_mode.given() && law.backlash > 0) ? ToothLaw::Damping::contact
                                                                                                 : ToothLaw::Damping::always;
  good = set_error(law, data, owner, context) && good;
  good = set_wheel_errors(law, data, context) && good;
  good = set_damping(law, data, owner, context) && good;
  good = set_relief(law, data, owner, context) && good;
  if (!good) return {};
  return teeth;
}

}  // namespace engrane::elements::gears

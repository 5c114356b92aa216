// SPDX-License-Identifier: BSD-3-Clause
#include "elements/gear_card.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>

#include "elements/building.hpp"

namespace engrane {

namespace {

/// Relative misfit of lengths up to which typed numbers count as equal.
constexpr double typing_tolerance = 1e-6;

/// A length as the user should read and may copy it.
std::string number(double value) { return fmt::format("{:.10g}", std::abs(value) < 1e-12 ? 0.0 : value); }

/// The wheel with more teeth is the ring of an internal pair.
std::optional<std::array<double, 2>> internal_cones(const GearData& data, const BuildContext& context) {
  if (data.teeth[0] == data.teeth[1]) {
    context.error("INTERNAL", fmt::format("an internal pair with {} teeth on both wheels", data.teeth[0]),
                  "the ring gear needs more teeth than the pinion");
    return {};
  }
  const bool ring_is_a = data.teeth[0] > data.teeth[1];
  return std::array<double, 2>{ring_is_a ? std::numbers::pi : 0.0, ring_is_a ? 0.0 : std::numbers::pi};
}

/// Cones of a pair whose axles meet: the sign is the one that suits the side of A on which B lies.
std::array<double, 2> bevel_cones(double shaft, const GearData& data, const Vec3& x_ab, const Vec3& axle) {
  auto cones = cones_of_shaft_angle(shaft, data.teeth);
  // the offset of B along the axle of A, −r_B Z₁₂ = −r_B sin(γ_A + γ_B), has the sign to choose by
  GearDesign design;
  design.teeth = data.teeth;
  design.normal_module = data.normal_module;
  design.cone = cones;
  if (closure(design, Vec3::Zero(), x_ab, axle).offset_needed * x_ab.dot(axle) < 0)
    for (double& cone : cones) cone = -cone;
  return cones;
}

/// Cone angles, radians, from whichever of CONE, SHAFT, INTERNAL and AXISB the deck gives.
std::optional<std::array<double, 2>> cones_of(const GearData& data, const Vec3& x_a, const Vec3& x_b, const Vec3& axle,
                                              const BuildContext& context) {
  const int ways = (data.cone ? 1 : 0) + (data.shaft_angle ? 1 : 0) + (data.internal ? 1 : 0);
  if (ways > 1) {
    context.error(data.internal ? "INTERNAL" : "SHAFT", "CONE, SHAFT and INTERNAL exclude each other: each fixes the cone angles",
                  "keep one of them");
    return {};
  }
  if (data.cone) return std::array<double, 2>{(*data.cone)[0] * degree, (*data.cone)[1] * degree};
  if (data.internal) return internal_cones(data, context);
  if (data.shaft_angle) return bevel_cones(*data.shaft_angle * degree, data, x_b - x_a, axle);
  if (data.axis_b) {
    const Vec3 axle_b = to_vector(*data.axis_b).normalized();
    if (const auto shaft = shaft_angle_of_axles(x_a, axle, x_b, axle_b)) return bevel_cones(*shaft, data, x_b - x_a, axle);
  }
  return std::array<double, 2>{0, 0};
}

void set_helices(GearDesign& design, const GearData& data) {
  if (data.helix.empty()) return;
  design.helix[0] = paper_helix(data.helix[0] * degree, design.cone[0]);
  design.helix[1] = data.helix.size() > 1 ? paper_helix(data.helix[1] * degree, design.cone[1]) : -design.helix[0];
}

bool check_radii(const GearDesign& design, const GearData& data, const BuildContext& context) {
  if (!data.radii) return true;
  bool good = true;
  for (const std::size_t wheel : {std::size_t{0}, std::size_t{1}}) {
    const double given = (*data.radii)[wheel], needed = design.radius(wheel);
    if (std::abs(given - needed) <= typing_tolerance * needed) continue;
    good = false;
    context.error("R",
                  fmt::format("pitch radius of wheel {}: {} given, {} needed by 2 r cos(helix) = z m_n", wheel == 0 ? "A" : "B",
                              number(given), number(needed)),
                  "leave R out: it follows from Z, MN and HELIX");
  }
  return good;
}

/// Does the pair close where its nodes are?
bool check_closure(const GearDesign& design, const GearData& data, const Vec3& x_a, const Vec3& x_b, const Vec3& axle,
                   const BuildContext& context) {
  const int kind = design.parallel_kind();
  if ((kind == -1 && design.teeth[1] <= design.teeth[0]) || (kind == -2 && design.teeth[0] <= design.teeth[1])) {
    context.error("CONE",
                  fmt::format("wheel {} is the ring gear (cone 180) of {} teeth, its pinion has {}", kind == -1 ? "B" : "A",
                              design.teeth[kind == -1 ? 1 : 0], design.teeth[kind == -1 ? 0 : 1]),
                  "the ring gear needs more teeth than the pinion; INTERNAL finds the ring by itself");
    return false;
  }
  const Closure c = closure(design, x_a, x_b, axle);
  if (c.distance_needed < typing_tolerance * c.size) {
    context.error("N", "the contact point has no place: both wheels would be the same circle",
                  "an internal pair needs wheels of different radii (theory, equation 12)");
    return false;
  }
  bool good = true;
  if (std::abs(c.distance_given - c.distance_needed) > typing_tolerance * c.size) {
    good = false;
    context.error("N",
                  fmt::format("{}: {} given, {} needed by Z, MN, HELIX and the cones",
                              kind != 0 ? "centre distance" : "distance of the centre of wheel B from the axle of wheel A",
                              number(c.distance_given), number(c.distance_needed)),
                  fmt::format("move node {} or {}", data.nodes[0], data.nodes[1]));
  }
  if (std::abs(c.offset_given - c.offset_needed) > typing_tolerance * c.size) {
    good = false;
    const bool mirrored = std::abs(c.offset_given + c.offset_needed) <= typing_tolerance * c.size;
    context.error("N",
                  fmt::format("offset of the centre of wheel B from the plane of wheel A, along AXIS: {} given, {} needed",
                              number(c.offset_given), number(c.offset_needed)),
                  mirrored ? "turn AXIS round, or change the sign of both cone angles"
                           : fmt::format("move node {} or {}", data.nodes[0], data.nodes[1]));
  }
  return good;
}

/// AXISB is a line: its sense does not matter.
bool check_axle_b(const GearDesign& design, const GearData& data, const PitchFrames& frames, const BuildContext& context) {
  const Vec3 needed = frames.xi.col(0);
  if (!data.axis_b) {
    if (std::abs(std::sin(design.cone[0])) + std::abs(std::sin(design.cone[1])) < 1e-9 && design.parallel_kind() == 0)
      context.diagnostics.warning(
          context.record.where("HELIX"),
          fmt::format("these helices make crossed axles: B turns about ({}, {}, {})", number(needed[0]), number(needed[1]),
                      number(needed[2])),
          "give AXISB to confirm; for parallel axles give HELIX one value, or opposite hands (equal hands inside a ring)");
    return true;
  }
  const Vec3 given = to_vector(*data.axis_b).normalized();
  const double off = cross(given, needed).norm();
  if (off <= typing_tolerance) return true;
  const double angle = std::atan2(off, std::abs(given.dot(needed))) / degree;
  context.error(
      "AXISB",
      fmt::format("axle of wheel B: ({}, {}, {}) given, ({}, {}, {}) needed by the cones and helices, {:.6g} degrees away",
                  number(given[0]), number(given[1]), number(given[2]), number(needed[0]), number(needed[1]), number(needed[2]),
                  angle),
      "parallel axles need opposite hands (equal hands inside a ring); crossed ones |helix A + helix B| = their angle");
  return false;
}

bool repeats_each_turn(const Function& function) {
  double size = 0, change = 0;
  for (int i = 0; i < 97; ++i) {
    const double x = -360 + 7.3 * i, f = function.at(x).f;
    size = std::max(size, std::abs(f));
    change = std::max(change, std::abs(function.at(x + 360).f - f));
  }
  return change <= 1e-9 * size;
}

bool set_error(ToothLaw& law, const GearData& data, const BuildContext& context) {
  if (!data.error.given()) return true;
  TransmissionError& error = law.error;
  error.teeth = data.teeth[0];
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
    const double id = data.error.values[0];
    if (id != std::floor(id) || std::abs(id) > 1e9) {
      context.error("ERR", fmt::format("ERR TABLE {}: not the number of a function", number(id)));
      return false;
    }
    error.function = context.function(static_cast<int>(id), "ERR");
    if (!error.function) return false;
    if (!repeats_each_turn(*error.function)) {
      context.error("ERR", fmt::format("function {} does not repeat with each turn of wheel A", static_cast<int>(id)),
                    fmt::format("it is a function of A's angle in degrees: give it PERIOD 360, or PERIOD (360/{}) for one tooth",
                                data.teeth[0]));
      return false;
    }
  }
  return true;
}

bool set_damping(ToothLaw& law, const GearData& data, const GearPlacement& placement, const BuildContext& context) {
  if (data.damping && data.damping_ratio) {
    context.error("CM", "both XI and CM are given: each fixes the damping of the teeth", "keep one of them");
    return false;
  }
  if (data.damping) law.damping = *data.damping;
  if (!data.damping_ratio || *data.damping_ratio == 0) return true;
  std::array<double, 2> inertia{};
  const std::array<Vec3, 2> axle{placement.frames.mu.col(0), placement.frames.xi.col(0)};
  bool good = true;
  for (const std::size_t wheel : {std::size_t{0}, std::size_t{1}}) {
    const int node = data.nodes[wheel];
    inertia[wheel] = node == 0 ? std::numeric_limits<double>::infinity() : context.wheel_inertia(node, axle[wheel]);
    if (inertia[wheel] > 0) continue;
    good = false;
    context.error("XI",
                  fmt::format("XI needs the inertia of both wheels about their axles (32, 33); node {} of wheel {} has none",
                              node, wheel == 0 ? "A" : "B"),
                  "give the damper itself with CM, or the wheel's inertia with INERTIA");
  }
  if (good)
    law.damping = tooth_damping(*data.damping_ratio, law.stiffness, inertia[0], inertia[1], placement.design.lever(0),
                                placement.design.lever(1));
  return good;
}

}  // namespace

const deck::Card<GearData>& gear_card() {
  static const deck::Card<GearData> card = [] {
    using namespace dimension;
    deck::Card<GearData> c("GEAR", {"ENGRENAGE", "GEAR_PAIR"},
                           "Pair of gears: spur, helical, internal, bevel, crossed, hypoid or worm");
    c.chapter("Rigid kinematic joints").numbered();
    c.describe(
        "Two toothed wheels, each at a node that is its centre. The pair passes the normal tooth force between them, with its "
        "tangential, radial and axial parts; bearings and shafts are other elements. The places of the nodes must agree with "
        "Z, MN, HELIX and the cones. Teeth are rigid unless KM is given; XI, CM, JEU, SMOOTH, DAMP and ERR need it. "
        "Right-hand helices are positive. Cone angles are the paper's: 0 an external cylinder, 180 a ring gear, positive "
        "when the wheel widens along its axle.");
    c.add("N", &GearData::nodes, "centres of wheel A and wheel B")
        .synonyms({"NOEUDS", "NODES", "NOEUD"})
        .refers(deck::Reference::node)
        .required();
    c.add("Z", &GearData::teeth, "numbers of teeth (threads of a worm)").synonyms({"DENTS", "TEETH"}).at_least(1).required();
    c.add("MN", &GearData::normal_module, "normal module").synonyms({"MODULE"}).unit(length).positive().required();
    c.add("ALPHA", &GearData::pressure_angle, "normal pressure angle").synonyms({"PRESSURE"}).unit(angle).at_least(0).below(90);
    c.add("HELIX", &GearData::helix, "helix or spiral angles at the pitch point, right hand positive; one value: B fits A")
        .synonyms({"HELICE", "BETA"})
        .unit(angle)
        .values(1, 2)
        .above(-90)
        .below(90);
    c.add("AXIS", &GearData::axis, "direction of the axle of wheel A in the reference configuration")
        .synonyms({"AXE"})
        .required();
    c.add("AXISB", &GearData::axis_b, "axle of wheel B, either sense: checked, and used to tell bevel from crossed pairs")
        .synonyms({"AXEB"});
    c.add("CONE", &GearData::cone, "pitch cone angles").synonyms({"CONICITE", "GAMMA"}).unit(angle).at_least(-360).at_most(360);
    c.add("SHAFT", &GearData::shaft_angle, "angle between the axles of a bevel pair: the cones follow from Z")
        .synonyms({"ARBRES", "SIGMA"})
        .unit(angle)
        .positive()
        .below(180);
    c.add("INTERNAL", &GearData::internal, "the wheel with more teeth is a ring gear").synonyms({"INTERNE", "INTERIEUR"});
    c.add("R", &GearData::radii, "pitch radii, only to be checked against z m_n/(2 cos helix)")
        .synonyms({"RAYONS", "RADII"})
        .unit(length)
        .positive();
    c.add("WIDTH", &GearData::width, "face width, for pictures; 10 m_n when not given")
        .synonyms({"LARGEUR"})
        .unit(length)
        .positive();
    c.add("KM", &GearData::stiffness, "tooth stiffness along the circumference")
        .synonyms({"RAIDEUR"})
        .unit(dimension::stiffness)
        .positive();
    c.add("XI", &GearData::damping_ratio, "damping ratio of the teeth against the inertia of both wheels").at_least(0);
    c.add("CM", &GearData::damping, "tooth damping along the circumference, instead of XI").unit(dimension::damping).at_least(0);
    c.add("JEU", &GearData::backlash, "backlash along the circumference").synonyms({"BACKLASH"}).unit(length).at_least(0);
    c.add("SMOOTH", &GearData::onset, "width over which contact comes on; JEU/1000 when not given")
        .synonyms({"LISSAGE"})
        .unit(length)
        .at_least(0);
    c.add("DAMP", &GearData::damping_mode, "when the teeth damp; CONTACT with JEU and ALWAYS without when not given")
        .synonyms({"AMORTISSEMENT"})
        .option({"ALWAYS", {"TOUJOURS"}, "at all times, the paper's law"})
        .option({"CONTACT", {}, "only while they touch, and never so that they pull"});
    c.add("ERR", &GearData::error, "transmission error under static load, along the circumference")
        .synonyms({"ERREUR", "ERROR"})
        .option({"COS", {}, "X: X (1 - cos z_A psi_A)", 1, 1, length})
        .option({"FOURIER", {}, "a1 b1 a2 b2 ...: sum of a_n cos(n z_A psi_A) + b_n sin(n z_A psi_A)", 2, 200, length})
        .option({"TABLE", {"FCT", "NF"}, "f: function f of psi_A in degrees, repeating with the turn", 1, 1});
    c.add("SEPARATION", &GearData::separation, "the radial part of the tooth force, which pushes the wheels apart")
        .option({"YES", {"OUI"}, "with it"})
        .option({"NO", {"NON"}, "without: tangential and axial parts only"});
    c.example("I 1 GEAR N 1 2 AXIS 0 0 1 Z 20 40 MN 2 HELIX 15");
    c.example("I 2 GEAR N 2 3 AXIS 0 0 1 Z 25 25 MN 0.15748 KM 1.477E7 XI 0.1 ERR COS 0.003937 JEU 0.001968");
    c.example("I 3 GEAR N 1 2 AXIS 0 1 0 Z 50 10 MN 0.2 SHAFT 90");
    return c;
  }();
  return card;
}

std::optional<GearPlacement> place_gear(const GearData& data, const BuildContext& context) {
  const bool nodes_good = check_nodes(context, {data.nodes[0], data.nodes[1]});
  const auto axle_given = unit_vector(context, "AXIS", data.axis);
  const bool axle_b_good = !data.axis_b || unit_vector(context, "AXISB", *data.axis_b);
  if (!nodes_good || !axle_given || !axle_b_good) return {};
  const Vec3 axle = *axle_given, x_a = context.nodes.at(data.nodes[0]), x_b = context.nodes.at(data.nodes[1]);
  const auto cones = cones_of(data, x_a, x_b, axle, context);
  if (!cones) return {};

  GearPlacement placement;
  GearDesign& design = placement.design;
  design.teeth = data.teeth;
  design.normal_module = data.normal_module;
  design.pressure_angle = data.pressure_angle * degree;
  design.cone = *cones;
  set_helices(design, data);
  const bool radii_good = check_radii(design, data, context);  // both, so that one run reports all faults
  if (!check_closure(design, data, x_a, x_b, axle, context) || !radii_good) return {};
  placement.frames = pitch_frames(design, x_a, x_b, axle);
  if (!check_axle_b(design, data, placement.frames, context)) return {};
  return placement;
}

std::optional<ToothLaw> tooth_law(const GearData& data, const GearPlacement& placement, const BuildContext& context) {
  ToothLaw law;
  if (!data.stiffness) {
    const std::array<std::pair<std::string_view, bool>, 6> elastic{{{"XI", data.damping_ratio.has_value()},
                                                                    {"CM", data.damping.has_value()},
                                                                    {"JEU", data.backlash.has_value()},
                                                                    {"SMOOTH", data.onset.has_value()},
                                                                    {"DAMP", data.damping_mode.given()},
                                                                    {"ERR", data.error.given()}}};
    bool rigid = true;
    for (const auto& [keyword, given] : elastic)
      if (given) {
        rigid = false;
        context.error(keyword, fmt::format("{} describes elastic teeth, but these are rigid", keyword),
                      "give the tooth stiffness KM");
      }
    if (!rigid) return {};
    return law;
  }
  law.stiffness = *data.stiffness;
  law.backlash = data.backlash.value_or(0);
  law.onset = data.onset.value_or(1e-3 * law.backlash);
  law.mode = data.damping_mode.is("CONTACT") || (!data.damping_mode.given() && law.backlash > 0) ? ToothLaw::Damping::contact
                                                                                                 : ToothLaw::Damping::always;
  bool good = true;
  if (data.onset && law.onset > law.backlash) {
    context.error(
        "SMOOTH", fmt::format("SMOOTH {} is wider than the backlash JEU {}", number(law.onset), number(law.backlash)),
        law.backlash > 0 ? "give a small fraction of JEU" : "without JEU there is no onset of contact: leave SMOOTH out");
    good = false;
  }
  good = set_error(law, data, context) && good;
  good = set_damping(law, data, placement, context) && good;
  if (!good) return {};
  return law;
}

}  // namespace engrane

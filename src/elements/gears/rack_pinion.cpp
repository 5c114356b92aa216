// SPDX-License-Identifier: BSD-3-Clause
#include "elements/gears/rack_pinion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <utility>

#include "base/text.hpp"
#include "elements/common/building.hpp"
#include "elements/gears/contact_channels.hpp"
#include "elements/gears/gear_bearings.hpp"
#include "elements/gears/gear_report.hpp"
#include "math/angle.hpp"

namespace engrane::elements::gears {

namespace {

std::vector<Channel> rack_channels() {
  using namespace dimension;
  std::vector<Channel> list{{"NORMAL_FORCE", force, "normal tooth force, positive where the pinion drives"},
                            {"TANGENTIAL_FORCE_A", force, "tooth force on the pinion along its positive sense of turning"},
                            {"RADIAL_FORCE_A", force, "tooth force on the pinion towards its axle"},
                            {"AXIAL_FORCE_A", force, "tooth force on the pinion along its axle"},
                            {"TORQUE_A", moment, "moment of the tooth forces on the pinion about its axle"},
                            {"RACK_FORCE", force, "tooth force on the rack along DIR"}};
  add_force_channels(list, {"the pinion", "the rack"});
  list.push_back({"PSI_A", angle, "turn of the pinion relative to the pair's frame, whole turns included"});
  list.push_back({"TRAVEL", length, "travel of the rack relative to the pair's frame, along DIR"});
  return list;
}

ContactGeometry contact_geometry(const RackPinion::Geometry& g, double width) {
  const GearDesign& design = g.design;
  ContactGeometry c;
  c.pressure_angle = design.pressure_angle;
  c.transverse_pressure_angle = design.transverse_pressure_angle(0);
  c.helix = design.helix[0];
  c.teeth = design.teeth[0];
  c.radius = design.radius(0);
  c.width = width;
  c.base_pitch = std::numbers::pi * design.transverse_module(0) * std::cos(c.transverse_pressure_angle);
  // the rack's tip line is at h_aP − x from the plane that rolls on the pinion's reference circle
  const double height = design.cut ? design.cut->addendum[1] - design.cut->shift[0] : 1;
  c.approach = height * design.normal_module / std::sin(c.transverse_pressure_angle);
  c.recess = path_of_contact(design, 0).value_or(0);
  c.reach = design.cut ? design.cut->tip_overlap() : 2 * design.normal_module;
  if (design.cut) c.flank = design.cut->thickness(0) / (whole_turn * design.normal_module);
  return c;
}

}  // namespace

RackPinion::RackPinion(int id, std::array<int, 2> nodes, const Geometry& geometry, const ToothLaw& teeth,
                       const ContactOptions& options, double width)
    : ToothedPair(id, nodes, ToothContact(contact_geometry(geometry, width), teeth, options),
                  {{{"PSI_A", dimension::angle, "turn of the pinion relative to the pair's frame"},
                    {"TRAVEL", dimension::length, "travel of the rack relative to the pair's frame"}}},
                  1, rack_channels()),
      geometry_(geometry),
      tooth_a_(tooth_axes(0, geometry.design.helix[0])),
      tooth_b_(mating_tooth_axes(0, geometry.design.helix[1])) {}

void RackPinion::count_turns(const State& state, std::span<double> scalars, std::span<double> history) const {
  const double turns = std::round(state.scalars[0] / whole_turn);
  scalars[0] = state.scalars[0] - turns * whole_turn;
  history[0] = state.history[0] + turns;
}

template <class T>
ToothedSide<T> RackPinion::pinion(const Mat3T<T>& R, const T& psi) const {
  return toothed_wheel(geometry_.frames.mu, tooth_a_, geometry_.design.radius(0), R, psi);
}

template <class T>
ToothedSide<T> RackPinion::rack(const Mat3T<T>& R, const T& travel) const {
  const Mat3& xi = geometry_.frames.xi;
  ToothedSide<T> side;
  side.axle = rotate(R, Vec3(xi.col(0)));
  side.forward = rotate(R, Vec3(xi.col(2)));
  side.eta_2 = rotate(R, Vec3(xi * tooth_b_.col(1)));
  side.eta_3 = rotate(R, Vec3(xi * tooth_b_.col(2)));
  side.arm = rotate(R, geometry_.offset);
  for (int k = 0; k < 3; ++k) side.arm[k] -= geometry_.sense * travel * side.forward[k];
  return side;
}

template <class T>
void RackPinion::mesh(const Motion<T, 2>& motion, const State& state, Balance<T, 2>& balance, ContactReport* report) const {
  const T &psi = motion.scalar[0], &travel = motion.scalar[1];
  const ToothedSide<T> a = pinion(motion.node[0].R, psi), b = rack(motion.node[1].R, travel);
  const double lever_a = geometry_.design.lever(0), lever_b = geometry_.sense * std::cos(geometry_.design.helix[1]);
  const T closing = -(lever_a * (psi + whole_turn * state.history[0]) + lever_b * travel);
  ToothLoads<T> loads;
  const T normal_force =
      contact_.act(motion, a, b, closing, balance, this->grip(psi, state.history[0], state, balance), loads, report);
  balance.scalar(0, contact_.cos_alpha() * lever_a * normal_force + dot(a.axle, loads.frame_moment[0]));
  // the travel moves the contact point along the rack by −s ξ₃
  balance.scalar(1, contact_.cos_alpha() * lever_b * normal_force - geometry_.sense * dot(b.forward, loads.frame_force));
}

void RackPinion::observe(const State& state, std::span<double> values) const {
  ChannelWriter out(values);
  const ContactReport on = report(state);
  const NodeState &node_a = state.nodes[0], &node_b = state.nodes[1];
  const auto a = pinion(node_a.R, state.scalars[0]);
  const auto b = rack(node_b.R, state.scalars[1]);
  const Vec3 outward = a.arm.normalized();
  const double torque = on.moment[0].dot(a.axle), thrust = geometry_.sense * on.force[1].dot(b.forward);
  out.put(state.multipliers[0]);
  out.put(on.force[0].dot(a.forward));
  out.put(-on.force[0].dot(outward));
  out.put(on.force[0].dot(a.axle));
  out.put(torque);
  out.put(thrust);
  put_force_channels(out, on, 0.5 * (node_a.x + a.arm + node_b.x + b.arm));
  out.put(state.scalars[0] + whole_turn * state.history[0]);
  out.put(state.scalars[1]);
  put_contact_channels(out, contact_, on, {torque * state.scalar_rates[0], thrust * state.scalar_rates[1]}, state.scalars);
}

template class ToothedPair<RackPinion>;

std::vector<Derived> RackPinion::derived() const {
  using namespace dimension;
  const GearDesign& d = geometry_.design;
  const double radius = d.radius(0);
  std::vector<Derived> list;
  if (d.cut)
    put_cut(list, *d.cut, {"the pinion", "the rack"});
  else
    list = {{"pitch radius of the pinion", radius, length},
            {"base radius of the pinion", radius * std::cos(d.transverse_pressure_angle(0)), length},
            {"transverse module", d.transverse_module(0), length},
            {"transverse pressure angle", d.transverse_pressure_angle(0), angle}};
  list.insert(list.end(), {{"helix angle of the pinion (right hand > 0)", -d.helix[0], angle},
                           {"helix angle of the rack (right hand > 0)", -d.helix[1], angle},
                           {"travel per turn of the pinion", whole_turn * d.lever(0) / std::cos(d.helix[1]), length}});
  for (int k = 0; k < 3; ++k) list.push_back({std::string("contact point, ") + "xyz"[k], geometry_.frames.contact[k], length});
  const ContactGeometry& g = contact_.geometry();
  if (g.recess > 0 && std::abs(d.helix[0] + d.helix[1]) < 1e-9)
    list.push_back({"transverse contact ratio", (g.approach + g.recess) / g.base_pitch, none});
  if (contact_.elastic()) {
    list.push_back({"tooth stiffness", contact_.law().stiffness, dimension::stiffness});
    list.push_back({"tooth damping", contact_.law().damping, dimension::damping});
  }
  put_backlash(list, contact_.law(), d.pressure_angle);
  return list;
}

Drawing RackPinion::drawing() const {
  const GearDesign& d = geometry_.design;
  const PitchFrames& f = geometry_.frames;
  const double width = contact_.geometry().width;
  Vec3 reference = f.contact;  // in the plane where teeth and spaces of the rack are equally wide
  if (d.cut) reference += d.cut->shift[0] * d.normal_module * f.mu.col(1);
  const std::string common =
      R"(, "module": )" + format_number(d.normal_module) + R"(, "width": )" + format_number(width) + R"(, "helix": )";
  return {R"("shape": "wheel", "node": )" + std::to_string(layout().nodes[0]) + R"(, "center": )" +
              json(Vec3(f.contact - d.radius(0) * f.mu.col(1))) + R"(, "axis": )" + json(Vec3(f.mu.col(0))) + R"(, "toward": )" +
              json(Vec3(f.mu.col(1))) + R"(, "radius": )" + format_number(d.radius(0)) + R"(, "cone": 0, "teeth": )" +
              std::to_string(d.teeth[0]) + common + format_number(-d.helix[0] / degree) +
              (d.cut ? drawn_cut(*d.cut, 0, d.radius(0)) : ""),
          R"("shape": "rack", "node": )" + std::to_string(layout().nodes[1]) + R"(, "center": )" + json(reference) +
              R"(, "direction": )" + json(Vec3(geometry_.sense * f.xi.col(2))) + R"(, "toward": )" + json(Vec3(f.xi.col(1))) +
              common + format_number(-d.helix[1] / degree)};
}

const deck::Card<RackData>& rack_card() {
  static const deck::Card<RackData> card = [] {
    using namespace dimension;
    deck::Card<RackData> c("RACK", {"CREMAILLERE", "RACK_PINION"}, "Rack and pinion, straight or helical");
    c.chapter("Rigid kinematic joints").numbered();
    c.describe(
        "A pinion at a node that is its centre, and a rack carried by a node anywhere on its body: the ground (0), a guided or a "
        "free body. The pitch plane of the rack touches the pitch circle; AT is a point of it, or with profile shift X of the "
        "reference plane, X modules further out. The rack passes the tooth force, guides and bearings are other elements. "
        "Everything about the teeth is as in GEAR; X, TIP and TIPALTER are the pinion's.");
    c.add("N", &RackData::nodes, "centre of the pinion, and body of the rack")
        .synonyms({"NOEUDS", "NODES", "NOEUD"})
        .refers(deck::Reference::node)
        .required();
    c.add("Z", &RackData::teeth, "number of teeth of the pinion").synonyms({"DENTS", "TEETH"}).at_least(1).required();
    c.add("MN", &RackData::normal_module, "normal module").synonyms({"MODULE"}).unit(length).positive().required();
    c.add("ALPHA", &RackData::pressure_angle, "normal pressure angle").synonyms({"PRESSURE"}).unit(angle).at_least(0).below(90);
    c.add("HELIX", &RackData::helix, "helix angles of pinion and rack, right hand positive; one value: the rack fits")
        .synonyms({"HELICE", "BETA"})
        .unit(angle)
        .values(1, 2)
        .above(-90)
        .below(90);
    c.add("AXIS", &RackData::axis, "direction of the pinion's axle in the reference configuration").synonyms({"AXE"}).required();
    c.add("DIR", &RackData::direction, "direction of the rack's pitch line; its travel counts along it")
        .synonyms({"DIRECTION"})
        .required();
    c.add("AT", &RackData::at, "a point of the rack's reference plane; the rack's node when not given")
        .synonyms({"POINT"})
        .unit(length);
    add_cut_keywords(c, true);
    add_teeth_keywords(c, true);
    c.example("I 1 RACK N 1 2 AXIS 0 0 1 DIR 1 0 0 Z 20 MN 2");
    c.example("I 3 RACK N 1 2 AXIS 0 0 1 DIR 1 0 0 AT 0 -19.8 0 Z 12 MN 3 X 0.6");
    c.example("I 2 RACK N 1 0 AXIS 0 0 1 DIR 1 0 0 AT 0 -20 0 Z 20 MN 2 HELIX 15 KM 1D8");
    return c;
  }();
  return card;
}

namespace {

/// Cuts the teeth of the pinion and of the mating rack as described by the card.
bool cut_rack(GearDesign& design, const RackData& data, const BuildContext& context) {
  if (std::abs(design.helix[0] + design.helix[1]) > 1e-9) {
    for (const auto& [keyword, given] : given_cut_keywords(data))
      if (given)
        context.error(keyword,
                      fmt::format("{} is for a rack straight across the pinion's axle, and this one runs obliquely", keyword),
                      "leave it out: such wheels have addendum m_n and no shift");
    return false;
  }
  CutTeeth cut = reference_cut(design, data);
  cut.teeth[1] = 0;
  if (!set_tips(cut, data, {"the pinion", "the rack"}, context)) return false;
  design.cut = cut;
  return true;
}

std::optional<RackPinion::Geometry> place_rack(const RackData& data, const BuildContext& context) {
  const bool nodes_good = check_nodes(context, {data.nodes[0], data.nodes[1]});
  const auto axle = unit_vector(context, "AXIS", data.axis), direction = unit_vector(context, "DIR", data.direction);
  if (!nodes_good || !axle || !direction) return {};
  const Vec3 x_a = context.nodes.at(data.nodes[0]), x_b = context.nodes.at(data.nodes[1]);
  const Vec3 point = data.at ? to_vector(*data.at) : x_b;
  const Vec3 across = cross(*axle, *direction);
  if (across.norm() < 1e-6) {
    context.error("DIR", "the rack runs along the pinion's axle", "a pinion drives a rack across its axle");
    return {};
  }
  RackPinion::Geometry g;
  GearDesign& d = g.design;
  d.teeth = {data.teeth, data.teeth};
  d.normal_module = data.normal_module;
  d.pressure_angle = data.pressure_angle * degree;
  if (!data.helix.empty()) {
    d.helix[0] = paper_helix(data.helix[0] * degree, 0);
    d.helix[1] = data.helix.size() > 1 ? paper_helix(data.helix[1] * degree, 0) : -d.helix[0];
  }
  const double away = (point - x_a).dot(across.normalized()), radius = d.radius(0);
  if (data.describes_cut() && !cut_rack(d, data, context)) return {};
  const double needed = radius + (d.cut ? d.cut->shift[0] * d.normal_module : 0);
  if (std::abs(std::abs(away) - needed) > 1e-6 * radius) {
    const char* plane = d.cut ? "reference plane" : "pitch plane";
    const double fits = (std::abs(away) - radius) / d.normal_module;
    context.error(data.at ? "AT" : "N",
                  fmt::format("distance of the rack's {} from the pinion's centre: {} given, {} needed by Z, MN{} HELIX", plane,
                              number(std::abs(away)), number(needed), d.cut ? ", X and" : " and"),
                  fmt::format("{}{}",
                              data.at ? fmt::format("AT is a point of the {}", plane)
                                      : fmt::format("give a point of the {} with AT, or move a node", plane),
                              std::abs(fits) < 1 ? fmt::format("; a profile shift X {} fits", number(fits)) : ""));
    return {};
  }
  PitchFrames& f = g.frames;
  f.mu.col(0) = *axle;
  f.mu.col(1) = (away > 0 ? 1 : -1) * across.normalized();
  f.mu.col(2) = cross(*axle, Vec3(f.mu.col(1)));
  f.xi = f.mu * wheel_to_wheel(d);
  f.contact = x_a + radius * f.mu.col(1);
  g.offset = f.contact - x_b;
  const double along = direction->dot(f.xi.col(2));
  if (std::abs(along) < 1 - 1e-10) {
    const Vec3 turned = (along < 0 ? -1 : 1) * f.xi.col(2);
    context.error(
        "DIR",
        fmt::format("direction of the rack: ({}, {}, {}) given, ({}, {}, {}) needed by the helices, {:.6g} degrees away",
                    number((*direction)[0]), number((*direction)[1]), number((*direction)[2]), number(turned[0]),
                    number(turned[1]), number(turned[2]), std::acos(std::min(std::abs(along), 1.0)) / degree),
        "a rack straight across the axle needs opposite hands: give HELIX one value; else their sum is the angle");
    return {};
  }
  g.sense = along < 0 ? -1 : 1;
  return g;
}

std::unique_ptr<Element> build_rack_pinion(const RackData& data, BuildContext& context) {
  warn_of_radians(data.pressure_angle, context);
  const auto geometry = place_rack(data, context);
  if (!geometry) return nullptr;
  const double width = data.width.value_or(10 * data.normal_module);
  TeethOwner owner;
  owner.nodes = data.nodes;
  owner.axle = {geometry->frames.mu.col(0), geometry->frames.xi.col(0)};
  owner.teeth = {data.teeth, 0};
  owner.lever = {geometry->design.lever(0), 1};
  owner.parallel = std::abs(geometry->design.helix[0] + geometry->design.helix[1]) < 1e-9;
  owner.path_known = owner.parallel;
  owner.geometry = contact_geometry(*geometry, width);
  if (!check_bearings(data.nodes, {owner.axle[0], Vec3::Zero()}, context)) return nullptr;
  owner.cut = geometry->design.cut;
  if (owner.cut)
    warn_about_cut(*owner.cut, data, {"the pinion", "the rack"}, context);
  else
    warn_about_undercut(geometry->design, 0, "the pinion", context);
  if (const ContactGeometry& g = owner.geometry; owner.parallel && g.recess > 0) {
    // the rack's tips have no contact beyond the start of the involute
    const double involute = geometry->design.radius(0) * std::sin(g.transverse_pressure_angle);
    warn_about_contact_ratio((std::min(g.approach, involute) + g.recess) / g.base_pitch, context);
  }
  const auto teeth = read_teeth(data, owner, context);
  if (!teeth) return nullptr;
  return std::make_unique<RackPinion>(context.record.id, data.nodes, *geometry, teeth->law, teeth->options, width);
}

}  // namespace

ElementType rack_pinion_type() { return element_type(rack_card(), build_rack_pinion, 1); }

}  // namespace engrane::elements::gears

// SPDX-License-Identifier: BSD-3-Clause
#include "elements/gears/tooth_phases.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>
#include <unordered_map>
#include <vector>

#include "elements/common/building.hpp"
#include "elements/gears/gear_place.hpp"
#include "elements/gears/gear_report.hpp"
#include "math/angle.hpp"

namespace engrane::elements::gears {

namespace {

constexpr std::array<std::size_t, 2> sides{0, 1};

/// Misfit, in pitches, that is attributed to typed coordinates, and the largest that elastic teeth can bridge.
constexpr double fits = 1e-6, bridged = 0.05;

/// Profile shifts that differ by less belong to the same wheel: one may be typed, the other computed from a rounded centre
/// distance.
constexpr double same_shift = 0.01;

/// The angle reduced to [−π, π].
double wrapped(double angle) { return std::remainder(angle, whole_turn); }

struct Wheel {
  int node = 0;
  int teeth = 1;
  double module = 1;
  double cone = 0, helix = 0;  ///< for the axle in its standard sense; right-hand helix positive
  Vec3 axle, center;
  Vec3 datum;  ///< across the axle, towards the wheel's first contact point
  double tip = 0, width = 0, shift = 0;

  bool same(const Wheel& w) const { return same_but_for_shift(w) && std::abs(shift - w.shift) <= same_shift; }
  bool same_but_for_shift(const Wheel& w) const {
    constexpr double angular = 1e-6;
    return node == w.node && teeth == w.teeth && std::abs(module - w.module) <= 1e-9 * module &&
           (axle - w.axle).norm() < angular && std::abs(wrapped(cone - w.cone)) < angular && std::abs(helix - w.helix) < angular;
  }
  bool external_cylinder() const { return std::abs(std::sin(cone)) < 1e-9 && std::cos(cone) > 0; }
};

struct Mesh {
  const deck::Record* record = nullptr;
  std::array<std::size_t, 2> wheel{0, 0};
  std::array<double, 2> sense{1, 1};    ///< of the pair's axles relative to those of the wheels
  std::array<double, 2> contact{0, 0};  ///< θ, from the wheel's datum about its axle
  std::array<double, 2> tip{0, 0};      ///< tip radii of the wheels according to this pair
  double module = 1;
  bool closes = false;  ///< its wheels are already connected by earlier pairs

  bool has(std::size_t w) const { return wheel[0] == w || wheel[1] == w; }
  std::size_t other(std::size_t w) const { return wheel[0] == w ? wheel[1] : wheel[0]; }
};

/// A standard sense for an axle, whichever way a deck gives it.
double sense_of(const Vec3& axle) {
  for (int k = 0; k < 3; ++k)
    if (std::abs(axle[k]) > 1e-6) return axle[k] < 0 ? -1 : 1;
  return 1;
}

/// All gear pairs of the deck with the phases of their wheels.
class Trains {
 public:
  explicit Trains(const BuildContext& context) {
    for (const deck::Record& record : *context.records) {
      const auto* data = record.get<GearData>();
      if (!data || !context.nodes.contains(data->nodes[0]) || !context.nodes.contains(data->nodes[1])) continue;
      Diagnostics unheard;
      const BuildContext other{context.nodes, context.functions, unheard, record, context.wheel_inertia, context.records, {},
                               nullptr,       context.notes};
      if (const auto placement = place_gear(*data, other)) add(record, *data, *placement);
    }
    join();
    spread();
  }

  const Mesh* find(const deck::Record& record) const {
    const auto found = mesh_of_.find(&record);
    return found == mesh_of_.end() ? nullptr : &meshes_[found->second];
  }

  /// z_A times the angle from the contact point to a tooth, about that wheel's axle in the pair's sense.
  double phase(const Mesh& m, std::size_t side) const {
    const Wheel& w = wheels_[m.wheel[side]];
    return m.sense[side] * (tooth_[m.wheel[side]] - w.teeth * m.contact[side]);
  }

  /// How far the teeth of A are ahead of a space of B, with a pitch of 2π.
  double misfit(const Mesh& m) const { return wrapped(phase(m, 0) + phase(m, 1) - std::numbers::pi); }

  std::string planet_condition(const Mesh& m) const;
  void warn_of_overlap(const Mesh& m, const BuildContext& context) const;
  void warn_of_cut(const Mesh& m, const BuildContext& context) const;

 private:
  void add(const deck::Record& record, const GearData& data, const GearPlacement& placement) {
    Mesh m;
    m.record = &record;
    m.module = placement.design.normal_module;
    for (const std::size_t side : sides) {
      const Mat3& triad = side == 0 ? placement.frames.mu : placement.frames.xi;
      const GearDesign& d = placement.design;
      const Vec3 axle = triad.col(0), toward = triad.col(1);
      m.sense[side] = sense_of(axle);
      Wheel w;
      w.node = data.nodes[side];
      w.teeth = d.teeth[side];
      w.module = d.cut_module();
      w.cone = m.sense[side] * d.cone[side];
      w.helix = paper_helix(d.cut_helix(side), d.cone[side]);
      w.axle = m.sense[side] * axle;
      w.center = placement.frames.contact - d.radius(side) * toward;
      w.datum = toward;
      w.tip = tip_radius(d, side);
      w.width = data.width.value_or(d.cut_module());
      w.shift = d.cut ? d.cut->shift[side] : 0;
      m.tip[side] = w.tip;
      std::vector<std::size_t>& at_node = wheels_at_[w.node];
      const auto known = std::find_if(at_node.begin(), at_node.end(), [&](std::size_t k) { return wheels_[k].same(w); });
      if (known == at_node.end()) {
        m.wheel[side] = wheels_.size();
        at_node.push_back(wheels_.size());
        wheels_.push_back(w);
        meshes_of_.emplace_back();
      } else {
        m.wheel[side] = *known;
        const Wheel& k = wheels_[*known];
        const Vec3 across = cross(k.axle, k.datum);
        m.contact[side] = std::atan2(toward.dot(across), toward.dot(k.datum));
      }
    }
    for (const std::size_t side : sides) meshes_of_[m.wheel[side]].push_back(meshes_.size());
    mesh_of_.try_emplace(&record, meshes_.size());
    meshes_.push_back(m);
  }

  /// Marks the pairs that close a loop: those whose wheels are already connected by earlier pairs of the deck.
  void join() {
    std::vector<std::size_t> joined_to(wheels_.size());  // a wheel of the same train; the representative's is itself
    std::iota(joined_to.begin(), joined_to.end(), std::size_t{0});
    const auto train = [&](std::size_t wheel) {
      while (joined_to[wheel] != wheel) wheel = joined_to[wheel] = joined_to[joined_to[wheel]];
      return wheel;
    };
    for (Mesh& m : meshes_) {
      const std::size_t a = train(m.wheel[0]), b = train(m.wheel[1]);
      m.closes = a == b;
      joined_to[b] = a;
    }
  }

  /// Positions the teeth of every wheel, starting from the first pair of each train.
  void spread() {
    tooth_.assign(wheels_.size(), 0);
    std::vector<bool> known(wheels_.size(), false);
    for (std::size_t first = 0; first < meshes_.size(); ++first) {
      const Mesh& founder = meshes_[first];
      if (known[founder.wheel[0]]) continue;
      known[founder.wheel[0]] = true;  // a tooth at the contact point, where θ = 0 by the datum
      tooth_[founder.wheel[0]] = wheels_[founder.wheel[0]].teeth * founder.contact[0];
      // pairs that close no loop form a tree: there is a single path to each wheel
      for (std::vector<std::size_t> open{founder.wheel[0]}; !open.empty();) {
        const std::size_t wheel = open.back();
        open.pop_back();
        for (const std::size_t index : meshes_of_[wheel]) {
          const Mesh& m = meshes_[index];
          if (m.closes || known[m.other(wheel)]) continue;
          const std::size_t side = m.wheel[0] == wheel ? 1 : 0;  // the wheel to be positioned
          const std::size_t next = m.wheel[side];
          const double phase_needed = std::numbers::pi - phase(m, 1 - side);
          tooth_[next] = wrapped(m.sense[side] * phase_needed + wheels_[next].teeth * m.contact[side]);
          known[next] = true;
          open.push_back(next);
        }
      }
    }
  }

  std::vector<Wheel> wheels_;
  std::vector<Mesh> meshes_;
  std::unordered_map<const deck::Record*, std::size_t> mesh_of_;
  std::unordered_map<int, std::vector<std::size_t>> wheels_at_;  ///< by node
  std::vector<std::vector<std::size_t>> meshes_of_;              ///< pairs of each wheel, in the order of the deck
  std::vector<double> tooth_;                                    ///< z δ of each wheel, from its datum about its axle
};

/// Condition for equal planets when the pair closes a loop of two coaxial wheels and two planets: (z_s + z_r)·angle/360 must be
/// an integer (also for the pinions of a bevel differential, whose coaxial wheels turn in opposite directions).
std::string Trains::planet_condition(const Mesh& m) const {
  for (const std::size_t side : sides) {
    const std::size_t planet = m.wheel[side], central = m.wheel[1 - side];
    const Wheel& c = wheels_[central];
    for (const Mesh& second : meshes_) {
      if (&second == &m || !second.has(planet)) continue;
      const std::size_t opposite = second.other(planet);
      const Wheel& o = wheels_[opposite];
      const Vec3 apart = o.center - c.center;
      if (opposite == central || cross(c.axle, o.axle).norm() > 1e-6 || cross(c.axle, apart).norm() > 1e-6 * c.tip) continue;
      for (std::size_t first = 0; first < wheels_.size(); ++first) {
        const auto joins = [&](std::size_t with) {
          return std::any_of(meshes_.begin(), meshes_.end(),
                             [&](const Mesh& k) { return k.has(first) && k.other(first) == with; });
        };
        if (first == planet || !joins(central) || !joins(opposite)) continue;
        Vec3 from = wheels_[first].center - c.center, to = wheels_[planet].center - c.center;
        from -= from.dot(c.axle) * c.axle;
        to -= to.dot(c.axle) * c.axle;
        if (from.norm() < 1e-6 * c.tip || to.norm() < 1e-6 * c.tip) continue;
        const double given = std::atan2(std::abs(c.axle.dot(cross(from, to))), from.dot(to)) / degree;
        const int sum = c.teeth + o.teeth;
        const double steps = given * sum / 360, below = std::floor(steps), above = std::ceil(steps);
        return fmt::format(
            "the planets at nodes {} and {} stand {} degrees apart; ({} + {})·angle/360 must be an integer: {} or {} fit",
            wheels_[first].node, wheels_[planet].node, number(given), std::min(c.teeth, o.teeth), std::max(c.teeth, o.teeth),
            number(below * 360 / sum), number(above * 360 / sum));
      }
    }
  }
  return "move the axle of one wheel of the loop, or change its teeth";
}

/// Warns if wheels that share a partner, such as neighbouring planets, overlap at their tips. Each wheel is checked by the
/// first pair that names it.
void Trains::warn_of_overlap(const Mesh& m, const BuildContext& context) const {
  for (const std::size_t side : sides) {
    const std::size_t self = m.wheel[side], partner = m.wheel[1 - side];
    const Wheel &w = wheels_[self], &p = wheels_[partner];
    if (!w.external_cylinder()) continue;
    if (&meshes_[meshes_of_[self].front()] != &m) continue;
    for (const std::size_t index : meshes_of_[partner]) {
      const Mesh& k = meshes_[index];
      if (&k == &m) break;  // each pair of wheels once
      const std::size_t neighbour = k.other(partner);
      const Wheel& n = wheels_[neighbour];
      if (neighbour == self || n.node == w.node || !n.external_cylinder() || cross(n.axle, w.axle).norm() > 1e-6) continue;
      const bool mesh = std::any_of(meshes_of_[self].begin(), meshes_of_[self].end(),
                                    [&](std::size_t j) { return meshes_[j].other(self) == neighbour; });
      const Vec3 apart = n.center - w.center;
      const double along = std::abs(apart.dot(w.axle)), across = cross(w.axle, apart).norm();
      if (mesh || along >= 0.5 * (n.width + w.width) || across >= n.tip + w.tip) continue;
      const double arm = cross(p.axle, Vec3(w.center - p.center)).norm();
      const int most = w.tip < arm ? static_cast<int>(std::numbers::pi / std::asin(w.tip / arm)) : 1;
      context.diagnostics.warning(
          context.record.where("N"),
          fmt::format("the wheels at nodes {} and {} run into each other: tip radii {} and {}, centres {} apart", n.node, w.node,
                      number(n.tip), number(w.tip), number(across)),
          fmt::format("at most {} wheels like that at node {} have room round node {}; otherwise take smaller ones", most, w.node,
                      p.node));
      break;
    }
  }
}

/// Warns of pairs that cut the same wheel differently. Each is compared with the wheel's first pair.
void Trains::warn_of_cut(const Mesh& m, const BuildContext& context) const {
  for (const std::size_t side : sides) {
    const std::size_t self = m.wheel[side];
    const Wheel& w = wheels_[self];
    const auto warn = [&](const char* what, double there, double here, const Mesh& first, const char* end, const char* cure) {
      context.diagnostics.warning(context.record.where("N"),
                                  fmt::format("the wheel at node {} has the {} {} in GEAR {} and {} here{}", w.node, what,
                                              number(there), first.record->id, number(here), end),
                                  cure);
    };
    const Mesh& first = meshes_[meshes_of_[self].front()];
    if (&first != &m) {
      const double tip = first.tip[first.wheel[0] == self ? 0 : 1];
      if (std::abs(tip - m.tip[side]) > 1e-3 * w.module)
        warn("tip diameter", 2 * tip, 2 * m.tip[side], first, "", "give both pairs the same with TIP or TIPALTER");
      continue;
    }
    for (const std::size_t other : wheels_at_.at(w.node))
      if (other < self && wheels_[other].same_but_for_shift(w))
        warn("profile shift", wheels_[other].shift, w.shift, meshes_[meshes_of_[other].front()], ": they are taken as two wheels",
             "give both pairs the same X, unless two wheels stand there");
  }
}

}  // namespace

std::optional<MeshPhase> mesh_phase(const BuildContext& context, bool elastic) {
  if (!context.records) return MeshPhase{};
  BuildNotes own;
  const Trains& trains = (context.notes ? *context.notes : own).get<Trains>([&] { return Trains(context); });
  const Mesh* m = trains.find(context.record);
  if (!m) return MeshPhase{};
  trains.warn_of_overlap(*m, context);
  trains.warn_of_cut(*m, context);
  MeshPhase result;
  result.phase = wrapped(trains.phase(*m, 0));
  if (result.phase < 1e-9 - std::numbers::pi) result.phase += whole_turn;  // half a pitch is always +π
  for (const std::size_t side : sides) result.contact[side] = m->sense[side] * m->contact[side];
  if (!m->closes) return result;

  const double misfit = trains.misfit(*m), pitches = std::abs(misfit) / whole_turn;
  if (pitches < fits) return result;
  result.misfit = 0.5 * m->module * misfit;
  const std::string message = fmt::format(
      "this pair closes a loop of wheels, and its teeth miss each other by {:.4g} of a pitch, {:.4g} along the circumference",
      pitches, std::abs(result.misfit));
  if (elastic && pitches <= bridged) {
    context.diagnostics.warning(context.record.where("N"), message + "; the elastic teeth take it up",
                                trains.planet_condition(*m));
    return result;
  }
  context.error("N", message, trains.planet_condition(*m));
  return {};
}

}  // namespace engrane::elements::gears

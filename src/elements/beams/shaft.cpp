// SPDX-License-Identifier: BSD-3-Clause
#include "elements/beams/shaft.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "deck/cards/profile_card.hpp"
#include "elements/beams/beam.hpp"
#include "elements/bearings/bearing.hpp"
#include "elements/bodies/inertia.hpp"
#include "elements/common/building.hpp"
#include "model/short_form.hpp"

namespace engrane::elements::beams {

namespace {

/// Positions closer than this fraction of the shaft's length coincide.
constexpr double near = 1e-6;
/// Maximum length of a piece in mean diameters, unless PIECES is given.
constexpr double slender = 3;
/// Maximum number of pieces between two positions; more suggests a wrong unit.
constexpr int most_pieces = 1000;

class ShaftWriter {
 public:
  ShaftWriter(const ShaftData& data, ShortForm& form) : data_(data), form_(form) {}

  void write() {
    if (!has_axis() || !has_steps() || !has_parts()) return;
    std::vector<BeamData> beams;
    int number = 0;
    for (std::size_t step = 0; step < steps(); ++step) {
      beams.push_back(beam_of(step));
      number += static_cast<int>(beams.back().nodes.size() / 2);
    }
    if (!form_.has_numbers(number + static_cast<int>(data_.discs.size() + data_.wheels.size() + data_.bearings.size()))) return;
    int id = form_.record.id;
    for (BeamData& beam : beams) {
      const int pieces = static_cast<int>(beam.nodes.size() / 2);
      form_.add("BEAM", std::exchange(id, id + pieces), std::move(beam));
    }
    for (std::size_t i = 0; i < data_.discs.size(); ++i) {
      const double polar = each(data_.polar, i);
      form_.add(
          "INERTIA", id++,
          inertia(data_.discs[i], each(data_.mass, i), polar, data_.diametral.empty() ? polar / 2 : each(data_.diametral, i)));
    }
    for (std::size_t i = 0; i < data_.wheels.size(); ++i) {
      const double outer = each(data_.outer, i), inner = inner_of(i), width = each(data_.width, i);
      const double mass = *density() * std::numbers::pi / 4 * (outer * outer - inner * inner) * width;
      const double polar = mass * (outer * outer + inner * inner) / 8;
      bodies::InertiaData wheel = inertia(data_.wheels[i], mass, polar, polar / 2 + mass * width * width / 12);
      wheel.outer = outer;
      wheel.inner = inner;
      wheel.width = width;
      form_.add("INERTIA", id++, wheel);
    }
    for (std::size_t i = 0; i < data_.bearings.size(); ++i) add_bearing(id++, i);
  }

 private:
  std::size_t steps() const { return data_.places.size() + 1; }
  double step_start(std::size_t step) const { return step == 0 ? 0 : data_.places[step - 1]; }
  double step_end(std::size_t step) const { return step + 1 == steps() ? length_ : data_.places[step]; }
  static double each(const std::vector<double>& values, std::size_t i) {
    return values.empty() ? 0 : values.size() == 1 ? values.front() : values[i];
  }
  double diameter(std::size_t step, bool end) const {
    return each(end && !data_.diameter_end.empty() ? data_.diameter_end : data_.diameter, step);
  }
  double bore(std::size_t step, bool end) const {
    return each(end && !data_.bore_end.empty() ? data_.bore_end : data_.bore, step);
  }
  double mean_diameter(std::size_t step) const { return (diameter(step, false) + diameter(step, true)) / 2; }
  bool is_cone(std::size_t step) const {
    return diameter(step, true) != diameter(step, false) || bore(step, true) != bore(step, false);
  }

  /// Whether the stations lie in order on a line; otherwise reports an error.
  bool has_axis() {
    const Vec3 first = form_.nodes.at(data_.nodes.front()), last = form_.nodes.at(data_.nodes.back());
    length_ = (last - first).norm();
    if (!(length_ > 0)) {
      form_.error("N", fmt::format("the ends of SHAFT {} are in one place", form_.record.id),
                  "N names the nodes from end to end");
      return false;
    }
    axis_ = (last - first) / length_;
    double before = 0;
    for (const int node : data_.nodes) {
      const Vec3 from = form_.nodes.at(node) - first;
      const double place = axis_.dot(from), off = (from - place * axis_).norm();
      if (off > near * length_) {
        form_.error("N", fmt::format("node {} is {} off the axis of the shaft", node, number(off)),
                    fmt::format("the axis is the line from node {} to node {}", data_.nodes.front(), data_.nodes.back()));
        return false;
      }
      if (!stations_.empty() && !(place - before > near * length_)) {
        form_.error("N", fmt::format("node {} does not follow node {} along the shaft", node, stations_.back().node),
                    "name the nodes in turn, from the first end to the other");
        return false;
      }
      stations_.push_back({node, before = place});
    }
    return true;
  }

  /// Whether the steps are in order, their bores are below their diameters and PIECES is given if needed; otherwise reports an
  /// error.
  bool has_steps() const {
    double before = 0;
    for (std::size_t i = 0; i < data_.places.size(); ++i) {
      const double place = data_.places[i];
      if (!(place - before > near * length_)) {
        form_.error("AT", fmt::format("the step that ends at {} has no length: it begins at {}", number(place), number(before)),
                    "AT counts from the first node on, and grows");
        return false;
      }
      before = place;
    }
    if (!data_.places.empty() && !(length_ - before > near * length_)) {
      form_.error("AT",
                  fmt::format("the step that begins at {} has no length: the shaft ends at {}", number(before), number(length_)),
                  "AT is where the diameter changes, between the ends of the shaft");
      return false;
    }
    for (const auto& [keyword, values] :
         {std::pair{"D", &data_.diameter}, {"D_END", &data_.diameter_end}, {"BORE", &data_.bore}, {"BORE_END", &data_.bore_end}})
      if (!counts(keyword, *values, steps(), "step", "AT")) return false;
    for (std::size_t step = 0; step < steps(); ++step)
      for (const bool end : {false, true})
        if (!(bore(step, end) < diameter(step, end))) {
          form_.error(end && !data_.bore_end.empty() ? "BORE_END" : "BORE",
                      fmt::format("step {} has a bore of {} in a diameter of {}", step + 1, number(bore(step, end)),
                                  number(diameter(step, end))),
                      "the bore is below the diameter");
          return false;
        }
    for (std::size_t step = 0; step < steps() && !data_.pieces; ++step)
      if (const double length = step_end(step) - step_start(step); !(length < most_pieces * slender * mean_diameter(step))) {
        form_.error("D", fmt::format("step {} is {} long and {} thick", step + 1, number(length), number(mean_diameter(step))),
                    "a shaft so slender needs PIECES, the number of pieces");
        return false;
      }
    return true;
  }

  /// Whether a keyword has one value for all, one for each, or none at all; otherwise reports an error.
  bool counts(const char* keyword, const std::vector<double>& values, std::size_t count, const char* what,
              const char* list) const {
    if (values.size() <= 1 || values.size() == count) {
      if (values.empty() || count > 0) return true;
      form_.error(keyword, fmt::format("{} without {}", keyword, list), fmt::format("{} names the stations", list));
      return false;
    }
    form_.error(keyword, fmt::format("{} values of {} for {} {}s", values.size(), keyword, count, what),
                fmt::format("give one for all, or one for each {}", what));
    return false;
  }

  bool at_stations(const char* keyword, const std::vector<int>& nodes) const {
    for (const int node : nodes)
      if (std::none_of(stations_.begin(), stations_.end(), [node](const Station& station) { return station.node == node; })) {
        form_.error(keyword, fmt::format("node {} is not one of the shaft", node), "N names the stations of the shaft");
        return false;
      }
    return true;
  }

  bool needs(const char* keyword, const std::vector<double>& values, const char* list, const std::vector<int>& nodes) const {
    if (nodes.empty() || !values.empty()) return true;
    form_.error(list, fmt::format("{} without {}", list, keyword), fmt::format("one {} for all, or one for each", keyword));
    return false;
  }

  /// Whether discs, wheels and bearings are complete and consistent; otherwise reports an error.
  bool has_parts() const {
    struct List {
      const char* name;
      const char* what;
      const std::vector<int>& nodes;
      std::vector<std::pair<const char*, const std::vector<double>*>> keywords;
    };
    const std::vector<List> lists = {
        {"DISC", "disc", data_.discs, {{"M", &data_.mass}, {"JP", &data_.polar}, {"JD", &data_.diametral}}},
        {"WHEEL", "wheel", data_.wheels, {{"OUTER", &data_.outer}, {"WIDTH", &data_.width}, {"INNER", &data_.inner}}},
        {"BEARING",
         "bearing",
         data_.bearings,
         {{"KR", &data_.radial_stiffness},
          {"KA", &data_.axial_stiffness},
          {"CR", &data_.radial_damping},
          {"CA", &data_.axial_damping}}}};
    for (const List& list : lists) {
      if (!at_stations(list.name, list.nodes)) return false;
      for (const auto& [keyword, values] : list.keywords)
        if (!counts(keyword, *values, list.nodes.size(), list.what, list.name)) return false;
      if (!needs(list.keywords.front().first, *list.keywords.front().second, list.name, list.nodes)) return false;
    }
    if (!needs("WIDTH", data_.width, "WHEEL", data_.wheels)) return false;
    if (!data_.wheels.empty() && !density()) {
      form_.error("WHEEL", "a wheel needs a density", "DENSITY, or M of the .MAT of the shaft");
      return false;
    }
    for (std::size_t i = 0; i < data_.wheels.size(); ++i)
      if (!(inner_of(i) < each(data_.outer, i))) {
        form_.error("OUTER",
                    fmt::format("the wheel on node {} has a diameter of {}, and a hole of {}", data_.wheels[i],
                                number(each(data_.outer, i)), number(inner_of(i))),
                    "OUTER is above INNER, by itself the diameter of the shaft there");
        return false;
      }
    return true;
  }

  /// Inner diameter of a wheel; default: the largest diameter of the shaft at its station.
  double inner_of(std::size_t wheel) const {
    if (!data_.inner.empty()) return each(data_.inner, wheel);
    double place = 0, largest = 0;
    for (const Station& station : stations_)
      if (station.node == data_.wheels[wheel]) place = station.place;
    for (std::size_t step = 0; step < steps(); ++step) {
      const double from = step_start(step), to = step_end(step);
      if (place < from - near * length_ || place > to + near * length_) continue;
      const double part = std::clamp((place - from) / (to - from), 0.0, 1.0);
      largest = std::max(largest, diameter(step, false) * (1 - part) + diameter(step, true) * part);
    }
    return largest;
  }

  std::optional<double> density() const {
    if (data_.density) return data_.density;
    for (const deck::Record& record : form_.records())
      if (const auto* material = record.get<deck::MaterialCard>(); material && record.id == data_.material)
        return material->density;
    return {};
  }

  int profile(double outer, double bore, bool tube) {
    deck::ProfileCard card;
    card.shape = tube ? deck::Tagged{"TUBE", {outer, bore}} : deck::Tagged{"CIRCLE", {outer}};
    if (data_.shear) card.factors = {{*data_.shear, *data_.shear}};
    const int id = form_.new_profile();
    form_.add(".BPR", id, card);
    return id;
  }

  int make_node(double place) {
    const auto next =
        std::find_if(stations_.begin() + 1, stations_.end() - 1, [place](const Station& s) { return s.place > place; });
    const Station &from = *(next - 1), &to = *next;
    return form_.add_node(form_.nodes.at(data_.nodes.front()) + place * axis_, {from.node, to.node},
                          (place - from.place) / (to.place - from.place));
  }

  /// Beam of a step: three-node pieces between its ends and the stations within it. Creates the missing nodes.
  BeamData beam_of(std::size_t step) {
    const double from = step_start(step), to = step_end(step);
    struct Stop {
      double place;
      int node;  ///< 0: no node of the deck
    };
    std::vector<Stop> stops = {{from, 0}};
    for (const Station& station : stations_) {
      if (std::abs(station.place - from) <= near * length_)
        stops.front() = {station.place, station.node};
      else if (station.place > from && station.place < to - near * length_)
        stops.push_back({station.place, station.node});
    }
    stops.push_back({to, 0});
    for (const Station& station : stations_)
      if (std::abs(station.place - to) <= near * length_) stops.back() = {station.place, station.node};
    if (stops.front().node == 0) stops.front().node = last_node_;  // created by the previous step

    BeamData beam;
    beam.nodes = {stops.front().node};
    for (std::size_t i = 1; i < stops.size(); ++i) {
      const double start = stops[i - 1].place, span = stops[i].place - start;
      const int pieces = data_.pieces.value_or(static_cast<int>(std::ceil(span / (slender * mean_diameter(step)) * (1 - near))));
      for (int k = 1; k < 2 * pieces; ++k) beam.nodes.push_back(make_node(start + span * k / (2 * pieces)));
      beam.nodes.push_back(stops[i].node == 0 ? make_node(to) : stops[i].node);
    }
    last_node_ = beam.nodes.back();
    const bool tube = bore(step, false) > 0 || bore(step, true) > 0;
    beam.profile = profile(diameter(step, false), bore(step, false), tube);
    if (is_cone(step)) beam.profile_end = profile(diameter(step, true), bore(step, true), tube);
    beam.material = data_.material;
    beam.damping = data_.damping;
    return beam;
  }

  bodies::InertiaData inertia(int node, double mass, double polar, double diametral) const {
    const Vec3 side = perpendicular(axis_);
    bodies::InertiaData out;
    out.node = node;
    out.mass = mass;
    out.tensor = {polar, diametral, diametral};
    out.axes = {axis_[0], axis_[1], axis_[2], side[0], side[1], side[2]};
    return out;
  }

  void add_bearing(int id, std::size_t i) {
    bearings::BearingData bearing;
    bearing.nodes = {0, data_.bearings[i]};
    bearing.axis = {axis_[0], axis_[1], axis_[2]};
    const auto diagonal = [i](const std::vector<double>& radial, const std::vector<double>& axial) {
      const double r = each(radial, i);
      return std::vector<double>{each(axial, i), r, r, 0, 0, 0};
    };
    bearing.stiffness = diagonal(data_.radial_stiffness, data_.axial_stiffness);
    if (!data_.radial_damping.empty() || !data_.axial_damping.empty())
      bearing.damping = diagonal(data_.radial_damping, data_.axial_damping);
    form_.add("BEARING", id, bearing);
  }

  struct Station {
    int node;
    double place;  ///< along the axis
  };

  const ShaftData& data_;
  ShortForm& form_;
  Vec3 axis_ = Vec3::UnitX();
  double length_ = 0;
  std::vector<Station> stations_;
  int last_node_ = 0;  ///< end node of the previous step
};

void expand(const ShaftData& data, ShortForm& form) { ShaftWriter(data, form).write(); }

}  // namespace

ElementType shaft_type() {
  deck::Card<ShaftData> card("SHAFT", {"ARBRE"}, "Stepped shaft with discs, wheels and bearings");
  card.numbered()
      .chapter("Beams")
      .describe(
          "A short form: it is written out as a BEAM for each step with its section, an INERTIA for each disc and wheel, and a "
          "BEARING to the ground for each bearing, which `engrane check` lists. N names the nodes of `.NOE` on the axis that "
          "matter, its ends among them; gears, joints, loads and bearings act on these. Nodes between them get the numbers after "
          "those of the deck. Elements are numbered on from the record: pieces of the beams along the shaft, then discs, wheels "
          "and bearings. Of what is given for steps, discs, wheels or bearings one value holds for all of them.")
      .example("I 1 SHAFT N 1 2 3  MAT 1  D 0.03 0.05 0.03  AT 0.1 0.25  BORE 0.01  BEARING 1 3  KR 1D8  KA 1D8 0")
      .example("I 1 SHAFT N 1 2  MAT 1  D 0.04  D_END 0.02  PIECES 4  WHEEL 2  OUTER 0.2  WIDTH 0.02");
  card.add("N", &ShaftData::nodes, "nodes on the axis in turn, from one end to the other")
      .synonyms({"NODES", "NOEUDS"})
      .refers(deck::Reference::node)
      .at_least(1)
      .values(2, deck::any_number)
      .required();
  card.add("MAT", &ShaftData::material, "number of the material in `.MAT`")
      .synonyms({"MATERIAL", "MATERIAU"})
      .at_least(1)
      .required();
  card.add("D", &ShaftData::diameter, "diameters of the steps")
      .synonyms({"DIAMETER", "DIAMETRE"})
      .unit(dimension::length)
      .positive()
      .required();
  card.add("AT", &ShaftData::places, "where one step ends and the next begins, from the first node along the axis")
      .unit(dimension::length)
      .positive();
  card.add("D_END", &ShaftData::diameter_end, "diameters at the ends of the steps, which are then cones")
      .unit(dimension::length)
      .positive();
  card.add("BORE", &ShaftData::bore, "diameters of the bores of the steps")
      .synonyms({"ALESAGE"})
      .unit(dimension::length)
      .at_least(0);
  card.add("BORE_END", &ShaftData::bore_end, "the same at the ends of the steps").unit(dimension::length).at_least(0);
  card.add("PIECES", &ShaftData::pieces,
           "pieces of three nodes between two stations or ends of steps; by itself so many that none is longer than three "
           "diameters")
      .at_least(1)
      .at_most(most_pieces);
  card.add("SHEAR", &ShaftData::shear, "shear factor of all sections; otherwise that of Cowper").positive();
  card.add("DAMPING", &ShaftData::damping, "material damping, as of BEAM; by itself that of MAT")
      .synonyms({"AMORTISSEMENT"})
      .unit(dimension::time)
      .at_least(0);
  card.add("DISC", &ShaftData::discs, "stations with a disc given by its mass")
      .synonyms({"DISQUE"})
      .refers(deck::Reference::node)
      .at_least(1);
  card.add("M", &ShaftData::mass, "masses of the discs").synonyms({"MASS", "MASSE"}).unit(dimension::mass).at_least(0);
  card.add("JP", &ShaftData::polar, "their moments of inertia about the axis").unit(dimension::inertia).at_least(0);
  card.add("JD", &ShaftData::diametral, "those across it; by themselves half of JP").unit(dimension::inertia).at_least(0);
  card.add("WHEEL", &ShaftData::wheels, "stations with a wheel given by its size: a ring in the middle of which the node is")
      .synonyms({"ROUE"})
      .refers(deck::Reference::node)
      .at_least(1);
  card.add("OUTER", &ShaftData::outer, "outer diameters of the wheels").unit(dimension::length).positive();
  card.add("INNER", &ShaftData::inner, "their holes; by themselves the diameter of the shaft")
      .unit(dimension::length)
      .at_least(0);
  card.add("WIDTH", &ShaftData::width, "their widths").synonyms({"LARGEUR"}).unit(dimension::length).positive();
  card.add("DENSITY", &ShaftData::density, "of the wheels; by itself that of MAT")
      .synonyms({"DENSITE"})
      .unit({-3, 1, 0, 0})
      .positive();
  card.add("BEARING", &ShaftData::bearings, "stations with a bearing on the ground")
      .synonyms({"PALIER"})
      .refers(deck::Reference::node)
      .at_least(1);
  card.add("KR", &ShaftData::radial_stiffness, "radial stiffnesses of the bearings").unit(dimension::stiffness).at_least(0);
  card.add("KA", &ShaftData::axial_stiffness, "their axial stiffnesses").unit(dimension::stiffness).at_least(0);
  card.add("CR", &ShaftData::radial_damping, "their radial dampings").unit(dimension::damping).at_least(0);
  card.add("CA", &ShaftData::axial_damping, "their axial dampings").unit(dimension::damping).at_least(0);
  return short_form(card, expand);
}

}  // namespace engrane::elements::beams

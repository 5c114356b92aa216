// SPDX-License-Identifier: BSD-3-Clause
#include "elements/gears/gear_kinds.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "elements/common/building.hpp"
#include "elements/gears/hypoid_cones.hpp"
#include "elements/gears/worm_sizes.hpp"

namespace engrane::elements::gears {

namespace {

constexpr double right_angle = std::numbers::pi / 2;

/// For each kind, the optional keywords that it accepts.
const std::vector<std::pair<std::string_view, std::vector<std::string_view>>>& keywords_by_kind() {
  static const std::vector<std::pair<std::string_view, std::vector<std::string_view>>> table{
      {"SPUR", {"MN", "MT", "DISTANCE", "X", "ADDENDUM", "DEDENDUM", "TIP", "TIPALTER"}},
      {"HELICAL", {"MN", "MT", "HELIX", "HAND", "DISTANCE", "X", "ADDENDUM", "DEDENDUM", "TIP", "TIPALTER"}},
      {"INTERNAL", {"MN", "MT", "HELIX", "HAND", "DISTANCE", "INTERNAL", "X", "ADDENDUM", "DEDENDUM", "TIP", "TIPALTER"}},
      {"BEVEL", {"MN", "MT", "DIAMETER", "SHAFT"}},
      {"SPIRAL", {"MN", "MT", "DIAMETER", "SHAFT", "HELIX"}},
      {"CROSSED", {"MN", "DISTANCE", "HELIX", "SHAFT"}},
      {"HYPOID", {"MN", "DIAMETER", "SHAFT", "HELIX", "OFFSET", "RINGCONE"}},
      {"WORM", {"MN", "MX", "STARTS", "LAMBDA", "LEAD", "Q", "DIAMETER", "DISTANCE", "SHAFT", "HAND"}}};
  return table;
}

/// Those keywords, with whether they are given on the card.
std::vector<std::pair<std::string_view, bool>> given_keywords(const GearData& data) {
  auto given = given_cut_keywords(data);
  given.insert(given.begin(), {{"MN", data.normal_module.has_value()},
                               {"MT", data.transverse_module.has_value()},
                               {"MX", data.axial_module.has_value()},
                               {"STARTS", data.starts.has_value()},
                               {"HELIX", !data.helix.empty()},
                               {"HAND", data.hand.given()},
                               {"DISTANCE", data.center_distance.has_value()},
                               {"DIAMETER", data.diameter.has_value()},
                               {"OFFSET", data.offset.has_value()},
                               {"RINGCONE", data.ring_cone.has_value()},
                               {"LAMBDA", data.lead_angle.has_value()},
                               {"LEAD", data.lead.has_value()},
                               {"Q", data.quotient.has_value()},
                               {"CONE", data.cone.has_value()},
                               {"SHAFT", data.shaft_angle.has_value()},
                               {"INTERNAL", data.internal}});
  return given;
}

/// Builds the design of one card.
class KindBuilder {
 public:
  KindBuilder(const GearData& data, const GearSite& site, const BuildContext& context, std::array<int, 2> teeth)
      : data_(data), site_(site), context_(context) {
    design_.teeth = teeth;
    design_.pressure_angle = data.pressure_angle * degree;
  }

  std::optional<GearDesign> build() {
    if (!check_keywords()) return {};
    bool good = false;
    const deck::Tagged& kind = data_.kind;
    if (kind.is("SPUR") || kind.is("HELICAL") || kind.is("INTERNAL")) good = parallel();
    if (kind.is("BEVEL") || kind.is("SPIRAL")) good = bevel();
    if (kind.is("CROSSED")) good = crossed();
    if (kind.is("HYPOID")) good = hypoid();
    if (kind.is("WORM")) good = worm();
    if (!good) return {};
    return design_;
  }

 private:
  bool fail(std::string_view keyword, std::string message, std::string hint = {}) const {
    context_.error(keyword, std::move(message), std::move(hint));
    return false;
  }

  bool check_keywords() const {
    for (const auto& [kind, taken] : keywords_by_kind()) {
      if (!data_.kind.is(kind)) continue;
      bool good = true;
      for (const auto& [keyword, given] : given_keywords(data_))
        if (given && std::find(taken.begin(), taken.end(), keyword) == taken.end())
          good = fail(keyword, fmt::format("KIND {} does not take {}", kind, keyword),
                      fmt::format("it takes Z with {}", fmt::join(taken, " ")));
      return good;
    }
    return false;
  }

  /// Which one of these keywords is given; reports an error unless it is exactly one.
  std::optional<std::string_view> one_of(const std::vector<std::pair<std::string_view, bool>>& choice,
                                         std::string_view what) const {
    std::vector<std::string_view> names, given;
    for (const auto& [keyword, present] : choice) {
      names.push_back(keyword);
      if (present) given.push_back(keyword);
    }
    if (given.size() == 1) return given[0];
    if (given.empty())
      fail("KIND", fmt::format("KIND {}: {} is missing", data_.kind.tag, what), fmt::format("give {}", fmt::join(names, " or ")));
    else
      fail(given[1], fmt::format("{} both fix {}", fmt::join(given, " and "), what), "keep one of them");
    return {};
  }

  /// Sign of A's helix angle (right hand positive) when its magnitude follows from other data.
  double hand() const { return data_.hand.is("LEFT") ? -1 : 1; }
  double helix_a() const { return data_.helix[0] * degree; }

  /// Sets both helices from angles that are positive for right hand.
  void set_helices(double trade_a, double trade_b) {
    design_.helix = {paper_helix(trade_a, design_.cone[0]), paper_helix(trade_b, design_.cone[1])};
  }
  /// The same, with the matching helix of B for parallel or intersecting axles.
  void set_helices(double trade_a) {
    design_.helix[0] = paper_helix(trade_a, design_.cone[0]);
    design_.helix[1] = -design_.helix[0];
  }

  /// Checks that a second helix angle, if given, is the matching one.
  bool check_second_helix() const {
    if (data_.helix.size() < 2) return true;
    const double fits = paper_helix(design_.helix[1], design_.cone[1]) / degree;
    if (std::abs(data_.helix[1] - fits) < 1e-6) return true;
    return fail("HELIX", fmt::format("helix of wheel B: {} given, {} needed", number(data_.helix[1]), number(fits)),
                data_.kind.is("INTERNAL") ? "wheels of an internal pair have the same hand"
                                          : "parallel axles and axles that meet need equal angles of opposite hands");
  }

  bool parallel() {
    if (data_.kind.is("INTERNAL")) {
      if (design_.teeth[0] == design_.teeth[1])
        return fail("Z", fmt::format("an internal pair with {} teeth on both wheels", design_.teeth[0]),
                    "the ring gear needs more teeth than the pinion");
      design_.cone[design_.teeth[0] > design_.teeth[1] ? 0 : 1] = std::numbers::pi;
    }
    if (!data_.helix.empty() && data_.hand.given())
      return fail("HAND", "HELIX has a sign and HAND is given as well", "right hand is positive: leave HAND out");
    const bool shifted = !data_.shift.empty(), shift_follows = data_.shift.size() == 1;
    const int sizes = (data_.normal_module ? 1 : 0) + (data_.transverse_module ? 1 : 0) + (data_.center_distance ? 1 : 0);
    const bool straight = data_.kind.is("SPUR") || (data_.kind.is("INTERNAL") && data_.helix.empty() &&
                                                    (sizes < 2 || shift_follows || data_.teeth.size() == 1));
    if (straight || !data_.helix.empty()) {
      set_helices(straight ? 0 : helix_a());
      if (!check_second_helix()) return false;
      // with X the distance may also be given: it determines the other shift, or is checked
      const bool module = data_.normal_module || data_.transverse_module;
      std::vector<std::pair<std::string_view, bool>> choice{{"MN", data_.normal_module.has_value()},
                                                            {"MT", data_.transverse_module.has_value()}};
      const bool teeth_follow = data_.teeth.size() == 1;
      if ((!shifted && !teeth_follow) || (!module && !shift_follows))
        choice.emplace_back("DISTANCE", data_.center_distance.has_value());
      const auto keyword = one_of(choice, "the module");
      if (!keyword) return false;
      const double cosine = std::cos(design_.helix[0]);
      if (*keyword == "MN") design_.normal_module = *data_.normal_module;
      if (*keyword == "MT") design_.normal_module = *data_.transverse_module * cosine;
      if (*keyword == "DISTANCE") {
        const auto per_module = distance_per_module(std::abs(design_.helix[0]));
        if (!per_module) return false;
        design_.normal_module = *data_.center_distance / *per_module;
      }
      return true;
    }
    return helix_that_fits();
  }

  /// Centre distance over m_n for parallel axles at the helix angle β, including profile shift.
  std::optional<double> distance_per_module(double helix) const {
    GearDesign one = design_;
    one.normal_module = 1;
    one.helix = {helix, -helix};
    CutTeeth cut = reference_cut(one, data_);
    const double sum = cut.shift[0] + cut.shift[1];
    if (data_.shift.empty() || sum == 0) return cut.reference_distance();
    const auto angle = cut.working_angle_of(sum);
    if (!angle) {
      fail("X", fmt::format("a sum of shifts of {}: the base circles would touch", number(sum)),
           "take a sum of shifts nearer to zero, or a larger ALPHA");
      return {};
    }
    cut.working_pressure_angle = *angle;
    return cut.distance();
  }

  /// Helix angle from cosβ = m_n/m_t; m_t may follow from the centre distance, and that from the nodes.
  bool helix_that_fits() {
    if (!data_.normal_module)
      return fail("KIND", fmt::format("KIND {}: the normal module or the helix is missing", data_.kind.tag),
                  "give MN, or HELIX with MT or DISTANCE");
    if (data_.transverse_module && data_.center_distance)
      return fail("DISTANCE", "MT and DISTANCE both fix the transverse module", "keep one of them");
    if (!data_.transverse_module && !data_.center_distance && !site_.x_b)
      return fail("KIND", fmt::format("KIND {}: the helix is missing", data_.kind.tag),
                  "give HELIX; or DISTANCE or MT, and it follows");
    double distance = 0;
    if (data_.center_distance)
      distance = *data_.center_distance;
    else if (!data_.transverse_module)
      distance = cross(site_.axle, Vec3(*site_.x_b - site_.x_a)).norm();
    if (data_.transverse_module) {
      const double m_t = *data_.transverse_module, cosine = *data_.normal_module / m_t;
      if (cosine > 1 + typing_tolerance)
        return fail("MT",
                    fmt::format("transverse module {} below the normal module {}", number(m_t), number(*data_.normal_module)),
                    "m_t = m_n/cos(helix) is never smaller");
      design_.normal_module = *data_.normal_module;
      set_helices(hand() * std::acos(std::min(cosine, 1.0)));
      return true;
    }
    if (data_.shift.size() == 1)
      return fail("X", "the centre distance cannot decide both the helix and the second shift",
                  "give HELIX, or MT, or X two values");
    const auto straight = distance_per_module(0);
    if (!straight) return false;
    const double wanted = distance / *data_.normal_module;
    if (*straight > wanted * (1 + typing_tolerance))
      return fail(data_.center_distance ? "DISTANCE" : "N",
                  fmt::format("centre distance {}: even straight teeth of module {} need {}", number(distance),
                              number(*data_.normal_module), number(*data_.normal_module * *straight)),
                  "no helix makes the wheels smaller: take fewer teeth, a smaller module or a larger distance");
    design_.normal_module = *data_.normal_module;
    double helix = 0;
    if (data_.shift.empty()) {
      helix = std::acos(std::min(*straight / wanted, 1.0));
    } else {  // the distance increases with the helix angle: bisection
      double low = 0, high = right_angle * (1 - 1e-9);
      for (int i = 0; i < 200 && high - low > 1e-16 * high; ++i) {
        helix = 0.5 * (low + high);
        const auto here = distance_per_module(helix);
        if (!here) return false;
        (*here < wanted ? low : high) = helix;
      }
    }
    set_helices(hand() * helix);
    return true;
  }

  /// The angle between intersecting axles: SHAFT, or from AXISB and the node positions, or 90 degrees.
  double shaft_angle() const {
    if (data_.shaft_angle) return *data_.shaft_angle * degree;
    if (data_.axis_b && site_.x_b)
      if (const auto angle = shaft_angle_of_axles(site_.x_a, site_.axle, *site_.x_b, to_vector(*data_.axis_b).normalized()))
        return *angle;
    return right_angle;
  }

  bool bevel() {
    if (data_.kind.is("SPIRAL") && data_.helix.empty())
      return fail("KIND", "KIND SPIRAL: the spiral angle is missing",
                  "give HELIX, the spiral angle of A at the middle of the face");
    design_.cone = bevel_cones(shaft_angle(), design_.teeth, site_);
    if (!data_.helix.empty()) set_helices(helix_a());
    if (!check_second_helix()) return false;
    const auto keyword = one_of({{"MN", data_.normal_module.has_value()},
                                 {"MT", data_.transverse_module.has_value()},
                                 {"DIAMETER", data_.diameter.has_value()}},
                                "the module");
    if (!keyword) return false;
    const double cosine = std::cos(design_.helix[0]);
    if (*keyword == "MN") design_.normal_module = *data_.normal_module;
    if (*keyword == "MT") design_.normal_module = *data_.transverse_module * cosine;
    if (*keyword == "DIAMETER") design_.normal_module = *data_.diameter * cosine / std::max(design_.teeth[0], design_.teeth[1]);
    return true;
  }

  bool crossed() {
    if (data_.helix.empty())
      return fail("KIND", "KIND CROSSED: the helices are missing", "give HELIX for both wheels, or for A and the angle SHAFT");
    double trade_b = 0;
    if (data_.helix.size() == 2) {
      trade_b = data_.helix[1] * degree;
      const double angle = std::abs(helix_a() + trade_b);
      if (data_.shaft_angle && std::abs(angle - *data_.shaft_angle * degree) > typing_tolerance)
        return fail("SHAFT",
                    fmt::format("angle between the axles: {} given, {} made by the helices", number(*data_.shaft_angle),
                                number(angle / degree)),
                    "|helix A + helix B| is the angle between the axles: leave SHAFT or the second helix out");
      if (angle < typing_tolerance)
        return fail("HELIX", "these helices make parallel axles", "KIND HELICAL is for parallel axles");
    } else if (data_.shaft_angle) {
      trade_b = (helix_a() < 0 ? -1 : 1) * *data_.shaft_angle * degree - helix_a();
      if (std::abs(trade_b) >= right_angle)
        return fail("HELIX",
                    fmt::format("wheel B would need a helix of {} degrees to make an angle of {}", number(trade_b / degree),
                                number(*data_.shaft_angle)),
                    "helices stay below 90 degrees: give A a larger one");
    } else {
      return fail("KIND", "KIND CROSSED: the helix of wheel B is missing",
                  "give HELIX two values, or the angle SHAFT between the axles");
    }
    set_helices(helix_a(), trade_b);
    const auto keyword =
        one_of({{"MN", data_.normal_module.has_value()}, {"DISTANCE", data_.center_distance.has_value()}}, "the module");
    if (!keyword) return false;
    design_.normal_module = 1;
    design_.normal_module =
        *keyword == "MN" ? *data_.normal_module : *data_.center_distance / (design_.radius(0) + design_.radius(1));
    return true;
  }

  bool hypoid() {
    const std::size_t pinion = design_.teeth[1] < design_.teeth[0] ? 1 : 0, ring = 1 - pinion;
    if (data_.helix.size() <= pinion)
      return fail("KIND", "KIND HYPOID: the spiral angle of the pinion is missing",
                  pinion == 0 ? "give HELIX, the spiral angle of A at the middle of the face"
                              : "the pinion is the wheel with fewer teeth: name it first, or give HELIX two values");
    const double spiral = data_.helix[pinion] * degree, hand = spiral < 0 ? -1 : 1;
    HypoidDesign h;
    h.pinion_teeth = design_.teeth[pinion];
    h.ring_teeth = design_.teeth[ring];
    h.shaft_angle = data_.shaft_angle.value_or(90) * degree;
    h.pinion_spiral = std::abs(spiral);
    h.offset = data_.offset;
    if (data_.helix.size() == 2) h.ring_spiral = -hand * data_.helix[ring] * degree;
    if (data_.ring_cone) h.ring_cone = *data_.ring_cone * degree;
    const int fixed = (h.offset ? 1 : 0) + (h.ring_spiral ? 1 : 0) + (h.ring_cone ? 1 : 0);
    if (fixed == 0 || (fixed == 1 && h.ring_cone))
      return fail("KIND", "KIND HYPOID: the offset of the axles is missing",
                  "give OFFSET, or HELIX for both wheels: it then follows");
    if (fixed == 3) return fail("RINGCONE", "OFFSET, two HELIX values and RINGCONE are one too many", "keep two of them");
    const auto keyword =
        one_of({{"MN", data_.normal_module.has_value()}, {"DIAMETER", data_.diameter.has_value()}}, "the module");
    if (!keyword) return false;
    if (*keyword == "MN")
      h.normal_module = data_.normal_module;
    else
      h.ring_radius = *data_.diameter / 2;
    const auto cones = hypoid_cones(h);
    if (!cones)
      return fail(data_.offset ? "OFFSET" : "HELIX", "no pitch cones touch with these numbers",
                  "a smaller offset, spiral angles that differ less or a smaller SHAFT bring it nearer to a spiral bevel pair");
    design_.normal_module = cones->normal_module;
    design_.cone[pinion] = cones->pinion_cone;
    design_.cone[ring] = cones->ring_cone;
    design_.helix[pinion] = paper_helix(spiral, cones->pinion_cone);
    design_.helix[ring] = paper_helix(-hand * cones->ring_spiral, cones->ring_cone);
    // A's axle may point from the apex outwards or inwards: the side on which B lies decides
    if (site_.x_b) {
      const Closure c = closure(design_, site_.x_a, *site_.x_b, site_.axle);
      if (c.offset_needed * c.offset_given < 0)
        for (double& cone : design_.cone) cone = -cone;
    }
    return true;
  }

  bool worm() {
    const WormNumbers numbers{design_.teeth[0], design_.teeth[1], data_.shaft_angle.value_or(90) * degree};
    const std::array<std::optional<double>, 7> values{data_.lead_angle ? std::optional(*data_.lead_angle * degree) : std::nullopt,
                                                      data_.quotient,
                                                      data_.normal_module,
                                                      data_.axial_module,
                                                      data_.lead,
                                                      data_.diameter,
                                                      data_.center_distance};
    struct Given {
      WormSize size;
      double value;
    };
    std::vector<Given> given;
    for (std::size_t i = 0; i < values.size(); ++i)
      if (values[i]) given.push_back({static_cast<WormSize>(i), *values[i]});
    const std::string all = fmt::format("{}", fmt::join(worm_keywords, " "));
    if (given.size() == 1 && site_.x_b && given[0].size != WormSize::center_distance)
      given.push_back({WormSize::center_distance, cross(site_.axle, Vec3(*site_.x_b - site_.x_a)).norm()});
    // two independent ones: λ and q are equivalent, and so are lead and axial module
    const auto independent = [](WormSize one, WormSize other) {
      if (!is_length(one) && !is_length(other)) return false;
      const auto pitch = [](WormSize s) { return s == WormSize::lead || s == WormSize::axial_module; };
      return !(pitch(one) && pitch(other));
    };
    for (std::size_t i = 0; i < given.size(); ++i)
      for (std::size_t j = i + 1; j < given.size(); ++j) {
        if (!independent(given[i].size, given[j].size)) continue;
        const auto lead_angle = worm_lead_angle(numbers, given[i].size, given[i].value, given[j].size, given[j].value);
        if (!lead_angle)
          return fail(
              data_.center_distance ? "DISTANCE" : "KIND",
              fmt::format("no lead angle makes a worm of {} {} and {} {}", keyword(given[i].size),
                          shown(given[i].size, given[i].value), keyword(given[j].size), shown(given[j].size, given[j].value)),
              "check the numbers of threads and teeth, and that all lengths have one unit");
        const auto& length = is_length(given[i].size) ? given[i] : given[j];
        design_.normal_module = length.value / worm_size(length.size, numbers, *lead_angle);
        const double helix = right_angle - *lead_angle;
        set_helices(hand() * helix, hand() * (numbers.shaft_angle - helix));
        return check_worm(numbers, *lead_angle, values);
      }
    return fail(
        "KIND",
        given.size() < 2 ? "KIND WORM: two sizes of the drive are needed" : "KIND WORM: the sizes given say the same twice",
        fmt::format("give two of {} (not LAMBDA with Q, not LEAD with MX)", all));
  }

  static std::string_view keyword(WormSize size) { return worm_keywords[static_cast<std::size_t>(size)]; }
  static std::string shown(WormSize size, double value) { return number(size == WormSize::lead_angle ? value / degree : value); }

  /// Checks that all other given dimensions agree.
  bool check_worm(const WormNumbers& numbers, double lead_angle, const std::array<std::optional<double>, 7>& values) const {
    bool good = true;
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (!values[i]) continue;
      const auto size = static_cast<WormSize>(i);
      const double needed = worm_size(size, numbers, lead_angle) * (is_length(size) ? design_.normal_module : 1);
      if (std::abs(*values[i] - needed) <= typing_tolerance * needed) continue;
      good = fail(
          worm_keywords[i],
          fmt::format("{} {} given, {} needed by the others", worm_keywords[i], shown(size, *values[i]), shown(size, needed)),
          "two sizes fix the drive: leave the others out");
    }
    return good;
  }

  const GearData& data_;
  const GearSite& site_;
  const BuildContext& context_;
  GearDesign design_;
};

}  // namespace

namespace {

/// The number of teeth of wheel B that closes a pair on parallel axles: the centre distance increases with it, external or
/// internal.
std::optional<std::array<int, 2>> teeth_that_close(const GearData& data, double distance, const BuildContext& context) {
  const bool internal = data.internal || data.kind.is("INTERNAL");
  const double helix = data.helix.empty() ? 0 : data.helix[0] * degree;
  GearDesign design;
  design.normal_module = data.normal_module ? *data.normal_module : *data.transverse_module * std::cos(helix);
  design.pressure_angle = data.pressure_angle * degree;
  design.helix = {helix, -helix};
  if (internal) design.cone[1] = std::numbers::pi;
  const auto distance_with = [&](int z) {
    design.teeth = {data.teeth[0], z};
    CutTeeth cut = reference_cut(design, data);
    const double sum = cut.shift[0] + cut.shift[1];
    if (sum != 0) cut.working_pressure_angle = cut.working_angle_of(sum).value_or(0);
    return cut.distance();
  };
  const int first = internal ? data.teeth[0] + 1 : 1;
  constexpr int most = 100000;
  if (distance_with(most) < distance) {
    context.error("Z", fmt::format("no number of teeth of wheel B makes a centre distance of {}", number(distance)),
                  "have the module and the centre distance one unit of length?");
    return {};
  }
  int low = first, high = most;
  while (low < high) {  // smallest number of teeth that reaches the distance
    const int middle = (low + high) / 2;
    if (distance_with(middle) < distance * (1 - typing_tolerance))
      low = middle + 1;
    else
      high = middle;
  }
  if (std::abs(distance_with(low) - distance) <= typing_tolerance * distance) return std::array<int, 2>{data.teeth[0], low};
  context.error("Z",
                fmt::format("no whole number of teeth of wheel B makes a centre distance of {}: {} make {}{}", number(distance),
                            low, number(distance_with(low)),
                            low > first ? fmt::format(", {} make {}", low - 1, number(distance_with(low - 1))) : ""),
                "give Z two values and X one: the shift of wheel B then follows");
  return {};
}

}  // namespace

std::optional<std::array<int, 2>> gear_teeth_numbers(const GearData& data, const GearSite& site, const BuildContext& context) {
  const bool starts = data.starts && data.kind.is("WORM");
  const bool parallel = data.kind.given()
                            ? data.kind.is("SPUR") || data.kind.is("INTERNAL") || (data.kind.is("HELICAL") && !data.helix.empty())
                            : !data.cone && !data.shaft_angle && !data.axis_b && data.helix.size() < 2;
  if (parallel && data.teeth.size() == 1 && data.shift.size() != 1 && (data.normal_module || data.transverse_module)) {
    std::optional<double> distance = data.center_distance;
    if (!distance && site.x_b) distance = cross(site.axle, Vec3(*site.x_b - site.x_a)).norm();
    if (distance) return teeth_that_close(data, *distance, context);
  }
  if (data.teeth.size() == 2 && !starts) return std::array<int, 2>{data.teeth[0], data.teeth[1]};
  if (data.teeth.size() == 1 && starts) return std::array<int, 2>{*data.starts, data.teeth[0]};
  if (starts)
    context.error("Z", "STARTS is the number of threads, and Z has two values", "with STARTS give the teeth of the wheel alone");
  else
    context.error("Z", fmt::format("numbers of teeth of two wheels are needed, {} given", data.teeth.size()),
                  data.kind.is("WORM") ? "give STARTS for the worm, or Z two values" : "give Z two values: of A and of B");
  return {};
}

std::array<double, 2> bevel_cones(double shaft, const std::array<int, 2>& teeth, const GearSite& site) {
  auto cones = cones_of_shaft_angle(shaft, teeth);
  if (!site.x_b) return cones;
  // the sign is chosen to match the offset of B along the axle of A, −r_B Z₁₂ = −r_B sin(γ_A + γ_B)
  GearDesign design;
  design.teeth = teeth;
  design.cone = cones;
  const Closure c = closure(design, site.x_a, *site.x_b, site.axle);
  if (c.offset_needed * c.offset_given < 0)
    for (double& cone : cones) cone = -cone;
  return cones;
}

std::optional<GearDesign> design_of_kind(const GearData& data, const GearSite& site, const BuildContext& context) {
  const auto teeth = gear_teeth_numbers(data, site, context);
  if (!teeth) return {};
  return KindBuilder(data, site, context, *teeth).build();
}

bool check_long_form(const GearData& data, const BuildContext& context) {
  constexpr std::array<std::string_view, 10> long_form{"MN", "HELIX",    "CONE",     "SHAFT", "INTERNAL",
                                                       "X",  "ADDENDUM", "DEDENDUM", "TIP",   "TIPALTER"};
  bool good = true;
  for (const auto& [keyword, given] : given_keywords(data)) {
    if (!given || std::find(long_form.begin(), long_form.end(), keyword) != long_form.end()) continue;
    good = false;
    std::vector<std::string_view> kinds;
    for (const auto& [kind, taken] : keywords_by_kind())
      if (std::find(taken.begin(), taken.end(), keyword) != taken.end()) kinds.push_back(kind);
    context.error(keyword, fmt::format("{} belongs to a short form, and there is no KIND", keyword),
                  fmt::format("give KIND {}", fmt::join(kinds, " or ")));
  }
  if (good && !data.normal_module) {
    context.error("MN", "the normal module is missing", "give MN, or a KIND from whose data it follows");
    good = false;
  }
  return good;
}

}  // namespace engrane::elements::gears

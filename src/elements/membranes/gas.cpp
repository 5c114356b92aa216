// SPDX-License-Identifier: BSD-3-Clause
#include "elements/membranes/gas.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "elements/common/building.hpp"
#include "elements/membranes/gas_law.hpp"
#include "elements/membranes/volume_shares.hpp"
#include "elements/structural/cell.hpp"
#include "elements/structural/cell_book.hpp"
#include "model/determined_channels.hpp"
#include "model/filled.hpp"

namespace engrane::elements::membranes {

namespace {

using structural::CellBook;
using structural::CellData;

/// Multiplier of Φ = (Σ V_e − V)/A: the overpressure p − p₀ times A.
std::vector<Multiplier> multipliers() {
  return {{{"PRESSURE_FORCE", dimension::length, "enclosed volume less that of the gas, over the reference surface"}}};
}

/// The gas. Its unknown is the volume V divided by the area A of the surface in the reference configuration.
class Gas final : public Element, public DeterminedChannels, public Filled {
 public:
  Gas(int id, const GasLaw& law, double area, double volume, double mass)
      : Element(id), law_(law), area_(area), volume_(volume), mass_(mass) {
    layout_.scalars = {{{"HEIGHT", dimension::length, "volume over the area of the surface"}}};
    layout_.multipliers = multipliers();
  }

  const Layout& layout() const override { return layout_; }
  bool in_mesh() const override { return false; }
  const char* why_not_finite() const override {
    return "encloses no volume, or has a mass below 0: take smaller steps H, and a function NF that is never below 0";
  }
  void start(std::span<double> scalars, std::span<double> /*history*/) const override { scalars[0] = volume_ / area_; }

  void residual(const State& state, std::span<double> r) const override {
    const GasLaw::Pressure p = law_.pressure(volume(state), state.time);
    r[0] = state.multipliers[0] - (p.value - law_.ambient) * area_;
    r[1] = state.scalars[0];
  }
  void tangent(const State& state, Weights weights, std::span<double> r, std::span<double> k) const override {
    residual(state, r);
    k[0] = -weights.q * law_.pressure(volume(state), state.time).by_volume * area_ * area_;
    k[1] = weights.multipliers;
    k[2] = weights.q;
    k[3] = 0;
  }
  void constraint_rates(const State& state, std::span<double> phi, std::span<double> rate,
                        std::span<double> second) const override {
    phi[0] = -state.scalars[0];
    rate[0] = -state.scalar_rates[0];
    second[0] = -state.scalar_accelerations[0];
  }

  Energies energies(const State& state) const override {
    Energies e;
    e.potential = law_.energy(volume(state), state.time);
    e.external = law_.filling(volume(state), state.time);
    return e;
  }
  Filling filling(const State& state) const override {
    const double now = volume(state);
    return {law_.amount_at(state.time), now, law_.filling(now, state.time)};
  }
  double work_of_filling(double from, double to, double volume) const override { return law_.work_of_filling(from, to, volume); }
  double slope_beside(const Filling& at, double volume) const override { return std::log(volume / at.size); }

  const std::vector<Channel>& channels() const override {
    static const std::vector<Channel> with_mass = {
        {"PRESSURE", dimension::pressure, "absolute pressure of the gas"},
        {"OVERPRESSURE", dimension::pressure, "pressure of the gas over that of the atmosphere"},
        {"VOLUME", {3, 0, 0, 0}, "volume of the gas"},
        {"MASS", dimension::mass, "mass of the gas"}};
    static const std::vector<Channel> without_mass(with_mass.begin(), with_mass.end() - 1);
    return mass_ > 0 ? with_mass : without_mass;
  }
  void observe(const State& state, std::span<double> values) const override {
    values[0] = law_.pressure(volume(state), state.time).value;
    values[1] = values[0] - law_.ambient;
    values[2] = volume(state);
    if (mass_ > 0) values[3] = mass(state.time);
  }
  std::vector<Determined> determined() const override {
    if (!law_.function) return {};
    return mass_ > 0 ? std::vector<Determined>{{0, {2}}, {1, {2}}, {3}} : std::vector<Determined>{{0, {2}}, {1, {2}}};
  }
  double determine(int channel, double time, std::span<const double> volume) const override {
    if (channel == 3) return mass(time);
    return law_.pressure(volume[0], time).value - (channel == 1 ? law_.ambient : 0);
  }
  std::vector<Derived> derived() const override { return {{"volume", volume_, {3, 0, 0, 0}}, {"surface", area_, {2, 0, 0, 0}}}; }

 private:
  double volume(const State& state) const { return state.scalars[0] * area_; }
  double mass(double time) const { return mass_ * (law_.function ? law_.function->at(time).f : 1); }

  Layout layout_;
  GasLaw law_;
  double area_, volume_;
  double mass_;  ///< for a function value of 1; 0: not given
};

struct Edge {
  std::vector<int> nodes;  ///< ends in the orientation of the cell, then the mid-side node if any
};

/// The membranes of a group of elements: cells of `.MAI` and elements of `.MCE`.
class Surface {
 public:
  explicit Surface(const BuildContext& context) : context_(context), book_(CellBook::of(context)) {}

  /// False after an error.
  bool read(const std::vector<std::string>& groups) {
    bool good = true;
    for (const std::string& name : groups) {
      if (!book_->has_group(name)) {
        context_.diagnostics.missing(".SEL", context_.record.where("GROUP"),
                                     fmt::format("there is no group of elements \"{}\"", name),
                                     "declare it with .SEL GROUP n MAILLES");
        good = false;
        continue;
      }
      for (const int id : book_->cells(name)) good = add_cell(id) && good;
      for (const int id : book_->other_elements(name))
        if (const std::vector<int>* nodes = book_->membrane(id)) add(*nodes);
    }
    if (good && cells_.empty()) {
      context_.error("GROUP", "there are no membranes in the group",
                     "name a group of elements MEMBRANE, or of cells of .HYP MEMBRANE");
      return false;
    }
    return good && pair_edges();
  }

  const std::vector<std::vector<int>>& cells() const { return cells_; }
  const std::vector<Edge>& rim() const { return rim_; }
  std::vector<Vec3> places(const std::vector<int>& nodes) const {
    std::vector<Vec3> x;
    for (const int id : nodes) x.push_back(context_.nodes.at(id));
    return x;
  }

 private:
  bool add_cell(int id) {
    const auto section = book_->section(id);
    const auto cell = structural::connectivity(book_->record(id)->get<CellData>()->nodes);
    if (!section || !cell) return false;  // reported with the cell
    if (!section->skin) {
      context_.error("GROUP", fmt::format("cell {} is no membrane", id), ".HYP MEMBRANE, without BIDIM");
      return false;
    }
    add(cell->nodes);
    return true;
  }

  void add(const std::vector<int>& nodes) {
    const bool known = std::all_of(nodes.begin(), nodes.end(), [this](int id) { return context_.nodes.contains(id); });
    if (known && nodes.size() >= 3) cells_.push_back(nodes);
  }

  /// Edges that belong to one cell only form the rim.
  bool pair_edges() {
    std::map<std::pair<int, int>, Edge> open;
    for (const std::vector<int>& cell : cells_) {
      const std::size_t corners = cell.size() == 6 ? 3 : cell.size() == 8 ? 4 : cell.size();
      for (std::size_t i = 0; i < corners; ++i) {
        const int a = cell[i], b = cell[(i + 1) % corners];
        if (open.erase({b, a}) > 0) continue;
        Edge edge{{a, b}};
        if (cell.size() > corners) edge.nodes.push_back(cell[corners + i]);
        if (open.emplace(std::pair(a, b), std::move(edge)).second) continue;
        context_.error("GROUP",
                       fmt::format("two membranes go from node {} to node {}: seen from one side they go round otherwise", a, b),
                       "the corners of all membranes go round counterclockwise, seen from outside");
        return false;
      }
    }
    for (auto& [ends, edge] : open) rim_.push_back(std::move(edge));
    return true;
  }

  const BuildContext& context_;
  std::shared_ptr<const CellBook> book_;
  std::vector<std::vector<int>> cells_;
  std::vector<Edge> rim_;
};

/// Normal of the cutting plane of each rim edge. Reports an error and returns nothing if an edge lies in none of the card's
/// planes.
std::optional<std::vector<Vec3>> planes_of(const Surface& surface, const GasData& data, double size,
                                           const BuildContext& context) {
  std::vector<Vec3> normals, found;
  for (std::size_t i = 0; i + 2 < data.cuts.size(); i += 3) normals.push_back(Vec3(&data.cuts[i]).stableNormalized());
  const Vec3 at = to_vector(data.at);
  constexpr double rounding = 1e-6;  // of coordinates in a deck
  for (const Edge& edge : surface.rim()) {
    const std::vector<Vec3> x = surface.places(edge.nodes);
    const auto holds = [&](const Vec3& n) {
      return std::all_of(x.begin(), x.end(), [&](const Vec3& p) { return std::abs(n.dot(p - at)) <= rounding * size; });
    };
    const auto plane = std::find_if(normals.begin(), normals.end(), holds);
    if (plane == normals.end()) {
      const std::string side = fmt::format("the side from node {} to node {}", edge.nodes[0], edge.nodes[1]);
      if (normals.empty())
        context.error("GROUP", fmt::format("the surface is open: {} has a membrane on one side only", side),
                      "membranes all round, with nodes in common, or planes CUT through AT that close it");
      else
        context.error("CUT", side + " of the rim lies in none of the planes",
                      "CUT holds their normals, AT a point of all of them");
      return {};
    }
    found.push_back(*plane);
  }
  return found;
}

/// Gas law from the card; `volume` is that of the reference configuration. Reports an error and returns nothing if the card is
/// inconsistent.
std::optional<GasLaw> law_of(const GasData& data, double volume, BuildContext& context) {
  GasLaw law;
  law.gamma = data.gamma;
  law.ambient = law.rest = data.ambient;
  if (!find_function(context, data.function, law.function)) return {};
  if (data.pressure.has_value() == data.mass.has_value()) {
    context.error("GROUP", "a gas has either a pressure P in the reference configuration or a MASS",
                  "P 101325., or MASS m R r TEMP T");
    return {};
  }
  for (const char* keyword : {"R", "TEMP", "NF"})
    if (data.pressure && context.record.given(keyword)) {
      context.error(keyword, fmt::format("{} without MASS", keyword), "MASS m R r TEMP T");
      return {};
    }
  if (data.mass && (!data.constant || !data.temperature)) {
    context.error("MASS", "MASS needs R and TEMP", "R 287. TEMP 293. for air, in J/kg K and K");
    return {};
  }
  if (data.mass && data.gamma != 1) {
    context.error("GAMMA", "a gas of a given MASS keeps its temperature TEMP", "leave GAMMA out, or give P");
    return {};
  }
  const bool flat = !(volume > 0);
  if (flat && (data.pressure || data.ambient == 0)) {
    context.error("GROUP", "the surface encloses no volume in the reference configuration",
                  data.pressure ? "MASS m R r TEMP T AMBIENT p, with a flat surface" : "a flat surface needs AMBIENT p");
    return {};
  }
  law.amount = data.mass ? *data.mass * *data.constant * *data.temperature : *data.pressure * std::pow(volume, data.gamma);
  if (law.rest == 0) law.rest = law.amount / volume;
  return law;
}

std::unique_ptr<Element> build(const GasData& data, BuildContext& context) {
  if (!context.records) return nullptr;
  if (data.cuts.size() % 3 != 0) {
    context.error("CUT", fmt::format("{} numbers for normals", data.cuts.size()), "three for each plane: CUT 1 0 0  0 1 0");
    return nullptr;
  }
  Surface surface(context);
  if (!surface.read(data.groups)) return nullptr;
  // the volume of a closed surface does not depend on the origin; one nearby minimises cancellation
  const Vec3 first = surface.places(surface.cells().front()).front();
  double size = 0, area = 0;
  for (const std::vector<int>& cell : surface.cells())
    for (const Vec3& x : surface.places(cell)) size = std::max(size, (x - first).norm());
  const auto planes = planes_of(surface, data, size, context);
  if (!planes) return nullptr;
  const Vec3 origin = surface.rim().empty() ? first : to_vector(data.at);
  for (const std::vector<int>& cell : surface.cells()) {
    const std::vector<Vec3> x = surface.places(cell);
    const bool three = cell.size() == 3 || cell.size() == 6;
    area += three ? (x[1] - x[0]).cross(x[2] - x[0]).norm() / 2 : (x[2] - x[0]).cross(x[3] - x[1]).norm() / 2;
  }

  BlockStore alone;
  BlockStore& blocks = context.blocks ? *context.blocks : alone;
  std::vector<std::unique_ptr<Element>> shares;
  double volume = 0;
  const auto add = [&](const std::vector<int>& nodes, bool rim, const Vec3& normal) {
    VolumeShares::Piece piece{nodes, origin, normal, area};
    const std::string options = fmt::format("{} {}", nodes.size(), rim);
    const auto block = blocks.block<VolumeShares>(options, nodes.size(), rim, multipliers());
    volume += block->volume(piece, surface.places(nodes));
    shares.push_back(std::make_unique<BlockMember>(context.record.id, block, block->add(std::move(piece))));
  };
  for (const std::vector<int>& cell : surface.cells()) add(cell, false, Vec3::Zero());
  for (std::size_t i = 0; i < surface.rim().size(); ++i) add(surface.rim()[i].nodes, true, (*planes)[i]);

  constexpr double rounding = 1e-9;
  if (volume < -rounding * area * size) {
    context.error("GROUP", "the membranes go round clockwise, seen from outside of what they enclose", "turn their corners");
    return nullptr;
  }
  if (volume < rounding * area * size) volume = 0;
  const auto law = law_of(data, volume, context);
  if (!law) return nullptr;
  // a flat skin starts with the volume of the gas at ambient pressure
  if (volume == 0) volume = law->amount * (law->function ? law->function->at(0).f : 1) / law->ambient;
  if (!(volume > 0)) {
    context.error("NF", "a flat surface begins with a mass above 0", "a function that begins above 0");
    return nullptr;
  }
  if (context.more) std::move(shares.begin(), shares.end(), std::back_inserter(*context.more));
  return std::make_unique<Gas>(context.record.id, *law, area, volume, data.mass.value_or(0));
}

}  // namespace

ElementType gas_type() {
  deck::Card<GasData> card("GAS", {"GAZ"}, "Gas: what membranes enclose, with a pressure that follows from its volume");
  card.numbered()
      .chapter("Meshes")
      .describe(
          "The membranes of the group go round counterclockwise, seen from outside, and meet in common nodes. They close the "
          "volume, or their rim lies in planes CUT through the point AT, such as planes of symmetry, in which it stays. The "
          "pressure is that of P in the reference configuration and follows p V = constant, or p V^GAMMA where no heat flows; or "
          "it "
          "follows from a MASS, which may be a function of time, as MASS R TEMP/V. Pressures are absolute; the skin feels the "
          "difference from AMBIENT.")
      .example("I 9 GAS GROUP \"balloon\"  P 1.2D5  AMBIENT 1D5  GAMMA 1.4")
      .example("I 9 GAS GROUP \"cushion\"  MASS 0.02 NF 1 R 287. TEMP 293.  AMBIENT 101325.  CUT 1 0 0  0 1 0  AT 0 0 0");
  card.add("GROUP", &GasData::groups, "groups of membranes: names or numbers")
      .refers(deck::Reference::group)
      .values(1, deck::any_number)
      .required();
  card.add("P", &GasData::pressure, "absolute pressure in the reference configuration")
      .synonyms({"PRESSURE", "PRESSION"})
      .unit(dimension::pressure)
      .positive();
  card.add("GAMMA", &GasData::gamma, "exponent of the volume: 1 where the temperature stays, 1.4 of air that gets no heat")
      .at_least(1);
  card.add("MASS", &GasData::mass, "mass of the gas").synonyms({"MASSE"}).unit(dimension::mass).positive();
  card.add("NF", &GasData::function, "function of time that MASS is multiplied by; default: none")
      .refers(deck::Reference::function);
  card.add("R", &GasData::constant, "specific gas constant: pressure times volume over mass and temperature").positive();
  card.add("TEMP", &GasData::temperature, "absolute temperature").positive();
  card.add("AMBIENT", &GasData::ambient, "pressure of the atmosphere").unit(dimension::pressure).at_least(0);
  card.add("CUT", &GasData::cuts,
           "normals of planes that close the surface, three numbers each; an edge is in the first that holds it")
      .values(3, deck::any_number);
  card.add("AT", &GasData::at, "a point of all these planes").unit(dimension::length);
  return element_type(card, build);
}

}  // namespace engrane::elements::membranes

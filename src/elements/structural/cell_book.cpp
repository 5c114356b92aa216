// SPDX-License-Identifier: BSD-3-Clause
#include "elements/structural/cell_book.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <set>
#include <tuple>

#include "base/text.hpp"
#include "deck/cards/cards.hpp"
#include "elements/structural/cell.hpp"
#include "elements/structural/cell_material.hpp"
#include "elements/structural/make_cell.hpp"
#include "math/angle.hpp"

namespace engrane::elements::structural {

namespace {

using materials::Hypothesis;

/// Hypothesis of a supported formulation of plane, solid or membrane cells; nothing for others.
std::optional<Hypothesis> hypothesis_of(const deck::HypothesisCard& card) {
  const auto variant = [&card](std::string_view wanted) { return card.variant.empty() || abbreviates(card.variant, wanted); };
  if (abbreviates(card.formulation, "MEMBRANE") && variant("BIDIM")) return Hypothesis::plane_stress;
  if (abbreviates(card.formulation, "CONTRAINTE") && variant("PLANE")) return Hypothesis::plane_stress;
  if (abbreviates(card.formulation, "DEFORMATION") && variant("PLANE")) return Hypothesis::plane_strain;
  if (abbreviates(card.formulation, "VOLUME") && card.variant.empty()) return Hypothesis::solid;
  if ((abbreviates(card.formulation, "AXISYMETRIQUE") || abbreviates(card.formulation, "AXISYMMETRIC")) && card.variant.empty())
    return Hypothesis::axisymmetric;
  return {};
}

bool is_beam_card(const deck::HypothesisCard& card) {
  return (abbreviates(card.formulation, "BEAM") || abbreviates(card.formulation, "POUTRE")) && card.variant.empty();
}

/// Whether the formulation is that of membranes in space, as opposed to the x-y plane.
bool is_skin(const deck::HypothesisCard& card) { return abbreviates(card.formulation, "MEMBRANE") && card.variant.empty(); }

/// The card of a hypothesis of membranes in space; nullptr if there is none or it is another.
const deck::HypothesisCard* skin_card(const deck::Record* hypothesis) {
  const auto* card = hypothesis ? hypothesis->get<deck::HypothesisCard>() : nullptr;
  return card && is_skin(*card) ? card : nullptr;
}

/// `"a"`, `"b"`, or all cells.
std::string names_of(const std::vector<std::string>& groups) {
  std::string names;
  for (const std::string& group : groups) names += (names.empty() ? "\"" : ", \"") + group + "\"";
  return groups.empty() ? "all cells" : (groups.size() == 1 ? "group " : "groups ") + names;
}

/// Material axes at a place, as columns: those of a frame, which must exist (0: global ones), turned about the third.
Mat3 axes_at(const Frames& frames, int frame, double degrees, const Vec3& place) {
  const Mat3 axes = frame == 0 ? Mat3::Identity() : *frames.axes_at(frame, place);
  return axes * Eigen::AngleAxisd(degrees * degree, Vec3::UnitZ()).toRotationMatrix();
}

/// Places of the corners of a cell that exist.
std::vector<Vec3> corners_of(const deck::Record& cell, const NodePositions& nodes) {
  std::vector<Vec3> places;
  for (const int id : cell.get<CellData>()->nodes)
    if (id > 0 && nodes.contains(id)) places.push_back(nodes.at(id));
  return places;
}

/// Mean of the corners; the origin if there are none.
Vec3 middle_of(const deck::Record& cell, const NodePositions& nodes) {
  const std::vector<Vec3> corners = corners_of(cell, nodes);
  const Vec3 sum = std::accumulate(corners.begin(), corners.end(), Vec3(Vec3::Zero()));
  return corners.empty() ? sum : Vec3(sum / static_cast<double>(corners.size()));
}

}  // namespace

CellBook::CellBook(const BuildContext& context)
    : diagnostics_(context.diagnostics),
      linear_(deck::has_small_displacements(*context.records)),
      lumped_(deck::has_lumped_masses(*context.records)) {
  const std::vector<deck::Record>& records = *context.records;
  read_cells(records);
  read_groups(records, context.nodes);
  read_properties(records);
  number_parts(records);
  read_rotations(context);
  make_sections(context.nodes);
  check_beams();
  check_weight(records);
  look_at_axes();
  if (context.temperatures) refuse_cold(*context.temperatures);
}

std::shared_ptr<const CellBook> CellBook::of(const BuildContext& context) {
  const auto make = [&context] { return std::make_shared<const CellBook>(context); };
  return context.notes ? context.notes->get<std::shared_ptr<const CellBook>>(make) : make();
}

void CellBook::read_cells(const std::vector<deck::Record>& records) {
  for (const deck::Record& record : records) {
    if (record.get<CellData>())
      cells_.push_back({&record});
    else if (const std::vector<int>* nodes = membrane_nodes(record))
      membranes_[record.id] = nodes;
  }
  const auto by_number = [](const Cell& a, const Cell& b) { return a.record->id < b.record->id; };
  if (!std::is_sorted(cells_.begin(), cells_.end(), by_number)) std::sort(cells_.begin(), cells_.end(), by_number);
}

std::size_t CellBook::index(int cell) const {
  const auto found =
      std::lower_bound(cells_.begin(), cells_.end(), cell, [](const Cell& one, int wanted) { return one.record->id < wanted; });
  return found == cells_.end() || found->record->id != cell ? cells_.size() : static_cast<std::size_t>(found - cells_.begin());
}

const CellBook::Cell* CellBook::find(int cell) const {
  const std::size_t at = index(cell);
  return at == cells_.size() ? nullptr : &cells_[at];
}

const deck::Record* CellBook::record(int cell) const {
  const Cell* found = find(cell);
  return found ? found->record : nullptr;
}

std::shared_ptr<const CellSection> CellBook::section(int cell) const {
  const Cell* found = find(cell);
  return found ? found->section : nullptr;
}

std::optional<BeamCell> CellBook::beam(int cell) const {
  const Cell* found = find(cell);
  if (!found || found->profile == 0 || !found->hypothesis || !is_beam_card(*found->hypothesis->get<deck::HypothesisCard>()))
    return {};
  return BeamCell{found->profile, found->material ? found->material->id : 0, found->axis_2, linear_, lumped_};
}

bool CellBook::is_beam(const Cell& cell) { return line_of(cell.record->get<CellData>()->nodes).has_value(); }

std::shared_ptr<const CellRotation> CellBook::rotation(int cell) const {
  const Cell* found = find(cell);
  return found ? found->rotation : nullptr;
}

void CellBook::read_properties(const std::vector<deck::Record>& records) {
  std::set<std::string> refused;
  Diagnostics told;  // discarded: the model itself reports errors of frames
  for (const deck::Record& record : records) {
    if (record.get<deck::MaterialCard>()) materials_[record.id] = &record;
    if (const auto* frame = record.get<deck::FrameCard>()) frames_.add(record, *frame, told);
  }
  for (const deck::Record& record : records) {
    if (const auto* hypothesis = record.get<deck::HypothesisCard>()) {
      const std::string words = hypothesis->formulation + (hypothesis->variant.empty() ? "" : " " + hypothesis->variant);
      if (!hypothesis_of(*hypothesis) && !is_beam_card(*hypothesis) && refused.insert(upper(words)).second)
        diagnostics_.error(record.where("FORMULATION"),
                           fmt::format("the formulation {} ({}) is not in this version", words, names_of(hypothesis->groups)),
                           "there are MEMB BIDIM and CONT PLAN (plane stress), DEFO PLAN (plane strain), AXIS, VOLUME, MEMBRANE "
                           "(in space) and BEAM");
      check_skin(record, *hypothesis);
      if (hypothesis->groups.empty())
        for (Cell& cell : cells_) cell.hypothesis = &record;
      for (const std::size_t i : members(record, hypothesis->groups)) cells_[i].hypothesis = &record;
    }
    if (const auto* property = record.get<deck::PropertyCard>())
      for (const std::size_t i : members(record, property->groups)) cells_[i].thickness = property->thickness.value_or(0);
    if (const auto* assignment = record.get<deck::AssignmentCard>()) assign(record, *assignment);
  }
}

void CellBook::number_parts(const std::vector<deck::Record>& records) {
  std::set<std::string> named;
  for (const deck::Record& record : records) {
    if (const auto* hypothesis = record.get<deck::HypothesisCard>())
      named.insert(hypothesis->groups.begin(), hypothesis->groups.end());
    if (const auto* property = record.get<deck::PropertyCard>()) named.insert(property->groups.begin(), property->groups.end());
    if (const auto* assignment = record.get<deck::AssignmentCard>())
      named.insert(assignment->groups.begin(), assignment->groups.end());
  }
  int parts = 1;
  for (const std::string& name : named) {
    const auto group = groups_.find(name);
    if (group == groups_.end()) continue;
    std::map<int, int> cut;  // from each part so far to the piece of it that lies in the group
    for (const std::size_t i : group->second.cells) {
      const auto [piece, fresh] = cut.try_emplace(cells_[i].part, parts);
      if (fresh) ++parts;
      cells_[i].part = piece->second;
    }
  }
}

void CellBook::check_skin(const deck::Record& record, const deck::HypothesisCard& card) {
  if (!is_skin(card)) {
    for (const char* keyword : {"TENSION", "WRINKLING", "SLACK"})
      if (record.given(keyword))
        diagnostics_.error(record.where(keyword), fmt::format("{} is of membranes in space", keyword),
                           ".HYP MEMBRANE, without BIDIM");
    return;
  }
  if (card.slack && !card.wrinkling)
    diagnostics_.error(record.where("SLACK"), "SLACK without WRINKLING", "WRINKLING, which leaves this part of the stiffness");
  if (card.wrinkling && card.tension < 0)
    diagnostics_.error(record.where("TENSION"), "a skin that wrinkles cannot be pressed in its reference configuration",
                       "TENSION of 0 or more");
  if (linear_)
    diagnostics_.error(record.location, "membranes have displacements of any size, and this analysis small ones",
                       ".SAM TYPE STATIC without DISPLACEMENTS SMALL, and .SUB");
  if (lumped_) diagnostics_.error(record.location, "membranes have consistent masses only", "leave MASS LUMPED out of .SAM");
}

void CellBook::read_rotations(const BuildContext& context) {
  const deck::AnalysisCard* analysis = deck::last_analysis(*context.records);
  for (const deck::Record& record : *context.records) {
    const auto* card = record.get<deck::RotationCard>();
    if (!card) continue;
    if (analysis && !analysis->type.is("STATIC"))
      diagnostics_.error(record.location, "ROT is a load of statics: what moves in axes that turn has Coriolis forces too",
                         "TYPE STATIC in .SAM, or let the body itself turn");
    bool has_skins = false;
    auto rotation = std::make_shared<CellRotation>();
    rotation->record = &record;
    rotation->speed = card->speed;
    rotation->axis = Vec3(card->axis.data()).stableNormalized();
    rotation->point = Vec3(card->point.data());
    if (card->function != 0)
      if (const auto found = context.functions.find(card->function); found != context.functions.end())
        rotation->function = found->second.get();
    for (const std::size_t i : members(record, card->groups)) {
      cells_[i].rotation = rotation;
      if (skin_card(cells_[i].hypothesis)) has_skins = true;
    }
    if (has_skins) diagnostics_.error(record.location, "ROT on membranes is not in this version", "leave them out of its groups");
  }
}

void CellBook::assign(const deck::Record& record, const deck::AssignmentCard& assignment) {
  std::vector<std::size_t> group = members(record, assignment.groups, !assignment.cells.empty());
  for (const int id : assignment.cells)
    if (const std::size_t at = index(id); at < cells_.size())
      group.push_back(at);
    else
      diagnostics_.missing(".MAI", record.where("I"), fmt::format("cell {} does not exist", id));
  const deck::Record* material = nullptr;
  if (assignment.material) {
    const auto found = materials_.find(*assignment.material);
    if (found == materials_.end())
      diagnostics_.missing(".MAT", record.where("MAT"), fmt::format("material {} does not exist", *assignment.material),
                           fmt::format("declare it with .MAT I {}", *assignment.material));
    // a placeholder for an unknown material avoids further errors about missing materials
    material = found == materials_.end() ? &record : found->second;
  }
  for (const std::size_t i : group) {
    Cell& cell = cells_[i];
    if (material) cell.material = material;
    if (assignment.profile) cell.profile = *assignment.profile;
    if (assignment.axis_2) cell.axis_2 = Vec3(assignment.axis_2->data());
    if (!assignment.theta && !assignment.frame) continue;
    if (assignment.theta) cell.theta = *assignment.theta;
    if (assignment.frame) cell.frame = *assignment.frame;
    cell.axes = &record;
  }
}

template <class Lacks>
void CellBook::report_lack(const Lacks& lacks, const std::string& what, const std::string& cure, std::string_view given_by) {
  if (unknown_groups_in_.contains(given_by)) return;  // it may be what that group was to have
  const Cell* first = nullptr;
  std::size_t count = 0;
  for (const Cell& cell : cells_) {
    if (!lacks(cell)) continue;
    if (!first) first = &cell;
    ++count;
  }
  const std::string others = count > 1 ? fmt::format(" (the first of {})", count) : "";
  if (count == 0) return;
  const std::string text = fmt::format("cell {} {}{}", first->record->id, what, others);
  if (given_by.empty())
    diagnostics_.error(first->record->location, text, cure);
  else
    diagnostics_.missing(given_by, first->record->location, text, cure);
}

void CellBook::refuse_cold(const Temperatures& temperatures) {
  const auto is_warm = [&](int node) { return temperatures.contains(std::abs(node)); };
  // without the function of time
  const auto vanishes = [&](const Cell& cell) {
    if (!cell.section || !cell.section->law.neo_hookean) return false;
    const double expansion = cell.section->law.expansion[0];
    const std::vector<int>& nodes = cell.record->get<CellData>()->nodes;
    return std::any_of(nodes.begin(), nodes.end(),
                       [&](int node) { return is_warm(node) && expansion * temperatures.at(std::abs(node)).rise <= -1; });
  };
  report_lack(vanishes, "shrinks to nothing: its temperature rise times A is -1 or less",
              "A of its .MAT is per degree, such as 2E-4 for rubber");
}

bool CellBook::has_curved_axes(const Cell& cell) const {
  return frames_.is_curved(cell.frame) && cell.material->get<deck::MaterialCard>()->young.size() != 1;
}

bool CellBook::is_plane(const Cell& cell, const Vec3& middle, const NodePositions& nodes) {
  const auto found = elastic_.find({cell.material->id, cell.section->hypothesis});
  const auto is_plane_at = [&](const Vec3& place) {
    const Mat3 axes = axes_at(frames_, cell.frame, cell.theta.value_or(0), place);
    return materials::is_plane(materials::turned(*found->second, axes));
  };
  bool plane = is_plane_at(middle);
  // not at the corners themselves: there may be no axes at one of them
  if (cell.section->curved)
    for (const Vec3& corner : corners_of(*cell.record, nodes)) plane = plane && is_plane_at((middle + corner) / 2);
  if (!plane && unsuitable_.insert(cell.material->id).second)
    diagnostics_.error(cell.axes->where("FRAME"), fmt::format("the axes of material {} lead out of the plane", cell.material->id),
                       "of a plane cell one axis of the material is z");
  return plane;
}

std::shared_ptr<const CellSection> CellBook::make_section(const Cell& cell, Hypothesis hypothesis, const Vec3& middle,
                                                          int number) {
  if (cell.frame != 0 && !frames_.axes_at(cell.frame, middle)) {
    diagnostics_.missing(".FRAME", cell.axes->where("FRAME"), fmt::format("frame {} does not exist", cell.frame),
                         fmt::format("declare it with .FRAME I {}", cell.frame));
    return nullptr;
  }
  const auto [entry, fresh] = elastic_.try_emplace({cell.material->id, hypothesis});
  if (fresh) entry->second = elastic_of(*cell.material, hypothesis, diagnostics_);
  if (!entry->second) return nullptr;
  const deck::HypothesisCard* skin = skin_card(cell.hypothesis);
  if (skin && cell.material->get<deck::MaterialCard>()->young.size() != 1) {
    if (unsuitable_.insert(cell.material->id).second)
      diagnostics_.error(cell.material->where("YT"),
                         fmt::format("material {} has axes, which membranes have not", cell.material->id),
                         "one value of YT and one of NT");
    return nullptr;
  }
  if (skin && entry->second->damping > 0) {
    if (unsuitable_.insert(cell.material->id).second)
      diagnostics_.error(cell.material->where("DAMPING"),
                         fmt::format("material {} has DAMPING, and membranes have none", cell.material->id),
                         "a .MAT without DAMPING for the cells that are membranes");
    return nullptr;
  }
  const double theta = cell.theta.value_or(0);
  const materials::Elastic& material = *entry->second;
  materials::Elasticity law =
      materials::law_of(hypothesis, materials::turned(material, axes_at(frames_, cell.frame, theta, middle)));
  if (linear_) law.neo_hookean.reset();  // small displacements use its tangent at rest, `stiffness`
  const bool has_thickness = hypothesis == Hypothesis::plane_stress || hypothesis == Hypothesis::plane_strain;
  auto section = std::make_shared<CellSection>(
      CellSection{hypothesis, law, has_thickness && cell.thickness > 0 ? cell.thickness : 1.0, linear_, number, lumped_});
  if (skin) section->skin = SkinOptions{skin->tension, skin->wrinkling, skin->slack};
  if (!skin && has_curved_axes(cell)) {
    const auto axes = [frames = frames_, frame = cell.frame, theta](const Vec3& place) {
      return axes_at(frames, frame, theta, place);
    };
    section->curved = CurvedLaw{hypothesis, material, axes, middle[2]};
  }
  return section;
}

void CellBook::make_sections(const NodePositions& nodes) {
  const auto is_solid_cell = [](const Cell& cell) {
    const std::vector<int>& written = cell.record->get<CellData>()->nodes;
    return std::find(written.begin(), written.end(), 0) != written.end();
  };
  const auto hypothesis = [&](const Cell& cell) {
    if (!cell.hypothesis && is_solid_cell(cell)) return std::optional(Hypothesis::solid);
    return cell.hypothesis ? hypothesis_of(*cell.hypothesis->get<deck::HypothesisCard>()) : std::nullopt;
  };
  const auto fits = [&](const Cell& cell) {
    const auto found = hypothesis(cell);
    if (!found) return !cell.hypothesis || !is_beam_card(*cell.hypothesis->get<deck::HypothesisCard>());
    return (*found == Hypothesis::solid) == is_solid_cell(cell);
  };
  const auto is_stress = [&](const Cell& cell) {
    return hypothesis(cell) == Hypothesis::plane_stress && fits(cell) && !is_beam(cell);
  };
  report_lack([&](const Cell& cell) { return !cell.hypothesis && !is_solid_cell(cell) && !is_beam(cell); }, "has no formulation",
              ".HYP MEMB BIDIM GROUP \"name\" (plane stress), DEFO PLAN (plane strain) or AXIS", ".HYP");
  report_lack([&](const Cell& cell) { return !is_beam(cell) && !fits(cell); }, "does not fit its formulation",
              "VOLUME is for solids, whose nodes hold a 0 (N 1 2 3 0 4); BEAM for two nodes, or three; others for plane cells");
  report_lack([](const Cell& cell) { return !is_beam(cell) && !cell.material; }, "has no material", ".AEL I 1 J 9 K 1 MAT 1",
              ".AEL");
  report_lack([&](const Cell& cell) { return is_stress(cell) && cell.thickness == 0; }, "has no thickness",
              "plane stress needs .PHP GROUP \"name\" THICK VAL t", ".PHP");
  using Key = std::tuple<Hypothesis, int, double, double, int, const deck::Record*, int, double>;
  std::map<Key, std::shared_ptr<const CellSection>> sections;
  std::map<Key, int> numbers;
  for (Cell& cell : cells_) {
    const auto formulation = hypothesis(cell);
    const bool has_material = cell.material && cell.material->get<deck::MaterialCard>();
    if (is_beam(cell) || !formulation || !fits(cell) || !has_material || (is_stress(cell) && cell.thickness == 0)) continue;
    const deck::Record* skin = skin_card(cell.hypothesis) ? cell.hypothesis : nullptr;
    const bool is_flat = *formulation != Hypothesis::solid && !skin;
    const Vec3 middle = middle_of(*cell.record, nodes);
    // curved axes depend on the height of a plane cell
    const double height = is_flat && has_curved_axes(cell) ? middle[2] : 0;
    const Key key{*formulation, cell.material->id, cell.thickness, cell.theta.value_or(0), cell.frame, skin, cell.part, height};
    Key group = key;
    std::get<7>(group) = 0;
    // isotropic: axes, which decks may give cell by cell, do not matter
    if (cell.material->get<deck::MaterialCard>()->young.size() == 1) {
      std::get<3>(group) = 0;
      std::get<4>(group) = 0;
    }
    const int number = numbers.try_emplace(group, static_cast<int>(numbers.size())).first->second;
    const auto [known, fresh] = sections.try_emplace(key);
    if (fresh) known->second = make_section(cell, *formulation, middle, number);
    cell.section = known->second;
    if (is_flat && cell.section && (fresh || cell.section->curved) && !is_plane(cell, middle, nodes))
      cell.section = known->second = nullptr;
  }
}

/// Reports missing properties of beams, and properties that have no meaning for a cell.
void CellBook::check_beams() {
  const auto formulated = [](const Cell& cell) {
    return cell.hypothesis && is_beam_card(*cell.hypothesis->get<deck::HypothesisCard>());
  };
  report_lack([&](const Cell& cell) { return is_beam(cell) && !formulated(cell); }, "of two corners is no BEAM",
              ".HYP BEAM GROUP \"name\"");
  report_lack([&](const Cell& cell) { return is_beam(cell) && formulated(cell) && cell.profile == 0; }, "has no section",
              ".AEL GROUP \"name\" MAT 1 BPR 2 AXIS2 0 0 1");
  report_lack([](const Cell& cell) { return is_beam(cell) && (cell.theta || cell.frame != 0); },
              "is a beam, and has THETA or FRAME", "AXIS2 x y z is where axis 2 of its section points");
  report_lack([](const Cell& cell) { return is_beam(cell) && cell.thickness > 0; }, "is a beam, and has a THICK",
              "BPR is the number of its section");
  report_lack([](const Cell& cell) { return is_beam(cell) && cell.rotation; }, "is a beam, and has ROT",
              "a beam of .MCE on nodes that turn");
  report_lack([](const Cell& cell) { return !is_beam(cell) && (cell.profile != 0 || cell.axis_2); },
              "is no beam, and has BPR or AXIS2", "these are for cells of two nodes, or three, with .HYP BEAM");
}

void CellBook::check_weight(const std::vector<deck::Record>& records) {
  const auto weighs = [this](Hypothesis hypothesis) {
    return std::any_of(cells_.begin(), cells_.end(), [hypothesis](const Cell& cell) {
      return cell.section && !cell.section->skin && cell.section->hypothesis == hypothesis && cell.section->law.density > 0;
    });
  };
  for (const deck::Record& record : records) {
    const auto* card = record.get<deck::GravityCard>();
    if (!card) continue;
    const auto& g = card->acceleration;
    const double rounding = 1e-9 * std::hypot(g[0], g[1], g[2]);  // of directions that expressions give
    const auto acts = [&](std::size_t axis) { return std::abs(g[axis]) > rounding; };
    if ((acts(0) || acts(2)) && weighs(Hypothesis::axisymmetric))
      diagnostics_.error(record.where("ACC"), "the weight of axisymmetric cells acts along their axis, and ACC leads across it",
                         "ACC 0 g 0: the axis is y");
    if (acts(2) && (weighs(Hypothesis::plane_stress) || weighs(Hypothesis::plane_strain)))
      diagnostics_.warning(record.where("ACC"),
                           "plane cells do not move along z: this component of gravity has no effect on them",
                           "they lie in the plane of x and y");
  }
}

void CellBook::look_at_axes() {
  const Cell* first = nullptr;
  std::size_t count = 0;
  for (const Cell& cell : cells_) {
    const bool turned = cell.theta.value_or(0) != 0 || cell.frame != 0;
    if (!turned || !cell.section || cell.material->get<deck::MaterialCard>()->young.size() != 1) continue;
    if (!first) first = &cell;
    ++count;
  }
  if (!first) return;
  const char* keyword = first->axes->given("THETA") ? "THETA" : "FRAME";
  diagnostics_.warning(first->axes->where(keyword),
                       fmt::format("the material of cell {}{} is isotropic: {} has no effect", first->record->id,
                                   count > 1 ? fmt::format(" (the first of {})", count) : "", keyword));
}

}  // namespace engrane::elements::structural

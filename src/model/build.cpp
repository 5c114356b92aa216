// SPDX-License-Identifier: BSD-3-Clause
// Builds a Model from the records of a deck.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <set>
#include <unordered_map>
#include <utility>

#include "deck/cards/initial_motion.hpp"
#include "deck/cards/mesh_cards.hpp"
#include "math/angle.hpp"
#include "model/archive.hpp"
#include "model/coordinate_channels.hpp"
#include "model/frames.hpp"
#include "model/groups.hpp"
#include "model/linear_statics.hpp"
#include "model/model.hpp"
#include "model/node_components.hpp"
#include "model/node_load.hpp"
#include "model/short_form.hpp"
#include "model/solver_options.hpp"
#include "model/user_function.hpp"

namespace engrane {

namespace {

/// Holds the data shared by the passes over the records.
class Builder {
 public:
  Builder(const deck::Deck& deck, const std::vector<ElementType>& types, const WrittenOut& short_forms, Diagnostics& diagnostics)
      : deck_(short_forms.deck ? *short_forms.deck : deck),
        types_(types),
        diagnostics_(diagnostics),
        fixed_(short_forms.named),
        made_nodes_(short_forms.made),
        groups_(nodes_, diagnostics) {}

  Model build() {
    for (const deck::Record& record : deck_.records) {
      if (const auto* card = record.get<deck::FrameCard>()) frames_.add(record, *card, diagnostics_);
      if (const auto* card = record.get<deck::SteppingCard>()) stepping_ = card;
      if (const ElementType* type = type_of(record)) elements_.push_back({&record, type});
      has_mesh_ = has_mesh_ || record.schema->name == cell_card;
      names_material_ = names_material_ || (record.schema->command() == ".MCE" && record.given("MAT"));
    }
    // linear statics: only the equilibrium at the end, in one step
    if (has_mesh_ && !deck::says_analysis(deck_.records)) {
      deck::SteppingCard& stepping = model_.commands.stepping;
      stepping.start = stepping.step = stepping.end;
    }
    add_nodes();
    for (const deck::Record& record : deck_.records)
      if (record.get<deck::FunctionCard>()) add_function(record);
    for (const ElementRecord& element : elements_) place_node(element);
    for (const deck::Record& record : deck_.records) add_command(record);
    warm_made_nodes();
    tell_codes(deck_.records, diagnostics_);
    settle_tolerance(deck_, model_.commands, diagnostics_);
    if (has_mesh_) model_.commands.analysis.displacements.tag = deck::has_small_displacements(deck_.records) ? "SMALL" : "LARGE";
    others_are_asked_for_ =
        std::any_of(elements_.begin(), elements_.end(), [](const ElementRecord& e) { return e.type->stage == 1; });
    model_.parts.reserve(elements_.size() + loads_.size());
    const auto is_numbered = [](const ElementRecord& element) { return element.record->id != 0; };
    for (int stage = 0; stage < 2; ++stage)
      for (const ElementRecord& element : elements_)
        if (element.type->stage == stage && is_numbered(element)) add_element(element, element.record->id);
    std::stable_sort(model_.parts.begin(), model_.parts.end(),
                     [](const Model::Part& a, const Model::Part& b) { return a.element->id() < b.element->id(); });
    int number = model_.parts.empty() ? 0 : model_.parts.back().element->id();
    for (const ElementRecord& element : elements_)
      if (!is_numbered(element)) number += add_element(element, number + 1);
    for (const deck::Record* record : initial_elements_) add_initial_coordinate(*record);
    add_loads();
    model_.nodes = nodes_.release();
    for (Model::Part& part : model_.parts)
      for (const int id : part.element->node_ids()) part.nodes.push_back(model_.node_index(id));
    check_supports(model_, support_locations_, diagnostics_);
    check_nodal_loads(model_, diagnostics_);
    check_stops(model_, diagnostics_);
    check_initial_values(model_, initial_locations_, diagnostics_);
    model_.measure();
    settle_plane();
    return std::move(model_);
  }

 private:
  /// An element of the deck and its type.
  struct ElementRecord {
    const deck::Record* record;
    const ElementType* type;
  };

  /// Element type of a record; nullptr if it belongs to another card.
  const ElementType* type_of(const deck::Record& record) {
    const auto [entry, fresh] = types_by_schema_.try_emplace(record.schema, nullptr);
    if (fresh) {
      const auto same = [&](const ElementType& type) { return type.schema.name == record.schema->name; };
      if (const auto type = std::find_if(types_.begin(), types_.end(), same); type != types_.end()) entry->second = &*type;
    }
    return entry->second;
  }

  void add_nodes() {
    std::size_t count = 1;
    for (const deck::Record& record : deck_.records) count += record.get<deck::NodeCard>() != nullptr;
    std::vector<NodePositions::Node> nodes;
    nodes.reserve(count);
    nodes.push_back({0, Vec3::Zero()});
    for (const deck::Record& record : deck_.records)
      if (const auto* card = record.get<deck::NodeCard>()) {
        if (record.id > 0)
          nodes.push_back({record.id, frames_.to_global(record, *card, diagnostics_)});
        else
          diagnostics_.error(record.location, fmt::format("node number {}: numbers start at 1", record.id),
                             "node 0 is the ground and need not be declared");
      }
    nodes_ = NodePositions(std::move(nodes));
  }

  void add_function(const deck::Record& record) {
    FunctionSetting setting;
    if (const int file = record.location.file; file >= 0 && file < static_cast<int>(deck_.folders.size()))
      setting.folder = deck_.folders[static_cast<std::size_t>(file)];
    if (stepping_) {
      setting.start = stepping_->start;
      setting.end = stepping_->end;
      setting.step = stepping_->step;
    }
    if (auto function = make_function(record, diagnostics_, setting))
      model_.functions[record.id] = std::move(function);
    else
      model_.functions[record.id] = nullptr;  // known but faulty: records that use it are not in error
  }

  void add_command(const deck::Record& record) {
    if (const auto* title = record.get<deck::TitleCard>()) model_.title = title->text;
    if (const auto* unit = record.get<deck::UnitCard>()) model_.units = {true, unit->length, unit->mass, unit->time};
    if (const auto* group = record.get<deck::GroupCard>()) groups_.add(record, *group);
    if (const auto* analysis = record.get<deck::AnalysisCard>()) model_.commands.analysis = *analysis;
    if (const auto* stepping = record.get<deck::SteppingCard>()) set_stepping(record, *stepping);
    if (const auto* path = record.get<deck::PathCard>()) model_.commands.path = *path;
    if (const auto* buckling = record.get<deck::BucklingCard>()) model_.commands.buckling = *buckling;
    if (const auto* archive = record.get<deck::ArchiveCard>()) add_archive(record, *archive);
    // a record in error may be the one that refers to it
    if (!has_mesh_ && !diagnostics_.has_errors())
      if (const char* what = record.get<deck::MaterialCard>() && !names_material_ ? "material"
                             : record.get<deck::HypothesisCard>()                 ? "formulation"
                             : record.get<deck::PropertyCard>()                   ? "property"
                             : record.get<deck::AssignmentCard>()                 ? "assignment"
                             : record.get<deck::RotationCard>()                   ? "rotation"
                                                                                  : nullptr)
        diagnostics_.warning_once(what, record.location,
                                  fmt::format("the deck has no cells (.MAI): this {} has no effect", what));
    if (const auto* check = record.get<deck::CheckCard>()) model_.commands.checks.push_back(*check);
    if (const auto* fix = record.get<deck::FixCard>()) add_supports(record, *fix, fix->components, {}, 0);
    if (const auto* dep = record.get<deck::DisplacementCard>())
      add_supports(record, *dep, dep->components, dep->values, dep->function);
    if (const auto* load = record.get<deck::LoadCard>()) add_load(record, *load);
    if (const auto* temperature = record.get<deck::TemperatureCard>()) add_temperature(record, *temperature);
    if (const auto* gravity = record.get<deck::GravityCard>()) {
      const auto& g = gravity->acceleration;
      model_.gravity.push_back({Vec3(g[0], g[1], g[2]), function(record, gravity->function)});
    }
    if (const auto* initial = record.get<deck::InitialMotionCard>()) {
      if (initial->element)
        initial_elements_.push_back(&record);  // after all elements are built
      else
        add_initial(record, *initial);
    }
  }

  /// Merges a record of `.SAI`, and adds the members of its groups to the archived nodes and elements.
  void add_archive(const deck::Record& record, const deck::ArchiveCard& card) {
    deck::ArchiveCard& archive = model_.commands.archive;
    engrane::add_archive(archive, record, diagnostics_);
    deck::NodeTarget nodes{card.nodes, {}};
    for (const std::string& name : card.groups) {
      bool of_elements = false, all = false;
      for (const deck::Record& other : deck_.records)
        if (const auto* group = other.get<deck::GroupCard>(); group && group->kind.is("ELEMENTS") && group->is_called(name)) {
          of_elements = true;
          all = all || group->all;
          archive.elements.insert(archive.elements.end(), group->ids.begin(), group->ids.end());
        }
      if (!of_elements) nodes.groups.push_back(name);
      for (const deck::Record& other : deck_.records)
        if (all && other.schema->command() == ".MCE") archive.elements.push_back(other.id);
    }
    const std::vector<int> found = groups_.resolve(record, nodes);
    archive.nodes.insert(archive.nodes.end(), found.begin(), found.end());
  }

  void set_stepping(const deck::Record& record, const deck::SteppingCard& card) {
    if (card.end <= card.start)
      diagnostics_.error(record.where("TF"), fmt::format("the end TF = {} is not after the start TI = {}", card.end, card.start));
    model_.commands.stepping = card;
  }

  /// The function of an NF keyword. nullptr for 0 (constant) and, with an error, for one that does not exist.
  const Function* function(const deck::Record& record, int id) {
    if (id == 0) return nullptr;
    if (const auto it = model_.functions.find(id); it != model_.functions.end()) {
      if (!is_function_of_one_variable(it->second.get(), record.where("NF"), diagnostics_)) return nullptr;
      model_.of_time.insert(it->second.get());
      return it->second.get();
    }
    diagnostics_.missing(".FCT", record.where("NF"), fmt::format("function {} does not exist", id),
                         fmt::format("declare it with .FCT I {}", id));
    return nullptr;
  }

  /// Checks that components are 1 to 6 and that there is one value for all or one for each. Returns one value per component;
  /// with `degrees`, rotations are converted from degrees to radians.
  std::vector<double> values_of(const deck::Record& record, const std::vector<int>& components, const std::vector<double>& values,
                                bool degrees) {
    for (const int c : components)
      if (c < 1 || c > 6)
        diagnostics_.error(record.where("C"), fmt::format("component {}: components are 1 to 6", c),
                           "1 2 3 are translations along, 4 5 6 rotations about x y z");
    std::vector<double> out(components.size(), values.empty() ? 0.0 : values.front());
    if (values.size() == components.size())
      out = values;
    else if (values.size() > 1)
      diagnostics_.error(record.where("V"), fmt::format("{} values for {} components", values.size(), components.size()),
                         "give one value for all components, or one for each");
    for (std::size_t i = 0; degrees && i < out.size(); ++i)
      if (components[i] > 3) out[i] *= degree;
    return out;
  }

  void add_supports(const deck::Record& record, const deck::NodeTarget& target, const std::vector<int>& components,
                    const std::vector<double>& values, int function_id) {
    const auto each = values_of(record, components, values, true);
    const Function* f = function(record, function_id);
    if (support_of_.empty()) support_of_.assign(nodes_.by_number().size(), {none, none, none, none, none, none});
    for (const int id : groups_.resolve(record, target))
      for (std::size_t i = 0; i < components.size(); ++i) {
        if (components[i] < 1 || components[i] > 6) continue;  // reported by values_of()
        const Support support{nodes_.index(id), components[i] - 1, each[i], f};
        int& index = support_of_[static_cast<std::size_t>(support.node)][static_cast<std::size_t>(support.component)];
        if (index == none) {
          index = static_cast<int>(model_.supports.size());
          model_.supports.push_back(support);
          support_locations_.push_back(record.location);
        } else if (const Support& old = model_.supports[static_cast<std::size_t>(index)];
                   old.value != support.value || old.function != support.function) {
          diagnostics_.error(record.location,
                             fmt::format("component {} of node {} is already prescribed otherwise", components[i], id));
        }
      }
  }

  /// Makes the model plane if `.SAM PLANE` requests it. So is one in statics unless PLANE NO is given, if springs and the like at
  /// plane cells would otherwise leave motions along z that nothing resists.
  void settle_plane() {
    constexpr std::size_t most_faults = 8;
    const deck::Tagged& wish = model_.commands.analysis.plane;
    if (diagnostics_.has_errors()) return;
    if (wish.is("NO")) {
      const bool given = std::any_of(deck_.records.begin(), deck_.records.end(), [](const deck::Record& record) {
        return record.get<deck::AnalysisCard>() && record.given("PLANE");
      });
      if (!given && model_.commands.analysis.type.is("STATIC") && asks_plane_cells_for_z(model_))
        examine_plane(model_, 2, 1, model_.plane);
      return;
    }
    if (wish.is("AUTO")) {
      model_.plane = find_plane(model_);
      return;
    }
    const int normal = wish.is("XY") ? 2 : wish.is("YZ") ? 0 : 1;
    const auto analysis = std::find_if(deck_.records.begin(), deck_.records.end(),
                                       [](const deck::Record& record) { return record.get<deck::AnalysisCard>(); });
    for (const PlaneFault& fault : examine_plane(model_, normal, most_faults, model_.plane))
      diagnostics_.error(fault.location.known() ? fault.location : analysis->where("PLANE"), fault.what, fault.hint);
  }

  void add_load(const deck::Record& record, const deck::LoadCard& card) {
    const auto each = values_of(record, card.components, card.values, false);
    const Function* f = function(record, card.function);
    for (const int id : groups_.resolve(record, card)) {
      Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
      for (std::size_t i = 0; i < card.components.size(); ++i) {
        const int c = card.components[i];
        if (c < 1 || c > 6) continue;
        (c <= 3 ? force : moment)[(c - 1) % 3] += each[i];
      }
      if (!force.isZero(0) || !moment.isZero(0)) loads_.push_back({id, force, moment, f, &record});
    }
  }

  void add_temperature(const deck::Record& record, const deck::TemperatureCard& card) {
    const Function* f = function(record, card.function);
    for (const int id : groups_.resolve(record, card)) temperatures_[id] = {card.rise, f};
    if (!has_mesh_ && !names_material_)
      diagnostics_.warning_once("TEMP", record.location,
                                "no element of the deck has a material that could expand: temperatures have no effect");
  }

  /// Interpolates the temperatures of nodes that short forms have made.
  void warm_made_nodes() {
    for (const MadeNode& node : made_nodes_) {
      const auto warmth = [this](int id) {
        const auto found = temperatures_.find(id);
        return found == temperatures_.end() ? Warmth{} : found->second;
      };
      const Warmth first = warmth(node.between[0]), second = warmth(node.between[1]);
      if (first.rise == 0 && second.rise == 0) continue;
      if (first.rise != 0 && second.rise != 0 && first.function != second.function)
        diagnostics_.error(
            node.location,
            fmt::format("the temperatures of nodes {} and {} follow different functions, and between them it has a "
                        "node of its own",
                        node.between[0], node.between[1]),
            "the same NF for both, or BEAMs with nodes of the deck");
      temperatures_[node.id] = {first.rise + node.part * (second.rise - first.rise),
                                first.rise != 0 ? first.function : second.function};
    }
  }

  void add_loads() {
    int id = 0;
    for (const Model::Part& part : model_.parts) id = std::max(id, part.element->id());
    const bool linear = is_linear_statics(model_);
    for (const Load& load : loads_)
      model_.parts.push_back(
          {make_node_load(++id, load.node, nodes_.at(load.node), load.force, load.moment, load.function, linear),
           "CHA",
           load.record,
           load.record->location,
           {}});
  }

  void add_initial(const deck::Record& record, const deck::InitialMotionCard& card) {
    const bool velocity = card.kind.is("VELOCITY");
    if (card.axis) {
      add_initial_spin(record, card);
      return;
    }
    const auto each = values_of(record, card.components, card.values, !velocity);
    for (const int id : groups_.resolve(record, card))
      for (std::size_t i = 0; i < card.components.size(); ++i)
        add_initial_value(record, {nodes_.index(id), card.components[i] - 1, each[i], velocity, card.imposed});
  }

  void add_initial_value(const deck::Record& record, const InitialValue& value) {
    model_.initial.push_back(value);
    initial_locations_.push_back(record.location);
  }

  void add_initial_spin(const deck::Record& record, const deck::InitialMotionCard& card) {
    Vec3 axis((*card.axis)[0], (*card.axis)[1], (*card.axis)[2]);
    const double largest = axis.cwiseAbs().maxCoeff();
    if (!(largest > 0)) {
      diagnostics_.error(record.where("AXIS"), "AXIS 0 0 0 is not a direction", "give three components, not all zero");
      return;
    }
    axis = (axis / largest).normalized();
    const Vec3 point = card.at ? Vec3((*card.at)[0], (*card.at)[1], (*card.at)[2]) : Vec3(Vec3::Zero());
    for (const int id : groups_.resolve(record, card)) {
      model_.initial_spins.push_back({nodes_.index(id), axis * card.values.front(), point});
      for (int c = 0; card.imposed && c < 6; ++c) add_initial_value(record, {nodes_.index(id), c, 0, true, true});
    }
  }

  void add_initial_coordinate(const deck::Record& record) {
    const auto& card = *record.get<deck::InitialMotionCard>();
    const int id = *card.element;
    const BuildContext::Found* found = find_in_mechanism(id);
    if (!found) {
      diagnostics_.missing(".MCE", record.where("ELEMENT"), fmt::format("element {} does not exist", id),
                           "name a joint or a SENSOR of .MCE by its number");
      return;
    }
    const auto part =
        std::find_if(model_.parts.begin(), model_.parts.end(), [id](const Model::Part& p) { return p.element->id() == id; });
    if (part == model_.parts.end()) return;  // its own faults have been reported
    const auto* owner = dynamic_cast<const CoordinateChannels*>(part->element.get());
    const int count = owner ? owner->coordinate_count() : 0;
    if (count == 0) {
      diagnostics_.error(record.where("ELEMENT"), fmt::format("{} {} has no coordinate", part->type, id),
                         "name a joint with a free coordinate, such as HINGE or PRISMATIC, or a SENSOR");
      return;
    }
    const std::vector<Channel>& channels = part->element->channels();
    int channel = 0;
    std::string names;
    for (; channel < 2 * count; channel += 2) {
      const std::string& name = channels[static_cast<std::size_t>(channel)].name;
      if (card.coordinate.empty() || name == card.coordinate) break;
      names += (names.empty() ? "" : ", ") + name;
    }
    if (channel == 2 * count) {
      diagnostics_.error(record.where("COORDINATE"), fmt::format("{} {} has no coordinate {}", part->type, id, card.coordinate),
                         "it has " + names);
      return;
    }
    const bool velocity = card.kind.is("VELOCITY");
    const deck::AnalysisCard& analysis = model_.commands.analysis;
    if (!velocity && (analysis.type.is("STATIC") || analysis.start.is("STATIC")))
      diagnostics_.warning(record.location,
                           fmt::format("the search for equilibrium only begins at this value of {} {}", part->type, id),
                           "a DRIVE in the joint holds it there");
    const bool degrees = !velocity && channels[static_cast<std::size_t>(channel)].dimension == dimension::angle;
    model_.initial_coordinates.push_back({static_cast<int>(part - model_.parts.begin()), channel,
                                          card.values.front() * (degrees ? degree : 1), velocity, record.location});
  }

  /// Returns the number of elements built from the record.
  int add_element(const ElementRecord& element, int number) {
    const deck::Record& record = *element.record;
    if (!has_nodes_named(record, nodes_, diagnostics_)) return 0;
    const std::string& name = element.type->schema.name;
    const bool command = name.front() == '.';
    if (command && taken(number, record)) return 0;
    BuildContext context = context_of(record, diagnostics_);
    context.number = number;
    std::vector<std::unique_ptr<Element>> more;
    context.more = &more;
    context.nodes_of = [this, &record](const deck::NodeTarget& target) { return groups_.resolve(record, target); };
    auto built = element.type->build(context);
    if (BuildContext::Found* one = element.type->stage == 0 && others_are_asked_for_ ? find_in_mechanism(record.id) : nullptr) {
      one->element = built.get();
      one->faulty = !built;
    }
    if (!built) return 0;
    const std::string_view key = element.type->schema.key();
    const std::string type = key.empty() || !command ? name.substr(command ? 1 : 0) : std::string(key);
    model_.parts.push_back({std::move(built), type, &record, record.location, {}});
    for (std::unique_ptr<Element>& one : more) model_.parts.push_back({std::move(one), type, &record, record.location, {}});
    return static_cast<int>(1 + more.size());
  }

  BuildContext::Found* find_in_mechanism(int id) {
    if (!std::exchange(knows_mechanism_, true))
      for (const deck::Record& other : deck_.records)
        if (other.schema->command() == ".MCE") mechanism_.try_emplace(other.id, BuildContext::Found{&other});
    const auto found = mechanism_.find(id);
    return found == mechanism_.end() ? nullptr : &found->second;
  }

  /// Results name elements by their numbers, so those of .MCE and of commands such as .LIA must differ.
  bool taken(int number, const deck::Record& record) {
    const BuildContext::Found* found = find_in_mechanism(number);
    if (!found) return false;
    const deck::Record& other = *found->record;
    diagnostics_.error(record.location, fmt::format("number {} is that of {} {}", record.id, other.schema->name, other.id),
                       "results name elements by their numbers: give another");
    return true;
  }

  BuildContext context_of(const deck::Record& record, Diagnostics& diagnostics) {
    return {nodes_,
            model_.functions,
            diagnostics,
            record,
            [this](int node, const Vec3& axis) { return inertia_about(node, axis); },
            &deck_.records,
            [this](int id) {
              const BuildContext::Found* found = find_in_mechanism(id);
              return found ? *found : BuildContext::Found{};
            },
            &blocks_,
            &notes_,
            0,
            &model_.of_time,
            &temperatures_};
  }

  /// Lets an element position a node. Elements are processed in deck order.
  void place_node(const ElementRecord& element) {
    if (!element.type->place) return;
    const deck::Record& record = *element.record;
    Diagnostics unheard;  // reported again when the element is built
    if (!has_nodes_named(record, nodes_, unheard)) return;
    const auto placed = element.type->place(context_of(record, unheard));
    if (!placed) return;
    if (fixed_.count(placed->node) > 0) {
      diagnostics_.error(record.where("PLACE"), fmt::format("node {} is one of a SHAFT: it cannot be placed", placed->node),
                         "leave PLACE out, and say where the node is in .NOE");
      return;
    }
    const auto [old, fresh] = placed_by_.try_emplace(placed->node, &record);
    const Vec3& x = nodes_.at(placed->node);
    const double size = (placed->x - nodes_.at(placed->from)).norm();
    if (fresh) {
      if (const auto earlier = placed_from_.find(placed->node); earlier != placed_from_.end())
        for (const int node : earlier->second) {
          const deck::Record& other = *placed_by_.at(node);
          diagnostics_.error(record.where("PLACE"),
                             fmt::format("node {} moves only here, but {} {} has already placed node {} from it", placed->node,
                                         other.schema->name, other.id, node),
                             "write the elements of a chain in its order");
        }
      nodes_.move(placed->node, placed->x);
      placed_from_[placed->from].push_back(placed->node);
    } else if ((placed->x - x).norm() > 1e-6 * size) {
      diagnostics_.error(
          record.where("PLACE"),
          fmt::format("node {} is placed at ({:.10g}, {:.10g}, {:.10g}) here and at ({:.10g}, {:.10g}, {:.10g}) by {} {}",
                      placed->node, placed->x[0], placed->x[1], placed->x[2], x[0], x[1], x[2], old->second->schema->name,
                      old->second->id),
          "keep PLACE in one of them");
    }
  }

  /// Infinite if all rotations of the node are supported.
  double inertia_about(int node, const Vec3& axis) {
    if (!support_of_.empty()) {
      const auto held = support_of_[static_cast<std::size_t>(nodes_.index(node))].begin();
      if (std::count(held + 3, held + 6, none) == 0) return std::numeric_limits<double>::infinity();
    }
    for (; indexed_ < model_.parts.size(); ++indexed_)
      for (const int id : model_.parts[indexed_].element->layout().nodes) parts_at_[id].push_back(indexed_);
    double sum = 0;
    std::size_t last = model_.parts.size();
    for (const std::size_t part : parts_at_[node])  // an element that names the node twice counts once
      if (std::exchange(last, part) != part) sum += axis.dot(model_.parts[part].element->inertia_at(node) * axis);
    return sum;
  }

  struct Load {
    int node;
    Vec3 force, moment;
    const Function* function;
    const deck::Record* record;
  };

  static constexpr int none = -1;
  static constexpr const char* cell_card = ".MAI";

  const deck::Deck& deck_;
  const std::vector<ElementType>& types_;
  Diagnostics& diagnostics_;
  const std::set<int>& fixed_;  ///< nodes whose positions expanded short forms depend on
  const std::vector<MadeNode>& made_nodes_;
  NodePositions nodes_;
  std::unordered_map<const deck::Schema*, const ElementType*> types_by_schema_;
  std::vector<ElementRecord> elements_;                     ///< in the order of the deck
  std::unordered_map<int, BuildContext::Found> mechanism_;  ///< records of .MCE by number; filled on first use
  bool knows_mechanism_ = false;
  bool has_mesh_ = false;                                       ///< some record is a cell
  bool names_material_ = false;                                 ///< some element of .MCE refers to a .MAT
  bool others_are_asked_for_ = false;                           ///< some element is of stage 1
  std::unordered_map<int, const deck::Record*> placed_by_;      ///< element that positioned a node
  std::unordered_map<int, std::vector<int>> placed_from_;       ///< nodes positioned from a node, in deck order
  std::unordered_map<int, std::vector<std::size_t>> parts_at_;  ///< elements at a node, among the first `indexed_`
  std::size_t indexed_ = 0;
  const deck::SteppingCard* stepping_ = nullptr;  ///< the last
  BuildNotes notes_;
  Frames frames_;
  NodeGroups groups_;
  BlockStore blocks_;
  Temperatures temperatures_;
  std::vector<Load> loads_;
  std::vector<const deck::Record*> initial_elements_;            ///< of `.INI`, for coordinates of elements
  std::vector<std::array<int, 6>> support_of_;                   ///< by node and component: index of its support, or none
  std::vector<Location> support_locations_, initial_locations_;  ///< of Model::supports and Model::initial
  Model model_;
};

}  // namespace

Model build_model(const deck::Deck& deck, const std::vector<ElementType>& types, Diagnostics& diagnostics) {
  const WrittenOut short_forms = write_out(deck, types, diagnostics);
  Model model = Builder(deck, types, short_forms, diagnostics).build();
  model.written_out = short_forms.deck;
  return model;
}

}  // namespace engrane

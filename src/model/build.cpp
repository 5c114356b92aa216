// SPDX-License-Identifier: BSD-3-Clause
// From the records of a deck to a Model.
#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "model/frames.hpp"
#include "model/groups.hpp"
#include "model/model.hpp"
#include "model/node_load.hpp"
#include "model/user_function.hpp"

namespace engrane {

namespace {

/// Carries what the passes over the records share.
class Builder {
 public:
  Builder(const deck::Deck& deck, const std::vector<ElementType>& types, Diagnostics& diagnostics)
      : deck_(deck), types_(types), diagnostics_(diagnostics), groups_(positions_, diagnostics) {}

  Model build() {
    positions_[0] = Vec3::Zero();
    for (const deck::Record& record : deck_.records)
      if (const auto* card = record.get<deck::FrameCard>()) frames_.add(record, *card, diagnostics_);
    for (const deck::Record& record : deck_.records) {
      if (const auto* card = record.get<deck::NodeCard>()) add_node(record, *card);
      if (record.get<deck::FunctionCard>()) add_function(record);
    }
    for (const deck::Record& record : deck_.records) place_node(record);
    for (const auto& [id, x] : positions_) model_.nodes.push_back({id, x});
    for (const deck::Record& record : deck_.records) add_command(record);
    for (int stage = 0; stage < 2; ++stage)
      for (const deck::Record& record : deck_.records) add_element(record, stage);
    std::stable_sort(model_.parts.begin(), model_.parts.end(),
                     [](const Model::Part& a, const Model::Part& b) { return a.element->id() < b.element->id(); });
    add_loads();
    for (Model::Part& part : model_.parts)
      for (const int id : part.element->node_ids()) part.nodes.push_back(model_.node_index(id));
    check_rotation_supports();
    return std::move(model_);
  }

 private:
  void add_node(const deck::Record& record, const deck::NodeCard& card) {
    if (record.id <= 0) {
      diagnostics_.error(record.location, fmt::format("node number {}: numbers start at 1", record.id),
                         "node 0 is the ground and need not be declared");
      return;
    }
    positions_[record.id] = frames_.to_global(record, card, diagnostics_);
  }

  void add_function(const deck::Record& record) {
    FunctionSetting setting;
    if (const int file = record.location.file; file >= 0 && file < static_cast<int>(deck_.folders.size()))
      setting.folder = deck_.folders[static_cast<std::size_t>(file)];
    for (const deck::Record& other : deck_.records)
      if (const auto* stepping = other.get<deck::SteppingCard>()) {
        setting.start = stepping->start;
        setting.end = stepping->end;
        setting.step = stepping->step;
      }
    if (auto function = make_function(record, diagnostics_, setting))
      model_.functions[record.id] = std::move(function);
    else
      model_.functions[record.id] = nullptr;  // known but wrong: its users are not to blame
  }

  void add_command(const deck::Record& record) {
    if (const auto* title = record.get<deck::TitleCard>()) model_.title = title->text;
    if (const auto* unit = record.get<deck::UnitCard>()) model_.units = {true, unit->length, unit->mass, unit->time};
    if (const auto* group = record.get<deck::GroupCard>()) groups_.add(record, *group);
    if (const auto* analysis = record.get<deck::AnalysisCard>()) model_.commands.analysis = *analysis;
    if (const auto* stepping = record.get<deck::SteppingCard>()) set_stepping(record, *stepping);
    if (const auto* archive = record.get<deck::ArchiveCard>()) {
      model_.commands.archive = *archive;
      if (!archive->codes.empty())
        diagnostics_.warning(record.where("STYP"), "STYP selects nothing in this version: all fields and histories are archived");
    }
    if (record.get<deck::MaterialCard>())
      diagnostics_.warning(record.location, "no element of this version takes a material: this one has no effect");
    if (const auto* check = record.get<deck::CheckCard>()) {
      model_.commands.checks.push_back(*check);
      model_.commands.check_locations.push_back(record.location);
    }
    if (const auto* fix = record.get<deck::FixCard>()) add_supports(record, *fix, fix->components, {}, 0);
    if (const auto* dep = record.get<deck::DisplacementCard>())
      add_supports(record, *dep, dep->components, dep->values, dep->function);
    if (const auto* load = record.get<deck::LoadCard>()) add_load(record, *load);
    if (const auto* gravity = record.get<deck::GravityCard>()) {
      const auto& g = gravity->acceleration;
      model_.gravity.push_back({Vec3(g[0], g[1], g[2]), function(record, gravity->function)});
    }
    if (const auto* initial = record.get<deck::InitialCard>()) add_initial(record, *initial);
  }

  void set_stepping(const deck::Record& record, const deck::SteppingCard& card) {
    if (card.end <= card.start)
      diagnostics_.error(record.where("TF"), fmt::format("the end TF = {} is not after the start TI = {}", card.end, card.start));
    model_.commands.stepping = card;
  }

  /// The function of an NF keyword; nullptr for 0 (constant) and, with an error, for one that does not exist.
  const Function* function(const deck::Record& record, int id) {
    if (id == 0) return nullptr;
    const auto it = model_.functions.find(id);
    if (it != model_.functions.end())
      return is_function_of_one_variable(it->second.get(), record.where("NF"), diagnostics_) ? it->second.get() : nullptr;
    diagnostics_.error(record.where("NF"), fmt::format("function {} does not exist", id),
                       fmt::format("declare it with .FCT I {}", id));
    return nullptr;
  }

  /// Checks that components are 1 to 6 and that there is one value for all or one for each; returns the values, one
  /// per component, rotations turned from degrees to radians when `degrees`.
  std::vector<double> values_of(const deck::Record& record, const std::vector<int>& components, const std::vector<double>& values,
                                bool degrees) {
    for (const int c : components)
      if (c < 1 || c > 6)
        diagnostics_.error(record.where("C"), fmt::format("component {}: components are 1 to 6", c),
                           "1 2 3 are translations along, 4 5 6 rotations about x y z");
    std::vector<double> out(components.size(), values.empty() ? 0.0 : values.front());
    if (values.size() > 1) {
      if (values.size() != components.size())
        diagnostics_.error(record.where("V"), fmt::format("{} values for {} components", values.size(), components.size()),
                           "give one value for all components, or one for each");
      else
        out = values;
    }
    for (std::size_t i = 0; degrees && i < out.size(); ++i)
      if (components[i] > 3) out[i] *= std::numbers::pi / 180;
    return out;
  }

  void add_supports(const deck::Record& record, const deck::NodeTarget& target, const std::vector<int>& components,
                    const std::vector<double>& values, int function_id) {
    const auto each = values_of(record, components, values, true);
    const Function* f = function(record, function_id);
    for (const int id : groups_.resolve(record, target))
      for (std::size_t i = 0; i < components.size(); ++i) {
        const Support support{model_.node_index(id), components[i] - 1, each[i], f};
        const auto same = [&](const Support& s) { return s.node == support.node && s.component == support.component; };
        const auto old = std::find_if(model_.supports.begin(), model_.supports.end(), same);
        if (old == model_.supports.end()) {
          model_.supports.push_back(support);
          support_locations_.push_back(record.location);
        } else if (old->value != support.value || old->function != support.function) {
          diagnostics_.error(record.location,
                             fmt::format("component {} of node {} is already prescribed otherwise", components[i], id));
        }
      }
  }

  /// Rotations of a node may be held all three, or two of them (it then turns about the third axis). Held alone, one
  /// component of a finite rotation has no meaning.
  void check_rotation_supports() {
    for (std::size_t i = 0; i < model_.supports.size(); ++i) {
      const Support& s = model_.supports[i];
      if (s.component < 3) continue;
      const auto held = std::count_if(model_.supports.begin(), model_.supports.end(),
                                      [&](const Support& other) { return other.node == s.node && other.component >= 3; });
      const int id = model_.nodes[static_cast<std::size_t>(s.node)].id;
      if (held == 1)
        diagnostics_.error(support_locations_[i],
                           fmt::format("node {} has only rotation component {} prescribed, which has no meaning for "
                                       "rotations of any size",
                                       id, s.component + 1),
                           "prescribe two or three of the components 4 5 6, or join the node to the ground with a HINGE");
      if (s.value != 0 && held == 3) {
        const auto moved = std::count_if(model_.supports.begin(), model_.supports.end(), [&](const Support& other) {
          return other.node == s.node && other.component >= 3 && other.value != 0;
        });
        if (moved > 1)
          diagnostics_.error(support_locations_[i], fmt::format("node {} is turned about more than one axis at once", id),
                             "prescribe one rotation and hold the other two at zero");
      }
    }
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
      loads_.push_back({id, force, moment, f, record.location, deck::record_json(record)});
    }
  }

  void add_loads() {
    int id = 0;
    for (const Model::Part& part : model_.parts) id = std::max(id, part.element->id());
    for (const Load& load : loads_)
      model_.parts.push_back({make_node_load(++id, load.node, positions_.at(load.node), load.force, load.moment, load.function),
                              "CHA",
                              load.parameters,
                              load.location,
                              {}});
  }

  void add_initial(const deck::Record& record, const deck::InitialCard& card) {
    const bool velocity = card.kind.is("VELOCITY");
    const auto each = values_of(record, card.components, card.values, !velocity);
    for (const int id : groups_.resolve(record, card))
      for (std::size_t i = 0; i < card.components.size(); ++i)
        model_.initial.push_back({model_.node_index(id), card.components[i] - 1, each[i], velocity, card.imposed});
  }

  void add_element(const deck::Record& record, int stage) {
    for (const ElementType& type : types_) {
      if (type.stage != stage || record.schema->name != type.schema.name) continue;
      if (!check_references(record, diagnostics_)) return;
      const bool command = type.schema.name.front() == '.';
      if (command && taken(record)) return;
      BuildContext context = context_of(record, diagnostics_);
      if (auto element = type.build(context))
        model_.parts.push_back(
            {std::move(element), type.schema.name.substr(command ? 1 : 0), deck::record_json(record), record.location, {}});
    }
  }

  /// Results name elements by their numbers, so those of .MCE and of commands such as .LIA must differ.
  bool taken(const deck::Record& record) {
    const auto same = [&](const deck::Record& other) {
      return &other != &record && other.id == record.id && other.schema->command() == ".MCE";
    };
    const auto other = std::find_if(deck_.records.begin(), deck_.records.end(), same);
    if (other == deck_.records.end()) return false;
    diagnostics_.error(record.location, fmt::format("number {} is that of {} {}", record.id, other->schema->name, other->id),
                       "results name elements by their numbers: give another");
    return true;
  }

  BuildContext context_of(const deck::Record& record, Diagnostics& diagnostics) {
    return {positions_,
            model_.functions,
            diagnostics,
            record,
            [this](int node, const Vec3& axis) { return inertia_about(node, axis); },
            &deck_.records,
            &blocks_};
  }

  /// Lets an element put a node where it needs it: one after another in the order of the deck.
  void place_node(const deck::Record& record) {
    for (const ElementType& type : types_) {
      if (!type.place || record.schema->name != type.schema.name) continue;
      Diagnostics unheard;  // the element says it again when it is built
      if (!check_references(record, unheard)) continue;
      const auto placed = type.place(context_of(record, unheard));
      if (!placed) continue;
      const auto old = placed_by_.find(placed->node);
      const double size = (placed->x - positions_.at(placed->from)).norm();
      if (old == placed_by_.end()) {
        for (const auto& [node, other] : placed_by_)
          if (other.from == placed->node)
            diagnostics_.error(record.where("PLACE"),
                               fmt::format("node {} moves only here, but {} {} has already placed node {} from it", placed->node,
                                           other.record->schema->name, other.record->id, node),
                               "write the elements of a chain in its order");
        positions_[placed->node] = placed->x;
        placed_by_[placed->node] = {&record, placed->from};
      } else if (const Vec3& x = positions_[placed->node]; (placed->x - x).norm() > 1e-6 * size) {
        diagnostics_.error(
            record.where("PLACE"),
            fmt::format("node {} is placed at ({:.10g}, {:.10g}, {:.10g}) here and at ({:.10g}, {:.10g}, {:.10g}) by {} {}",
                        placed->node, placed->x[0], placed->x[1], placed->x[2], x[0], x[1], x[2],
                        old->second.record->schema->name, old->second.record->id),
            "keep PLACE in one of them");
      }
    }
  }

  bool check_references(const deck::Record& record, Diagnostics& diagnostics) {
    bool good = true;
    for (const deck::Field& field : record.schema->fields) {
      if (field.reference != deck::Reference::node) continue;
      for (const double value : field.load(record.data).numbers) {
        const int id = static_cast<int>(value);
        if (positions_.contains(id)) continue;
        diagnostics.error(record.where(field.keyword),
                          fmt::format("node {} of {} {} does not exist", id, record.schema->name, record.id));
        good = false;
      }
    }
    return good;
  }

  double inertia_about(int node, const Vec3& axis) const {
    double sum = 0;
    for (const Model::Part& part : model_.parts) sum += axis.dot(part.element->inertia_at(node) * axis);
    return sum;
  }

  struct Load {
    int node;
    Vec3 force, moment;
    const Function* function;
    Location location;
    std::string parameters;
  };

  /// Which element placed a node, and from which other node.
  struct Placed {
    const deck::Record* record;
    int from;
  };

  const deck::Deck& deck_;
  const std::vector<ElementType>& types_;
  Diagnostics& diagnostics_;
  std::map<int, Vec3> positions_;
  std::map<int, Placed> placed_by_;
  Frames frames_;
  NodeGroups groups_;
  BlockStore blocks_;
  std::vector<Load> loads_;
  std::vector<Location> support_locations_;
  Model model_;
};

}  // namespace

Model build_model(const deck::Deck& deck, const std::vector<ElementType>& types, Diagnostics& diagnostics) {
  return Builder(deck, types, diagnostics).build();
}

}  // namespace engrane

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <compare>
#include <cstddef>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "assembly/assembler.hpp"
#include "assembly/reactions.hpp"
#include "model/determined_channels.hpp"
#include "observe/field_channels.hpp"
#include "observe/fields.hpp"

namespace engrane::observe {

/// Which elements, nodes and channels to keep histories of.
struct Selection {
  bool all_parts = true, all_nodes = true;
  std::set<int> parts, nodes;      ///< in addition; indices into Model::parts and Model::nodes
  std::set<std::string> channels;  ///< of the selected parts and nodes; empty for all but those of fields
  /// One channel of one part or node, selected regardless of everything else.
  struct Single {
    bool of_part = true;
    int index = 0;
    std::string channel;
    auto operator<=>(const Single&) const = default;
  };
  std::set<Single> singles;

  /// Whether all channels of a part or node are kept, or those that `channels` names.
  bool chooses(bool of_part, int index) const {
    return of_part ? all_parts || parts.contains(index) : all_nodes || nodes.contains(index);
  }
};

/// A component of a field that is averaged at nodes.
struct AverageValue {
  std::size_t field = 0;  ///< index into ElementFields::averages()
  std::size_t component = 0;
  auto operator<=>(const AverageValue&) const = default;
};

/// Histories of parts or nodes with the same channels. The columns are the channels of the first owner, then those of the next,
/// and so on.
struct Table {
  std::string path;         ///< `element/GEAR`, `element/GEAR_2`, `node/NODE`
  std::string type;         ///< name of the card, for elements
  std::vector<int> ids;     ///< ids of the owners in the deck
  std::vector<int> owners;  ///< their indices into Model::parts or Model::nodes
  std::vector<Channel> channels;
  std::vector<int> places;  ///< indices of the first of these channels among all channels of an owner
  // the other channels
  std::vector<FieldValues> of_fields;     ///< of elements: what they take of the fields of their owner
  std::vector<AverageValue> of_averages;  ///< of nodes

  std::size_t columns() const { return owners.size() * channels.size(); }
};

/// Channels of a node: displacement and rotation, with `moves` their rates, with `supported` the reactions.
std::vector<Channel> node_channels(bool moves, bool supported);

/// Descriptions and values of the histories that a run keeps. Each rank evaluates its own elements.
class Histories {
 public:
  /// Collective. `moves`: the analysis has velocities. `fields`: computed anew with each evaluation where histories of averages
  /// at nodes are kept.
  Histories(Assembler& assembler, const Reactions& reactions, ElementFields& fields, bool moves, const Selection& selection);

  /// Tables of elements, then of nodes.
  const std::vector<Table>& tables() const { return tables_; }
  /// Number of columns of all tables.
  std::size_t columns() const { return columns_; }

  /// Returns the values in the order of the columns, on rank 0; empty on the others. Collective.
  const std::vector<double>& evaluate(const Configuration& c, const std::vector<Reaction>& reactions);
  /// Updates only the columns of nodes, from node_columns() on, with zero reactions. Returns all columns, on rank 0.
  const std::vector<double>& evaluate_nodes(const Configuration& c);
  std::size_t node_columns() const { return destination_.size(); }
  /// A column whose values are known between two instants (DeterminedChannels).
  struct Known {
    std::size_t column;
    int part;
    DeterminedChannels::Determined determined;
    const DeterminedChannels* element;
    Dimension of_source;               ///< dimension of the first source channel, if it has any
    std::size_t first;                 ///< place of its sources in sources()
    std::vector<std::size_t> columns;  ///< of its sources, if all are kept and none is of_motion(): they are not in sources()

    double at(double time, std::span<const double> own_sources) const {
      return element->determine(determined.channel, time, own_sources);
    }
  };
  const std::vector<Known>& known() const { return known_; }
  /// Values of the source channels of known() that are no columns, one after another, on rank 0, which holds the whole
  /// configuration. Sources need not be kept: a selection does not change results.
  const std::vector<double>& sources(const Configuration& c);
  std::size_t source_count() const { return sources_.size(); }
  /// Number of tables of elements.
  std::size_t part_tables() const { return part_tables_; }

 private:
  void add_parts(const Selection& selection);
  void add_nodes(const Selection& selection);
  void find_known();
  void plan_gathering();
  void put_nodes(const Configuration& c, const std::vector<Reaction>& reactions);
  /// Channels that the fields of an element give, of those selected.
  std::vector<FieldChannel> selected_fields(const Selection& selection, int part) const;
  /// Channels of a node from averaged fields, of those selected, and what they take. `of`: see elements_averaged().
  std::vector<std::pair<Channel, AverageValue>> selected_averages(const Selection& selection, int node, const Element* of) const;
  double average(const AverageValue& value, int node) const;

  Assembler& assembler_;
  const Reactions& supports_;
  ElementFields& fields_;
  bool averages_ = false;  ///< some histories are of averages at nodes
  bool moves_;
  std::vector<Table> tables_;
  std::size_t part_tables_ = 0;
  std::size_t columns_ = 0;
  std::vector<double> values_;
  std::vector<double> own_, element_;        ///< this rank's columns; all channels of one element
  std::vector<double> of_fields_;            ///< all field values of one element
  std::vector<int> counts_, displacements_;  ///< rank 0: columns received from each rank
  std::vector<std::size_t> destination_;     ///< rank 0: column of each gathered value
  std::vector<double> gathered_;
  std::vector<Known> known_;
  std::vector<double> sources_;
};

}  // namespace engrane::observe

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "deck/cards/mesh_cards.hpp"
#include "elements/materials/elasticity.hpp"
#include "elements/structural/cell_topology.hpp"
#include "model/frames.hpp"
#include "model/registry.hpp"

namespace engrane::elements::structural {

/// Options of cells that are membranes in space.
struct SkinOptions {
  double tension = 0;  ///< isotropic prestress
  bool wrinkling = false;
  std::optional<double> slack;  ///< fraction of the stiffness that remains where they wrinkle; none: the default
};

/// Law of an anisotropic material whose axes follow a curved frame, such as a cylindrical one: it differs from point to point.
struct CurvedLaw {
  materials::Hypothesis hypothesis;
  materials::Elastic material;            ///< in its own axes
  std::function<Mat3(const Vec3&)> axes;  ///< as columns, at a place in the reference configuration
  double height = 0;                      ///< z of plane cells

  materials::Elasticity at(const Vec3& place) const {
    return materials::law_of(hypothesis, materials::turned(material, axes(place)));
  }
};

/// Properties shared by cells of one material, hypothesis and thickness.
struct CellSection {
  materials::Hypothesis hypothesis;
  materials::Elasticity law;  ///< if there is a `curved`: for what does not depend on axes, such as the density
  double thickness = 1;
  bool linear = true;  ///< small displacements
  /// Number of the section within the deck. Cells with the same number have the same material, hypothesis and thickness and, if
  /// the material is anisotropic, the same definition of its axes, and are in the same of the groups that give properties.
  int number = 0;
  bool lumped = false;                   ///< lumped instead of consistent masses
  std::optional<SkinOptions> skin = {};  ///< membranes in space
  std::optional<CurvedLaw> curved = {};
};

/// Properties of a cell that is a beam.
struct BeamCell {
  int profile = 0, material = 0;  ///< of `.BPR` and `.MAT`; 0: not given
  std::optional<Vec3> axis_2;
  bool linear = true, lumped = false;  ///< small displacements; lumped masses
};

/// Steady rotation of a body about an axis, seen in axes that rotate with it: the source of centrifugal loads.
struct CellRotation {
  const deck::Record* record = nullptr;
  double speed = 0;  ///< angular velocity, radians per unit of time
  Vec3 axis = Vec3::UnitZ(), point = Vec3::Zero();
  const Function* function = nullptr;  ///< function of time that multiplies the speed; nullptr: 1

  double speed_at(double time) const { return speed * (function ? function->at(time).f : 1); }
  /// Projection onto the plane normal to the axis.
  Mat3 projection() const { return Mat3::Identity() - axis * axis.transpose(); }
};

/// Properties of the cells from `.HYP`, `.MAT`, `.PHP`, `.AEL`, `.SEL` and rotations (ROT), by cell number. The constructor
/// reports errors, each once for all cells concerned.
class CellBook {
 public:
  explicit CellBook(const BuildContext& context);

  /// The book of a model, created on first use; created anew on each call if the context shares no notes.
  static std::shared_ptr<const CellBook> of(const BuildContext& context);

  /// The record of `.MAI`; nullptr if the cell does not exist.
  const deck::Record* record(int cell) const;
  /// Alternating cell numbers and face numbers, counted from 1, of a group of faces, each face once; nullptr if the group does
  /// not exist.
  const std::vector<int>* faces(const std::string& group) const;
  /// Cell numbers of a group; empty if the group does not exist.
  std::vector<int> cells(const std::string& group) const;
  /// Numbers of the other elements of a group, of `.MCE` and `.LIA`; empty if the group does not exist.
  std::vector<int> other_elements(const std::string& group) const;
  /// Nodes of an element MEMBRANE of `.MCE`; nullptr if the element is another one, or does not exist.
  const std::vector<int>* membrane(int element) const;
  /// Whether there is a group of elements of that name; it may contain no cells.
  bool has_group(const std::string& group) const { return groups_.contains(group); }
  /// Section of a plane, solid or membrane cell; nullptr if something is missing, which has been reported.
  std::shared_ptr<const CellSection> section(int cell) const;
  /// Properties of a beam cell; nothing if something is missing, which has been reported.
  std::optional<BeamCell> beam(int cell) const;
  /// nullptr: the cell does not rotate.
  std::shared_ptr<const CellRotation> rotation(int cell) const;

 private:
  struct Cell {
    const deck::Record* record;
    const deck::Record* hypothesis = nullptr;
    const deck::Record* material = nullptr;
    double thickness = 0;                ///< 0: not given
    std::optional<double> theta = {};    ///< degrees
    int frame = 0;                       ///< 0: global axes
    const deck::Record* axes = nullptr;  ///< record that gives `theta` or `frame`
    int profile = 0;                     ///< beams only; 0: not given
    std::optional<Vec3> axis_2 = {};
    int part = 0;  ///< set by number_parts()
    std::shared_ptr<const CellSection> section = nullptr;
    std::shared_ptr<const CellRotation> rotation = nullptr;
  };
  struct Group {
    std::vector<std::size_t> cells;  ///< indices into `cells_`
    std::vector<int> others;         ///< numbers of elements that are not cells
    bool empty() const { return cells.empty() && others.empty(); }
  };

  void read_cells(const std::vector<deck::Record>& records);
  void read_groups(const std::vector<deck::Record>& records, const NodePositions& nodes);
  /// Adds to a group the cells that a record of `.SEL` chooses.
  void add_members(const deck::Record& record, const deck::GroupCard& card, const NodePositions& nodes, Group& group);
  void read_properties(const std::vector<deck::Record>& records);
  void read_rotations(const BuildContext& context);
  /// Numbers the parts of the mesh: two cells are of one part if they are in the same groups, of those that `.HYP`, `.PHP` and
  /// `.AEL` name.
  void number_parts(const std::vector<deck::Record>& records);
  void check_skin(const deck::Record& record, const deck::HypothesisCard& card);
  void assign(const deck::Record& record, const deck::AssignmentCard& assignment);
  void make_sections(const NodePositions& nodes);
  void check_beams();
  /// Looks for gravity that the cells cannot follow.
  void check_weight(const std::vector<deck::Record>& records);
  /// Warns about axes of materials that have none.
  void look_at_axes();
  /// Reports rubber that gets so cold that nothing is left of it.
  void refuse_cold(const Temperatures& temperatures);
  std::shared_ptr<const CellSection> make_section(const Cell& cell, materials::Hypothesis hypothesis, const Vec3& middle,
                                                  int number);
  /// Whether the material has axes and these differ from place to place.
  bool has_curved_axes(const Cell& cell) const;
  /// Whether one axis of the material is z wherever the cell is; otherwise reports an error, once for each material.
  bool is_plane(const Cell& cell, const Vec3& middle, const NodePositions& nodes);

  /// Cells of groups given by name or number; reports unknown groups and, unless the record names `others`, warns if it applies
  /// to no cell.
  std::vector<std::size_t> members(const deck::Record& record, const std::vector<std::string>& groups, bool others = false);
  void report_unknown_group(const deck::Record& record, const char* keyword, const std::string& name);
  const Cell* find(int cell) const;
  std::size_t index(int cell) const;
  /// Reports one error for all cells for which `lacks` is true; not where a record of the command `given_by`, which gives
  /// what they lack, is at fault or names a group that is not known.
  template <class Lacks>
  void report_lack(const Lacks& lacks, const std::string& what, const std::string& cure, std::string_view given_by = {});

  static bool is_beam(const Cell& cell);

  Diagnostics& diagnostics_;
  std::set<std::string_view> unknown_groups_in_;  ///< commands of records that name groups which do not exist
  bool linear_, lumped_;                          ///< for all cells of the model: small displacements, lumped masses
  std::vector<Cell> cells_;                       ///< by number
  std::map<std::string, Group> groups_;
  std::map<std::string, std::vector<int>> faces_;
  std::map<int, const std::vector<int>*> membranes_;  ///< nodes of the elements MEMBRANE
  std::map<int, const deck::Record*> materials_;
  /// By material number and hypothesis; empty if the material is invalid.
  std::map<std::pair<int, materials::Hypothesis>, std::optional<materials::Elastic>> elastic_;
  std::set<int> unsuitable_;  ///< materials that have been reported: axes or damping that their cells cannot have
  Frames frames_;
};

}  // namespace engrane::elements::structural

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "deck/cards/mesh_cards.hpp"
#include "elements/materials/elasticity.hpp"
#include "elements/structural/cell_topology.hpp"
#include "model/frames.hpp"
#include "model/registry.hpp"

namespace engrane::elements::structural {

/// What makes cells membranes in space: a tension, and whether they wrinkle.
struct SkinOptions {
  double tension = 0;
  bool wrinkling = false;
  std::optional<double> slack;  ///< part of the stiffness that is left where they wrinkle; none: the usual
};

/// What cells of one material, hypothesis and thickness share.
struct CellSection {
  materials::Hypothesis hypothesis;
  materials::Elasticity law;
  double thickness = 1;
  bool linear = true;  ///< small displacements
  /// Which of the sections of the deck: cells of one have the same material, hypothesis and thickness, and axes that are given in
  /// the same way where they matter. Where these turn from cell to cell, as in a cylindrical frame, each has a struct of its own.
  int number = 0;
  bool lumped = false;                   ///< masses at the nodes
  std::optional<SkinOptions> skin = {};  ///< membranes in space
};

/// What a cell that is a beam is made of.
struct BeamCell {
  int profile = 0, material = 0;  ///< of `.BPR` and `.MAT`; 0: not given
  std::optional<Vec3> axis_2;
  bool linear = true, lumped = false;  ///< small displacements; masses at the nodes
};

/// A body that turns about an axis, in axes that turn with it.
struct CellRotation {
  const deck::Record* record = nullptr;
  double speed = 0;  ///< radians per unit of time
  Vec3 axis = Vec3::UnitZ(), point = Vec3::Zero();
  const Function* function = nullptr;  ///< of time, a factor of the speed

  double speed_at(double time) const { return speed * (function ? function->at(time).f : 1); }
  /// Across the axis.
  Mat3 projection() const { return Mat3::Identity() - axis * axis.transpose(); }
};

/// What a deck says of its cells in `.HYP`, `.MAT`, `.PHP`, `.AEL` and `.SEL`, looked up by the number of a cell. Faults are
/// reported while it is made, each once, however many cells have it.
class CellBook {
 public:
  explicit CellBook(const BuildContext& context);

  /// The book of a model; made when the first cell asks for it, and each time where nothing is shared.
  static std::shared_ptr<const CellBook> of(const BuildContext& context);

  /// The record of `.MAI`; nullptr when there is no such cell.
  const deck::Record* record(int cell) const;
  /// Pairs of a cell and its face, counted from 1, of a group of faces; nullptr when there is no such group.
  const std::vector<int>* faces(const std::string& group) const;
  /// Cells of a group; nothing when there is no such group.
  std::vector<int> cells(const std::string& group) const;
  /// nullptr: something is missing, and was reported.
  std::shared_ptr<const CellSection> section(int cell) const;
  /// Of a cell of two nodes, or three; nothing: something is missing, and was reported.
  std::optional<BeamCell> beam(int cell) const;
  /// nullptr: the cell does not turn.
  std::shared_ptr<const CellRotation> rotation(int cell) const;

 private:
  struct Cell {
    const deck::Record* record;
    const deck::Record* hypothesis = nullptr;
    const deck::Record* material = nullptr;
    double thickness = 0;                ///< 0: not given
    std::optional<double> theta = {};    ///< degrees
    int frame = 0;                       ///< 0: the global one
    const deck::Record* axes = nullptr;  ///< where they were given
    int profile = 0;                     ///< of a beam; 0: not given
    std::optional<Vec3> axis_2 = {};
    std::shared_ptr<const CellSection> section = nullptr;
    std::shared_ptr<const CellRotation> rotation = nullptr;
  };
  using Group = std::vector<std::size_t>;  ///< indices of cells

  void read_cells(const std::vector<deck::Record>& records);
  void read_groups(const std::vector<deck::Record>& records);
  void read_properties(const std::vector<deck::Record>& records);
  void read_rotations(const BuildContext& context);
  void check_skin(const deck::Record& record, const deck::HypothesisCard& card);
  void assign(const deck::Record& record, const deck::AssignmentCard& assignment);
  void make_sections(const NodePositions& nodes);
  void check_beams(const Temperatures* temperatures);
  void refuse_warm(const Temperatures& temperatures);
  std::shared_ptr<const CellSection> make_section(const Cell& cell, materials::Hypothesis hypothesis, const Mat3& axes,
                                                  int number);
  /// Axes of the material of a cell; nothing where its frame does not exist, which is reported.
  std::optional<Mat3> axes_of(const Cell& cell, const NodePositions& nodes);

  /// Cells of groups, by name or number; an unknown one is an error.
  Group members(const deck::Record& record, const std::vector<std::string>& groups);
  const Cell* find(int cell) const;
  std::size_t index(int cell) const;
  /// One error for all cells that lack something.
  template <class Lacks>
  void report_lack(const Lacks& lacks, const std::string& what, const std::string& cure);

  static bool is_beam(const Cell& cell);

  Diagnostics& diagnostics_;
  bool linear_, lumped_;     ///< what all cells of the model have
  std::vector<Cell> cells_;  ///< by number
  std::map<std::string, Group> groups_;
  std::map<std::string, std::vector<int>> faces_;
  std::map<int, const deck::Record*> materials_;
  std::map<std::pair<int, materials::Hypothesis>, std::optional<materials::Elastic>> elastic_;  ///< by material
  std::set<int> crooked_;  ///< materials whose axes were told to lead out of the plane
  Frames frames_;
};

}  // namespace engrane::elements::structural

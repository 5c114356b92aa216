// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "assembly/assembler.hpp"
#include "base/snapshot.hpp"

namespace engrane::solve {

/// Axes in which kept factors are used. Rotation unknowns have components in node axes. What acts on a wheel but stands still
/// in space, such as a tooth normal, turns in these axes, so that the factors become outdated. With Q = RᵀR₀ on the rotation of
/// such a node and the identity elsewhere, Q K₀⁻¹ Qᵀ is used in place of K₀⁻¹; R₀ is the rotation at which the tangent K₀ was
/// evaluated. The same applies to forces and moments of a joint with components in axes of its first node. Which of these
/// triples of unknowns to turn is decided when a new tangent is made: those with which Q K₀ Qᵀ comes closest to it.
///
/// Does nothing on several ranks.
class FactorFrames {
 public:
  explicit FactorFrames(const Assembler& assembler);

  /// Call before a new tangent is made at `c`. `comparable`: it will differ from the present one by the motion alone.
  void take_old(const Configuration& c, Mat tangent, bool comparable);
  /// Call after it has been made. `length`: reference length of the unknown of each equation, which makes entries comparable.
  void renew(const Configuration& c, Mat tangent, const std::function<double(int)>& length);
  /// Multiplies the right side by Qᵀ, before a solution at `c` with kept factors.
  void turn_right_side(const Configuration& c, Vec v);
  /// Multiplies the solution by Q, after it.
  void turn_solution(Vec v) const;

  void save(Snapshot& snapshot) const;
  void load(const Snapshot& snapshot);

 private:
  /// Three unknowns that may have components in the axes of a node.
  struct Frame {
    int node;
    std::array<int, 3> equations;
    Mat3 made_for = Mat3::Identity();  ///< R₀
    Mat3 q = Mat3::Identity();
    bool turned = false;                      ///< Q is used
    std::array<double, 2> alone{};            ///< misfit in columns that belong to no frame: unturned, turned
    std::vector<std::size_t> couplings = {};  ///< indices into couplings_
  };
  /// Misfit of the rows of one frame in the columns of another, or its own, by whether each of the two is turned.
  struct Coupling {
    std::size_t row, column;
    std::array<std::array<double, 2>, 2> misfit{};
  };
  void add(int node, const std::array<int, 3>& equations);
  void measure(Mat tangent, const std::function<double(int)>& length);
  /// Changes one choice after the other as long as the misfit decreases, and returns it.
  double settle(std::vector<char>& turned) const;
  double misfit(const std::vector<char>& turned, std::size_t frame) const;
  template <class Turn>
  void apply(Vec v, const Turn& turn) const;

  std::vector<Frame> frames_;
  std::vector<int> frame_of_;  ///< of each equation; −1: none
  std::vector<double> old_;    ///< rows of the frames in the old tangent; empty: not compared
  std::vector<Coupling> couplings_;
  // the choice is reviewed after 1, 2, 4, … tangents as long as it stays the same
  int pause_ = 1, left_ = 1;
};

}  // namespace engrane::solve

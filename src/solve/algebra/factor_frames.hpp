// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "assembly/assembler.hpp"
#include "base/snapshot.hpp"

namespace engrane::solve {

/// The axes in which kept factors are used. Rotations are unknown in axes of the nodes; what acts on a wheel, such as a tooth
/// normal that stands still in space, turns in these axes, and factors grow old. With Q = RᵀR₀ on the rotation of such a node and
/// the identity elsewhere, Q K₀⁻¹ Qᵀ takes the place of K₀⁻¹: R₀ is the rotation for which the tangent K₀ was made. The same of
/// forces and moments of a joint that have axes of its first node. Which of these triples of unknowns are better turned is seen
/// when a tangent is made anew: those with which Q K₀ Qᵀ comes nearest to it.
///
/// On several ranks all stays as it is.
class FactorFrames {
 public:
  explicit FactorFrames(const Assembler& assembler);

  /// A tangent is about to be made anew at `c`. `comparable`: it will differ from the one there is by the motion alone.
  void take_old(const Configuration& c, Mat tangent, bool comparable);
  /// It has been made. `length`, of the unknown of each equation, makes entries comparable.
  void renew(const Configuration& c, Mat tangent, const std::function<double(int)>& length);
  /// Qᵀ times a vector, before a solution for `c` with the factors kept.
  void turn_right_side(const Configuration& c, Vec v);
  /// Q times a vector, after it.
  void turn_solution(Vec v) const;

  void save(Snapshot& snapshot) const;
  void load(const Snapshot& snapshot);

 private:
  /// Three unknowns that may have the axes of a node.
  struct Frame {
    int node;
    std::array<int, 3> equations;
    Mat3 made_for = Mat3::Identity();  ///< R₀
    Mat3 q = Mat3::Identity();
    bool turned = false;                      ///< Q is used
    std::array<double, 2> alone{};            ///< misfit of its columns that belong to no frame: as they are, turned
    std::vector<std::size_t> couplings = {};  ///< that it takes part in
  };
  /// Misfit of the rows of a frame in the columns of another, or its own: for each choice of the one and of the other.
  struct Coupling {
    std::size_t row, column;
    std::array<std::array<double, 2>, 2> misfit{};
  };
  void add(int node, const std::array<int, 3>& equations);
  void measure(Mat tangent, const std::function<double(int)>& length);
  /// Changes one choice after the other as long as the misfit shrinks, and returns it.
  double settle(std::vector<char>& turned) const;
  double misfit(const std::vector<char>& turned, std::size_t frame) const;
  template <class Turn>
  void apply(Vec v, const Turn& turn) const;

  std::vector<Frame> frames_;
  std::vector<int> frame_of_;  ///< of each equation; −1: none
  std::vector<double> old_;    ///< rows of the frames; empty: they are not looked at
  std::vector<Coupling> couplings_;
  // as long as answers stay the same the question is asked after 1, 2, 4, … tangents
  int pause_ = 1, left_ = 1;
};

}  // namespace engrane::solve

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>

#include "deck/cards/cards.hpp"
#include "math/vector.hpp"

namespace engrane {

/// The local frames of `.FRAME`, in which nodes may be given.
class Frames {
 public:
  void add(const deck::Record& record, const deck::FrameCard& card, Diagnostics& diagnostics);

  /// Global position of a node given in its frame (Cartesian, cylindrical r θ z or spherical r θ φ, degrees).
  Vec3 to_global(const deck::Record& record, const deck::NodeCard& node, Diagnostics& diagnostics) const;

  /// Axes of a frame at a place, as columns: of a cylindrical one the radial, the circumferential and the third axis, of a
  /// spherical one the radial, that of growing θ and that of growing φ. Nothing when there is no such frame.
  std::optional<Mat3> axes_at(int frame, const Vec3& place) const;
  /// Whether they differ from place to place.
  bool is_curved(int frame) const;

 private:
  enum class Kind { cartesian, cylindrical, spherical };
  struct Frame {
    Vec3 origin;
    Mat3 axes;  ///< columns
    Kind kind;
  };
  std::map<int, Frame> frames_;
};

}  // namespace engrane

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>

#include "deck/cards/cards.hpp"
#include "math/vector.hpp"

namespace engrane {

/// The local frames of `.FRAME`, in which node coordinates may be given.
class Frames {
 public:
  void add(const deck::Record& record, const deck::FrameCard& card, Diagnostics& diagnostics);

  /// Global position of a node given in its frame (Cartesian, cylindrical r θ z or spherical r θ φ, degrees).
  Vec3 to_global(const deck::Record& record, const deck::NodeCard& node, Diagnostics& diagnostics) const;

  /// Axes of a frame at a point, as columns: cartesian axes; radial, circumferential and third axis of a cylindrical frame;
  /// directions of increasing r, θ and φ of a spherical one. Empty if there is no such frame.
  std::optional<Mat3> axes_at(int frame, const Vec3& place) const;
  /// Whether the axes vary from point to point.
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

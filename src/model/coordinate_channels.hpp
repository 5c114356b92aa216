// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace engrane {

/// An element that measures coordinates between its nodes: an angle, a slide, a distance. Its channels begin with them, each
/// followed by its rate, and no rate depends on anything but positions and, linearly, on velocities.
class CoordinateChannels {
 public:
  /// How many there are: coordinate i is channel 2i, and its rate channel 2i + 1.
  virtual int coordinate_count() const = 0;

 protected:
  ~CoordinateChannels() = default;
};

}  // namespace engrane

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace engrane {

/// An element that measures relative coordinates between its nodes: an angle, a displacement, a distance. Its channels start
/// with these coordinates, each followed by its rate. The rates depend on positions and, linearly, on velocities only.
class CoordinateChannels {
 public:
  /// Number of coordinates: coordinate i is channel 2i, its rate channel 2i + 1.
  virtual int coordinate_count() const = 0;

 protected:
  ~CoordinateChannels() = default;
};

}  // namespace engrane

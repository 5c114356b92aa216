// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mpi.h>

#include <cstddef>
#include <span>
#include <vector>

#include "base/snapshot.hpp"
#include "math/extrapolation.hpp"
#include "model/element.hpp"

namespace engrane::observe {

/// Whether values of this dimension are taken from an interpolated motion. Angles may jump by a turn, and velocities are as
/// accurate as the motion itself. Lengths are left out: they may be small differences of large ones, such as coordinates.
bool of_motion(const Dimension& d);

/// Values of histories between the instants at which they were observed: polynomials through the latest of them
/// (Channel::Course). Rank 0 has the values; all ranks know how the points follow one another.
class HistoryInterpolation {
 public:
  /// `channels`: of each value, those of elements first, which are `element_values`.
  HistoryInterpolation(std::vector<const Channel*> channels, std::size_t element_values, MPI_Comm comm);

  /// Adds a point. `sources`: values of further channels, which are interpolated beside. Collective.
  void add(double time, std::span<const double> values, std::span<const double> sources);
  /// Begins anew at the latest point, as after an event or a corner.
  void begin_anew() { begins_anew_ = true; }
  /// The latest point is too far from the one before to detect a jump of an angle between them.
  void doubt() { steady_ = 0; }
  /// Whether all points in use are close together, and no angle jumps between them.
  bool steady() const { return steady_ >= most_points; }

  /// Sets `values` to those at a time between the latest two points; returns the sources there. Those of channels of_motion()
  /// are those of `moved` from the column `first` on, if it is not empty. Only on rank 0.
  std::vector<double> at(double time, std::span<const double> moved, std::size_t first, std::span<double> values) const;
  /// Values at the latest point; empty if there is none.
  std::span<const double> latest() const;

  void save(Snapshot& snapshot) const;
  /// Does nothing if other channels or another number of `sources` were saved, or none.
  void load(const Snapshot& snapshot, std::size_t sources);

 private:
  static constexpr std::size_t most_points = 6;

  /// The polynomial with these weights of the points.
  double weighted(std::size_t column, std::span<const double> weights) const;
  /// A `value` by all `points`, or, where that goes astray, the one by a few of them that is `calm`.
  double calmed(std::size_t column, std::size_t points, double calm, double value) const;
  /// A Channel::Course::size. `smooth`: the polynomial through the sizes.
  double size_between(std::size_t column, std::span<const double> weights, double smooth) const;

  std::vector<const Channel*> channels_;
  std::size_t element_values_;
  MPI_Comm comm_;
  Extrapolation points_;
  std::vector<double> latest_;  ///< values at the latest point, at latest_time_, and then their sources
  double latest_time_ = 0;
  std::size_t steady_ = 0;  ///< consecutive points without a jump of an angle between them, and close enough to detect one
  bool begins_anew_ = false;
};

}  // namespace engrane::observe

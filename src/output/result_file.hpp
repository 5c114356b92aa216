// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>
#include <span>
#include <string>
#include <vector>

#include "output/hdf5_handle.hpp"
#include "output/results_layout.hpp"

namespace engrane::output {

/// The fields of a frame, in the order they are stored; velocities may be left out.
enum class FrameField : unsigned char { displacement, rotation, velocity, angular_velocity, reaction_force, reaction_torque };

struct FieldInfo {
  FrameField field;
  const char* name;
  const char* label;
  Dimension dimension;
};
/// The fields that frames of this layout have.
std::vector<FieldInfo> frame_fields(const ResultsLayout& layout);

/// Samples and frames waiting to be written.
struct Batch {
  struct Frame {
    double time = 0;
    std::vector<double> values;  ///< the fields in the order of frame_fields(), each n × 3
  };
  std::vector<double> times;
  std::vector<double> values;  ///< a row of channel_count() per sample
  std::vector<Frame> frames;

  bool empty() const { return times.empty() && frames.empty(); }
  std::size_t bytes() const;
};

/// The mesh as XDMF reads it: a mixed topology, and the element of each of its cells.
struct MixedTopology {
  std::vector<std::int32_t> data;
  std::vector<std::int32_t> elements;
};
MixedTopology mixed_topology(const ResultsLayout& layout);

/// One HDF5 file with the layout of docs/format.md. Knows nothing of names that change or of spares; see Results.
class ResultFile {
 public:
  /// Creates the file, over any that is there. The layout must outlive it. Everything throws OutputError, which calls the
  /// file `shown_as`.
  ResultFile(const std::string& path, const ResultsLayout& layout, std::string shown_as);

  void append(const Batch& batch);
  /// Writes the attribute `unique` = 0 on these channels, but for those that have it.
  void mark_not_unique(std::span<const int> channels);
  void write_checks(std::span<const CheckResult> checks);
  void set_status(const std::string& status);
  /// Hands everything to the operating system: from here on the file opens with all that was appended.
  void flush();
  /// Flushes and closes; the file takes nothing more.
  void close();
  /// Closes without caring whether that succeeds.
  void abandon() noexcept;

 private:
  struct Growing {
    hdf5::Handle set;
    hsize_t size = 0;
  };
  Growing create_growing(hid_t group, const std::string& name, const std::string& unit, const std::string& label,
                         hsize_t chunk) const;
  void grow(Growing& target, std::span<const double> values) const;
  void create_mesh();
  void create_histories();
  void create_fields();
  void append_samples(const Batch& batch);
  void append_frame(const Batch::Frame& frame);
  hdf5::Place at(const hdf5::Handle& handle) const { return {handle.id(), path_}; }

  std::string path_;  ///< for messages
  const ResultsLayout* layout_;
  hdf5::Handle file_;
  Growing time_;
  std::vector<Growing> channels_;
  std::set<int> not_unique_;
  Growing frame_time_;
  std::vector<hdf5::Handle> field_groups_;
};

}  // namespace engrane::output

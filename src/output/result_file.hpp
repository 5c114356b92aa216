// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/snapshot.hpp"
#include "output/hdf5_handle.hpp"
#include "output/results_layout.hpp"

namespace engrane::output {

/// What a run is restarted from: everything that it remembers at an accepted step, and how much of the results belong to it.
struct RestartPoint {
  double time = 0;
  std::size_t samples = 0, frames = 0;  ///< written up to there
  Snapshot memory;
};

/// What waits to be written.
struct Batch {
  struct Frame {
    double time = 0;
    FrameValues values;
    bool written = false;  ///< another file holds the values, which are gone
  };
  std::vector<double> times;
  std::vector<double> values;  ///< a row of channel_count() per sample
  std::vector<Frame> frames;
  std::vector<RestartPoint> restarts;  ///< that are kept

  bool empty() const { return times.empty() && frames.empty() && restarts.empty(); }
  std::size_t bytes() const;
};

/// The mesh as XDMF reads it: a mixed topology, and the element of each of its cells.
struct MixedTopology {
  std::vector<std::int32_t> data;
  std::vector<std::int32_t> elements;
  std::vector<std::size_t> cells;  ///< the place in ResultsLayout::cells that each of its cells stands for
};
MixedTopology mixed_topology(const ResultsLayout& layout);

/// The version of the layout of docs/format.md; files of another are not read.
constexpr int format_version = 2;

/// One open HDF5 file with the layout of docs/format.md. Knows nothing of names that change or of spares; see Results.
/// Everything throws OutputError, which calls the file `shown_as`.
class ResultFile {
 public:
  enum class Mode : unsigned char { create, append };
  /// Creates the file, over any that is there, with everything but steps; or opens it to add steps. The layout must outlive it.
  ResultFile(const std::string& path, const ResultsLayout& layout, std::string shown_as, Mode mode);
  /// Closes without caring whether that succeeds.
  ~ResultFile();
  ResultFile(const ResultFile&) = delete;
  ResultFile& operator=(const ResultFile&) = delete;

  /// Adds samples, frames and kept restart points. Frames that are `written` are copied from `other`, as they stand there.
  void append(const Batch& batch, hid_t other = H5I_INVALID_HID);
  /// Brings over what an earlier run's file holds up to a restart point: its histories as far as this layout has them (other
  /// columns are not a number), its frames (fields that it lacks are zero) and its kept restart points. Returns the frames'
  /// times.
  std::vector<double> copy_from(hid_t earlier, std::size_t samples, std::size_t frames);
  /// Writes the restart point `latest` over the one before. The last one of a run is compressed.
  void write_latest(const RestartPoint& point, bool last);
  /// Sets `unique` to 0 for these columns, counted over all tables.
  void mark_not_unique(std::span<const int> columns);
  void write_modes(std::span<const ModeShape> modes);
  void write_checks(std::span<const CheckResult> checks);
  void set_status(const std::string& status);
  /// Hands everything to the operating system and closes: the file opens with all that was appended.
  void close();

 private:
  struct Growing {
    hdf5::Handle set;
    hsize_t rows = 0, columns = 1;
  };
  /// A dataset of rows that can be added to; without `columns` a plain list of numbers.
  void create_growing(hid_t group, const std::string& name, std::optional<hsize_t> columns, hsize_t chunk_rows,
                      const std::string& unit, const std::string& label) const;
  Growing open_growing(const std::string& name) const;
  void grow(Growing& target, const double* values, std::size_t rows) const;
  void create_all();
  void create_mesh();
  void create_histories();
  void create_fields();
  void append_samples(const Batch& batch);
  void append_frame(const Batch::Frame& frame, const std::string& name);
  /// Copies the fields of a frame of a file with the same layout: compressed blocks as they are.
  void copy_frame(hid_t other, const std::string& name);
  void append_cell_fields(const Batch::Frame& frame, const std::string& name);
  void append_point_fields(const Batch::Frame& frame, const std::string& name);
  void append_averages(const Batch::Frame& frame, const std::string& name);
  void write_restart(const std::string& name, const RestartPoint& point, bool compressed);
  void copy_histories(hid_t earlier, std::size_t samples);
  hdf5::Place at(const hdf5::Handle& handle) const { return {handle.id(), path_}; }

  std::string path_;  ///< for messages
  const ResultsLayout* layout_;
  hdf5::Handle file_;
};

/// Names of the kept restart points of a file, in the order they were written.
std::vector<std::string> kept_restarts(hid_t file);

}  // namespace engrane::output

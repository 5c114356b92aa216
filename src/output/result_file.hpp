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

/// Everything needed to restart a run from an accepted step, and how many results precede it.
struct RestartPoint {
  double time = 0;
  std::size_t samples = 0, frames = 0;  ///< written up to this point
  Snapshot memory;
};

/// Results waiting to be written.
struct Batch {
  struct Frame {
    double time = 0;
    FrameValues values;
    bool written = false;  ///< `values` are gone; another file holds them
  };
  std::vector<double> times;
  std::vector<double> values;  ///< a row of channel_count() per sample
  std::vector<Frame> frames;
  std::vector<RestartPoint> restarts;  ///< those to be kept

  bool empty() const { return times.empty() && frames.empty() && restarts.empty(); }
  std::size_t bytes() const;
};

/// The mesh in XDMF form: a mixed topology, and the element of each of its cells.
struct MixedTopology {
  std::vector<std::int32_t> data;
  std::vector<std::int32_t> elements;
  std::vector<std::size_t> cells;  ///< index into ResultsLayout::cells for each of its cells
};
MixedTopology mixed_topology(const ResultsLayout& layout);

/// Version of the layout in docs/format.md. Files of other versions are not read.
constexpr int format_version = 2;

/// One open HDF5 file with the layout of docs/format.md. It handles neither changing file names nor the second file; see
/// Results. All members throw OutputError on failure, which calls the file `shown_as`.
class ResultFile {
 public:
  enum class Mode : unsigned char { create, append };
  /// Creates the file with everything except steps, replacing any existing one; or opens it to append steps. The layout must
  /// outlive this object.
  ResultFile(const std::string& path, const ResultsLayout& layout, std::string shown_as, Mode mode);
  /// Closes the file and ignores errors.
  ~ResultFile();
  ResultFile(const ResultFile&) = delete;
  ResultFile& operator=(const ResultFile&) = delete;

  /// Appends samples, frames and kept restart points. Frames marked `written` are copied from `other`.
  void append(const Batch& batch, hid_t other = H5I_INVALID_HID);
  /// Copies the results of an earlier run up to a restart point: histories, frames and kept restart points. Columns that the
  /// earlier file lacks become NaN. Missing fields become zero at nodes and NaN elsewhere. Returns the times of the frames.
  std::vector<double> copy_from(hid_t earlier, std::size_t samples, std::size_t frames);
  /// Overwrites the restart point `latest`. The last one of a run is compressed.
  void write_latest(const RestartPoint& point, bool last);
  /// Sets `unique` to 0 for these columns, counted over all tables.
  void mark_not_unique(std::span<const int> columns);
  void write_modes(std::span<const ModeShape> modes);
  void write_checks(std::span<const CheckResult> checks);
  void set_status(const std::string& status);
  /// Flushes everything to the operating system and closes. The file can then be opened with all that was appended.
  void close();

 private:
  struct Growing {
    hdf5::Handle set;
    hsize_t rows = 0, columns = 1;
  };
  /// Creates an extensible dataset of rows; without `columns` a plain list of numbers.
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
  /// Copies the fields of a frame from a file with the same layout. Compressed chunks are copied as they are.
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

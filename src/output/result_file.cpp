// SPDX-License-Identifier: BSD-3-Clause
#include "output/result_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cstring>

namespace engrane::output {

using hdf5::check;
using hdf5::Handle;

namespace {

/// Bytes that the first chunks of all channels may take together: short runs must not leave large files.
constexpr std::size_t first_chunks = std::size_t{4} << 20;

hsize_t chunk_of_channels(std::size_t channels) {
  return std::clamp<hsize_t>(first_chunks / sizeof(double) / std::max<std::size_t>(channels, 1), 64, 1024);
}

}  // namespace

std::vector<FieldInfo> frame_fields(const ResultsLayout& layout) {
  std::vector<FieldInfo> fields{
      {FrameField::displacement, "displacement", "displacement", dimension::length},
      {FrameField::rotation, "rotation", "rotation vector", dimension::angle},
  };
  if (layout.velocities) {
    fields.push_back({FrameField::velocity, "velocity", "velocity", dimension::velocity});
    fields.push_back({FrameField::angular_velocity, "angular_velocity", "angular velocity", dimension::angular_velocity});
  }
  fields.push_back({FrameField::reaction_force, "reaction_force", "reaction force", dimension::force});
  fields.push_back({FrameField::reaction_torque, "reaction_torque", "reaction torque", dimension::moment});
  return fields;
}

std::size_t Batch::bytes() const {
  std::size_t numbers = times.size() + values.size();
  for (const Frame& frame : frames) numbers += frame.values.size();
  return numbers * sizeof(double);
}

MixedTopology mixed_topology(const ResultsLayout& layout) {
  constexpr std::int32_t polyline = 2, triangle = 4, quadrilateral = 5;
  MixedTopology topology;
  // A vertex has no type code that all readers take the same way, and some take no polyline of more than two points.
  const auto line = [&](int a, int b, int element) {
    topology.data.insert(topology.data.end(), {polyline, 2, a, b});
    topology.elements.push_back(element);
  };
  for (const Cell& cell : layout.cells) {
    const std::size_t n = cell.points.size();
    if (cell.surface && (n == 3 || n == 4)) {
      topology.data.push_back(n == 3 ? triangle : quadrilateral);
      topology.data.insert(topology.data.end(), cell.points.begin(), cell.points.end());
      topology.elements.push_back(cell.element);
    } else if (n == 1) {
      line(cell.points[0], cell.points[0], cell.element);
    } else {
      for (std::size_t i = 0; i + 1 < n; ++i) line(cell.points[i], cell.points[i + 1], cell.element);
    }
  }
  // readers refuse a mesh without cells
  if (topology.elements.empty())
    for (int i = 0; i < static_cast<int>(layout.points.size()); ++i) line(i, i, 0);
  return topology;
}

ResultFile::ResultFile(const std::string& path, const ResultsLayout& layout, std::string shown_as)
    : path_(std::move(shown_as)), layout_(&layout) {
  hdf5::prepare();
  assert(layout.node_ids.size() == layout.points.size());
  const Handle access(check(H5Pcreate(H5P_FILE_ACCESS), path_));
  // the oldest format: every reader knows it, and it has no mark "open for writing" that a killed run would leave
  check(H5Pset_libver_bounds(access.id(), H5F_LIBVER_EARLIEST, H5F_LIBVER_V18), path_);
  check(H5Pset_file_locking(access.id(), false, true), path_);  // readers may look while the run goes on
  check(H5Pset_fclose_degree(access.id(), H5F_CLOSE_STRONG), path_);
  file_ = Handle(check(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access.id()), path_));

  const hdf5::Place root = at(file_);
  root.attribute("format", "engrane");
  root.attribute("format_version", 1);
  root.attribute("program", "engrane " + layout.version);
  root.attribute("libraries", layout.libraries);
  root.attribute("title", layout.title);
  root.attribute("analysis", layout.analysis);
  set_status("running");
  at(root.text("deck", layout.deck_text)).attribute("label", "the deck as run");
  at(root.text("model", layout.model_json)).attribute("label", "elements and their drawings, JSON");

  const Handle units = root.group("units");
  at(units).attribute("given", layout.units.given ? 1 : 0);
  at(units).attribute("length", layout.units.length);
  at(units).attribute("mass", layout.units.mass);
  at(units).attribute("time", layout.units.time);

  create_mesh();
  create_histories();
  create_fields();
}

void ResultFile::create_mesh() {
  const ResultsLayout& layout = *layout_;
  const Handle mesh = at(file_).group("mesh");
  const std::vector<std::int32_t> ids(layout.node_ids.begin(), layout.node_ids.end());
  at(at(mesh).integers("node_ids", ids)).attribute("label", "node ids of the deck");
  std::vector<double> points;
  points.reserve(3 * layout.points.size());
  for (const Vec3& p : layout.points) points.insert(points.end(), p.data(), p.data() + 3);
  const hsize_t shape[2] = {layout.points.size(), 3};
  const Handle set = at(mesh).numbers("points", points, shape);
  at(set).attribute("unit", layout.units.label(dimension::length));
  at(set).attribute("label", "reference positions");
  const MixedTopology topology = mixed_topology(layout);
  at(at(mesh).integers("topology", topology.data)).attribute("label", "XDMF mixed topology");
  at(at(mesh).integers("cell_elements", topology.elements)).attribute("label", "element of each cell");
}

void ResultFile::create_histories() {
  const ResultsLayout& layout = *layout_;
  const Handle history = at(file_).group("history");
  const hsize_t chunk = chunk_of_channels(layout.channel_count());
  time_ = create_growing(history.id(), "time", layout.units.label(dimension::time), "time", chunk);
  channels_.reserve(layout.channel_count());
  for (const ChannelGroup& owner : layout.history) {
    const Handle group = at(history).group(owner.path);
    for (const auto& [name, text] : owner.attributes) at(group).attribute(name.c_str(), text);
    for (const Named& channel : owner.channels)
      channels_.push_back(create_growing(group.id(), channel.name, layout.units.label(channel.dimension), channel.help, chunk));
  }
}

void ResultFile::create_fields() {
  const ResultsLayout& layout = *layout_;
  const Handle fields = at(file_).group("fields");
  frame_time_ = create_growing(fields.id(), "time", layout.units.label(dimension::time), "time of the frame", 64);
  for (const FieldInfo& field : frame_fields(layout)) {
    Handle group = at(fields).group(field.name);
    at(group).attribute("unit", layout.units.label(field.dimension));
    at(group).attribute("label", field.label);
    field_groups_.push_back(std::move(group));
  }
}

ResultFile::Growing ResultFile::create_growing(hid_t group, const std::string& name, const std::string& unit,
                                               const std::string& label, hsize_t chunk) const {
  const hsize_t start[1] = {0}, unlimited[1] = {H5S_UNLIMITED};
  const Handle space(check(H5Screate_simple(1, start, unlimited), path_));
  const Handle creation(check(H5Pcreate(H5P_DATASET_CREATE), path_));
  check(H5Pset_chunk(creation.id(), 1, &chunk), path_);
  check(H5Pset_fill_time(creation.id(), H5D_FILL_TIME_NEVER), path_);
  check(H5Pset_obj_track_times(creation.id(), false), path_);
  // batches are written once and whole: a cache would only copy them, and there may be thousands of channels
  const Handle access(check(H5Pcreate(H5P_DATASET_ACCESS), path_));
  check(H5Pset_chunk_cache(access.id(), 1, 0, 1), path_);
  Growing growing;
  growing.set = Handle(
      check(H5Dcreate2(group, name.c_str(), H5T_NATIVE_DOUBLE, space.id(), H5P_DEFAULT, creation.id(), access.id()), path_));
  at(growing.set).attribute("unit", unit);
  at(growing.set).attribute("label", label);
  return growing;
}

void ResultFile::grow(Growing& target, std::span<const double> values) const {
  const hsize_t count = values.size(), size = target.size + count;
  check(H5Dset_extent(target.set.id(), &size), path_);
  const Handle space(check(H5Dget_space(target.set.id()), path_));
  check(H5Sselect_hyperslab(space.id(), H5S_SELECT_SET, &target.size, nullptr, &count, nullptr), path_);
  const Handle memory(check(H5Screate_simple(1, &count, nullptr), path_));
  check(H5Dwrite(target.set.id(), H5T_NATIVE_DOUBLE, memory.id(), space.id(), H5P_DEFAULT, values.data()), path_);
  target.size = size;
}

void ResultFile::append(const Batch& batch) {
  if (!batch.times.empty()) append_samples(batch);
  for (const Batch::Frame& frame : batch.frames) append_frame(frame);
}

void ResultFile::append_samples(const Batch& batch) {
  const std::size_t samples = batch.times.size(), channels = channels_.size();
  assert(batch.values.size() == samples * channels);
  std::vector<double> column(samples);
  for (std::size_t c = 0; c < channels; ++c) {
    for (std::size_t s = 0; s < samples; ++s) column[s] = batch.values[s * channels + c];
    grow(channels_[c], column);
  }
  grow(time_, batch.times);
}

void ResultFile::append_frame(const Batch::Frame& frame) {
  const std::size_t numbers = 3 * layout_->points.size();
  assert(frame.values.size() == numbers * field_groups_.size());
  const std::string name = fmt::format("{:06}", frame_time_.size);
  const hsize_t shape[2] = {layout_->points.size(), 3};
  for (std::size_t f = 0; f < field_groups_.size(); ++f)
    at(field_groups_[f]).numbers(name, std::span(frame.values).subspan(f * numbers, numbers), shape);
  const double time[1] = {frame.time};
  grow(frame_time_, time);
}

void ResultFile::mark_not_unique(std::span<const int> channels) {
  for (const int channel : channels)
    if (not_unique_.insert(channel).second) at(channels_[static_cast<std::size_t>(channel)].set).attribute("unique", 0);
}

void ResultFile::write_checks(std::span<const CheckResult> checks) {
  struct Row {
    const char* text;
    double value, expected, tolerance;
    std::int32_t passed;
  };
  std::vector<Row> rows;
  rows.reserve(checks.size());
  for (const CheckResult& c : checks) rows.push_back({c.text.c_str(), c.value, c.expected, c.tolerance, c.passed ? 1 : 0});
  const Handle text(check(H5Tcopy(H5T_C_S1), path_));
  check(H5Tset_size(text.id(), H5T_VARIABLE), path_);
  check(H5Tset_cset(text.id(), H5T_CSET_UTF8), path_);
  const Handle type(check(H5Tcreate(H5T_COMPOUND, sizeof(Row)), path_));
  check(H5Tinsert(type.id(), "text", offsetof(Row, text), text.id()), path_);
  check(H5Tinsert(type.id(), "value", offsetof(Row, value), H5T_NATIVE_DOUBLE), path_);
  check(H5Tinsert(type.id(), "expected", offsetof(Row, expected), H5T_NATIVE_DOUBLE), path_);
  check(H5Tinsert(type.id(), "tolerance", offsetof(Row, tolerance), H5T_NATIVE_DOUBLE), path_);
  check(H5Tinsert(type.id(), "passed", offsetof(Row, passed), H5T_NATIVE_INT32), path_);
  const hsize_t count = rows.size();
  const Handle space(check(H5Screate_simple(1, &count, nullptr), path_));
  const Handle set(check(H5Dcreate2(file_.id(), "checks", type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), path_));
  if (count > 0) check(H5Dwrite(set.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, rows.data()), path_);
  at(set).attribute("label", "what the deck's .CHK asked for and what came of it");
}

void ResultFile::set_status(const std::string& status) { at(file_).attribute("status", status); }

void ResultFile::flush() { check(H5Fflush(file_.id(), H5F_SCOPE_GLOBAL), path_); }

void ResultFile::close() {
  flush();
  channels_.clear();
  time_ = {};
  frame_time_ = {};
  field_groups_.clear();
  check(H5Fclose(file_.release()), path_);
}

void ResultFile::abandon() noexcept {
  channels_.clear();
  time_.set.close();
  frame_time_.set.close();
  field_groups_.clear();
  file_.close();
}

}  // namespace engrane::output

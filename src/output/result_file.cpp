// SPDX-License-Identifier: BSD-3-Clause
#include "output/result_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>

namespace engrane::output {

using hdf5::check;
using hdf5::Handle;

namespace {

/// Maximum chunk size of a table, in bytes.
constexpr std::size_t chunk_bytes = std::size_t{1} << 20;
/// Maximum number of rows per chunk: this many samples of one channel are read at once.
constexpr hsize_t most_chunk_rows = 1024;

/// Size of equal pieces of at most `most`. Chunks are stored whole, so a nearly empty last one would waste space.
hsize_t even_pieces(hsize_t total, hsize_t most) {
  const hsize_t pieces = (total + most - 1) / most;
  return pieces == 0 ? 1 : (total + pieces - 1) / pieces;
}

std::string table_place(const HistoryTable& table) { return "history/" + table.path; }

/// Type code in XDMF 3. Elements that are not cells of a mesh are polylines.
std::int32_t xdmf_code(CellShape shape) {
  // in the order of CellShape
  static constexpr std::array<std::int32_t, 11> codes{2, 4, 36, 5, 37, 6, 38, 8, 40, 9, 48};
  return codes.at(static_cast<std::size_t>(shape));
}

std::string frame_name(std::size_t index) { return fmt::format("{:06}", index); }

}  // namespace

std::size_t Batch::bytes() const {
  std::size_t numbers = times.size() + values.size();
  for (const Frame& frame : frames)
    for (const auto* fields : {&frame.values.nodes, &frame.values.cells, &frame.values.points, &frame.values.averages})
      for (const std::vector<double>& field : *fields) numbers += field.size();
  for (const RestartPoint& point : restarts)
    for (const auto& [name, array] : point.memory.arrays()) numbers += array.size();
  return numbers * sizeof(double);
}

MixedTopology mixed_topology(const ResultsLayout& layout) {
  const std::int32_t polyline = xdmf_code(CellShape::none);
  MixedTopology topology;
  // Readers disagree on the type code of a vertex, and some do not accept polylines of more than two points.
  const auto line = [&](int a, int b, int element) {
    topology.data.insert(topology.data.end(), {polyline, 2, a, b});
    topology.elements.push_back(element);
  };
  for (std::size_t c = 0; c < layout.cells.size(); ++c) {
    const Cell& cell = layout.cells[c];
    const std::size_t n = cell.points.size();
    if (cell.shape != CellShape::none) {
      topology.data.push_back(xdmf_code(cell.shape));
      topology.data.insert(topology.data.end(), cell.points.begin(), cell.points.end());
      topology.elements.push_back(cell.element);
    } else if (n == 1) {
      line(cell.points[0], cell.points[0], cell.element);
    } else {
      for (std::size_t i = 0; i + 1 < n; ++i) line(cell.points[i], cell.points[i + 1], cell.element);
    }
    topology.cells.resize(topology.elements.size(), c);
  }
  // readers reject a mesh without cells
  if (topology.elements.empty())
    for (int i = 0; i < static_cast<int>(layout.points.size()); ++i) line(i, i, 0);
  return topology;
}

ResultFile::ResultFile(const std::string& path, const ResultsLayout& layout, std::string shown_as, Mode mode)
    : path_(std::move(shown_as)), layout_(&layout) {
  assert(layout.node_ids.size() == layout.points.size());
  const Handle access = hdf5::file_access(path_);
  file_ = Handle(check(mode == Mode::create ? H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access.id())
                                            : H5Fopen(path.c_str(), H5F_ACC_RDWR, access.id()),
                       path_));
  if (mode == Mode::create) create_all();
}

ResultFile::~ResultFile() = default;

void ResultFile::create_all() {
  const ResultsLayout& layout = *layout_;
  const hdf5::Place root = at(file_);
  root.attribute("format", "engrane");
  root.attribute("format_version", format_version);
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
  root.group("restart");
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
  const hsize_t rows = even_pieces(layout.expected_samples, most_chunk_rows);
  create_growing(history.id(), "time", {}, rows, layout.units.label(dimension::time), "time");
  for (const HistoryTable& table : layout.history) {
    const Handle group = at(history).group(table.path);
    if (!table.type.empty()) at(group).attribute("type", table.type);
    if (!table.ids.empty()) at(group).integers("ids", std::vector<std::int32_t>(table.ids.begin(), table.ids.end()));
    std::vector<std::string> names, units, labels;
    for (const Named& channel : table.channels) {
      names.push_back(channel.name);
      units.push_back(layout.units.label(channel.dimension));
      labels.push_back(channel.help);
    }
    at(group).texts("channels", names);
    at(group).texts("units", units);
    at(group).texts("labels", labels);
    create_growing(group.id(), "values", table.columns(), rows, "", "a row per sample, the channels of each owner side by side");
  }
}

void ResultFile::create_fields() {
  const ResultsLayout& layout = *layout_;
  const Handle fields = at(file_).group("fields");
  create_growing(fields.id(), "time", {}, 64, layout.units.label(dimension::time), "time of the frame");
  for (const Named& field : layout.node_fields) {
    const Handle group = at(fields).group(field.name);
    at(group).attribute("unit", layout.units.label(field.dimension));
    at(group).attribute("label", field.help);
  }
  const auto describe = [&](const Handle& group, const CellField& field, const std::string& center) {
    at(group).attribute("unit", layout.units.label(field.named.dimension));
    at(group).attribute("label", field.named.help);
    at(group).attribute("center", center);
    if (!field.components.empty()) at(group).attribute("components", fmt::format("{}", fmt::join(field.components, " ")));
  };
  for (const CellField& field : layout.cell_fields) describe(at(fields).group(field.named.name), field, "Cell");
  if (!layout.averages.empty()) {
    const Handle nodes = at(file_).group("nodes");
    for (const CellField& field : layout.averages) describe(at(nodes).group(field.named.name), field, "Node");
  }
  if (layout.point_fields.empty()) return;
  const Handle points = at(file_).group("points");
  for (const PointField& one : layout.point_fields) {
    const Handle group = at(points).group(one.field.named.name);
    describe(group, one.field, "Point");
    at(at(group).integers("elements", one.elements)).attribute("label", "element of each row");
    at(at(group).integers("numbers", one.points)).attribute("label", "node or integration point of that element, from 0");
  }
}

void ResultFile::create_growing(hid_t group, const std::string& name, std::optional<hsize_t> columns, hsize_t chunk_rows,
                                const std::string& unit, const std::string& label) const {
  const int rank = columns ? 2 : 1;
  const hsize_t start[2] = {0, columns.value_or(1)}, limit[2] = {H5S_UNLIMITED, columns.value_or(1)};
  const hsize_t chunk[2] = {chunk_rows,
                            even_pieces(columns.value_or(1), std::max<hsize_t>(1, chunk_bytes / sizeof(double) / chunk_rows))};
  const Handle space(check(H5Screate_simple(rank, start, limit), path_));
  const Handle creation(check(H5Pcreate(H5P_DATASET_CREATE), path_));
  check(H5Pset_chunk(creation.id(), rank, chunk), path_);
  check(H5Pset_fill_time(creation.id(), H5D_FILL_TIME_NEVER), path_);
  check(H5Pset_obj_track_times(creation.id(), false), path_);
  const Handle set(
      check(H5Dcreate2(group, name.c_str(), H5T_NATIVE_DOUBLE, space.id(), H5P_DEFAULT, creation.id(), H5P_DEFAULT), path_));
  if (!columns) at(set).attribute("unit", unit);
  at(set).attribute("label", label);
}

ResultFile::Growing ResultFile::open_growing(const std::string& name) const {
  // rows are written once and completely, so a cache would only copy them
  const Handle access(check(H5Pcreate(H5P_DATASET_ACCESS), path_));
  check(H5Pset_chunk_cache(access.id(), 1, 0, 1), path_);
  Growing growing;
  growing.set = Handle(check(H5Dopen2(file_.id(), name.c_str(), access.id()), path_));
  const Handle space(check(H5Dget_space(growing.set.id()), path_));
  hsize_t extent[2] = {0, 1};
  check(H5Sget_simple_extent_dims(space.id(), extent, nullptr), path_);
  growing.rows = extent[0];
  growing.columns = extent[1];
  return growing;
}

void ResultFile::grow(Growing& target, const double* values, std::size_t rows) const {
  const hsize_t count[2] = {rows, target.columns}, start[2] = {target.rows, 0}, size[2] = {target.rows + rows, target.columns};
  check(H5Dset_extent(target.set.id(), size), path_);
  const Handle space(check(H5Dget_space(target.set.id()), path_));
  check(H5Sselect_hyperslab(space.id(), H5S_SELECT_SET, start, nullptr, count, nullptr), path_);
  const Handle memory(check(H5Screate_simple(H5Sget_simple_extent_ndims(space.id()), count, nullptr), path_));
  check(H5Dwrite(target.set.id(), H5T_NATIVE_DOUBLE, memory.id(), space.id(), H5P_DEFAULT, values), path_);
  target.rows += rows;
}

void ResultFile::append(const Batch& batch, hid_t other) {
  if (!batch.times.empty()) append_samples(batch);
  for (const Batch::Frame& frame : batch.frames) {
    Growing time = open_growing("fields/time");
    if (frame.written)
      copy_frame(other, frame_name(time.rows));
    else
      append_frame(frame, frame_name(time.rows));
    grow(time, &frame.time, 1);
  }
  for (const RestartPoint& point : batch.restarts) write_restart(frame_name(kept_restarts(file_.id()).size()), point, true);
}

void ResultFile::append_samples(const Batch& batch) {
  const std::size_t samples = batch.times.size(), width = layout_->channel_count();
  assert(batch.values.size() == samples * width);
  std::vector<double> block;
  std::size_t first = 0;
  for (const HistoryTable& table : layout_->history) {
    const std::size_t columns = table.columns();
    block.resize(samples * columns);
    for (std::size_t s = 0; s < samples; ++s)
      std::copy_n(batch.values.data() + s * width + first, columns, block.data() + s * columns);
    Growing target = open_growing(table_place(table) + "/values");
    grow(target, block.data(), samples);
    first += columns;
  }
  Growing time = open_growing("history/time");
  grow(time, batch.times.data(), samples);
}

void ResultFile::copy_frame(hid_t other, const std::string& name) {
  const auto copy = [&](const char* group, const Named& field) {
    const std::string place = fmt::format("{}/{}/{}", group, field.name, name);
    check(H5Ocopy(other, place.c_str(), file_.id(), place.c_str(), H5P_DEFAULT, H5P_DEFAULT), path_);
  };
  for (const Named& field : layout_->node_fields) copy("fields", field);
  for (const CellField& field : layout_->cell_fields) copy("fields", field.named);
  for (const PointField& one : layout_->point_fields) copy("points", one.field.named);
  for (const CellField& field : layout_->averages) copy("nodes", field.named);
}

void ResultFile::append_frame(const Batch::Frame& frame, const std::string& name) {
  const hsize_t shape[2] = {layout_->points.size(), 3};
  for (std::size_t f = 0; f < layout_->node_fields.size(); ++f) {
    assert(frame.values.nodes[f].size() == 3 * layout_->points.size());
    at(file_).numbers(fmt::format("fields/{}/{}", layout_->node_fields[f].name, name), frame.values.nodes[f], shape);
  }
  append_cell_fields(frame, name);
  append_point_fields(frame, name);
  append_averages(frame, name);
}

void ResultFile::append_cell_fields(const Batch::Frame& frame, const std::string& name) {
  if (layout_->cell_fields.empty()) return;
  const std::vector<std::size_t> cells = mixed_topology(*layout_).cells;
  for (std::size_t f = 0; f < layout_->cell_fields.size(); ++f) {
    const CellField& field = layout_->cell_fields[f];
    assert(frame.values.cells[f].size() == layout_->cells.size() * field.width());
    std::vector<double> rows;
    rows.reserve(cells.size() * field.width());
    for (const std::size_t cell : cells)
      for (std::size_t k = 0; k < field.width(); ++k) rows.push_back(frame.values.cells[f][cell * field.width() + k]);
    const hsize_t shape[2] = {cells.size(), field.width()};
    at(file_).numbers(fmt::format("fields/{}/{}", field.named.name, name), rows, shape);
  }
}

void ResultFile::append_point_fields(const Batch::Frame& frame, const std::string& name) {
  for (std::size_t f = 0; f < layout_->point_fields.size(); ++f) {
    const PointField& one = layout_->point_fields[f];
    assert(frame.values.points[f].size() == one.rows() * one.field.width());
    const hsize_t shape[2] = {one.rows(), one.field.width()};
    at(file_).numbers(fmt::format("points/{}/{}", one.field.named.name, name), frame.values.points[f], shape);
  }
}

void ResultFile::append_averages(const Batch::Frame& frame, const std::string& name) {
  for (std::size_t f = 0; f < layout_->averages.size(); ++f) {
    const CellField& field = layout_->averages[f];
    assert(frame.values.averages[f].size() == layout_->points.size() * field.width());
    const hsize_t shape[2] = {layout_->points.size(), field.width()};
    at(file_).numbers(fmt::format("nodes/{}/{}", field.named.name, name), frame.values.averages[f], shape);
  }
}

void ResultFile::write_restart(const std::string& name, const RestartPoint& point, bool compressed) {
  const Handle group = at(file_).group("restart/" + name);
  at(group).attribute("time", point.time);
  at(group).attribute("samples", static_cast<double>(point.samples));
  at(group).attribute("frames", static_cast<double>(point.frames));
  for (const auto& [array, values] : point.memory.arrays()) {
    const hsize_t shape[1] = {values.size()};
    if (compressed)
      at(group).numbers(array, values, shape);
    else
      at(group).plain_numbers(array, values);
  }
}

void ResultFile::write_latest(const RestartPoint& point, bool last) {
  // keep the size of what is overwritten every second, or the file would grow with every batch
  const Handle before(
      H5Lexists(file_.id(), "restart/latest", H5P_DEFAULT) > 0 ? H5Gopen2(file_.id(), "restart/latest", H5P_DEFAULT) : -1);
  bool fits = before.id() >= 0 && !last;
  for (const auto& [array, values] : point.memory.arrays()) {
    if (!fits) break;
    const std::vector<hsize_t> shape = hdf5::read_shape(before.id(), array);
    fits = shape.size() == 1 && shape[0] == values.size();
  }
  if (!fits) {
    if (before.id() >= 0) check(H5Ldelete(file_.id(), "restart/latest", H5P_DEFAULT), path_);
    write_restart("latest", point, last);
    return;
  }
  at(before).attribute("time", point.time);
  at(before).attribute("samples", static_cast<double>(point.samples));
  at(before).attribute("frames", static_cast<double>(point.frames));
  for (const auto& [array, values] : point.memory.arrays()) {
    const Handle set(check(H5Dopen2(before.id(), array.c_str(), H5P_DEFAULT), path_));
    if (!values.empty()) check(H5Dwrite(set.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), path_);
  }
}

void ResultFile::mark_not_unique(std::span<const int> columns) {
  std::size_t first = 0;
  for (const HistoryTable& table : layout_->history) {
    const std::size_t count = table.columns();
    std::vector<std::int32_t> unique(count, 1);
    bool all = true;
    for (const int column : columns)
      if (const auto c = static_cast<std::size_t>(column); c >= first && c < first + count) {
        unique[c - first] = 0;
        all = false;
      }
    first += count;
    if (all) continue;
    const std::string name = table_place(table) + "/unique";
    if (H5Lexists(file_.id(), name.c_str(), H5P_DEFAULT) > 0) check(H5Ldelete(file_.id(), name.c_str(), H5P_DEFAULT), path_);
    at(at(file_).integers(name, unique)).attribute("label", "0: the least of many values that balance the same loads");
  }
}

void ResultFile::write_modes(std::span<const ModeShape> modes) {
  const Handle group = at(file_).group("modes");
  std::vector<double> times;
  const hsize_t shape[2] = {layout_->points.size(), 3};
  for (std::size_t i = 0; i < modes.size(); ++i) {
    times.push_back(modes[i].load_time);
    const Handle set = at(group).numbers(fmt::format("mode_{}", i + 1), modes[i].displacement, shape);
    at(set).attribute("label", "displacements, the largest component 1");
    const Handle turns = at(group).numbers(fmt::format("rotation_{}", i + 1), modes[i].rotation, shape);
    at(turns).attribute("label", "rotations in the same scale");
  }
  const hsize_t count[1] = {times.size()};
  const Handle set = at(group).numbers("load_time", times, count);
  at(set).attribute("unit", layout_->units.label(dimension::time));
  at(set).attribute("label", "time of functions at which the model buckles, by linearisation");
}

void ResultFile::write_checks(std::span<const CheckResult> checks) {
  struct Row {
    const char* text;
    double value, expected, tolerance;
    std::int32_t passed;
  };
  std::vector<std::string> texts;
  for (const CheckResult& c : checks) texts.push_back(hdf5::utf8(c.text));
  std::vector<Row> rows;
  rows.reserve(checks.size());
  for (const CheckResult& c : checks)
    rows.push_back({texts[rows.size()].c_str(), c.value, c.expected, c.tolerance, c.passed ? 1 : 0});
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

void ResultFile::close() {
  check(H5Fflush(file_.id(), H5F_SCOPE_GLOBAL), path_);
  check(H5Fclose(file_.release()), path_);
}

std::vector<std::string> kept_restarts(hid_t file) {
  std::vector<std::string> names;
  for (;; names.push_back(frame_name(names.size())))
    if (H5Lexists(file, ("restart/" + frame_name(names.size())).c_str(), H5P_DEFAULT) <= 0) return names;
}

}  // namespace engrane::output

// SPDX-License-Identifier: BSD-3-Clause
// What a restarted run takes over from the file that it continues.
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>

#include "output/result_file.hpp"

namespace engrane::output {

using hdf5::check;
using hdf5::Handle;

namespace {

/// Number of rows that are copied at a time.
constexpr std::size_t block_rows = 1024;

/// A table of the earlier file.
struct Source {
  Handle values;
  std::size_t columns = 0;
  std::vector<double> block;
};

/// Position of a channel in the earlier file.
struct Origin {
  std::size_t table = 0, column = 0;
  bool unique = true;
};

struct Sources {
  std::vector<Source> tables;
  std::map<std::string, Origin> channels;  ///< key: `element/7/NORMAL_FORCE`

  void add(hid_t file, const std::string& path) {
    const std::string place = "history/" + path;
    Source source;
    source.values = Handle(H5Dopen2(file, (place + "/values").c_str(), H5P_DEFAULT));
    const std::vector<hsize_t> shape = hdf5::read_shape(file, place + "/values");
    const std::vector<std::string> names = hdf5::read_texts(file, place + "/channels");
    const bool owned = H5Lexists(file, (place + "/ids").c_str(), H5P_DEFAULT) > 0;
    const std::vector<double> ids = owned ? hdf5::read_numbers(file, place + "/ids") : std::vector<double>{};
    const std::vector<double> unique = H5Lexists(file, (place + "/unique").c_str(), H5P_DEFAULT) > 0
                                           ? hdf5::read_numbers(file, place + "/unique")
                                           : std::vector<double>{};
    if (shape.size() != 2) return;
    source.columns = shape[1];
    const std::string kind = path.substr(0, path.find('/'));
    for (std::size_t c = 0; c < source.columns; ++c) {
      const std::string owner = owned ? fmt::format("{}/{}", kind, ids[c / names.size()]) : path;
      channels[owner + "/" + names[c % names.size()]] = {tables.size(), c, unique.empty() || unique[c] != 0};
    }
    tables.push_back(std::move(source));
  }
};

/// Paths of all tables, relative to /history.
std::vector<std::string> table_paths(hid_t file) {
  std::vector<std::string> paths;
  const Handle history(H5Gopen2(file, "history", H5P_DEFAULT));
  H5Lvisit(
      history.id(), H5_INDEX_NAME, H5_ITER_INC,
      [](hid_t, const char* name, const H5L_info_t*, void* data) -> herr_t {
        const std::string path = name, ending = "/values";
        if (path.size() > ending.size() && path.ends_with(ending))
          static_cast<std::vector<std::string>*>(data)->push_back(path.substr(0, path.size() - ending.size()));
        return 0;
      },
      &paths);
  return paths;
}

void read_rows(const Source& source, std::size_t first, std::size_t rows, std::vector<double>& block, const std::string& path) {
  block.resize(rows * source.columns);
  const hsize_t start[2] = {first, 0}, count[2] = {rows, source.columns};
  const Handle space(check(H5Dget_space(source.values.id()), path));
  check(H5Sselect_hyperslab(space.id(), H5S_SELECT_SET, start, nullptr, count, nullptr), path);
  const Handle memory(check(H5Screate_simple(2, count, nullptr), path));
  check(H5Dread(source.values.id(), H5T_NATIVE_DOUBLE, memory.id(), space.id(), H5P_DEFAULT, block.data()), path);
}

}  // namespace

void ResultFile::copy_histories(hid_t earlier, std::size_t samples) {
  Sources sources;
  for (const std::string& path : table_paths(earlier)) sources.add(earlier, path);
  std::vector<const Origin*> origins;
  std::vector<int> not_unique;
  for (const HistoryTable& table : layout_->history)
    for (std::size_t owner = 0; owner < table.owners(); ++owner)
      for (const Named& channel : table.channels) {
        const auto found = sources.channels.find(table.owner(owner) + "/" + channel.name);
        origins.push_back(found == sources.channels.end() ? nullptr : &found->second);
        if (origins.back() && !origins.back()->unique) not_unique.push_back(static_cast<int>(origins.size()) - 1);
      }
  std::vector<double> times = hdf5::read_numbers(earlier, "history/time");
  times.resize(std::min(times.size(), samples));
  for (std::size_t first = 0; first < times.size(); first += block_rows) {
    const std::size_t rows = std::min(block_rows, times.size() - first);
    for (Source& source : sources.tables) read_rows(source, first, rows, source.block, path_);
    Batch batch;
    batch.times.assign(times.begin() + static_cast<std::ptrdiff_t>(first),
                       times.begin() + static_cast<std::ptrdiff_t>(first + rows));
    batch.values.resize(rows * origins.size(), std::numeric_limits<double>::quiet_NaN());
    for (std::size_t r = 0; r < rows; ++r)
      for (std::size_t c = 0; c < origins.size(); ++c)
        if (const Origin* origin = origins[c]) {
          const Source& source = sources.tables[origin->table];
          batch.values[r * origins.size() + c] = source.block[r * source.columns + origin->column];
        }
    append_samples(batch);
  }
  if (!not_unique.empty()) mark_not_unique(not_unique);
}

std::vector<double> ResultFile::copy_from(hid_t earlier, std::size_t samples, std::size_t frames) {
  copy_histories(earlier, samples);

  std::vector<double> times = hdf5::read_numbers(earlier, "fields/time");
  times.resize(std::min(times.size(), frames));
  // a field that the earlier run did not have: zero at nodes, NaN elsewhere
  const auto bring = [&](const std::string& name, hsize_t rows, hsize_t columns, double missing) {
    const hsize_t shape[2] = {rows, columns};
    const std::vector<hsize_t> found = hdf5::read_shape(earlier, name);
    if (found.size() == 2 && found[0] == rows && found[1] == columns)
      check(H5Ocopy(earlier, name.c_str(), file_.id(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), path_);
    else
      at(file_).numbers(name, std::vector<double>(rows * columns, missing), shape);
  };
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  const std::size_t cells = layout_->cell_fields.empty() ? 0 : mixed_topology(*layout_).cells.size();
  for (std::size_t f = 0; f < times.size(); ++f) {
    for (const Named& field : layout_->node_fields)
      bring(fmt::format("fields/{}/{:06}", field.name, f), layout_->points.size(), 3, 0);
    for (const CellField& field : layout_->cell_fields)
      bring(fmt::format("fields/{}/{:06}", field.named.name, f), cells, field.width(), unknown);
    for (const PointField& one : layout_->point_fields)
      bring(fmt::format("points/{}/{:06}", one.field.named.name, f), one.rows(), one.field.width(), unknown);
    for (const CellField& field : layout_->averages)
      bring(fmt::format("nodes/{}/{:06}", field.named.name, f), layout_->points.size(), field.width(), unknown);
  }
  if (!times.empty()) {
    Growing list = open_growing("fields/time");
    grow(list, times.data(), times.size());
  }

  for (const std::string& name : kept_restarts(earlier)) {
    const std::string place = "restart/" + name;
    const Handle group(H5Gopen2(earlier, place.c_str(), H5P_DEFAULT));
    if (hdf5::read_number_attribute(group.id(), "samples", 0) > static_cast<double>(samples)) break;
    check(H5Ocopy(earlier, place.c_str(), file_.id(), place.c_str(), H5P_DEFAULT, H5P_DEFAULT), path_);
  }
  return times;
}

}  // namespace engrane::output

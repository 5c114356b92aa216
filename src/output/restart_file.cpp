// SPDX-License-Identifier: BSD-3-Clause
#include "output/restart_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string_view>
#include <system_error>

#include "base/text.hpp"

namespace engrane::output {

namespace {

std::string find_result(const std::string& prefix) {
  for (const char* ending : {".h5", ".partial.h5", ""})
    if (const std::string path = prefix + ending; std::filesystem::is_regular_file(path)) return path;
  throw RestartError(fmt::format("Cannot restart from {}: there is no file {}.h5.", prefix, prefix));
}

/// Name and time of a restart point.
struct Entry {
  std::string name;
  double time = 0;
};

std::vector<Entry> entries(hid_t file) {
  std::vector<std::string> names = kept_restarts(file);
  if (H5Lexists(file, "restart", H5P_DEFAULT) > 0 && H5Lexists(file, "restart/latest", H5P_DEFAULT) > 0)
    names.emplace_back("latest");
  std::vector<Entry> found;
  for (const std::string& name : names) {
    const hdf5::Handle group(H5Gopen2(file, ("restart/" + name).c_str(), H5P_DEFAULT));
    found.push_back({name, hdf5::read_number_attribute(group.id(), "time", std::nan(""))});
  }
  std::stable_sort(found.begin(), found.end(), [](const Entry& a, const Entry& b) { return a.time < b.time; });
  return found;
}

/// Times as a list that fits in a sentence: the first and last few if there are many.
std::string list_of(const std::vector<Entry>& points) {
  constexpr std::size_t shown = 4;
  std::string list;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points.size() > 2 * shown && i == shown) {
      list += ", …";
      i = points.size() - shown;
    }
    list += (list.empty() ? "" : ", ") + format_number(points[i].time);
  }
  return list;
}

}  // namespace

RestartFile::RestartFile(const std::string& prefix) : path_(find_result(prefix)), file_(hdf5::open_for_reading(path_)) {
  if (file_.id() < 0 || hdf5::read_text_attribute(file_.id(), "format") != "engrane")
    throw RestartError(fmt::format("Cannot restart from {}: it is not a result of engrane.", path_));
  const double version = hdf5::read_number_attribute(file_.id(), "format_version", 0);
  if (version != format_version)
    throw RestartError(
        fmt::format("Cannot restart from {}: its format has version {}, this program's has {}.", path_, version, format_version));
}

std::string RestartFile::deck_text() const {
  const std::vector<std::string> texts = hdf5::read_texts(file_.id(), "deck");
  return texts.empty() ? "" : texts.front();
}

std::string RestartFile::model_json() const {
  const std::vector<std::string> texts = hdf5::read_texts(file_.id(), "model");
  return texts.empty() ? "" : texts.front();
}

std::vector<double> RestartFile::times() const {
  std::vector<double> times;
  for (const Entry& entry : entries(file_.id())) times.push_back(entry.time);
  return times;
}

bool RestartFile::is_empty() const {
  const std::vector<hsize_t> samples = hdf5::read_shape(file_.id(), "history/time");
  return hdf5::read_text_attribute(file_.id(), "status") == "running" && entries(file_.id()).empty() &&
         (samples.empty() || samples[0] == 0);
}

std::string RestartFile::advice_on_newer_partial() const {
  constexpr std::string_view ending = ".h5", partial_ending = ".partial.h5";
  if (!path_.ends_with(ending) || path_.ends_with(partial_ending)) return {};
  const std::string stem = path_.substr(0, path_.size() - ending.size()) + ".partial", partial = stem + std::string(ending);
  std::error_code missing, unknown;
  const auto written = std::filesystem::last_write_time(partial, missing), own = std::filesystem::last_write_time(path_, unknown);
  if (missing || unknown || written <= own) return {};
  const hdf5::Handle file(hdf5::open_for_reading(partial));
  if (file.id() < 0) return {};
  const std::vector<Entry> points = entries(file.id());
  if (points.empty()) return {};
  return fmt::format(
      "The newer {}, of a run that was not completed, can be continued from t = {}: --restart {}, or RESTART \"{}\"", partial,
      format_number(points.back().time), stem, stem);
}

RestartPoint RestartFile::load(std::optional<double> time) const {
  const std::vector<Entry> points = entries(file_.id());
  if (points.empty())
    throw RestartError(fmt::format(
        "Cannot restart from {}: it holds no restart point. Without --restart or RESTART the run starts from the beginning.",
        path_));
  // a time given with fewer digits means the same restart point, as times are sums of steps
  const auto after = [&](double t) { return t > *time + 1e-9 * std::max(std::abs(t), std::abs(*time)); };
  const Entry* chosen = nullptr;
  for (const Entry& point : points)
    if (!time || !after(point.time)) chosen = &point;
  if (!chosen)
    throw RestartError(fmt::format("Cannot restart from {} at t = {}: its restart points are at t = {}.", path_,
                                   format_number(*time), list_of(points)));

  const hdf5::Handle group(H5Gopen2(file_.id(), ("restart/" + chosen->name).c_str(), H5P_DEFAULT));
  RestartPoint result;
  result.time = chosen->time;
  result.samples = static_cast<std::size_t>(hdf5::read_number_attribute(group.id(), "samples", 0));
  result.frames = static_cast<std::size_t>(hdf5::read_number_attribute(group.id(), "frames", 0));
  std::vector<std::string> names;
  H5Lvisit(
      group.id(), H5_INDEX_NAME, H5_ITER_INC,
      [](hid_t place, const char* name, const H5L_info_t*, void* data) -> herr_t {
        const hdf5::Handle object(H5Oopen(place, name, H5P_DEFAULT));
        if (H5Iget_type(object.id()) == H5I_DATASET) static_cast<std::vector<std::string>*>(data)->emplace_back(name);
        return 0;
      },
      &names);
  for (const std::string& name : names) {
    const std::vector<hsize_t> shape = hdf5::read_shape(group.id(), name);
    std::vector<double> values = hdf5::read_numbers(group.id(), name);
    if (shape.size() != 1 || values.size() != shape[0])
      throw RestartError(fmt::format("Cannot restart from {}: its restart point at t = {} is damaged ({} cannot be read).", path_,
                                     format_number(result.time), name));
    result.memory.put(name, std::move(values));
  }
  return result;
}

}  // namespace engrane::output

// SPDX-License-Identifier: BSD-3-Clause
#include "output/hdf5_handle.hpp"

#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <vector>

#include "base/text.hpp"
#include "output/error.hpp"

namespace engrane::output::hdf5 {

void prepare() {
  // At exit, the library would close what is still open, and crash on a file that it could not close because the disk was full.
  // We close our files ourselves.
  H5dont_atexit();
  H5open();
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

Handle open_for_reading(const std::string& path) {
  prepare();
  const Handle access(H5Pcreate(H5P_FILE_ACCESS));
  H5Pset_file_locking(access.id(), false, true);
  return Handle(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access.id()));
}

Handle file_access(const std::string& path) {
  prepare();
  Handle access(check(H5Pcreate(H5P_FILE_ACCESS), path));
  // the oldest format: every reader knows it, and a killed run leaves no "open for writing" flag in it
  check(H5Pset_libver_bounds(access.id(), H5F_LIBVER_EARLIEST, H5F_LIBVER_V18), path);
  check(H5Pset_file_locking(access.id(), false, true), path);  // readers may look during the run
  check(H5Pset_fclose_degree(access.id(), H5F_CLOSE_STRONG), path);
  return access;
}

std::string reason_of_failure() {
  std::string reason;
  // walk from the outermost call to the one that failed: the last message is the most specific
  H5Ewalk2(
      H5E_DEFAULT, H5E_WALK_DOWNWARD,
      [](unsigned, const H5E_error2_t* entry, void* data) -> herr_t {
        auto& text = *static_cast<std::string*>(data);
        const std::string description = entry->desc ? entry->desc : "";
        // drivers quote the system: "… errno = 28, error message = 'No space left on device', buf = …"
        const std::string mark = "error message = '";
        const std::size_t start = description.find(mark);
        if (start != std::string::npos) {
          const std::size_t from = start + mark.size();
          text = description.substr(from, description.find('\'', from) - from);
        } else {
          text = description;
        }
        return 0;
      },
      &reason);
  return reason.empty() ? "the HDF5 library gives no reason" : reason;
}

void fail(const std::string& path) { throw OutputError(path, reason_of_failure()); }

namespace {

Handle text_type() {
  Handle type(H5Tcopy(H5T_C_S1));
  H5Tset_size(type.id(), H5T_VARIABLE);
  H5Tset_cset(type.id(), H5T_CSET_UTF8);
  return type;
}

void write_attribute(const Place& place, const char* name, hid_t type, const void* value) {
  if (H5Aexists(place.id, name) > 0) check(H5Adelete(place.id, name), place.file);
  const Handle space(check(H5Screate(H5S_SCALAR), place.file));
  const Handle attribute(check(H5Acreate2(place.id, name, type, space.id(), H5P_DEFAULT, H5P_DEFAULT), place.file));
  check(H5Awrite(attribute.id(), type, value), place.file);
}

/// Arrays up to this size in bytes are stored in the header of their object, larger ones may be compressed.
constexpr std::size_t small = 4096;
/// Chunk size of a compressed array, in bytes.
constexpr std::size_t most_of_chunk = std::size_t{1} << 20;

/// Arrays of numbers below this size in bytes are always compressed: a file has many of them.
constexpr std::size_t worth_a_trial = std::size_t{1} << 16;
/// Arrays of numbers are stored uncompressed if deflate would leave more than this fraction. All digits of computed stresses
/// differ: deflate leaves 0.74 to 0.79 of them, and 0.58 of displacements in a plane, both at 0.1 GB/s, which is slower than a
/// disk.
constexpr double most_left = 0.5;

/// Whether shuffle and deflate reduce an array of numbers enough to be worth their time, judged by a few samples of it.
bool shrinks(const double* values, std::size_t count) {
  constexpr std::size_t length = 2048, width = sizeof(double);
  const std::size_t stretches = std::clamp<std::size_t>(count / (4 * length), 1, 16);
  std::vector<unsigned char> shuffled(length * width), deflated(compressBound(length * width));
  std::size_t before = 0, after = 0;
  for (std::size_t s = 0; s < stretches; ++s) {
    const auto* bytes = reinterpret_cast<const unsigned char*>(values + (2 * s + 1) * (count - length) / (2 * stretches));
    for (std::size_t i = 0; i < length; ++i)
      for (std::size_t k = 0; k < width; ++k) shuffled[k * length + i] = bytes[i * width + k];
    uLongf size = deflated.size();
    if (compress2(deflated.data(), &size, shuffled.data(), shuffled.size(), 1) != Z_OK) return true;
    before += shuffled.size();
    after += size;
  }
  return static_cast<double>(after) <= most_left * static_cast<double>(before);
}

/// Creation properties of a dataset. `size` is the size of one value in bytes.
Handle storage(const Place& place, std::span<const hsize_t> shape, std::size_t size, bool compressed) {
  Handle creation(check(H5Pcreate(H5P_DATASET_CREATE), place.file));
  check(H5Pset_obj_track_times(creation.id(), false), place.file);
  // Headers without room for attributes: with it, a third of the headers is free space, and how much depends on the batches in
  // which a run writes.
  check(H5Pset_dset_no_attrs_hint(creation.id(), true), place.file);
  hsize_t count = 1;
  for (const hsize_t n : shape) count *= n;
  if (count * size <= small) {
    if (count > 0) check(H5Pset_layout(creation.id(), H5D_COMPACT), place.file);
    return creation;
  }
  if (!compressed || H5Zfilter_avail(H5Z_FILTER_DEFLATE) <= 0) return creation;
  std::vector<hsize_t> chunk(shape.begin(), shape.end());
  chunk[0] = std::clamp<hsize_t>(most_of_chunk / (count / shape[0] * size), 1, shape[0]);
  check(H5Pset_chunk(creation.id(), static_cast<int>(chunk.size()), chunk.data()), place.file);
  check(H5Pset_shuffle(creation.id()), place.file);
  check(H5Pset_deflate(creation.id(), 1), place.file);
  return creation;
}

/// How the values of an array are stored.
enum class Keep : unsigned char {
  deflated,
  plain,
  nothing  ///< all are zero, which HDF5 assumes for values never written
};

bool all_zero(const double* values, std::size_t count) {
  // compare bits: a negative zero must be written
  return std::all_of(values, values + count, [](double value) { return std::bit_cast<std::uint64_t>(value) == 0; });
}

Keep best_way(const double* values, std::size_t count) {
  if (count * sizeof(double) < worth_a_trial) return Keep::deflated;
  if (all_zero(values, count)) return Keep::nothing;
  return shrinks(values, count) ? Keep::deflated : Keep::plain;
}

Handle write_array(const Place& place, const std::string& name, hid_t type, const void* values, std::span<const hsize_t> shape,
                   Keep keep = Keep::deflated) {
  const Handle space(check(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), place.file));
  const Handle creation = storage(place, shape, H5Tget_size(type), keep == Keep::deflated);
  const Handle links(check(H5Pcreate(H5P_LINK_CREATE), place.file));
  check(H5Pset_create_intermediate_group(links.id(), 1), place.file);
  Handle set(check(H5Dcreate2(place.id, name.c_str(), type, space.id(), links.id(), creation.id(), H5P_DEFAULT), place.file));
  if (keep != Keep::nothing && H5Sget_simple_extent_npoints(space.id()) > 0)
    check(H5Dwrite(set.id(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), place.file);
  return set;
}

}  // namespace

std::string utf8(std::string_view text) {
  const auto beyond = std::find_if(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) >= 0x80; });
  std::string result(text.begin(), beyond);
  if (beyond == text.end()) return result;  // as nearly always, and quickly: decks of meshes are long
  result.reserve(text.size());
  for (std::size_t i = result.size(); i < text.size();) {
    const std::size_t size = character_size(text, i);
    if (const auto c = static_cast<unsigned char>(text[i]); size == 1 && c >= 0x80) {
      result += static_cast<char>(0xc0 | (c >> 6));
      result += static_cast<char>(0x80 | (c & 0x3f));
    } else {
      result += text.substr(i, size);
    }
    i += size;
  }
  return result;
}

Handle Place::group(const std::string& name) const {
  const Handle links(check(H5Pcreate(H5P_LINK_CREATE), file));
  check(H5Pset_create_intermediate_group(links.id(), 1), file);
  return Handle(check(H5Gcreate2(id, name.c_str(), links.id(), H5P_DEFAULT, H5P_DEFAULT), file));
}

void Place::attribute(const char* name, const std::string& content) const {
  const Handle type = text_type();
  const std::string converted = utf8(content);
  const char* text = converted.c_str();
  write_attribute(*this, name, type.id(), &text);
}
void Place::attribute(const char* name, double number) const { write_attribute(*this, name, H5T_NATIVE_DOUBLE, &number); }
void Place::attribute(const char* name, int number) const { write_attribute(*this, name, H5T_NATIVE_INT, &number); }

namespace {

Handle fixed_text_type(std::size_t width, const std::string& file) {
  Handle type(check(H5Tcopy(H5T_C_S1), file));
  check(H5Tset_size(type.id(), std::max<std::size_t>(1, width)), file);
  check(H5Tset_strpad(type.id(), H5T_STR_NULLPAD), file);
  check(H5Tset_cset(type.id(), H5T_CSET_UTF8), file);
  return type;
}

}  // namespace

Handle Place::text(const std::string& name, const std::string& content) const {
  const std::string converted = utf8(content);
  const Handle type = fixed_text_type(converted.size(), file);
  const hsize_t shape[1] = {1};
  return write_array(*this, name, type.id(), converted.c_str(), shape);  // an empty text has one byte, its null terminator
}

Handle Place::texts(const std::string& name, std::span<const std::string> contents) const {
  std::vector<std::string> converted;
  for (const std::string& text : contents) converted.push_back(utf8(text));
  std::size_t width = 1;
  for (const std::string& text : converted) width = std::max(width, text.size());
  std::string block(width * contents.size(), '\0');
  for (std::size_t i = 0; i < contents.size(); ++i) converted[i].copy(block.data() + i * width, width);
  const Handle type = fixed_text_type(width, file);
  const hsize_t shape[1] = {contents.size()};
  return write_array(*this, name, type.id(), block.data(), shape);
}

Handle Place::numbers(const std::string& name, std::span<const double> values, std::span<const hsize_t> shape) const {
  return write_array(*this, name, H5T_NATIVE_DOUBLE, values.data(), shape, best_way(values.data(), values.size()));
}

Handle Place::plain_numbers(const std::string& name, std::span<const double> values) const {
  const hsize_t count = values.size();
  const Handle space(check(H5Screate_simple(1, &count, nullptr), file));
  const Handle links(check(H5Pcreate(H5P_LINK_CREATE), file));
  check(H5Pset_create_intermediate_group(links.id(), 1), file);
  Handle set(check(H5Dcreate2(id, name.c_str(), H5T_NATIVE_DOUBLE, space.id(), links.id(), H5P_DEFAULT, H5P_DEFAULT), file));
  if (count > 0) check(H5Dwrite(set.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), file);
  return set;
}

Handle Place::integers(const std::string& name, std::span<const std::int32_t> values) const {
  const hsize_t shape[1] = {values.size()};
  return write_array(*this, name, H5T_NATIVE_INT32, values.data(), shape);
}

std::vector<hsize_t> read_shape(hid_t place, const std::string& name) {
  const Handle set(H5Dopen2(place, name.c_str(), H5P_DEFAULT));
  const Handle space(set.id() < 0 ? -1 : H5Dget_space(set.id()));
  if (space.id() < 0) return {};
  std::vector<hsize_t> shape(static_cast<std::size_t>(std::max(0, H5Sget_simple_extent_ndims(space.id()))));
  H5Sget_simple_extent_dims(space.id(), shape.data(), nullptr);
  return shape;
}

namespace {

template <class Number>
std::vector<Number> read_array(hid_t place, const std::string& name, hid_t type) {
  const Handle set(H5Dopen2(place, name.c_str(), H5P_DEFAULT));
  const Handle space(set.id() < 0 ? -1 : H5Dget_space(set.id()));
  if (space.id() < 0) return {};
  std::vector<Number> values(static_cast<std::size_t>(std::max<hssize_t>(0, H5Sget_simple_extent_npoints(space.id()))));
  if (!values.empty() && H5Dread(set.id(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0) return {};
  return values;
}

}  // namespace

std::vector<double> read_numbers(hid_t place, const std::string& name) {
  return read_array<double>(place, name, H5T_NATIVE_DOUBLE);
}

std::vector<std::int32_t> read_integers(hid_t place, const std::string& name) {
  const Handle set(H5Dopen2(place, name.c_str(), H5P_DEFAULT));
  const Handle type(set.id() < 0 ? -1 : H5Dget_type(set.id()));
  if (type.id() < 0 || H5Tget_class(type.id()) != H5T_INTEGER) return {};
  if (H5Tget_size(type.id()) <= sizeof(std::int32_t)) return read_array<std::int32_t>(place, name, H5T_NATIVE_INT32);
  const std::vector<std::int64_t> wide = read_array<std::int64_t>(place, name, H5T_NATIVE_INT64);
  constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();
  if (std::any_of(wide.begin(), wide.end(), [](std::int64_t n) { return n > most || n < -most; })) return {};
  return {wide.begin(), wide.end()};
}

std::vector<std::string> read_texts(hid_t place, const std::string& name) {
  const Handle set(H5Dopen2(place, name.c_str(), H5P_DEFAULT));
  const Handle space(set.id() < 0 ? -1 : H5Dget_space(set.id()));
  const Handle type(set.id() < 0 ? -1 : H5Dget_type(set.id()));
  if (space.id() < 0 || type.id() < 0 || H5Tis_variable_str(type.id()) != 0) return {};
  const std::size_t width = H5Tget_size(type.id());
  const auto count = static_cast<std::size_t>(std::max<hssize_t>(0, H5Sget_simple_extent_npoints(space.id())));
  std::string block(width * count, '\0');
  if (count > 0 && H5Dread(set.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, block.data()) < 0) return {};
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < count; ++i) {
    texts.push_back(block.substr(i * width, width));
    texts.back().erase(texts.back().find_last_not_of('\0') + 1);
  }
  return texts;
}

std::string read_text_attribute(hid_t object, const char* name) {
  const Handle attribute(H5Aexists(object, name) > 0 ? H5Aopen(object, name, H5P_DEFAULT) : -1);
  if (attribute.id() < 0) return "";
  const Handle type(H5Aget_type(attribute.id()));
  if (H5Tis_variable_str(type.id()) <= 0) return "";
  char* text = nullptr;
  if (H5Aread(attribute.id(), type.id(), &text) < 0 || !text) return "";
  std::string result(text);
  H5free_memory(text);
  return result;
}

double read_number_attribute(hid_t object, const char* name, double missing) {
  const Handle attribute(H5Aexists(object, name) > 0 ? H5Aopen(object, name, H5P_DEFAULT) : -1);
  double value = missing;
  if (attribute.id() >= 0 && H5Aread(attribute.id(), H5T_NATIVE_DOUBLE, &value) < 0) return missing;
  return value;
}

}  // namespace engrane::output::hdf5

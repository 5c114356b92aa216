// SPDX-License-Identifier: BSD-3-Clause
#include "output/hdf5_handle.hpp"

#include "output/error.hpp"

namespace engrane::output::hdf5 {

void prepare() {
  // At exit the library closes what is still open, and crashes on a file that a full disk kept it from closing. We close
  // our files ourselves.
  H5dont_atexit();
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

std::string reason_of_failure() {
  std::string reason;
  // from the call that the user of the library made down to the one that failed: the last one knows most
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

Handle write_array(const Place& place, const std::string& name, hid_t type, const void* values, std::span<const hsize_t> shape) {
  const Handle space(check(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), place.file));
  Handle set(check(H5Dcreate2(place.id, name.c_str(), type, space.id(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), place.file));
  hsize_t count = 1;
  for (const hsize_t n : shape) count *= n;
  if (count > 0) check(H5Dwrite(set.id(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), place.file);
  return set;
}

}  // namespace

Handle Place::group(const std::string& name) const {
  const Handle links(check(H5Pcreate(H5P_LINK_CREATE), file));
  check(H5Pset_create_intermediate_group(links.id(), 1), file);
  return Handle(check(H5Gcreate2(id, name.c_str(), links.id(), H5P_DEFAULT, H5P_DEFAULT), file));
}

void Place::attribute(const char* name, const std::string& content) const {
  const Handle type = text_type();
  const char* text = content.c_str();
  write_attribute(*this, name, type.id(), &text);
}
void Place::attribute(const char* name, double number) const { write_attribute(*this, name, H5T_NATIVE_DOUBLE, &number); }
void Place::attribute(const char* name, int number) const { write_attribute(*this, name, H5T_NATIVE_INT, &number); }

Handle Place::text(const std::string& name, const std::string& content) const {
  const Handle type = text_type();
  const Handle space(check(H5Screate(H5S_SCALAR), file));
  Handle set(check(H5Dcreate2(id, name.c_str(), type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), file));
  const char* text = content.c_str();
  check(H5Dwrite(set.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, &text), file);
  return set;
}

Handle Place::numbers(const std::string& name, std::span<const double> values, std::span<const hsize_t> shape) const {
  return write_array(*this, name, H5T_NATIVE_DOUBLE, values.data(), shape);
}

Handle Place::integers(const std::string& name, std::span<const std::int32_t> values) const {
  const hsize_t shape[1] = {values.size()};
  return write_array(*this, name, H5T_NATIVE_INT32, values.data(), shape);
}

}  // namespace engrane::output::hdf5

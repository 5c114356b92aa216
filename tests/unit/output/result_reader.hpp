// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "output/hdf5_handle.hpp"

namespace engrane::testing {

using namespace output;

/// Reads a result file back with the plain HDF5 library.
class ResultReader {
 public:
  explicit ResultReader(const std::string& path) {
    hdf5::prepare();
    file_ = hdf5::Handle(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT));
  }
  bool opens() const { return file_.id() >= 0; }
  bool has(const std::string& name) const { return H5Lexists(file_.id(), name.c_str(), H5P_DEFAULT) > 0; }

  std::vector<double> numbers(const std::string& name) const {
    const hdf5::Handle set(H5Dopen2(file_.id(), name.c_str(), H5P_DEFAULT));
    if (set.id() < 0) {
      ADD_FAILURE() << "no dataset " << name;
      return {};
    }
    const hdf5::Handle space(H5Dget_space(set.id()));
    std::vector<double> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space.id())));
    if (!values.empty() && H5Dread(set.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
      ADD_FAILURE() << name << " cannot be read: " << hdf5::reason_of_failure();
    return values;
  }

  std::vector<std::string> texts(const std::string& name) const { return hdf5::read_texts(file_.id(), name); }

  std::string attribute(const std::string& object, const char* name) const {
    const hdf5::Handle owner(H5Oopen(file_.id(), object.c_str(), H5P_DEFAULT));
    const hdf5::Handle attribute(H5Aopen(owner.id(), name, H5P_DEFAULT));
    if (attribute.id() < 0) return "(none)";
    const hdf5::Handle type(H5Aget_type(attribute.id()));
    char* text = nullptr;
    if (H5Aread(attribute.id(), type.id(), &text) < 0) return "(unreadable)";
    std::string result(text);
    H5free_memory(text);
    return result;
  }

 private:
  hdf5::Handle file_;
};

}  // namespace engrane::testing

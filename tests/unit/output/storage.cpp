// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "output/hdf5_handle.hpp"

namespace engrane::testing {

using namespace output;

namespace {

/// The layout of an array of `count` numbers as stored, after it was read back whole.
H5D_layout_t stored(const std::vector<double>& values) {
  const std::string path = (std::filesystem::temp_directory_path() / "engrane_storage.h5").string();
  const hdf5::Handle access = hdf5::file_access(path);
  const hdf5::Handle file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access.id()));
  const hsize_t shape[1] = {values.size()};
  const hdf5::Handle set = hdf5::Place{file.id(), path}.numbers("values", values, shape);
  EXPECT_EQ(hdf5::read_numbers(file.id(), "values"), values);
  const hdf5::Handle creation(H5Dget_create_plist(set.id()));
  const H5D_layout_t layout = H5Pget_layout(creation.id());
  std::filesystem::remove(path);
  return layout;
}

TEST(Storage, CompressesWhatShrinks) {
  constexpr std::size_t many = 300'000;
  std::vector<double> flat(many, 0.0), smooth(many), rough(many);
  for (std::size_t i = 0; i < many; ++i) {
    smooth[i] = 0.25 * static_cast<double>(i);
    rough[i] = std::sin(1e5 * std::sin(static_cast<double>(i)));  // all digits of the mantissa differ
  }
  EXPECT_EQ(stored(flat), H5D_CHUNKED);
  EXPECT_EQ(stored(smooth), H5D_CHUNKED);
  EXPECT_EQ(stored(rough), H5D_CONTIGUOUS);
  rough.resize(10'000);  // too small for its time to matter
  EXPECT_EQ(stored(rough), H5D_CHUNKED);
  rough.resize(100);
  EXPECT_EQ(stored(rough), H5D_COMPACT);
}

}  // namespace
}  // namespace engrane::testing

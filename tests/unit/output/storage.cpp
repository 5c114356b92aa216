// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "output/hdf5_handle.hpp"
#include "sample_results.hpp"

namespace engrane::testing {

using namespace output;

namespace {

struct Stored {
  H5D_layout_t layout;
  hsize_t bytes;  ///< in the file
};

/// How an array is stored, after it was read back whole.
Stored stored(const std::vector<double>& values) {
  const Scratch folder;  // tests of this file run side by side
  const std::string path = folder / "storage.h5";
  const hdf5::Handle access = hdf5::file_access(path);
  const hdf5::Handle file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access.id()));
  const hsize_t shape[1] = {values.size()};
  const hdf5::Handle set = hdf5::Place{file.id(), path}.numbers("values", values, shape);
  const std::vector<double> found = hdf5::read_numbers(file.id(), "values");
  EXPECT_EQ(found.size(), values.size());
  EXPECT_EQ(std::memcmp(found.data(), values.data(), values.size() * sizeof(double)), 0);
  const hdf5::Handle creation(H5Dget_create_plist(set.id()));
  const Stored how{H5Pget_layout(creation.id()), H5Dget_storage_size(set.id())};
  return how;
}

TEST(Storage, CompressesWhatShrinks) {
  constexpr std::size_t many = 300'000;
  std::vector<double> flat(many, 2.5), smooth(many), rough(many);
  for (std::size_t i = 0; i < many; ++i) {
    smooth[i] = 0.25 * static_cast<double>(i);
    rough[i] = std::sin(1e5 * std::sin(static_cast<double>(i)));  // all digits of the mantissa differ
  }
  EXPECT_EQ(stored(flat).layout, H5D_CHUNKED);
  EXPECT_EQ(stored(smooth).layout, H5D_CHUNKED);
  EXPECT_EQ(stored(rough).layout, H5D_CONTIGUOUS);
  // two of three keep half of their bytes and more, which would take longer to compress than to write
  for (std::size_t i = 0; i < many; i += 3) rough[i] = 0;
  EXPECT_EQ(stored(rough).layout, H5D_CONTIGUOUS);
  rough.resize(10'000);  // many of them make a file
  EXPECT_EQ(stored(rough).layout, H5D_CONTIGUOUS);
  rough.resize(5'000);  // too small to be tried
  EXPECT_EQ(stored(rough).layout, H5D_CHUNKED);
  rough.resize(100);
  EXPECT_EQ(stored(rough).layout, H5D_COMPACT);
}

TEST(Storage, ZerosTakeNoBytes) {
  std::vector<double> zeros(300'000, 0.0);
  EXPECT_EQ(stored(zeros).bytes, 0u);
  zeros[250'000] = -0.0;
  EXPECT_GT(stored(zeros).bytes, 0u) << "this zero has a sign";
}

}  // namespace
}  // namespace engrane::testing

// SPDX-License-Identifier: BSD-3-Clause
#include "output/mesh_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "output/hdf5_handle.hpp"

namespace engrane::output {

namespace {

constexpr int version = 1;
constexpr std::int32_t largest_number = 999'999'999;

[[noreturn]] void refuse(const std::string& set, const std::string& why) {
  throw MeshFileError(fmt::format("its `{}` {}", set, why));
}

/// Reads a required dataset of integers with `extents` dimensions.
std::vector<std::int32_t> integers(hid_t file, const std::string& set, std::size_t extents) {
  if (hdf5::read_shape(file, set).size() != extents)
    refuse(set, extents == 1 ? "is not there, or no list of whole numbers" : "is not there, or no table of whole numbers");
  std::vector<std::int32_t> values = hdf5::read_integers(file, set);
  if (values.empty()) refuse(set, "is empty, cannot be read, or does not hold whole numbers of 32 bits");
  return values;
}

std::vector<std::int32_t> numbers(hid_t file, const std::string& set) {
  std::vector<std::int32_t> values = integers(file, set, 1);
  const auto wrong = std::find_if(values.begin(), values.end(), [](std::int32_t n) { return n < 1 || n > largest_number; });
  if (wrong != values.end()) refuse(set, fmt::format("holds {}: numbers are from 1 to {}", *wrong, largest_number));
  return values;
}

void read_nodes(hid_t file, MeshFile& mesh) {
  mesh.numbers = numbers(file, "nodes/numbers");
  const std::string set = "nodes/places";
  if (hdf5::read_shape(file, set) != std::vector<hsize_t>{mesh.numbers.size(), 3})
    refuse(set, fmt::format("is not there, or no table of {} rows x y z", mesh.numbers.size()));
  const std::vector<double> places = hdf5::read_numbers(file, set);
  if (places.size() != 3 * mesh.numbers.size()) refuse(set, "cannot be read");
  mesh.places.resize(mesh.numbers.size());
  std::memcpy(mesh.places.data(), places.data(), places.size() * sizeof(double));
  for (std::size_t i = 0; i < places.size(); ++i)
    if (!std::isfinite(places[i])) refuse(set, fmt::format("has no finite place for node {}", mesh.numbers[i / 3]));
}

bool exists(hid_t file, const std::string& group) { return H5Lexists(file, group.c_str(), H5P_DEFAULT) > 0; }

}  // namespace

MeshFile read_mesh_file(const std::string& path) {
  const hdf5::Handle file = hdf5::open_for_reading(path);
  if (file.id() < 0) throw MeshFileError("it cannot be read as HDF5: " + hdf5::reason_of_failure());
  const double found = hdf5::read_number_attribute(file.id(), "engrane_mesh", 0);
  if (found == 0) throw MeshFileError("it is a file of HDF5, but no mesh of engrane");
  if (found != version) throw MeshFileError(fmt::format("its version is {}, this program reads {}", found, version));
  MeshFile mesh;
  read_nodes(file.id(), mesh);
  if (exists(file.id(), "cells"))
    for (int k = 1; exists(file.id(), fmt::format("cells/{}", k)); ++k) {
      const std::string kind = fmt::format("cells/{}/", k);
      MeshFile::Cells cells;
      cells.numbers = numbers(file.id(), kind + "numbers");
      cells.rows = integers(file.id(), kind + "nodes", 2);
      cells.width = cells.rows.size() / cells.numbers.size();
      if (cells.rows.size() != cells.width * cells.numbers.size() || cells.width == 0)
        refuse(kind + "nodes", fmt::format("does not have a row for each of {} cells", cells.numbers.size()));
      mesh.cells.push_back(std::move(cells));
    }
  if (mesh.cells.empty()) throw MeshFileError("it has no cells");
  if (exists(file.id(), "groups"))
    for (int k = 1; exists(file.id(), fmt::format("groups/{}", k)); ++k) {
      const std::string set = fmt::format("groups/{}", k);
      const hdf5::Handle object(H5Dopen2(file.id(), set.c_str(), H5P_DEFAULT));
      MeshFile::Group group{hdf5::read_text_attribute(object.id(), "name"), hdf5::read_text_attribute(object.id(), "kind"), {}};
      if (group.kind != "NODES" && group.kind != "ELEMENTS" && group.kind != "FACES")
        refuse(set, "has no `kind` NODES, ELEMENTS or FACES");
      group.members = integers(file.id(), set, group.kind == "FACES" ? 2 : 1);
      mesh.groups.push_back(std::move(group));
    }
  return mesh;
}

}  // namespace engrane::output

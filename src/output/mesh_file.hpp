// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace engrane::output {

/// A mesh as written by `engrane import` (docs/format.md, Meshes).
struct MeshFile {
  /// Cells of one kind: a number and a row of `width` entries per cell, in the order of N of `.MAI`.
  struct Cells {
    std::vector<std::int32_t> numbers, rows;
    std::size_t width = 0;
  };
  struct Group {
    std::string name, kind;             ///< kind: NODES, ELEMENTS or FACES
    std::vector<std::int32_t> members;  ///< numbers; for faces, pairs of cell and face
  };

  std::vector<std::int32_t> numbers;          ///< of the nodes
  std::vector<std::array<double, 3>> places;  ///< coordinates, in the unit of the deck
  std::vector<Cells> cells;
  std::vector<Group> groups;  ///< the n-th is `.SEL GROUP` n
};

/// The file is not such a mesh, or its arrays do not fit together. The text says what is wrong.
class MeshFileError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Throws MeshFileError. Numbers are returned as they are in the file: duplicates and references to missing nodes are not
/// checked.
MeshFile read_mesh_file(const std::string& path);

}  // namespace engrane::output

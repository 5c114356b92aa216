// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace engrane::output {

/// A mesh as `engrane import` writes it (docs/format.md, Meshes).
struct MeshFile {
  /// Cells of one kind: a number and a row of `width` entries for each, as they stand behind N of `.MAI`.
  struct Cells {
    std::vector<std::int32_t> numbers, rows;
    std::size_t width = 0;
  };
  struct Group {
    std::string name, kind;             ///< kind: NODES, ELEMENTS or FACES
    std::vector<std::int32_t> members;  ///< numbers; of faces pairs of a cell and its face
  };

  std::vector<std::int32_t> numbers;          ///< of the nodes
  std::vector<std::array<double, 3>> places;  ///< in the unit of the deck
  std::vector<Cells> cells;
  std::vector<Group> groups;  ///< the n-th is `.SEL GROUP` n
};

/// A file that is no such mesh, or whose arrays do not fit together; the text says what is wrong.
class MeshFileError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Throws MeshFileError. Numbers are as the file has them: whether they are given twice, or nodes exist, is not asked.
MeshFile read_mesh_file(const std::string& path);

}  // namespace engrane::output

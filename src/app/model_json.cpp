// SPDX-License-Identifier: BSD-3-Clause
#include "app/model_json.hpp"

#include <fmt/format.h>
#include <petscversion.h>

#include <Eigen/Core>
#include <iterator>

#include "assembly/petsc.hpp"
#include "base/text.hpp"

namespace engrane::app {

std::string model_json(const Model& model) {
  std::string json = fmt::format("{{\"title\": {},\n \"elements\": [", json_string(model.title));
  bool first = true;
  const Model::Part* before = nullptr;
  for (const Model::Part& part : model.parts) {
    // parameters of a card with many parts (such as the weights of a link) go with its first part; those of a cell are only its
    // nodes
    const bool goes_on = before && before->record == part.record && before->element->id() == part.element->id();
    const bool says_more = !goes_on && part.element->cell_shape() == CellShape::none;
    before = &part;
    fmt::format_to(std::back_inserter(json), "{}\n  {{\"id\": {}, \"type\": {}, \"nodes\": [{}]", first ? "" : ",",
                   part.element->id(), json_string(part.type), fmt::join(part.element->node_ids(), ", "));
    first = false;
    if (says_more) json += ", \"parameters\": " + parameters_json(part);
    if (const Drawing shapes = part.element->drawing(); !shapes.empty())
      json += fmt::format(", \"drawing\": [{{{}}}]", fmt::join(shapes, "}, {"));
    json += '}';
  }
  return json + "]}\n";
}

std::string library_versions() {
  char mpi[MPI_MAX_LIBRARY_VERSION_STRING] = "";
  int length = 0;
  MPI_Get_library_version(mpi, &length);
  std::string mpi_name(mpi, static_cast<std::size_t>(length));
  mpi_name.resize(std::min(mpi_name.find_first_of(",\n"), mpi_name.size()));
  return fmt::format("PETSc {}.{}.{}, {}, Eigen {}.{}.{}", PETSC_VERSION_MAJOR, PETSC_VERSION_MINOR, PETSC_VERSION_SUBMINOR,
                     mpi_name, EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION);
}

}  // namespace engrane::app

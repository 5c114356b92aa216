// SPDX-License-Identifier: BSD-3-Clause
#include "app/mesh_records.hpp"

#include <fmt/format.h>

#include "deck/cards/cards.hpp"
#include "elements/structural/cell.hpp"
#include "output/mesh_file.hpp"

namespace engrane::app {

namespace {

constexpr const char* ending = ".mesh.h5";

/// Makes a record as if its keywords were at the location where the mesh file is named.
template <class Data>
deck::Record record_of(const deck::Schema& schema, int id, Data data, const Location& where,
                       std::initializer_list<const char*> keywords) {
  deck::Record record;
  record.schema = &schema;
  record.id = id;
  record.location = where;
  record.field_locations.reserve(keywords.size());
  for (const char* keyword : keywords) record.field_locations.push_back({schema.find(keyword), where});
  record.data = std::move(data);
  return record;
}

std::vector<deck::Record> records_of(const output::MeshFile& mesh, const deck::Catalogue& catalogue, const Location& where,
                                     Diagnostics& diagnostics) {
  std::vector<deck::Record> records;
  std::size_t count = mesh.numbers.size() + mesh.groups.size();
  for (const output::MeshFile::Cells& cells : mesh.cells) count += cells.numbers.size();
  records.reserve(count);
  const deck::Schema &node = *catalogue.find(".NOE"), &cell = *catalogue.find(".MAI"), &group = *catalogue.find(".SEL");
  for (std::size_t i = 0; i < mesh.numbers.size(); ++i)
    records.push_back(record_of(node, mesh.numbers[i], deck::NodeCard{mesh.places[i]}, where, {"X"}));
  for (const output::MeshFile::Cells& cells : mesh.cells)
    for (std::size_t i = 0; i < cells.numbers.size(); ++i) {
      const auto row = cells.rows.begin() + static_cast<std::ptrdiff_t>(i * cells.width);
      elements::structural::CellData data;
      data.nodes.assign(row, row + static_cast<std::ptrdiff_t>(cells.width));
      records.push_back(record_of(cell, cells.numbers[i], std::move(data), where, {"N"}));
    }
  int number = 0;
  for (const output::MeshFile::Group& members : mesh.groups) {
    deck::GroupCard data;
    data.name = members.name;
    data.of_file = true;
    data.kind.tag = members.kind;
    data.ids = members.members;
    records.push_back(record_of(group, ++number, std::move(data), where, {"NOM", "KIND", "IDS"}));
    if (group.finish) group.finish(records.back(), diagnostics);
  }
  return records;
}

}  // namespace

std::vector<deck::Record> mesh_records(const std::filesystem::path& file, const deck::Catalogue& catalogue, const Location& where,
                                       Diagnostics& diagnostics) {
  const std::string name = file.string();
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) {
    diagnostics.error(where, fmt::format("there is no file `{}`", name), "names are relative to the folder of the deck");
    return {};
  }
  if (!name.ends_with(ending)) {
    const std::string made = file.stem().string() + ending;
    diagnostics.error(
        where, fmt::format("`{}` is no mesh that decks read, whose names end with {}", name, ending),
        fmt::format("engrane import {} -o {}  makes one; then name {} here", name, (file.parent_path() / made).string(), made));
    return {};
  }
  try {
    return records_of(output::read_mesh_file(name), catalogue, where, diagnostics);
  } catch (const output::MeshFileError& failure) {
    diagnostics.error(where, fmt::format("the mesh `{}` cannot be used: {}", name, failure.what()),
                      "`engrane import` writes such files; docs/format.md says what is in them");
    return {};
  }
}

}  // namespace engrane::app

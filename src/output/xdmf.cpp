// SPDX-License-Identifier: BSD-3-Clause
#include "output/xdmf.hpp"

#include <fmt/format.h>

#include <iterator>

#include "output/result_file.hpp"

namespace engrane::output {

namespace {

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else
      out += c;
  }
  return out;
}

const char* attribute_type(std::size_t width) {
  return width == 1 ? "Scalar" : width == 3 ? "Vector" : width == 6 ? "Tensor6" : width == 9 ? "Tensor" : "Matrix";
}

}  // namespace

std::string xdmf_index(const ResultsLayout& layout, const std::string& h5_name, std::span<const double> frame_times,
                       std::size_t modes) {
  const MixedTopology topology = mixed_topology(layout);
  const std::string file = escaped(h5_name);
  const std::size_t points = layout.points.size();
  // repeated in every grid; meshio reads it from the first one only
  const std::string mesh = fmt::format(
      "<Topology TopologyType=\"Mixed\" NumberOfElements=\"{0}\">"
      "<DataItem Dimensions=\"{1}\" NumberType=\"Int\" Precision=\"4\" Format=\"HDF\">{3}:/mesh/topology</DataItem></Topology>\n"
      "<Geometry GeometryType=\"XYZ\">"
      "<DataItem Dimensions=\"{2} 3\" NumberType=\"Float\" Precision=\"8\" Format=\"HDF\">{3}:/mesh/points</DataItem>"
      "</Geometry>\n"
      "<Attribute Name=\"element\" AttributeType=\"Scalar\" Center=\"Cell\">"
      "<DataItem Dimensions=\"{0}\" NumberType=\"Int\" Precision=\"4\" Format=\"HDF\">{3}:/mesh/cell_elements</DataItem>"
      "</Attribute>\n",
      topology.elements.size(), topology.data.size(), points, file);

  std::string out =
      "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\">\n<Domain>\n"
      "<Grid Name=\"frames\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
  for (std::size_t i = 0; i < frame_times.size(); ++i) {
    fmt::format_to(std::back_inserter(out), "<Grid Name=\"frame {}\" GridType=\"Uniform\">\n<Time Value=\"{}\"/>\n{}", i,
                   frame_times[i], mesh);
    for (const Named& field : layout.node_fields)
      fmt::format_to(std::back_inserter(out),
                     "<Attribute Name=\"{0}\" AttributeType=\"Vector\" Center=\"Node\">"
                     "<DataItem Dimensions=\"{1} 3\" NumberType=\"Float\" Precision=\"8\" Format=\"HDF\">"
                     "{2}:/fields/{0}/{3:06}</DataItem></Attribute>\n",
                     field.name, points, file, i);
    const auto add = [&](const CellField& field, const char* center, std::size_t rows, const char* folder) {
      fmt::format_to(std::back_inserter(out),
                     "<Attribute Name=\"{0}\" AttributeType=\"{4}\" Center=\"{6}\">"
                     "<DataItem Dimensions=\"{1} {5}\" NumberType=\"Float\" Precision=\"8\" Format=\"HDF\">"
                     "{2}:/{7}/{0}/{3:06}</DataItem></Attribute>\n",
                     field.named.name, rows, file, i, attribute_type(field.width()), field.width(), center, folder);
    };
    for (const CellField& field : layout.averages) add(field, "Node", points, "nodes");
    for (const CellField& field : layout.cell_fields) add(field, "Cell", topology.cells.size(), "fields");
    for (std::size_t mode = 1; mode <= modes; ++mode)
      fmt::format_to(std::back_inserter(out),
                     "<Attribute Name=\"mode_{0}\" AttributeType=\"Vector\" Center=\"Node\">"
                     "<DataItem Dimensions=\"{1} 3\" NumberType=\"Float\" Precision=\"8\" Format=\"HDF\">"
                     "{2}:/modes/mode_{0}</DataItem></Attribute>\n",
                     mode, points, file);
    out += "</Grid>\n";
  }
  return out + "</Grid>\n</Domain>\n</Xdmf>\n";
}

}  // namespace engrane::output

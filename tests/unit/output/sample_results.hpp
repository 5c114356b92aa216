// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "output/results.hpp"

namespace engrane::testing {

using namespace output;

/// A folder of its own, removed at the end.
class Scratch {
 public:
  Scratch() {
    std::string name = (std::filesystem::temp_directory_path() / "engrane-XXXXXX").string();
    path_ = mkdtemp(name.data());
  }
  ~Scratch() { std::filesystem::remove_all(path_); }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  std::string operator/(const std::string& name) const { return (path_ / name).string(); }
  bool has(const std::string& name) const { return std::filesystem::exists(path_ / name); }

 private:
  std::filesystem::path path_;
};

/// Four nodes with a line of three points, a single point, a triangle and a quadrilateral. Two gears share
/// `channels` histories, an even number; a last one is of the run.
inline ResultsLayout sample_layout(std::size_t channels = 2) {
  ResultsLayout layout;
  layout.title = "sample <1> & \"2\"";
  layout.analysis = "DYNAMIC";
  layout.deck_text = ".FIN 1\n";
  layout.model_json = R"({"title": "sample", "elements": []})";
  layout.version = "0.0.0";
  layout.libraries = "none";
  layout.units.given = true;
  layout.node_ids = {10, 20, 30, 40};
  layout.points = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)};
  layout.cells = {{{0, 1, 2}, 1}, {{3}, 2}, {{0, 1, 2}, 3, CellShape::triangle}, {{0, 1, 2, 3}, 4, CellShape::quadrilateral}};
  layout.cell_fields = {{{"STRESS", dimension::pressure, "stress"}, {}}};
  layout.point_fields = {{layout.cell_fields[0], {2, 3, 3}, {0, 0, 1}}};
  for (const char* name : {"displacement", "rotation", "velocity"}) layout.node_fields.push_back({name, dimension::length, name});
  layout.node_fields.push_back({"angular_velocity", dimension::angular_velocity, "angular velocity"});
  for (const char* name : {"reaction_force", "reaction_torque"}) layout.node_fields.push_back({name, dimension::force, name});
  HistoryTable gear{"element/GEAR", "GEAR", {7, 9}, {}};
  for (std::size_t i = 0; i < channels / 2; ++i) gear.channels.push_back({"C" + std::to_string(i), dimension::force, "force"});
  layout.history = {gear, {"run", "", {}, {{"KINETIC_ENERGY", dimension::energy, "kinetic energy"}}}};
  return layout;
}

/// What channel c holds in sample s.
inline double sample_value(std::size_t s, std::size_t c) { return static_cast<double>(s) + 1e-3 * static_cast<double>(c); }

inline void write_sample(Results& results, std::size_t s) {
  std::vector<double> values(results.layout().channel_count());
  for (std::size_t c = 0; c < values.size(); ++c) values[c] = sample_value(s, c);
  results.sample(1e-3 * static_cast<double>(s), values);
  if (results.due()) results.flush();
}

/// Frame f: every field is f plus the number's place, the displacement a tenth of it.
inline void write_frame(Results& results, std::size_t f) {
  std::vector<double> field(3 * results.layout().points.size()), small(field.size());
  for (std::size_t i = 0; i < field.size(); ++i) {
    field[i] = static_cast<double>(f) + 0.01 * static_cast<double>(i);
    small[i] = 0.1 * field[i];
  }
  results.frame(
      0.1 * static_cast<double>(f),
      {{small, field, field, field, field, field}, {{1, 2, 3, static_cast<double>(f)}}, {{7, 8, static_cast<double>(f)}}});
}

}  // namespace engrane::testing

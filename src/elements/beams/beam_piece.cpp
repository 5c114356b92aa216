// SPDX-License-Identifier: BSD-3-Clause
#include "elements/beams/beam_piece.hpp"

#include <fmt/format.h>

#include "elements/common/building.hpp"
#include "math/rotation.hpp"

template class engrane::TemplatedBlock<engrane::elements::beams::BeamPiece<2>, 2, 15>;
template class engrane::TemplatedBlock<engrane::elements::beams::BeamPiece<3>, 3, 24>;

namespace engrane::elements::beams {

namespace {

template <int Nodes>
Layout piece_layout(bool inextensible, bool unshearable) {
  Layout layout;
  for (int point = 1; point < Nodes; ++point) {
    const auto hold = [&](const char* name, const char* help) {
      layout.multipliers.push_back({{fmt::format("{}_{}", name, point), dimension::length, help}, Role::other});
    };
    if (inextensible) hold("STRETCH", "pull of a beam that does not stretch");
    if (unshearable) hold("SHEAR_2", "shear force along axis 2 of a beam that does not shear");
    if (unshearable) hold("SHEAR_3", "shear force along axis 3 of a beam that does not shear");
  }
  layout.nodes.assign(Nodes, -1);
  layout.needs.assign(Nodes, NodeNeed::both);
  return layout;
}

constexpr std::array<const char*, 2> ends = {"A", "B"};

/// Largest and smallest normal stress E (ε + κ_2 z − κ_3 y) of a section; NaN if its shape is not known.
std::pair<double, double> normal_stress(const BeamSection& section, const Vec6& strain) {
  if (!(section.young > 0) || section.outline.empty()) return {std::nan(""), std::nan("")};
  const auto at = [&](const Eigen::Vector2d& r) { return section.young * (strain[0] + strain[4] * r[1] - strain[5] * r[0]); };
  if (section.radius > 0) {
    const double middle = at(section.middle), bend = section.young * section.radius * std::hypot(strain[4], strain[5]);
    return {middle + bend, middle - bend};
  }
  std::pair<double, double> extremes = {at(section.outline.front()), at(section.outline.front())};
  for (const Eigen::Vector2d& corner : section.outline)
    extremes = {std::max(extremes.first, at(corner)), std::min(extremes.second, at(corner))};
  return extremes;
}

}  // namespace

template <int Nodes, bool Held>
Beams<Nodes, Held>::Beams(bool inextensible, bool unshearable)
    : BeamSweep<Nodes>(piece_layout<Nodes>(inextensible, unshearable)) {}

template <int Nodes, bool Held>
Beams<Nodes, Held>::~Beams() = default;

template <int Nodes, bool Held>
void Beams<Nodes, Held>::tangent(std::size_t first, std::span<const State> states, Weights weights, std::span<double> r,
                                 std::span<double> k) const {
  const auto n = static_cast<std::size_t>(this->layout().slots());
  for (std::size_t i = 0; i < states.size(); ++i) {
    const auto own_r = r.subspan(i * n, n), own_k = k.subspan(i * n * n, n * n);
    if (const BeamPiece<Nodes>& piece = this->data(first + i); piece.has_tangent())
      piece.tangent(states[i], weights, own_r, own_k);
    else
      BeamSweep<Nodes>::tangent(first + i, states.subspan(i, 1), weights, own_r, own_k);
  }
}

template <int Nodes, bool Held>
Energies Beams<Nodes, Held>::energies(std::size_t e, const State& state) const {
  const BeamPiece<Nodes>& piece = this->data(e);
  const Motion<double, Nodes> motion(state);
  Energies sum;
  for (std::size_t p = 0; p < piece.at.size(); ++p) {
    const Vec6 strain = piece.strain(motion, p, state.time), stress = piece.stress(p, strain);
    sum.strain += piece.at[p].length / 2 * stress.dot(strain);
    sum.external -= piece.at[p].length * stress[0] * piece.free_stretch_rate(p, state.time);  // ∂V/∂ΔT dΔT
    if (piece.section->damping > 0) {
      const Vec6 rate = piece.strain_rate(motion, p);
      sum.dissipated += piece.at[p].length * piece.section->damping * rate.dot(piece.stress(p, rate));
    }
  }
  sum.potential = sum.strain;
  if (!piece.section->has_mass()) return sum;
  std::array<Vec3, Nodes> velocity, center;
  for (std::size_t i = 0; i < Nodes; ++i) {
    const NodeState& node = state.nodes[i];
    const Vec3 &arm = piece.centers[i], change = cross(node.W, arm);
    velocity[i] = node.v + (piece.small ? change : Vec3(node.R * change));
    center[i] = node.x + (piece.small ? Vec3(arm + cross(rotation_log(node.R), arm)) : Vec3(node.R * arm));
    sum.kinetic += 0.5 * node.W.dot(piece.inertia[i] * node.W);
  }
  for (std::size_t i = 0; i < Nodes; ++i)
    for (std::size_t j = 0; j < Nodes; ++j) {
      const double mass = piece.mass(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
      sum.kinetic += 0.5 * mass * velocity[i].dot(velocity[j]);
      sum.add_weight(state, mass, center[i], velocity[i]);
    }
  return sum;
}

template <int Nodes, bool Held>
Mat3 Beams<Nodes, Held>::inertia_at(std::size_t e, int node) const {
  const BeamPiece<Nodes>& piece = this->data(e);
  Mat3 sum = Mat3::Zero();
  for (std::size_t i = 0; i < Nodes; ++i) {
    if (this->node_ids(e)[i] != node) continue;
    const Vec3& arm = piece.centers[i];
    sum += piece.inertia[i] +
           piece.mass.row(static_cast<Eigen::Index>(i)).sum() * (arm.squaredNorm() * Mat3::Identity() - arm * arm.transpose());
  }
  return sum;
}

template <int Nodes, bool Held>
const std::vector<Channel>& Beams<Nodes, Held>::channels() const {
  static const std::vector<Channel> all = [] {
    std::vector<Channel> list;
    for (const char* end : ends) {
      const auto add = [&](const char* name, Dimension dimension, const char* help) {
        list.push_back({fmt::format("{}_{}", name, end), dimension,
                        fmt::format("{} at the {} node, in the axes of the section", help, *end == 'A' ? "first" : "last")});
      };
      add("NORMAL_FORCE", dimension::force, "pull");
      add("SHEAR_FORCE_2", dimension::force, "shear along axis 2");
      add("SHEAR_FORCE_3", dimension::force, "shear along axis 3");
      add("TORQUE", dimension::moment, "torsion");
      add("BENDING_MOMENT_2", dimension::moment, "bending about axis 2");
      add("BENDING_MOMENT_3", dimension::moment, "bending about axis 3");
    }
    list.push_back({"STRAIN_ENERGY", dimension::energy, "energy stored by deformation"});
    return list;
  }();
  return all;
}

template <int Nodes, bool Held>
void Beams<Nodes, Held>::observe(std::size_t e, const State& state, std::span<double> values) const {
  const BeamPiece<Nodes>& piece = this->data(e);
  std::array<double, 6 * Nodes + 3 * (Nodes - 1)> r{};
  this->residual(e, {&state, 1}, std::span(r).first(static_cast<std::size_t>(this->layout().slots())));
  std::size_t next = 0;
  for (std::size_t end = 0; end < 2; ++end) {
    const std::size_t node = end == 0 ? 0 : Nodes - 1;
    const double sign = end == 0 ? -1 : 1;  // section forces act on the face whose outward normal is along the beam
    const double* at = r.data() + 6 * node;
    const Mat3 back = piece.axes[node].transpose();
    const Vec3 in_space(at[0], at[1], at[2]);
    const Vec3 force = back * (piece.small ? in_space : Vec3(state.nodes[node].R.transpose() * in_space));
    const Vec3 moment = back * Vec3(at[3], at[4], at[5]);
    for (Eigen::Index c = 0; c < 3; ++c) values[next++] = sign * force[c];
    for (Eigen::Index c = 0; c < 3; ++c) values[next++] = sign * moment[c];
  }
  const Motion<double, Nodes> motion(state);
  values[next] = 0;
  for (std::size_t p = 0; p < piece.at.size(); ++p) {
    const Vec6 strain = piece.strain(motion, p, state.time);
    values[next] += piece.at[p].length / 2 * piece.stress(p, strain).dot(strain);
  }
}

template <int Nodes, bool Held>
const std::vector<Field>& Beams<Nodes, Held>::fields() const {
  static const std::vector<Field> all = [] {
    const auto at_points = [](const char* name, Dimension dimension, const char* help, std::vector<std::string> components) {
      return Field{{name, dimension, help}, Field::Place::point, std::move(components), BeamPiece<Nodes>::points};
    };
    return std::vector<Field>{
        at_points("SECTION_FORCE", dimension::force, "pull and shear forces of a beam, axes of the section", {"N", "V2", "V3"}),
        at_points("SECTION_MOMENT", dimension::moment, "torsion and bending moments of a beam, axes of the section",
                  {"T", "M2", "M3"}),
        at_points("BEAM_STRESS", dimension::pressure, "largest and least normal stress of a section of one material",
                  {"MAX", "MIN"})};
  }();
  return all;
}

template <int Nodes, bool Held>
void Beams<Nodes, Held>::evaluate_fields(std::size_t e, const State& state, std::span<double> values) const {
  const BeamPiece<Nodes>& piece = this->data(e);
  const Motion<double, Nodes> motion(state);
  for (std::size_t p = 0; p < piece.at.size(); ++p) {
    const BeamSection& section = *piece.at[p].section;
    Vec6 strain = piece.strain(motion, p, state.time), stress = piece.stress(p, strain);
    if (section.damping > 0) stress += section.damping * piece.stress(p, piece.strain_rate(motion, p));
    if (Held) stress += piece.holding(state, p);
    for (std::size_t c = 0; c < 3; ++c) {
      values[3 * p + c] = stress[static_cast<Eigen::Index>(c)];
      values[3 * (piece.at.size() + p) + c] = stress[static_cast<Eigen::Index>(3 + c)];
    }
    // the stress of an inextensible beam follows from the stretch that its normal force would cause
    if (Held && section.stiffness(0, 0) == 0) strain[0] += stress[0] / section.own_stiffness[0];
    const auto [most, least] = normal_stress(section, strain);
    values[6 * piece.at.size() + 2 * p] = most;
    values[6 * piece.at.size() + 2 * p + 1] = least;
  }
}

template <int Nodes, bool Held>
std::vector<Derived> Beams<Nodes, Held>::derived(std::size_t e) const {
  const BeamPiece<Nodes>& piece = this->data(e);
  double length = 0;
  for (const auto& point : piece.at) length += point.length;
  std::vector<Derived> all = {{"length", length, dimension::length}};
  if (piece.section->mass > 0) all.push_back({"mass", piece.mass.sum(), dimension::mass});
  const Vec6& stiffness = piece.section->own_stiffness;
  constexpr Dimension bending{3, 1, -2, 0};
  all.push_back({"EA", stiffness[0], dimension::force});
  for (const auto& [name, row] : {std::pair{"GJ", 3}, {"EI 2", 4}, {"EI 3", 5}}) all.push_back({name, stiffness[row], bending});
  return all;
}

template <int Nodes, bool Held>
Drawing Beams<Nodes, Held>::drawing(std::size_t e) const {
  const auto ids = this->node_ids(e);
  const BeamPiece<Nodes>& piece = this->data(e);
  std::string shape = fmt::format(R"("shape": "beam", "points": {})", json(std::vector<int>(ids.begin(), ids.end())));
  if (!piece.section->outline.empty()) {
    std::vector<double> corners, axes;
    for (const Eigen::Vector2d& corner : piece.section->outline) corners.insert(corners.end(), {corner[0], corner[1]});
    for (const Mat3& at : piece.axes)
      for (const Eigen::Index axis : {1, 2}) axes.insert(axes.end(), {at(0, axis), at(1, axis), at(2, axis)});
    shape += fmt::format(R"(, "outline": [{}], "axes": [{}])", fmt::join(corners, ", "), fmt::join(axes, ", "));
  }
  return {shape};
}

template class Beams<2, false>;
template class Beams<3, false>;
template class Beams<2, true>;
template class Beams<3, true>;

}  // namespace engrane::elements::beams

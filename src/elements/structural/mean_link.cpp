// SPDX-License-Identifier: BSD-3-Clause
#include "elements/structural/mean_link.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "model/templated_element.hpp"

namespace engrane::elements::structural {

namespace {

constexpr double least_part = 1e-12;  ///< rounding of sums and of squared lengths, relative
constexpr double rounding_of_places = 16 * std::numeric_limits<double>::epsilon();  ///< of coordinates and differences, relative

constexpr const char* cure =
    "name nodes that do not lie on a line, or join single nodes to N by SPHERICAL joints; RIGID_LINK takes any group";

/// Share of the first node of the group. It owns the multipliers of the whole link and provides its results.
class FirstShare final : public TemplatedElement<FirstShare, 2, 15> {
 public:
  FirstShare(int id, Layout layout, NodeLink share) : TemplatedElement(id), share_(std::move(share)) {
    set_layout(std::move(layout));
  }

  template <class T>
  void evaluate(const Motion<T, 2>& motion, const State& state, Balance<T, 2>& balance) const {
    share_.evaluate(motion, state, balance);
  }

  bool in_mesh() const override { return false; }
  bool is_linear() const override { return share_.small; }

  const std::vector<Channel>& channels() const override {
    static const std::vector<Channel> names = {{"FORCE_X", dimension::force, "force of the node N on the group"},
                                               {"FORCE_Y", dimension::force, ""},
                                               {"FORCE_Z", dimension::force, ""},
                                               {"MOMENT_X", dimension::moment, "moment at the mean place of the group"},
                                               {"MOMENT_Y", dimension::moment, ""},
                                               {"MOMENT_Z", dimension::moment, ""}};
    return names;
  }

  void observe(const State& state, std::span<double> values) const override {
    Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
    const std::size_t forces = state.multipliers.size() == 3 ? 2 : 3;
    for (std::size_t c = 0; c < forces; ++c) force[static_cast<Eigen::Index>(c)] = state.multipliers[c];
    for (std::size_t c = forces; c < state.multipliers.size(); ++c)
      moment[static_cast<Eigen::Index>(forces == 2 ? 2 : c - forces)] = state.multipliers[c];
    const Mat3 R = share_.small ? Mat3(Mat3::Identity()) : state.nodes[0].R;
    Eigen::Map<Vec3>(values.data()) = R * force;
    Eigen::Map<Vec3>(values.data() + 3) = R * moment;
  }

 private:
  NodeLink share_;
};

/// The weights normalised to a sum of 1. Reports an error and returns nothing if their number is wrong, or there is no mean.
std::optional<std::vector<double>> parts_of_one(const MeanLinkData& data, std::size_t count, const BuildContext& context) {
  std::vector<double> weights = data.weights;
  if (weights.empty()) weights.assign(count, 1.0);
  if (weights.size() != count) {
    context.error("W", fmt::format("{} weights for {} nodes", weights.size(), count),
                  "give one for each node, in the order of their numbers, or none");
    return {};
  }
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  const double size = std::accumulate(weights.begin(), weights.end(), 0.0, [](double s, double w) { return s + std::abs(w); });
  if (!(std::abs(sum) > least_part * size)) {
    context.error("W", "the weights add up to zero: there is no mean",
                  "weights may be zero and negative, as those of the nodes of a face of second order; their sum may not be zero");
    return {};
  }
  for (double& w : weights) w /= sum;
  return weights;
}

std::unique_ptr<Element> build(const MeanLinkData& data, BuildContext& context) {
  const auto group = linked_group(data, context);
  if (!group) return nullptr;
  const std::size_t count = group->nodes.size();
  const auto weights = parts_of_one(data, count, context);
  if (!weights) return nullptr;
  // from the first node on: the place of the group in the model costs no digits of its size
  Vec3 centre = group->places.front();
  for (std::size_t i = 0; i < count; ++i) centre += (*weights)[i] * (group->places[i] - group->places.front());
  // weighted second moments of the positions about their centre; negative weights may take from them, but not from the extents
  Mat3 spread = Mat3::Zero(), unsigned_spread = Mat3::Zero();
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 e = group->places[i] - centre;
    spread += (*weights)[i] * e * e.transpose();
    unsigned_spread += std::abs((*weights)[i]) * e * e.transpose();
  }
  const Vec3 extents = Eigen::SelfAdjointEigenSolver<Mat3>(unsigned_spread).eigenvalues();
  // second moments that the rounding of coordinates makes
  double rounded = 0;
  for (const Vec3& place : group->places)
    rounded = std::max({rounded, place.squaredNorm(), (context.nodes.at(data.master) + place).squaredNorm()});
  rounded *= rounding_of_places * rounding_of_places;
  if (!(extents[2] > rounded)) {
    context.error("N",
                  fmt::format("the {} of the group lie in one place, which has no rotation for node {} to follow",
                              count == 1 ? "node" : "nodes", data.master),
                  cure);
    return nullptr;
  }
  if (!group->in_plane() && !(extents[1] > std::max(least_part * extents[2], rounded))) {
    context.error("N", fmt::format("the nodes of the group lie on a line, about which node {} could turn freely", data.master),
                  cure);
    return nullptr;
  }
  const Mat3 inertia = spread.trace() * Mat3::Identity() - spread;
  const Vec3 resistances =
      group->in_plane() ? Vec3(Vec3::Constant(inertia(2, 2))) : Vec3(Eigen::SelfAdjointEigenSolver<Mat3>(inertia).eigenvalues());
  if (!(resistances.cwiseAbs().minCoeff() > least_part * extents[2])) {
    context.error("W", fmt::format("with these weights the group has no mean rotation for node {} to follow", data.master),
                  "the second moments of the weights cancel out; take those of a face, or none");
    return nullptr;
  }
  const Mat3 flexibility = group->in_plane() ? Mat3(Vec3(0, 0, 1 / inertia(2, 2)).asDiagonal()) : Mat3(inertia.inverse());

  std::vector<Multiplier> multipliers;
  for (const char* name : {"FORCE_X", "FORCE_Y", "FORCE_Z"})
    multipliers.push_back({{name, dimension::length, "mean of the group, master's axes"}, Role::force});
  for (const char* name : {"MOMENT_X", "MOMENT_Y", "MOMENT_Z"})
    multipliers.push_back({{name, dimension::angle, "mean rotation of the group, master's axes"}, Role::moment});
  std::vector<Eigen::Index> rows = {0, 1, 2, 3, 4, 5};
  if (group->in_plane()) {
    rows = {0, 1, 5};
    multipliers = {multipliers[0], multipliers[1], multipliers[5]};
  }
  Layout whole = link_layout(group->in_plane(), std::move(multipliers));
  Layout shared = whole;
  shared.shares_multipliers = true;
  BlockStore alone;
  const auto block =
      (context.blocks ? *context.blocks : alone).block<NodeLinks>(group->in_plane() ? "mean, plane" : "mean", std::move(shared));
  std::unique_ptr<Element> first;
  for (std::size_t i = 0; i < count; ++i) {
    Eigen::Matrix<double, 6, 3> all;
    all.topRows<3>() = (*weights)[i] * Mat3::Identity();
    all.bottomRows<3>() = (*weights)[i] * flexibility * skew(group->places[i] - centre);
    if (group->in_plane()) all.col(2).setZero();
    NodeLink share{group->places[i], all(rows, Eigen::all), true, group->small, group->height};
    if (!first) {
      whole.nodes = {data.master, group->nodes[i]};
      first = std::make_unique<FirstShare>(context.record.id, whole, std::move(share));
    } else if (context.more) {
      context.more->push_back(NodeLinks::add(block, context.record.id, {data.master, group->nodes[i]}, std::move(share)));
    }
  }
  return first;
}

}  // namespace

ElementType mean_link_type() {
  deck::Card<MeanLinkData> card("MEAN_LINK", {"LIAISON_MOYENNE"},
                                "Mean link: a node follows the mean motion of a group of nodes");
  card.numbered()
      .chapter("Meshes")
      .describe(
          "The node N follows the weighted mean of the group in displacements and rotations of any size, and gives force and "
          "moment on it to the group, which stays as flexible as it is. Joints, gears and loads act on N. Of nodes of plane "
          "cells "
          "N follows x, y and the rotation about z.")
      .example("I 8 MEAN_LINK N 101 GROUP \"rim\"")
      .example("I 8 MEAN_LINK N 101 MEMBERS 1 2 3  W 1. 4. 1.");
  add_link_nodes(card);
  card.add("W", &MeanLinkData::weights,
           "weights of the nodes in the order of their numbers; none: all the same. They may be zero or negative, as the "
           "consistent ones of a face are; their sum may not be zero")
      .values(1, deck::any_number);
  return element_type(card, build);
}

}  // namespace engrane::elements::structural

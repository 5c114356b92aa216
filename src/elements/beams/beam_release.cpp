// SPDX-License-Identifier: BSD-3-Clause
#include "elements/beams/beam_release.hpp"

#include <fmt/format.h>

#include <Eigen/SVD>
#include <bitset>

#include "deck/cards/cards.hpp"
#include "elements/beams/line_shape.hpp"
#include "elements/common/building.hpp"
#include "elements/joints/joint_card.hpp"

namespace engrane::elements::beams {

namespace {

/// Force and moment components at an end in the axes of the section: N, V2, V3, T, M2, M3.
using Components = std::bitset<6>;

struct End {
  const char* keyword;
  bool last;
  Components released;
  Mat3 axes = Mat3::Identity();  ///< of the section, as columns
  Vec3 place = Vec3::Zero();
};

std::string in_words(const Components& components) {
  std::string text;
  for (std::size_t i = 0; i < 6; ++i)
    if (components.test(i)) text += (text.empty() ? "" : " ") + std::to_string(i + 1);
  return text;
}

/// Joint that releases certain components: its card, and its axes as indices of section axes (0 to 2).
struct Fitting {
  const char* card;
  std::size_t axis = 0;
  std::optional<std::size_t> second;  ///< second axis, fixed to the node of the deck
};

std::optional<Fitting> fitting(const Components& released) {
  const std::bitset<3> forces(released.to_ulong() & 7U), moments(released.to_ulong() >> 3U);
  const auto only = [](const std::bitset<3>& one) { return one.test(0) ? 0UL : one.test(1) ? 1UL : 2UL; };
  switch (forces.count()) {
    case 0:
      if (moments.count() == 1) return Fitting{"HINGE", only(moments), {}};
      if (moments.count() == 2) {
        const std::size_t first = only(moments);
        return Fitting{"UNIVERSAL", first, only(std::bitset<3>(moments).reset(first))};
      }
      return Fitting{"SPHERICAL", 0, {}};
    case 1:
      if (moments.none()) return Fitting{"PRISMATIC", only(forces), {}};
      if (moments == forces) return Fitting{"CYLINDRICAL", only(forces), {}};
      if (moments.all()) return Fitting{"POINT_LINE", only(forces), {}};
      return {};
    case 2:
      if (moments == ~forces) return Fitting{"PLANAR", only(~forces), {}};
      if (moments.all()) return Fitting{"POINT_PLANE", only(~forces), {}};
      return {};
    default:
      return {};
  }
}

class ReleaseWriter {
 public:
  ReleaseWriter(const BeamData& data, ShortForm& form) : data_(data), form_(form) {}

  void write() {
    BeamData beam = data_;
    beam.release_a.clear();
    beam.release_b.clear();
    // other errors of the beam are reported when it is built
    const std::vector<Fitting> joints = is_line() && find_ends() ? fittings() : std::vector<Fitting>{};
    const int pieces = static_cast<int>(LineNodes{data_.nodes, data_.linear}.pieces());
    if (joints.empty() || !form_.has_numbers(pieces + static_cast<int>(joints.size()))) {
      form_.add("BEAM", form_.record.id, std::move(beam));
      return;
    }
    std::vector<joints::JointData> made(joints.size());
    for (std::size_t i = 0; i < joints.size(); ++i) {
      const End& end = ends_[i];
      int& node = end.last ? beam.nodes.back() : beam.nodes.front();
      made[i].nodes = {form_.add_node(end.place, {node, node}, 0), node};
      node = made[i].nodes[0];
      const auto axis = [&](std::size_t k) {
        const Vec3 e = end.axes.col(static_cast<Eigen::Index>(k));
        return std::array{e[0], e[1], e[2]};
      };
      made[i].axis = axis(joints[i].axis);
      if (joints[i].second) made[i].second = axis(*joints[i].second);
    }
    form_.add("BEAM", form_.record.id, std::move(beam));
    for (std::size_t i = 0; i < joints.size(); ++i)
      form_.add(joints[i].card, form_.record.id + pieces + static_cast<int>(i), std::move(made[i]));
  }

 private:
  bool is_line() const {
    const std::size_t count = data_.nodes.size();
    return count == 2 || (count > 2 && (data_.linear || count % 2 == 1));
  }

  /// Collects the released ends with their axes. False if they cannot be determined; unless AXIS2 is missing, building the beam
  /// reports the reason.
  bool find_ends() {
    for (const auto& [keyword, components, last] :
         {std::tuple{"RELEASE_A", &data_.release_a, false}, {"RELEASE_B", &data_.release_b, true}}) {
      if (components->empty()) continue;
      End end{keyword, last, {}};
      for (const int component : *components) end.released.set(static_cast<std::size_t>(component - 1));
      end.place = form_.nodes.at(last ? data_.nodes.back() : data_.nodes.front());
      const bool alike = end.released.test(1) == end.released.test(2) && end.released.test(4) == end.released.test(5);
      if (!data_.axis_2 && !alike) {
        form_.error(keyword,
                    fmt::format("{} {} tells axis 2 from axis 3, and the beam has no AXIS2", keyword, in_words(end.released)),
                    "AXIS2 x y z, a direction across the beam on the side of axis 2 of its sections");
        return false;
      }
      const Vec3 first = tangent(last).stableNormalized();
      const auto& given = last && data_.axis_2_end ? data_.axis_2_end : data_.axis_2;
      const Vec3 side = given ? to_vector(*given).stableNormalized() : perpendicular(first);
      const Vec3 across = side - first.dot(side) * first;
      if (!(across.norm() > 1e-3)) return false;
      end.axes << first, across.normalized(), cross(first, across.normalized());
      ends_.push_back(end);
    }
    return true;
  }

  Vec3 tangent(bool last) const {
    const auto at = [&](std::size_t i) { return form_.nodes.at(data_.nodes[last ? data_.nodes.size() - 1 - i : i]); };
    const double sense = last ? -1 : 1;
    if (LineNodes{data_.nodes, data_.linear}.of_two()) return sense * (at(1) - at(0));
    return sense * LineShape<3>(-1).along({at(0), at(1), at(2)});
  }

  /// Joints of the released ends; empty after an error.
  std::vector<Fitting> fittings() const {
    std::vector<Fitting> joints;
    for (const End& end : ends_) {
      const auto joint = fitting(end.released);
      if (!joint) {
        const bool loose = (end.released.to_ulong() & 7U) == 7U;
        form_.error(end.keyword,
                    loose ? fmt::format("with 1, 2 and 3 released the end is not joined to node {}",
                                        end.last ? data_.nodes.back() : data_.nodes.front())
                          : fmt::format("no joint leaves {} free and holds the rest", in_words(end.released)),
                    loose
                        ? "give a free end a node of its own"
                        : "any of the moments 4 5 6; one force, alone, with the moment about it, or with all moments; two forces "
                          "with the moment about the third, or with all moments");
        return {};
      }
      joints.push_back(*joint);
    }
    return is_held() ? joints : std::vector<Fitting>{};
  }

  /// Whether the unreleased components of both ends prevent every rigid-body motion; otherwise reports an error.
  bool is_held() const {
    if (ends_.size() < 2) return true;  // the other end is rigidly connected
    const Vec3 middle = (ends_[0].place + ends_[1].place) / 2;
    const double length = (ends_[1].place - ends_[0].place).norm();
    Eigen::Matrix<double, 6, Eigen::Dynamic> held(6, 12);
    Eigen::Index count = 0;
    for (const End& end : ends_)
      for (Eigen::Index k = 0; k < 6; ++k) {
        if (end.released.test(static_cast<std::size_t>(k))) continue;
        const Vec3 e = end.axes.col(k % 3);
        held.col(count).head<3>() = k < 3 ? e : Vec3(Vec3::Zero());
        held.col(count++).tail<3>() = k < 3 ? Vec3(cross(Vec3((end.place - middle) / length), e)) : e;
      }
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(held.leftCols(count), Eigen::ComputeFullU);
    constexpr double small = 1e-9;
    if (count >= 6 && svd.singularValues()[5] > small * svd.singularValues()[0]) return true;
    const Eigen::VectorXd motion = svd.matrixU().col(5);
    const Vec3 shift = motion.head<3>(), turn = motion.tail<3>();
    const bool turns = turn.norm() > 1e-6;
    Vec3 along = (turns ? turn : shift).normalized();
    Eigen::Index largest = 0;
    along.cwiseAbs().maxCoeff(&largest);
    if (along[largest] < 0) along = -along;
    const auto clean = [](double x) { return number(std::abs(x) < small ? 0 : x); };
    form_.error("RELEASE_B",
                fmt::format("with these releases at both ends beam {} is free to {} {} {} {}", form_.record.id,
                            turns ? "turn about" : "move along", clean(along[0]), clean(along[1]), clean(along[2])),
                "what one end leaves free, the other must hold");
    return false;
  }

  const BeamData& data_;
  ShortForm& form_;
  std::vector<End> ends_;
};

}  // namespace

void write_releases(const BeamData& data, ShortForm& form) { ReleaseWriter(data, form).write(); }

}  // namespace engrane::elements::beams

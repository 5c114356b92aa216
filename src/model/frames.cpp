// SPDX-License-Identifier: BSD-3-Clause
#include "model/frames.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>

#include "math/angle.hpp"

namespace engrane {

void Frames::add(const deck::Record& record, const deck::FrameCard& card, Diagnostics& diagnostics) {
  const Vec3 origin(card.origin[0], card.origin[1], card.origin[2]);
  const Vec3 first(card.first[0], card.first[1], card.first[2]);
  const Vec3 second(card.second[0], card.second[1], card.second[2]);
  const Vec3 normal = cross(first, second);
  if (normal.norm() <= 1e-12 * first.norm() * second.norm()) {
    diagnostics.error(record.where("V2"), "the two vectors of this frame are parallel or zero",
                      "V2 fixes the plane of the second axis: give any vector that is not along V1");
    return;
  }
  Mat3 axes;
  axes.col(0) = first.normalized();
  axes.col(2) = normal.normalized();
  axes.col(1) = cross(Vec3(axes.col(2)), Vec3(axes.col(0)));
  const Kind kind = card.kind.is("CYLINDRICAL") ? Kind::cylindrical
                    : card.kind.is("SPHERICAL") ? Kind::spherical
                                                : Kind::cartesian;
  frames_[record.id] = {origin, axes, kind};
}

Vec3 Frames::to_global(const deck::Record& record, const deck::NodeCard& node, Diagnostics& diagnostics) const {
  const Vec3 given(node.x[0], node.x[1], node.x[2]);
  if (node.frame == 0) return given;
  const auto it = frames_.find(node.frame);
  if (it == frames_.end()) {
    diagnostics.missing(".FRAME", record.where("FRAME"), fmt::format("frame {} does not exist", node.frame),
                        fmt::format("declare it with .FRAME I {}", node.frame));
    return given;
  }
  const Frame& frame = it->second;
  Vec3 local = given;
  if (frame.kind == Kind::cylindrical)
    local = Vec3(given[0] * std::cos(given[1] * degree), given[0] * std::sin(given[1] * degree), given[2]);
  if (frame.kind == Kind::spherical) {
    const double theta = given[1] * degree, phi = given[2] * degree;
    local = given[0] * Vec3(std::cos(theta) * std::cos(phi), std::sin(theta) * std::cos(phi), std::sin(phi));
  }
  return frame.origin + frame.axes * local;
}

std::optional<Mat3> Frames::axes_at(int frame, const Vec3& place) const {
  const auto it = frames_.find(frame);
  if (it == frames_.end()) return {};
  const Frame& f = it->second;
  if (f.kind == Kind::cartesian) return f.axes;
  const Vec3 local = f.axes.transpose() * (place - f.origin);
  const double theta = std::atan2(local[1], local[0]);
  const Mat3 about = Eigen::AngleAxisd(theta, Vec3::UnitZ()).toRotationMatrix();
  if (f.kind == Kind::cylindrical) return Mat3(f.axes * about);
  // the elevation φ turns the radial axis towards the third axis
  const double phi = std::atan2(local[2], std::hypot(local[0], local[1]));
  return Mat3(f.axes * about * Eigen::AngleAxisd(-phi, Vec3::UnitY()).toRotationMatrix());
}

bool Frames::is_curved(int frame) const {
  const auto it = frames_.find(frame);
  return it != frames_.end() && it->second.kind != Kind::cartesian;
}

}  // namespace engrane

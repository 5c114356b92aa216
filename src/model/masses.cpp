// SPDX-License-Identifier: BSD-3-Clause
#include "model/masses.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "model/element_at_rest.hpp"

namespace engrane {

namespace {

/// Inertia of a point mass about a point at the distance `away` (parallel-axis term).
Mat3 steiner(double mass, const Vec3& away) { return mass * (away.squaredNorm() * Mat3::Identity() - away * away.transpose()); }

/// Acceleration whose inertia forces are as large as the forces at rest, by those for an acceleration of 1; at least 1. Thermal
/// and prestressed elements have forces at rest beside which those of 1 would be rounding.
double acceleration_beside(std::span<const double> still, std::span<const double> moved) {
  double rest = 0, inertia = 0;
  for (std::size_t i = 0; i < still.size(); ++i) {
    rest = std::max(rest, std::abs(still[i]));
    inertia = std::max(inertia, std::abs(moved[i] - still[i]));
  }
  return inertia > 0 ? std::max(1.0, rest / inertia) : 1.0;
}

/// Resultant force of an element's residual, and moment about the first node.
struct Resistance {
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
};

class Shaken {
 public:
  Shaken(const Model& model, const Model::Part& part)
      : element_(*part.element),
        body_(model, part),
        still_(static_cast<std::size_t>(element_.layout().slots())),
        moved_(still_.size()) {
    element_.residual(body_.view(), still_);
  }

  const Vec3& origin() const { return body_.nodes.front().x; }
  /// From now on accelerates so strongly that forces at rest leave no rounding; after a first call of under().
  void accelerate() { unit_ = acceleration_beside(still_, moved_); }

  Resistance under(const Vec3& acceleration, const Vec3& turning) {
    for (NodeState& node : body_.nodes) {
      node.a = unit_ * (acceleration + turning.cross(Vec3(node.x - origin())));
      node.A = unit_ * turning;  // no rotation has occurred yet
    }
    element_.residual(body_.view(), moved_);
    Resistance sum;
    const Layout& layout = element_.layout();
    for (std::size_t i = 0; i < body_.nodes.size(); ++i) {
      const auto at = [&](int slot) {
        return slot < 0 ? Vec3(Vec3::Zero())
                        : Vec3((Eigen::Map<const Vec3>(&moved_[static_cast<std::size_t>(slot)]) -
                                Eigen::Map<const Vec3>(&still_[static_cast<std::size_t>(slot)])) /
                               unit_);
      };
      const Vec3 force = at(layout.node_slot(i, NodeNeed::translation));
      sum.force += force;
      sum.moment += at(layout.node_slot(i, NodeNeed::rotation)) + Vec3(body_.nodes[i].x - origin()).cross(force);
    }
    return sum;
  }

 private:
  const Element& element_;
  ElementAtRest body_;
  std::vector<double> still_, moved_;
  double unit_ = 1;  ///< of accelerations
};

/// Mass properties of a cell whose nodes move along x and y only, with equal mass in both directions. Nodal accelerations 1, x
/// and y give its mass matrix times these vectors, and hence all in-plane moments of its mass. Out of plane, the mass is at the
/// height of the nodes. `mass_alone`: computes the mass only.
MassProperties plane_mass_properties(const Model& model, const Model::Part& part, bool mass_alone) {
  ElementAtRest body(model, part);
  const std::size_t count = body.nodes.size();
  std::vector<double> still(2 * count), moved(2 * count);
  part.element->residual(body.view(), still);
  MassProperties found;
  double unit = 1;          // of accelerations
  Eigen::Matrix3d moments;  // of the functions 1, x and y with one another
  const Vec3 origin = body.nodes.front().x;
  const auto function = [&](std::size_t i, Eigen::Index of) { return of == 0 ? 1 : body.nodes[i].x[of - 1] - origin[of - 1]; };
  /// Inertia forces for the last acceleration along a direction, times the function `row`.
  const auto moment = [&](Eigen::Index row, std::size_t direction) {
    double sum = 0;
    for (std::size_t i = 0; i < count; ++i) sum += function(i, row) * (moved[2 * i + direction] - still[2 * i + direction]);
    return sum / unit;
  };
  const auto accelerate = [&](Eigen::Index along_x, Eigen::Index along_y) {
    for (std::size_t i = 0; i < count; ++i)
      body.nodes[i].a = unit * Vec3(function(i, along_x), along_y < 0 ? 0 : function(i, along_y), 0);
    part.element->residual(body.view(), moved);
  };
  accelerate(0, mass_alone ? -1 : 1);
  unit = acceleration_beside(still, moved);
  if (unit > 1) accelerate(0, mass_alone ? -1 : 1);
  found.mass = moment(0, 0);
  if (mass_alone || found.mass == 0) return found;
  for (Eigen::Index row = 0; row < 3; ++row)
    for (const std::size_t direction : {0U, 1U}) moments(row, static_cast<Eigen::Index>(direction)) = moment(row, direction);
  accelerate(2, -1);
  for (Eigen::Index row = 0; row < 3; ++row) moments(row, 2) = moment(row, 0);
  const Eigen::Vector2d from = moments.block<2, 1>(1, 0) / found.mass;
  const Eigen::Matrix2d second = moments.block<2, 2>(1, 1) - found.mass * from * from.transpose();
  found.centre = origin + Vec3(from[0], from[1], 0);
  found.inertia << second(1, 1), -second(0, 1), 0, -second(1, 0), second(0, 0), 0, 0, 0, second.trace();
  return found;
}

/// Translational mass that an element contributes to its first node, from its residual under unit acceleration.
double mass_at_first_node(const Model& model, const Model::Part& part) {
  ElementAtRest body(model, part);
  const auto n = static_cast<std::size_t>(part.element->layout().slots());
  std::vector<double> still(n), moved(n);
  part.element->residual(body.view(), still);
  body.nodes[0].a = Vec3::UnitX();
  part.element->residual(body.view(), moved);
  return moved[0] - still[0];
}

}  // namespace

void MassProperties::add(const MassProperties& other) {
  const double sum = mass + other.mass;
  const Vec3 middle = sum != 0 ? Vec3((mass * centre + other.mass * other.centre) / sum) : centre;
  inertia += other.inertia + steiner(mass, centre - middle) + steiner(other.mass, other.centre - middle);
  mass = sum;
  centre = middle;
}

MassProperties mass_properties(const Model& model, const Model::Part& part) {
  MassProperties found;
  if (part.nodes.empty() || part.element->layout().node_slots() == 0) return found;
  if (part.element->layout().needs_any(0, NodeNeed::in_plane)) {
    if (part.element->cell_shape() == CellShape::none) return found;  // a load
    return plane_mass_properties(model, part, false);
  }
  Shaken shaken(model, part);
  // most elements of a large model have no mass: one evaluation shows this
  const Resistance any = shaken.under(Vec3(0.83, -0.51, 0.22), Vec3(-0.37, 0.61, 0.7));
  if (any.force.isZero(0) && any.moment.isZero(0)) return found;
  shaken.accelerate();
  Vec3 first = Vec3::Zero();  // mass times position of the centre relative to the first node
  Mat3 about;
  for (int k = 0; k < 3; ++k) {
    const Vec3 e = Vec3::Unit(k);
    found.mass += shaken.under(e, Vec3::Zero()).force[k] / 3;
    const Resistance turned = shaken.under(Vec3::Zero(), e);
    first += turned.force.cross(e) / 2;  // Σ e × (…): m (e × c) × e summed over the axes is 2 m c
    about.col(k) = turned.moment;
  }
  const Vec3 from = found.mass != 0 ? Vec3(first / found.mass) : Vec3(Vec3::Zero());
  found.centre = shaken.origin() + from;
  found.inertia = about - steiner(found.mass, from);
  // residues of cancelling large terms are not inertia
  const double rounding = 1e-13 * (about.cwiseAbs().maxCoeff() + std::abs(found.mass) * from.squaredNorm());
  found.inertia = found.inertia.unaryExpr([rounding](double x) { return std::abs(x) <= rounding ? 0.0 : x; });
  return found;
}

double mass_of(const Model& model, const Model::Part& part) {
  const bool is_plane_cell = part.element->cell_shape() != CellShape::none && part.element->layout().node_slots() > 0 &&
                             part.element->layout().needs_any(0, NodeNeed::in_plane);
  return is_plane_cell ? plane_mass_properties(model, part, true).mass : mass_properties(model, part).mass;
}

double radius_of_gyration(const Model& model, const Model::Part& part) {
  if (part.nodes.empty() || part.nodes.front() <= 0) return 0;
  const Mat3 inertia = part.element->inertia_at(model.node(part.nodes.front()).id);
  const double moment = inertia.diagonal().maxCoeff();
  const double mass = moment > 0 ? mass_at_first_node(model, part) : 0;
  return mass > 0 ? std::sqrt(moment / mass) : 0;
}

}  // namespace engrane

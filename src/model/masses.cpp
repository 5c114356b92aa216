// SPDX-License-Identifier: BSD-3-Clause
#include "model/masses.hpp"

#include <cmath>

#include "model/element_at_rest.hpp"

namespace engrane {

namespace {

/// I about a point that lies `away` from the centre of the mass.
Mat3 steiner(double mass, const Vec3& away) { return mass * (away.squaredNorm() * Mat3::Identity() - away * away.transpose()); }

/// Resultant of an element's resistance, its moment about the first node.
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

  Resistance under(const Vec3& acceleration, const Vec3& turning) {
    for (NodeState& node : body_.nodes) {
      node.a = acceleration + turning.cross(Vec3(node.x - origin()));
      node.A = turning;  // nothing has turned yet
    }
    element_.residual(body_.view(), moved_);
    Resistance sum;
    const Layout& layout = element_.layout();
    for (std::size_t i = 0; i < body_.nodes.size(); ++i) {
      const auto at = [&](int slot) {
        return slot < 0 ? Vec3(Vec3::Zero())
                        : Vec3(Eigen::Map<const Vec3>(&moved_[static_cast<std::size_t>(slot)]) -
                               Eigen::Map<const Vec3>(&still_[static_cast<std::size_t>(slot)]));
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
};

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
  Shaken shaken(model, part);
  // most elements of a large model have no mass: one look at them is enough
  const Resistance any = shaken.under(Vec3(0.83, -0.51, 0.22), Vec3(-0.37, 0.61, 0.7));
  if (any.force.isZero(0) && any.moment.isZero(0)) return found;
  Vec3 first = Vec3::Zero();  // mass times centre, from the first node
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
  // what is left of large terms that cancel is not inertia
  const double rounding = 1e-13 * (about.cwiseAbs().maxCoeff() + std::abs(found.mass) * from.squaredNorm());
  found.inertia = found.inertia.unaryExpr([rounding](double x) { return std::abs(x) <= rounding ? 0.0 : x; });
  return found;
}

}  // namespace engrane

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>

#include "elements/bodies/body_inertia.hpp"
#include "model/templated_element.hpp"

namespace engrane::elements::bodies {

/// A rigid body's inertia on one node: all of INERTIA, and a part of RIGID. It needs the node's rotation only if the body has a
/// tensor or an offset.
class CarriedBody final : public TemplatedElement<CarriedBody, 1, 6> {
 public:
  /// `drawing`: see docs/format.md; default: a ball at the node.
  CarriedBody(int id, int node, const BodyInertia& body, std::string drawing = {})
      : TemplatedElement(id), body_(body), channels_(body_channels(body)), drawing_(std::move(drawing)) {
    if (drawing_.empty()) drawing_ = R"("shape": "mass", "node": )" + std::to_string(node);
    Layout layout;
    layout.nodes = {node};
    layout.needs = {!body.turns() ? NodeNeed::translation : body.mass == 0 ? NodeNeed::rotation : NodeNeed::both};
    set_layout(std::move(layout));
  }

  template <class T>
  void evaluate(const Motion<T, 1>& motion, const State& state, Balance<T, 1>& balance) const {
    const auto resistance = body_.resistance<T>(motion.node[0], state.gravity);
    balance.force(0, resistance.force);
    balance.moment(0, resistance.moment);
  }

  Energies energies(const State& state) const override { return body_.energies(state); }
  bool is_body() const override { return true; }
  Mat3 inertia_at(int node) const override { return node == layout().nodes[0] ? body_.about_node() : Mat3(Mat3::Zero()); }
  const std::vector<Channel>& channels() const override { return channels_; }
  void observe(const State& state, std::span<double> values) const override { observe_body(body_, state.nodes[0], values); }
  Drawing drawing() const override { return {drawing_}; }

 private:
  BodyInertia body_;
  std::vector<Channel> channels_;
  std::string drawing_;
};

}  // namespace engrane::elements::bodies

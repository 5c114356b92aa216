// SPDX-License-Identifier: BSD-3-Clause
#include "elements/joints/weld.hpp"

namespace engrane::elements::joints {

namespace {

std::unique_ptr<Element> build_weld(const JointData& data, BuildContext& context) {
  auto parts = start_joint(data, context, "weld", PointRule::at_b, false);
  if (!parts) return nullptr;
  parts->constraints = {{Measure::gap_1},  {Measure::gap_2},  {Measure::gap_3},
                        {Measure::turn_1}, {Measure::turn_2}, {Measure::turn_3}};
  parts->has_axis = true;  // those of node a
  return std::make_unique<Joint>(context.record.id, std::move(*parts));
}

}  // namespace

ElementType weld_type() {
  JointCard card("WELD", {"ENCASTREMENT", "FIXED"}, "Weld: node b keeps its place and orientation relative to node a");
  card.numbered()
      .chapter("Rigid kinematic joints")
      .describe(
          "The nodes may be anywhere: they stay as they are to each other in the reference configuration. AT is the point at "
          "which moments are reported, without it node b.")
      .example("I 3 WELD N 1 2")
      .example("I 4 WELD N 0 7  AT 0 0 1");
  add_joint_nodes(card);
  add_joint_point(card);
  return element_type(card, build_weld);
}

}  // namespace engrane::elements::joints

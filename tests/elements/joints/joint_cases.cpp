// SPDX-License-Identifier: BSD-3-Clause
#include "elements/joints/joint_cases.hpp"

namespace engrane::suite {

const FunctionMap& joint_functions() {
  static const FunctionMap functions = [] {
    FunctionMap f;
    f[1] = std::make_unique<Wave>(0.3, 0.7, 1.9, 0.4);
    return f;
  }();
  return functions;
}

JointData joint_data(int a, int b) {
  JointData data;
  data.nodes = {a, b};
  data.axis = {0.3, -0.5, 0.7};
  data.at = {{0.4, 0.1, -0.2}};
  data.pitch = 0.8;
  return data;
}

void keep_near(StateBuffer& state, double largest) {
  const Mat3 apart = state.nodes[0].R.transpose() * state.nodes[1].R;
  const Eigen::AngleAxisd turn(apart);
  if (turn.angle() <= largest) return;
  const std::size_t moved = state.is_ground(1) ? 0 : 1;
  const Mat3 kept = Eigen::AngleAxisd(largest, turn.axis()).toRotationMatrix();
  const Mat3 R = moved == 1 ? Mat3(state.nodes[0].R * kept) : Mat3(state.nodes[1].R * kept.transpose());
  const Vec3 y = state.y[moved];
  state.turn(moved, R * rotation_exp(y).transpose(), y);
}

Subject joint_subject(const std::string& name, ElementType (*type)(), const JointData& wished) {
  Subject s;
  s.name = name;
  s.nodes = {{0, Vec3::Zero()}, {1, {1, 0.2, -0.3}}, {2, {-0.5, 0.4, 0.8}}};
  s.build = [=](const Mat3& Q) {
    JointData data = wished;
    data.axis = components(Q * Vec3(data.axis.data()));
    for (auto* direction : {&data.second, &data.at, &data.from, &data.to, &data.on})
      if (*direction) *direction = components(Q * Vec3((*direction)->data()));
    return build(type(), data, turned(s.nodes, Q), {.functions = &joint_functions()});
  };
  s.force = 5;
  s.states = name == "joint" ? 40 : 10;
  s.adjust = [](StateBuffer& state, Random&) { keep_near(state, 2); };
  s.own_axes = true;
  return s;
}

Subject damped(Subject s) {
  s.skip[Check::lagrange] = "a damper has no potential";
  return s;
}

Subject driven(Subject s) {
  s.skip[Check::zero] = "the function is not zero at t = 0";
  s.skip[Check::rigid] = "the function is not zero at t = 0";
  return s;
}

void check_switches(const Subject& subject) {
  SCOPED_TRACE(subject.name);
  const auto element = subject.build(Mat3::Identity());
  ASSERT_NE(element, nullptr);
  Random random(11);
  const std::size_t count = element->layout().switches.size();
  ASSERT_GT(count, 0U);
  for (int i = 0; i < 10; ++i) {
    const StateBuffer state = random_state(subject, *element, random);
    const auto at = [&](double t) {
      std::vector<Switch> values(count);
      element->switches(state.after(t).view(), values);
      return values;
    };
    const double h = 1e-5;
    const auto now = at(0), plus = at(h), minus = at(-h);
    for (std::size_t k = 0; k < count; ++k) {
      if (now[k].size == 0 || plus[k].size == 0 || minus[k].size == 0) continue;
      const double rate = (plus[k].value - minus[k].value) / (2 * h);
      EXPECT_NEAR(now[k].rate, rate, 1e-6 * (std::abs(rate) + now[k].size)) << element->layout().switches[k].rises;
    }
  }
}

void run_coordinate(ElementType (*type)(), const JointData& plain, Coordinate of, const std::string& itself, bool turns,
                    double largest) {
  const auto joint_subject = [=](const std::string& name, ElementType (*of_type)(), const JointData& data) {
    Subject s = suite::joint_subject(name, of_type, data);
    s.adjust = [=](StateBuffer& state, Random&) { keep_near(state, largest); };
    return s;
  };
  for (const std::string& kind : {itself, std::string("SPEED")}) {
    JointData data = plain;
    of(data).drive.tag = kind;
    of(data).function = 1;
    run_suite(driven(joint_subject("driven in " + kind, type, data)));
  }
  {
    JointData data = plain;
    of(data).stiffness = 12;
    of(data).relaxed = turns ? 20 : 0.3;
    Subject s = joint_subject("spring", type, data);
    s.skip[Check::zero] = s.skip[Check::rigid] = "the spring is not relaxed in the reference configuration";
    run_suite(s);
    of(data).relaxed = 0;
    of(data).damping = 3;
    run_suite(damped(joint_subject("spring and damper", type, data)));
  }
  {
    JointData data = plain;
    of(data).law = {"POLY", {3, 0.7, 2}};
    run_suite(joint_subject("polynomial", type, data));
    of(data).damping_law = 1;
    Subject s = driven(damped(joint_subject("polynomial and law of damping", type, data)));
    run_suite(s);
  }
  // far enough that every state presses the same stop: at the limit itself differences have no meaning
  for (const double far : {1.0, -1.0}) {
    const double exponent = far > 0 ? 1 : 1.5;
    JointData data = plain;
    of(data).lower = of(data).upper = far * (turns ? 400 : 12);
    of(data).stop_stiffness = 9;
    of(data).stop_exponent = exponent;
    Subject s = joint_subject("stops", type, data);
    s.skip[Check::zero] = s.skip[Check::rigid] = "the reference configuration presses on a stop";
    run_suite(s);
    of(data).stop_damping = {"HUNT", {0.02}};
    s = damped(joint_subject("stops of Hunt and Crossley", type, data));
    s.skip[Check::zero] = s.skip[Check::rigid] = "the reference configuration presses on a stop";
    run_suite(s);
    check_switches(s);
  }
}

namespace {

/// The card with a friction of which every keyword counts that there is for any joint.
JointData rubbing(const JointData& plain, const deck::Tagged& law, bool has_radius) {
  JointData data = plain;
  data.friction = law;
  if (has_radius) data.radius = 0.4;
  data.collar = 0.3;
  data.bearing_length = 0.9;
  data.preload = 0.6;
  return data;
}

Subject rubbed_subject(const std::string& name, ElementType (*type)(), const JointData& data) {
  Subject s = joint_subject(name, type, data);
  s.skip[Check::ideal] = "friction follows the size of the reaction";
  s.skip[Check::lagrange] = "friction has no potential";
  return s;
}

}  // namespace

void run_friction(ElementType (*type)(), const JointData& plain, bool has_radius, double largest) {
  const deck::Tagged laws[] = {{"CONST", {0.3}}, {"STRIBECK", {0.4, 0.25, 0.8, 0.05}}, {"FCT", {1}}};
  for (const deck::Tagged& law : laws)
    for (const double width : {0.02, 20.0}) {
      JointData data = rubbing(plain, law, has_radius);
      data.friction_width = width;
      Subject s = rubbed_subject("friction " + law.tag + " of width " + std::to_string(width), type, data);
      s.adjust = [=](StateBuffer& state, Random&) { keep_near(state, largest); };
      run_suite(s);
      if (law.tag == "FCT") continue;  // a wave: may be negative
      const auto element = s.build(Mat3::Identity());
      Random random(5);
      for (int i = 0; i < 40; ++i) {
        const StateBuffer state = random_state(s, *element, random);
        EXPECT_GT(element->energies(state.view()).dissipated, 0) << s.name;
      }
    }
}

void run_grips(ElementType (*type)(), const JointData& plain, bool has_radius, const std::map<Check, std::string>& skip,
               double largest) {
  const deck::Tagged laws[] = {{"CONST", {0.3, 0.4}}, {"STRIBECK", {0.4, 0.25, 0.8, 0.05}}};
  for (const deck::Tagged& law : laws)
    for (const GripState::Mode mode : {GripState::sliding, GripState::holding}) {
      JointData data = rubbing(plain, law, has_radius);
      data.sticks = true;
      Subject s = rubbed_subject("grip " + law.tag + " in mode " + std::to_string(mode), type, data);
      const Layout layout = s.build(Mat3::Identity())->layout();
      s.adjust = [=](StateBuffer& state, Random&) { keep_near(state, largest); };
      put_grips(s, layout, mode);
      s.step *= 0.3;  // near rest directions turn fast
      s.skip.insert(skip.begin(), skip.end());
      run_suite(s);

      const auto element = s.build(Mat3::Identity());
      Random random(5);
      for (int k = 0; k < 20; ++k) {
        StateBuffer state = random_state(s, *element, random);
        std::vector<double> history = state.history, scalars(layout.scalars.size());
        element->count_turns(state.view(), scalars, history);  // a ball that slides is measured from where it last was
        state.history = history;
        std::vector<Grip> now(layout.grips.size());
        find_grips(*element, state.view(), now);
        std::vector<Switch> switches(layout.switches.size());
        element->switches(state.view(), switches);
        double lost = 0;
        for (std::size_t i = 0; i < now.size(); ++i) {
          const Grip& grip = now[i];
          EXPECT_GT(grip.limit, 0) << s.name;
          EXPECT_EQ(grip.state.mode, mode);
          const Switch& slides = switches[2 * i];
          const Switch& holds = switches[2 * i + 1];
          if (mode == GripState::holding) {
            EXPECT_EQ(slides.size, 0);
            EXPECT_DOUBLE_EQ(holds.value, (1 + GripState::slack) * grip.limit - grip.force.norm());
          } else {
            EXPECT_EQ(holds.size, 0);
            EXPECT_DOUBLE_EQ(slides.value, grip.state.direction.dot(grip.speed));
            // at the speed zero friction is its limit, for the law that has but one coefficient
            lost += grip.state.towards(grip.speed, grip.shape.size).dot(grip.speed) * grip.limit;
          }
        }
        if (law.tag != "CONST" || mode == GripState::holding) continue;
        EXPECT_NEAR(element->energies(state.view()).dissipated, 0.75 * lost, 1e-10 * std::abs(lost)) << s.name;
      }
    }
}

void run_joint_extremes(ElementType (*type)(), const JointData& wished) {
  for (const double stiffness : {1e-6, 1e15})
    for (const double length : {1e-9, 1e6}) {
      Subject s;
      s.name = "stiffness " + std::to_string(stiffness) + " length " + std::to_string(length);
      s.nodes = {{0, Vec3::Zero()}, {1, Vec3(length, 0, 0)}, {2, Vec3(0, length, 0)}};
      s.length = s.velocity = length;
      s.build = [=](const Mat3&) {
        JointData data = wished;
        data.slide().stiffness = data.slide().damping = data.turn().stiffness = data.turn().damping = stiffness;
        data.pitch *= length;
        for (auto* place : {&data.at, &data.from, &data.to, &data.on})
          if (*place) *place = components(Vec3((*place)->data()) * length);
        return build(type(), data, s.nodes, {.functions = &joint_functions()});
      };
      run_extreme(s);
    }
}

std::string joint_fault(ElementType (*type)(), const JointData& data) {
  const NodeMap nodes = {{0, Vec3::Zero()}, {1, {1, 0, 0}}, {2, {1, 3, 4}}};
  Diagnostics diagnostics;
  EXPECT_EQ(build(type(), data, nodes, {.functions = &joint_functions(), .diagnostics = &diagnostics}), nullptr);
  return diagnostics.all().empty() ? std::string() : diagnostics.all().front().message;
}

}  // namespace engrane::suite

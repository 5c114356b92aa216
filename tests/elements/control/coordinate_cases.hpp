// SPDX-License-Identifier: BSD-3-Clause
// What the tests of elements that use other elements' coordinates share: a machine of three joints and three sensors.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "elements/control/sensor.hpp"
#include "elements/joints/cylindrical.hpp"
#include "elements/joints/joint_card.hpp"
#include "elements/joints/joint_cases.hpp"
#include "elements/joints/prismatic.hpp"
#include "elements/joints/spherical.hpp"
#include "elements/joints/universal.hpp"
#include "elements/suite.hpp"

namespace engrane::suite {

using namespace elements::control;
using namespace elements::joints;

inline NodeMap machine_nodes() {
  return {{0, Vec3::Zero()}, {1, {1, 0.2, -0.3}}, {2, {-0.5, 0.4, 0.8}}, {3, {0.3, -0.7, 0.5}}, {4, {0.9, 0.6, 1.1}}};
}

/// Records of a deck:
/// 1 CYLINDRICAL of nodes 1 and 2, 2 PRISMATIC of 2 and 3, 3 UNIVERSAL of 3 and 4, 4 CYLINDRICAL of the ground and 1,
/// 5 SPHERICAL of 1 and 2; sensors 11 DISTANCE of 1 and 3, 12 ANGLE of 2 and 4, 13 DISPLACEMENT of the ground and 3.
class Machine {
 public:
  explicit Machine(const Mat3& turn = Mat3::Identity()) {
    add(1, types().cylindrical, joint(1, 2, turn));
    add(2, types().prismatic, joint(2, 3, turn));
    JointData cross = joint(3, 4, turn);
    cross.second = components(turn * Vec3(0.5, 0.3, 0));  // perpendicular to the axis
    add(3, types().universal, cross);
    add(4, types().cylindrical, joint(0, 1, turn));
    add(5, types().spherical, joint(1, 2, turn));
    const Vec3 axis = turn * Vec3(0.3, -0.5, 0.7);
    SensorData sensor;
    sensor.nodes = {1, 3};
    sensor.kind.tag = "DISTANCE";
    add(11, types().sensor, sensor);
    sensor.nodes = {2, 4};
    sensor.kind.tag = "ANGLE";
    sensor.axis = components(axis);
    add(12, types().sensor, sensor);
    sensor.nodes = {0, 3};
    sensor.kind.tag = "DISPLACEMENT";
    add(13, types().sensor, sensor);
  }

  const std::vector<deck::Record>& records() const { return records_; }

  template <class Data>
  void add(int id, const ElementType& type, const Data& data) {
    deck::Record record;
    record.schema = &type.schema;
    record.id = id;
    record.data = data;
    records_.push_back(std::move(record));
  }

 private:
  struct Types {
    ElementType cylindrical = cylindrical_type(), prismatic = prismatic_type(), universal = universal_type(),
                spherical = spherical_type(), sensor = sensor_type();
  };
  static const Types& types() {
    static const Types all;
    return all;
  }
  static JointData joint(int a, int b, const Mat3& turn) {
    JointData data = joint_data(a, b);
    data.axis = components(turn * Vec3(data.axis.data()));
    data.at = components(turn * Vec3(data.at->data()));
    return data;
  }

  std::vector<deck::Record> records_;
};

/// A subject that builds its element in the machine.
template <class Data>
Subject machine_subject(const std::string& name, ElementType (*type)(), const Data& data) {
  Subject s;
  s.name = name;
  s.nodes = machine_nodes();
  s.build = [=](const Mat3& Q) {
    const Machine machine(Q);
    return build(type(), data, turned(s.nodes, Q), {.functions = &joint_functions(), .records = &machine.records()});
  };
  s.force = 5;
  s.step = 3e-4;  // angles far from their axes turn fast
  s.tolerance = 1e-7;
  s.skip[Check::zero] = "the wanted value is not that of the reference configuration";
  s.skip[Check::rigid] = s.skip[Check::zero];
  return s;
}

/// The first message about a faulty card.
template <class Data>
std::string machine_fault(ElementType (*type)(), const Data& data) {
  const Machine machine;
  Diagnostics diagnostics;
  EXPECT_EQ(build(type(), data, machine_nodes(),
                  {.functions = &joint_functions(), .diagnostics = &diagnostics, .records = &machine.records()}),
            nullptr);
  return diagnostics.all().empty() ? std::string() : diagnostics.all().front().message;
}

}  // namespace engrane::suite

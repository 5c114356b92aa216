// SPDX-License-Identifier: BSD-3-Clause
#include "elements/control/controller.hpp"

#include <Eigen/LU>
#include <complex>

#include "elements/control/control_law.hpp"
#include "elements/control/coordinate_cases.hpp"

namespace engrane::elements::control {
namespace {

using namespace suite;

ControllerData controller(int in, int out) {
  ControllerData data;
  data.input = in;
  data.output = out;
  data.function = 1;
  return data;
}

ControllerData pid(int in, int out) {
  ControllerData data = controller(in, out);
  data.proportional = 7;
  data.integral = 3;
  data.derivative = 2;
  data.filter = 0.3;
  return data;
}

ControllerData transfer(int in, int out) {
  ControllerData data = controller(in, out);
  data.numerator = {2, 1, 5};
  data.denominator = {0.5, 2, 3, 4};
  return data;
}

Subject control(const std::string& name, const ControllerData& data) {
  Subject s = machine_subject(name, controller_type, data);
  s.skip[Check::lagrange] = "it feeds energy in";
  s.skip[Check::power] = "its states carry no energy; NothingIsLostInTheStates looks at the rest";
  if (data.drive.given()) s.skip[Check::ideal] = "the drive's command feels no force";
  s.states = 2;
  return s;
}

TEST(Controller, SuiteOfPid) {
  run_suite(control("slide", pid(1, 1)));
  run_suite(control("from a universal joint to a slide", pid(3, 2)));
  run_suite(control("from a distance to an angle", pid(11, 12)));
  ControllerData data = pid(4, 13);
  data.coordinate = "ANGLE";
  run_suite(control("from an angle on the ground", data));
  data.quantity.tag = "SPEED";
  run_suite(control("of a speed", data));
}

TEST(Controller, SuiteOfTransferFunctions) {
  run_suite(control("order 3", transfer(12, 2)));
  ControllerData integrator = transfer(2, 2);
  integrator.denominator = {1, 2, 0, 0};
  run_suite(control("two integrators", integrator));
  ControllerData gain = transfer(2, 2);
  gain.numerator = {3};
  gain.denominator = {2};
  run_suite(control("gain", gain));
}

TEST(Controller, SuiteOfDrives) {
  for (const char* kind : {"SPEED", "POSITION"}) {
    ControllerData data = pid(1, 2);
    data.drive.tag = kind;
    data.lag = 0.4;
    run_suite(control(std::string("PID drives the ") + kind, data));
    data = transfer(12, 3);
    data.drive.tag = kind;
    data.lag = 0.4;
    run_suite(control(std::string("a transfer function drives the ") + kind, data));
  }
}

/// Beyond a limit the command is held, and the integral tracks it.
TEST(Controller, SuiteBeyondTheLimits) {
  ControllerData data = pid(1, 1);
  data.limits = {-1e-3, 1e-3};
  run_suite(control("held", data));
}

TEST(Controller, Extremes) {
  for (const double gain : {1e-6, 1e15}) {
    ControllerData data = pid(1, 2);
    data.proportional = data.integral = data.derivative = gain;
    run_extreme(control("extreme gains", data));
  }
}

/// Power of the forces on the nodes is what the channel says, positive into the mechanism.
TEST(Controller, NothingIsLostInTheStates) {
  const Subject s = control("power", pid(3, 2));
  const auto element = s.build(Mat3::Identity());
  Random random(9);
  const StateBuffer state = random_state(s, *element, random);
  const auto r = residual_of(*element, state);
  double power = 0;
  for (std::size_t i = 0; i < 6 * state.nodes.size(); ++i) power -= r[i] * state.velocity(i);
  EXPECT_NEAR(channel_of(*element, state, "POWER"), power, 1e-12 * std::abs(power));
  EXPECT_NEAR(element->energies(state.view()).external, power, 1e-12 * std::abs(power));
}

using Complex = std::complex<double>;

/// Response of a law to r or m = exp(s t), from its matrices.
Complex response(const ControlLaw& law, Complex s, bool to_reference) {
  const int n = law.order();
  const Eigen::MatrixXcd system = s * Eigen::MatrixXcd::Identity(n, n) - law.A.cast<Complex>();
  const Eigen::VectorXcd input = to_reference ? Eigen::VectorXcd(law.b_r.cast<Complex>())
                                              : Eigen::VectorXcd(law.b_m.cast<Complex>() + s * law.b_v.cast<Complex>());
  Complex y = to_reference ? law.d_r : law.d_m;
  if (n > 0) y += (law.c.cast<Complex>().transpose() * system.partialPivLu().solve(input))(0);
  return y;
}

TEST(ControlLaw, IsItsTransferFunction) {
  for (const bool by_rate : {false, true})
    for (const Complex s : {Complex(0, 0.7), Complex(0.2, 30), Complex(1e3, 4)}) {
      const ControlLaw law = ControlLaw::pid({7, 3, 2, 0.3, 0}, 0.4, by_rate);
      const Complex wanted = 7.0 + 3.0 / s + 2.0 * s / (1.0 + 0.3 * s);
      EXPECT_LT(std::abs(response(law, s, true) - wanted), 1e-13 * std::abs(wanted));
      EXPECT_LT(std::abs(response(law, s, false) + wanted), 1e-13 * std::abs(wanted));
      const ControlLaw third = ControlLaw::transfer_function({2, 1, 5, 1}, {0.5, 2, 3, 4}, 0.4, by_rate, {});
      const Complex ratio = (2.0 * s * s * s + s * s + 5.0 * s + 1.0) / (0.5 * s * s * s + 2.0 * s * s + 3.0 * s + 4.0);
      EXPECT_LT(std::abs(response(third, s, true) - ratio), 1e-12 * std::abs(ratio));
      EXPECT_LT(std::abs(response(third, s, false) + ratio), 1e-12 * std::abs(ratio));
      const ControlLaw integrators = ControlLaw::transfer_function({5}, {1e-4, 0, 0}, 0.4, by_rate, {});
      EXPECT_LT(std::abs(response(integrators, s, false) + 5e4 / (s * s)), 1e-12 * std::abs(5e4 / (s * s)));
    }
}

/// Steady at the start: with the reference of the start and any constant measured value, no state moves.
TEST(ControlLaw, StartsSteady) {
  for (const ControlLaw& law :
       {ControlLaw::pid({7, 0, 2, 0.3, 0}, 0.4, true), ControlLaw::transfer_function({2, 1, 5}, {0.5, 2, 3, 4}, 0.4, true, {})}) {
    EXPECT_LT((law.A * law.start + law.b_r * 0.4).norm(), 1e-12);
    EXPECT_EQ(law.b_m.norm(), 0);
  }
}

TEST(Controller, CommandInStaticsAndItsLimits) {
  ControllerData data = pid(13, 13);
  data.function = 0;
  data.reference = 2;
  data.integral_start = 4;
  data.limits = {-5, 15};
  const Machine machine;
  const auto element = build(controller_type(), data, machine_nodes(), {.records = &machine.records()});
  StateBuffer state(*element, machine_nodes());
  EXPECT_NEAR(channel_of(*element, state, "COMMAND"), 7 * 2 + 4, 1e-13) << "the derivative begins at rest";
  EXPECT_NEAR(channel_of(*element, state, "LIMITED"), 15, 1e-13);
  EXPECT_NEAR(channel_of(*element, state, "EFFORT"), 15, 1e-13);
}

TEST(Controller, FaultsOfTheCard) {
  EXPECT_EQ(machine_fault(controller_type, controller(1, 2)), "a controller without a law");
  EXPECT_EQ(machine_fault(controller_type, pid(9, 2)), "element 9 does not exist");
  EXPECT_EQ(machine_fault(controller_type, pid(1, 5)), "SPHERICAL 5 has no coordinate");
  ControllerData data = pid(1, 2);
  data.drive.tag = "SPEED";
  EXPECT_EQ(machine_fault(controller_type, data), "a drive without a lag");
  data = pid(1, 2);
  data.lag = 1;
  EXPECT_EQ(machine_fault(controller_type, data), "TAU without DRIVE");
  data = pid(1, 2);
  data.limits = {3, 1};
  EXPECT_EQ(machine_fault(controller_type, data), "the lower limit 3 is not below the upper 1");
  data = pid(1, 2);
  data.proportional = 0;
  data.limits = {-1, 1};
  EXPECT_EQ(machine_fault(controller_type, data), "the integral of a limited command would wind up");
  data.filter.reset();
  EXPECT_EQ(machine_fault(controller_type, data), "the derivative has no filter");
  data = controller(1, 2);
  data.states = {1};
  EXPECT_EQ(machine_fault(controller_type, data), "STATES belong to a transfer function");
}

}  // namespace
}  // namespace engrane::elements::control

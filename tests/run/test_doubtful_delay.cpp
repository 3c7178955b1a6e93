// A log that begins with its input on does not say what was sent before.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "inspection/first_row.h"
#include "run/doubtful_delay.h"

namespace gapscope {
namespace {

using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;

constexpr double kDelay = 6e-3, kInertia = 1e-3, kDamping = 4e-3;

/// Two seconds at 1 kHz of a body from rest, in counts, by steps of a microsecond.
/// @param friction  that holds it at first [N m]
Recording logged(double friction) {
  Recording r;
  r.file = "log.csv", r.dt = 1e-3, r.quantum = 1e-4;
  for (int i = 0; i < 2000; ++i) {
    const double t = r.dt * i;
    r.u.push_back(0.05 * (std::cos(20.0 * t - 0.9) + std::cos(47.0 * t - 0.9)));
  }
  constexpr int kSteps = 1000;
  const int late = static_cast<int>(std::lround(kDelay / r.dt * kSteps));
  double x = 0.0, w = 0.0;
  for (int i = 0; i < 2000; ++i) {
    r.x1.push_back(r.quantum * std::round(x / r.quantum));
    for (int k = 0; k < kSteps; ++k) {
      const int sent = i * kSteps + k - late;
      const double u = sent < 0 ? 0.0 : r.u[static_cast<std::size_t>(sent / kSteps)];
      const double free = w + 1e-6 * (u - kDamping * w) / kInertia, most = 1e-6 * friction / kInertia;
      w = std::abs(free) < most ? 0.0 : free - std::copysign(most, free);
      x += 1e-6 * w;
    }
  }
  return r;
}

/// As a diagnosis would have fitted it: a body with friction and a delay.
Diagnosis diagnosed(const Recording& r, double friction) {
  ReferenceModel model;
  model.structure.has_load = false;
  model.set("motor_inertia", ParameterSetting::sought(0.9 * kInertia));
  model.set("torque_constant", ParameterSetting::known(1.0));
  model.set("motor_damping", ParameterSetting::sought(1.1 * kDamping));
  ModelEffect delay{find_effect("input_delay"), {}};
  delay.parameters[0] = ParameterSetting::sought(4e-3);
  ModelEffect rubs{find_effect("motor_coulomb_friction"), {}};
  rubs.parameters[0] = ParameterSetting::known(friction);
  model.effects = {delay, rubs};
  const MotorTrace traces[] = {r.motor_trace()};
  const FitSummary found = fit(traces, model);
  for (const char* key : {"motor_inertia", "motor_damping"})
    model.set(key, ParameterSetting::sought(found.find(key)->value));
  model.effects[0].parameters[0] = ParameterSetting::sought(found.find("input_delay.delay_s")->value);
  Diagnosis d;
  d.fitted = model;
  return d;
}

std::string told(double friction) {
  const Recording r = logged(friction);
  EXPECT_TRUE(begins_under_input(r.motor_trace()));
  return internal::run::doubtful_delay({}, {r.motor_trace()}, diagnosed(r, friction));
}

TEST(DoubtfulDelay, IsToldWithWhatItIsWithoutTheBeginning) {
  EXPECT_THAT(told(0.0),
              AllOf(HasSubstr("log.csv begins with its input on while the motor is still at rest"),
                    HasSubstr("window: [0.1, 1.999]"),
                    ContainsRegex("the input delay then comes out as (5.99|6)[0-9.]* ms, not 6.0[78]")));
}

TEST(DoubtfulDelay, IsNotToldWhereFrictionHeldTheDriveOrThereIsNoDelay) {
  EXPECT_EQ(told(0.075), "") << "the delay is the same without the beginning";
  EXPECT_EQ(internal::run::doubtful_delay({}, {logged(0.0).motor_trace()}, {}), "");
}

}  // namespace
}  // namespace gapscope

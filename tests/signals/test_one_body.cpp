#include <gtest/gtest.h>

#include "independent_plant/simulate.h"
#include "signals/one_body.h"

namespace gapscope::internal::signals {
namespace {

TEST(OneBody, TheBalanceOfOneInertiaIsItsOwn) {
  independent_plant::BlindDrive drive;
  drive.load = independent_plant::BlindLoad::kNone;
  drive.effects.motor.friction.level_nm = 0.01;
  independent_plant::BlindExcitation excitation;
  excitation.waveform = independent_plant::Waveform::kMultisine;
  const Recording recording =
      independent_plant::simulate_blind(drive, excitation, independent_plant::BlindSensor::with_bits(20),
                                        {1000.0, 4.0, 1, 1e-10})
          .recording;
  const MotorTrace traces[] = {recording.motor_trace()};
  const OneBody body = as_one_body(traces);
  // Speeds are slopes over 20 ms and the balance has 500 rows: some percent, enough for a start.
  EXPECT_NEAR(0.172 * body.inertia / 8.78e-4, 1.0, 0.2);
  EXPECT_NEAR(0.172 * body.damping / 0.062, 1.0, 0.05);
  EXPECT_NEAR(0.172 * body.friction / 0.01, 1.0, 0.2);
  EXPECT_NEAR(body.peak_input, 0.5814, 0.01);
}

}  // namespace
}  // namespace gapscope::internal::signals

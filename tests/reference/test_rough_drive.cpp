#include <gtest/gtest.h>

#include "reference/rigs.h"
#include "reference/rough_drive.h"

namespace gapscope::internal::reference {
namespace {

TEST(RoughDrive, TheBalanceOfOneInertiaIsItsOwn) {
  test::BlindRig run;
  run.drive.load = independent_plant::BlindLoad::kNone;
  run.drive.effects.motor.friction.level_nm = 0.01;
  run.excitation.waveform = independent_plant::Waveform::kMultisine;
  const Recording recording = run.recording();
  const MotorTrace traces[] = {recording.motor_trace()};
  const RoughDrive rough = rough_drive(traces);
  // Speeds are slopes over 20 ms and the balance has 500 rows: some percent, enough for a start.
  EXPECT_NEAR(0.172 * rough.inertia / 8.78e-4, 1.0, 0.2);
  EXPECT_NEAR(0.172 * rough.damping / 0.062, 1.0, 0.05);
  EXPECT_NEAR(0.172 * rough.friction / 0.01, 1.0, 0.2);
  EXPECT_NEAR(rough.peak_input, 0.5814, 0.01);
}

TEST(RoughDrive, TheFirstSamplesOfAParabolaGiveItsSpeed) {
  Recording r;
  r.dt = 1e-3;
  for (int i = 0; i < 100; ++i) {
    const double t = i * r.dt;
    r.x1.push_back(0.2 + 3.0 * t - 5.0 * t * t);
    r.u.push_back(0.0);
  }
  const LocalMotion motion = local_motion(r.motor_trace(), 1e-6);
  EXPECT_NEAR(motion.x, 0.2, 1e-12);
  EXPECT_NEAR(motion.w, 3.0, 1e-9);
}

TEST(RoughDrive, TheFloorIsTheQuantisersOrTheNoisesWhicheverIsLarger) {
  test::BlindRig run;
  run.sensor = independent_plant::BlindSensor::with_bits(20);
  const Recording clean = run.recording();
  EXPECT_NEAR(encoder_floor(clean.motor_trace()), clean.quantum / std::sqrt(12.0), 0.3 * clean.quantum);
  run.sensor.noise = 1e-4;  // fourth differences of white noise: their robust deviation is its rms
  EXPECT_NEAR(encoder_floor(run.recording().motor_trace()), 1e-4, 5e-6);
}

}  // namespace
}  // namespace gapscope::internal::reference

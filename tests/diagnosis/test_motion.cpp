#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "diagnosis/motion.h"
#include "diagnosis/one_inertia.h"
#include "gapscope/base/errors.h"

namespace gapscope::internal::diagnosis {
namespace {

using ::testing::HasSubstr;

constexpr double kNoise = 1e-5;  // [rad]

/// Four seconds of x1(t), with noise, at 1 kHz.
template <class Position>
Recording recording_of(const Position& x1) {
  Recording r;
  r.file = "x.csv";
  r.dt = 1e-3;
  auto noise = random_stream(1, "noise");
  for (int i = 0; i < 4000; ++i) {
    const double t = r.dt * i;
    r.u.push_back(0.6 * std::sin(2.0 * kPi * t));
    r.x1.push_back(x1(t) + kNoise * normal(noise));
  }
  return r;
}

HeldOut judged_by(const Recording& r) { return {{r.motor_trace()}, {0}, {kNoise}, {0}, 0.0, 0.0, ""}; }

/// A model that leaves this much of every window [free_floor²].
ScoredModel leaving(const HeldOut& held_out, double square) {
  ScoredModel model;
  model.windows.free.assign(still_windows(held_out).size(), square);
  return model;
}

std::string refusal(const std::function<void()>& of) {
  try {
    of();
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

TEST(Motion, NoiseAndCountsAreNoMotion) {
  const Recording still = recording_of([](double) { return 0.0; });
  EXPECT_THAT(refusal([&] { require_motion(still.motor_trace()); }), HasSubstr("x.csv: x1 does not move"));
  Recording counts = still;
  counts.quantum = 1e-4;
  for (std::size_t i = 0; i < counts.size(); ++i) counts.x1[i] = counts.quantum * static_cast<double>(i % 4);
  EXPECT_THAT(refusal([&] { require_motion(counts.motor_trace()); }), HasSubstr("x1 does not move"));
  const Recording small = recording_of([](double t) { return 10.0 * kNoise * std::sin(2.0 * kPi * t); });
  EXPECT_NO_THROW(require_motion(small.motor_trace()));
}

TEST(Motion, AModelLeavesOfItWhatItsFreeRunsMiss) {
  const Recording moving = recording_of([](double t) { return 0.1 * std::sin(2.0 * kPi * t); });
  const HeldOut held_out = judged_by(moving);
  EXPECT_LT(unexplained_motion(held_out, leaving(held_out, 1.0)), 1e-3);
  ScoredModel still;
  still.windows.free = still_windows(held_out);
  EXPECT_DOUBLE_EQ(unexplained_motion(held_out, still), 1.0);
  EXPECT_EQ(motion_left(held_out, still),
            "the simulated motion of the best model is off by 100 % of the motion itself");
  EXPECT_EQ(motion_left(held_out, leaving(held_out, 1.0)), "");
}

TEST(Motion, ADriveThatComesToRestEarlyMostlyRests) {
  const auto moving_until = [](double end) {
    return recording_of([=](double t) { return 0.1 * std::sin(2.0 * kPi * std::min(t, end)); });
  };
  const Recording resting = moving_until(1.3), moving = moving_until(3.7);
  EXPECT_TRUE(mostly_rests(judged_by(resting)));
  EXPECT_FALSE(mostly_rests(judged_by(moving)));
}

TEST(Motion, WhereX1StandsStillNothingIsExplained) {
  const Recording start = recording_of([](double t) { return t < 0.4 ? 0.1 * t : 0.04; });
  const HeldOut held_out = judged_by(start);  // the first window is the observer's
  EXPECT_TRUE(std::isnan(unexplained_motion(held_out, leaving(held_out, 1.0))));
  EXPECT_THAT(refusal([&] { require_motion(held_out); }),
              HasSubstr("x1 does not move where the model is judged"));
}

/// What a diagnosis that knows friction alone says of this file, its last third held out.
std::string answer_to(const Recording& file) {
  blind::BlindPair drive = test::one_inertia({}, 1);
  drive.sheet.parameters[place::kMotorInertia].estimate = false;
  drive.sheet.parameters[place::kMotorDamping] = {0.05, true, 0.0, 0.1, {}};  // does not hold it still
  DiagnosisOptions options;
  for (const auto table : {effect_table(), last_resort_table()})
    for (const EffectEntry* e : table)
      if (e->name != std::string("motor_coulomb_friction")) options.excluded.emplace_back(e->name);
  const MotorTrace trace = file.motor_trace();
  std::string warnings;
  const std::string refused = refusal([&] {
    const Diagnosis d = diagnose({&trace, 1}, {}, drive.sheet, options);
    EXPECT_EQ(d.verdict, DiagnosisVerdict::kUnknown);
    EXPECT_TRUE(d.effects.empty());
    for (const std::string& warning : d.warnings) warnings += warning + "\n";
  });
  return refused + warnings;
}

TEST(Motion, NoEffectIsNamedWhereUMovesNothing) {
  answer_to(recording_of([](double t) { return 30.0 * kNoise * std::sin(2.0 * kPi * 50.0 * t); }));  // hum
  EXPECT_THAT(answer_to(recording_of([](double t) { return t < 1.5 ? 0.0 : 1e-3; })),
              HasSubstr("x1 does not move where the model is judged"));
}

}  // namespace
}  // namespace gapscope::internal::diagnosis

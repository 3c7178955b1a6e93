// Every question of a check must be answered one way by a good recording and the other way by a spoilt one.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "gapscope/base/errors.h"
#include "gapscope/inspection/inspection.h"
#include "inspection/inspected.h"
#include "inspection/rows.h"
#include "support/data.h"
#include "support/reading.h"
#include "support/temporary_file.h"

namespace gapscope {
namespace {

using test::changed;
using test::finding;
using test::good;
using test::inspected;
using test::noise_of;
using test::rules_with;
using test::scale;
using testing::closed_loop;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::rig;
using testing::Rows;
using testing::TemporaryFile;

TEST(Inspection, AGoodRecordingIsTold) {
  const Inspection i = inspected(good());
  EXPECT_FALSE(i.spoilt()) << i.report();
  EXPECT_THAT(rules_with(i, Severity::kNote), ElementsAre("spectrum", "scale of u"))  // one sine
      << i.report();
  EXPECT_EQ(i.facts.samples, 8000);
  EXPECT_NEAR(i.facts.rate, 1000.0, 1e-6);
  EXPECT_NEAR(i.facts.quantum, 2.0 * kPi / 262144.0, 1e-9);
  EXPECT_NEAR(i.facts.period, 1.0, 0.01);
  EXPECT_NEAR(i.facts.input_period, 1.0, 1e-3);
  EXPECT_NEAR(i.facts.input_frequency, 1.0, 0.1);
  EXPECT_THAT(i.report(), HasSubstr("16 checks: "));
}

TEST(Inspection, AStepThatIsARoundNumberOfRadiansMayBeOneOfMetres) {
  Rows rows = rig([](double t) { return 0.5814 * std::sin(2.0 * kPi * t); }, {}, 30);
  for (double& x : rows.x1) x = 5e-8 * std::round(x / 5e-8);
  EXPECT_THAT(finding(inspected(rows), "encoder").found, HasSubstr("a round number"));
  EXPECT_THAT(finding(inspected(good()), "encoder").found,
              HasSubstr("no gap below 20 steps, 479.4 µrad, is found"));
}

TEST(Inspection, ARegisterWithoutItsSignIsSeenBehindUnitAndSupply) {
  const Rows rows = changed([](Rows& r) {
    for (double& u : r.u) u = std::fmod(std::round(885.0 * u) + 65536.0, 65536.0);
  });
  std::string text = "t,u,x1,volts\n";
  for (std::size_t i = 0; i < rows.t.size(); ++i)
    text +=
        fmt::format("{:.9g},{},{:.12g},{}\n", rows.t[i], rows.u[i], rows.x1[i], 7.0 + 0.1 * double(i % 3));
  const TemporaryFile file(text);
  ReadOptions options;
  options.columns.voltage = "volts";
  options.columns.scales.input = {0.0011299, 1.0};
  const Inspection blind = inspect(file.path(), options);
  EXPECT_EQ(finding(blind, "input").severity, Severity::kSpoils);
  EXPECT_THAT(finding(blind, "input").advice, HasSubstr("--input-register 16"));
  options.columns.scales.input.form.bits = 16;
  EXPECT_EQ(finding(inspect(file.path(), options), "input").severity, Severity::kFine);
}

struct Fault {
  const char* name;
  std::function<Rows()> make;
  std::vector<std::string> spoils;  ///< the rules that must say so, and no other
  const char* words;                ///< what the first of them says
};

void PrintTo(const Fault& f, std::ostream* out) { *out << f.name; }

class FaultTest : public ::testing::TestWithParam<Fault> {};

TEST_P(FaultTest, IsNamedAndNothingElse) {
  const Inspection i = inspected(GetParam().make());
  EXPECT_EQ(rules_with(i, Severity::kSpoils), GetParam().spoils) << i.report();
  const Finding& f = finding(i, GetParam().spoils.front());
  EXPECT_THAT(f.found + " -> " + f.advice, HasSubstr(GetParam().words));
  EXPECT_FALSE(f.advice.empty());
  EXPECT_TRUE(i.spoilt());
}

const std::vector<Fault> kFaults = {
    {"repeated_rows",
     [] {
       return changed([](Rows& r) {
         for (std::size_t i = 100; i < 103; ++i) r.t[i] = r.t[99];
       });
     },
     {"time"},
     "3 rows are not later than the row before, the first in line 102"},
    {"missing_rows",
     [] { return changed([](Rows& r) { r.erase(3000, 12); }); },
     {"time"},
     "12 samples are missing"},
    {"clock_of_a_pc",
     [] {
       return changed([](Rows& r) {
         for (double& t : r.t) t = 1e-3 * std::round(1e3 * std::floor(64.0 * t) / 64.0);
       });
     },
     {"time"},
     "whole ticks of 15.6 ms"},
    {"milliseconds",
     [] { return changed([](Rows& r) { scale(r.t, 1000.0); }); },
     {"time"},
     "give t in seconds"},
    {"counts",
     [] {
       return changed([](Rows& r) {
         for (double& x : r.x1) x = std::round(x * 262144.0 / (2.0 * kPi));
       });
     },
     {"unit of x1"},
     "position: counts"},
    {"degrees", [] { return changed([](Rows& r) { scale(r.x1, 180.0 / kPi); }); }, {"unit of x1"}, "degrees"},
    {"milliradians",
     [] { return changed([](Rows& r) { scale(r.x1, 1000.0); }); },
     {"unit of x1"},
     "position: mrad"},
    {"radians_as_degrees",
     [] { return changed([](Rows& r) { scale(r.x1, kPi / 180.0); }); },
     {"unit of x1"},
     "57.3 times"},
    {"degrees_as_turns",
     [] { return changed([](Rows& r) { scale(r.x1, 360.0); }); },
     {"unit of x1"},
     "degrees, declared as turns"},
    {"turns", [] { return changed([](Rows& r) { scale(r.x1, 0.5 / kPi); }); }, {"unit of x1"}, "turns"},
    {"register_without_its_sign",
     [] {
       return changed([](Rows& r) {
         for (double& u : r.u) u = std::fmod(std::round(885.0 * u) + 65536.0, 65536.0);
       });
     },
     {"input", "sign"},
     "--input-register 16), so that 65535 is -1"},
    {"far_too_fast",
     [] {
       return changed([](Rows& r) {
         for (std::size_t i = 0; i < r.x1.size(); ++i) r.x1[i] = 1e4 * r.x1[i] + 1e-3 * noise_of(i);
       });
     },
     {"unit of x1"},
     "rad/s, more than 3000"},
    {"lost_counts",
     [] {
       return changed([](Rows& r) {
         for (std::size_t i = 4321; i < r.x1.size(); ++i) r.x1[i] += 0.3;
       });
     },
     {"jumps"},
     "in line 4323"},
    {"held_position",
     [] {
       return changed([](Rows& r) {
         for (std::size_t i = 0; i < r.x1.size(); ++i) r.x1[i] = r.x1[i - i % 4];
       });
     },
     {"fresh samples"},
     "every 4th row"},
    {"no_motion",
     [] {
       return changed([](Rows& r) {
         for (std::size_t i = 0; i < r.x1.size(); ++i) r.x1[i] = kPi / 131072.0 * std::round(noise_of(i));
       });
     },
     {"travel", "reversals"},
     "raise the excitation"},
    {"few_steps_of_the_encoder",
     [] { return rig(sine(0.5814, 1.0), {}, 6); },
     {"travel", "reversals"},
     "raise the excitation"},
    {"one_way",
     [] { return rig([](double) { return 0.5; }); },
     {"reversals", "input"},
     "the detector will be inconclusive"},
    {"constant_input",
     [] { return changed([](Rows& r) { std::fill(r.u.begin(), r.u.end(), 0.3); }); },
     {"input"},
     "u is 0.3 all the time"},
    {"wrong_sign", [] { return changed([](Rows& r) { scale(r.u, -1.0); }); }, {"sign"}, "turn the sign"},
    {"wrong_sign_of_a_closed_loop",
     [] { return changed(closed_loop(), [](Rows& r) { scale(r.u, -1.0); }); },
     {"sign"},
     "turn the sign"},
};

INSTANTIATE_TEST_SUITE_P(Inspection, FaultTest, ::testing::ValuesIn(kFaults),
                         [](const auto& tested) { return std::string(tested.param.name); });

TEST(Inspection, AnInputThatDoesNotRepeatLeavesTheDiagnosisTheEncoderAlone) {
  const Inspection swept = inspected(rig([](double t) { return 0.6 * std::sin(3.0 * t + 0.7 * t * t); }));
  EXPECT_EQ(finding(swept, "diagnosis").severity, Severity::kNote);
  EXPECT_EQ(finding(inspected(good()), "diagnosis").severity, Severity::kFine);
}

TEST(Inspection, IrregularTimeIsANoteForFitAndDiagnoseAndNeedsAGridForTheDetector) {
  Rows rows = good();
  for (std::size_t i = 0; i < rows.t.size(); ++i) rows.t[i] += 2e-4 * noise_of(i);
  const Inspection raw = inspected(rows);
  EXPECT_FALSE(raw.spoilt()) << raw.report();
  EXPECT_FALSE(raw.facts.uniform);
  const Finding& time = finding(raw, "time");
  EXPECT_EQ(time.severity, Severity::kNote);
  EXPECT_THAT(time.advice, HasSubstr("fit and diagnose use each step with its own length"));
  EXPECT_THAT(time.advice, HasSubstr("resample: {rate: "));
  ReadOptions options;
  options.resample_rate = 900.0;
  const Inspection i = inspected(rows, options);
  EXPECT_EQ(finding(i, "time").severity, Severity::kNote) << i.report();
  EXPECT_FALSE(i.spoilt()) << i.report();
}

TEST(Inspection, ADeclaredRateThatTheTimeContradictsIsTold) {
  ReadOptions options;
  options.columns.rate = 100.0;  // the rig has 1000
  const Finding time = finding(inspected(good(), options), "time");
  EXPECT_EQ(time.severity, Severity::kSpoils);
  EXPECT_THAT(time.found, HasSubstr("come at 1000 Hz"));
  options.columns.rate = 1000.0;
  EXPECT_EQ(finding(inspected(good(), options), "time").severity, Severity::kFine);
  // A clock that is no number, and one that counts the rows, are the reason to name a rate.
  options.columns.rate = 2000.0;
  for (const char* stamp : {"n/a", "{}"}) {
    const Rows rows = good();
    std::string text = "time,u,x1\n";
    for (std::size_t i = 0; i < rows.t.size(); ++i)
      text += fmt::format("{},{},{}\n", fmt::format(fmt::runtime(stamp), i), rows.u[i], rows.x1[i]);
    const TemporaryFile file(text);
    EXPECT_EQ(finding(inspect(file.path(), options), "time").severity, Severity::kFine) << stamp;
  }
}

TEST(Inspection, AClockOfWholeMillisecondsHasLostNothingAndItsRateIsTheMeanOne) {
  Rows rows = good();
  for (std::size_t i = 0; i < rows.t.size(); ++i) rows.t[i] = 1e-3 * std::round(static_cast<double>(i) / 0.7);
  const Inspection i = inspected(rows);
  EXPECT_EQ(finding(i, "time").severity, Severity::kNote) << i.report();
  EXPECT_EQ(i.facts.missing_samples, 0);
  EXPECT_NEAR(i.facts.rate, 700.0, 1.0);
}

/// Whatever the balance puts for an inertia whose torque drowns in what one body leaves is no measurement.
TEST(Inspection, ARecordingThatCannotShowAnInertiaSaysSo) {
  const auto rows_of_body =
      [](double inertia) {  // under two sines, with a damping of 2 and an odd disturbance
        return changed([inertia](Rows& r) {
          for (std::size_t i = 0; i < r.t.size(); ++i) {
            const double t = r.t[i], slow = 2.0, fast = 9.0;
            r.x1[i] = 1e-4 * std::round(1e4 * (0.5 * std::sin(slow * t) + 0.1 * std::sin(fast * t)));
            const double speed = 0.5 * slow * std::cos(slow * t) + 0.1 * fast * std::cos(fast * t);
            const double acceleration =
                -0.5 * slow * slow * std::sin(slow * t) - 0.1 * fast * fast * std::sin(fast * t);
            r.u[i] = inertia * acceleration + 2.0 * speed + 0.3 * std::sin(5.0 * t);
          }
        });
      };
  const Inspection heavy = inspected(rows_of_body(1.0)), light = inspected(rows_of_body(1e-3));
  EXPECT_EQ(finding(heavy, "scale of u").severity, Severity::kFine) << heavy.report();
  EXPECT_EQ(finding(light, "scale of u").severity, Severity::kNote) << light.report();
  EXPECT_THAT(finding(light, "scale of u").found, HasSubstr("this recording cannot show the inertia"));
  EXPECT_THAT(finding(light, "scale of u").advice, HasSubstr("motor_inertia"));
}

TEST(Inspection, WrapsAndSpikesAreMendedAndNoted) {
  const Inspection wrapped = inspected(changed([](Rows& r) {
    for (double& x : r.x1) x = x < 0.05 ? x + 2.0 * kPi : x;
  }));
  EXPECT_EQ(finding(wrapped, "jumps").severity, Severity::kNote) << wrapped.report();
  EXPECT_THAT(finding(wrapped, "jumps").found, HasSubstr("starts again"));
  EXPECT_NEAR(wrapped.facts.travel, inspected(good()).facts.travel, 1e-6);
  const Inspection spike = inspected(changed([](Rows& r) { r.x1[4321] += 0.3; }));
  EXPECT_EQ(finding(spike, "jumps").severity, Severity::kNote) << spike.report();
  EXPECT_THAT(finding(spike, "jumps").found, HasSubstr("the first in line 4323"));
  EXPECT_FALSE(spike.spoilt()) << spike.report();
}

TEST(Inspection, APauseOfAgesCostsNoMemory) {
  Rows rows = good();
  for (std::size_t i = 5000; i < rows.t.size(); ++i) rows.t[i] += 1e9;
  const Inspection i = inspected(rows);
  EXPECT_THAT(finding(i, "time").found, HasSubstr("from t = 4.999 s on"));
}

TEST(Inspection, WhatIsNoRecordingIsRefusedAsEverywhere) {
  const TemporaryFile word("t,u,x1\n0,zero,1\n"), few("t,u,x1\n0,0,0\n1,0,0\n");
  EXPECT_THAT(testing::refusal([&] { inspect(word.path()); }), HasSubstr("r.csv:2: u is 'zero', expected"));
  EXPECT_THAT(testing::refusal([&] { inspect(few.path()); }), HasSubstr("2 samples, expected at least 50"));
  std::string standing = "t,u,x1\n";
  for (int i = 0; i < 100; ++i) standing += fmt::format("{},1,2\n", i < 5 ? 0.01 * i : 0.0);
  const TemporaryFile stands(standing);
  EXPECT_THAT(testing::refusal([&] { inspect(stands.path()); }),
              HasSubstr(":7: t is not later than in the row before, and so in 95 rows, expected time that"));
}

TEST(Inspection, TheRealRecordings) {
  GAPSCOPE_NEEDS_DATA();
  const std::string data = testing::data_folder();
  const Inspection axis = inspect(data + "/emps/emps_train.csv", {}, Coordinates::kTranslation);
  EXPECT_FALSE(axis.spoilt()) << axis.report();
  EXPECT_NEAR(axis.facts.quantum, 5e-8, 1e-10);
  EXPECT_EQ(finding(axis, "feedback").severity, Severity::kNote);  // it was recorded in a position loop
  EXPECT_NEAR(axis.facts.inertia, 95.1, 10.0);                     // kg: one unit of u is one N
  EXPECT_FALSE(inspect(data + "/emps/emps_pulses.csv", {}, Coordinates::kTranslation).spoilt());
  for (const char* reducer : {"baseline_pos1", "splitpreload3_pos1"}) {
    const std::string path = data + "/cycloidal/" + reducer + ".csv";
    EXPECT_EQ(finding(inspect(path), "time").severity, Severity::kNote);
    ReadOptions options;
    options.resample_rate = 400.0;
    const Inspection uniform = inspect(path, options);
    EXPECT_FALSE(uniform.spoilt()) << uniform.report();
    EXPECT_EQ(finding(uniform, "feedback").severity, Severity::kFine);  // torque mode
  }
}

TEST(Inspection, RefusesARateThatLeavesHardlyASample) {
  ReadOptions options;
  options.resample_rate = 0.5;
  EXPECT_THAT(testing::refusal([&] { inspected(good(), options); }),
              HasSubstr("after resampling, expected at least 50"));
}

TEST(LoadEncoder, IsAskedForNoMotionThatADetectorWouldNeed) {
  Inspection seen = inspected(changed([](Rows& r) { r.erase(700, r.t.size() - 700); }));
  ASSERT_EQ(finding(seen, kReversalsRule).severity, Severity::kSpoils);
  judge_for_load_encoder(seen);
  EXPECT_EQ(finding(seen, kReversalsRule).severity, Severity::kNote);
  EXPECT_NE(finding(seen, kReversalsRule).advice.find("record the motor's position as well"),
            std::string::npos);
}

}  // namespace
}  // namespace gapscope

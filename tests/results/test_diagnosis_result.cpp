#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "gapscope/base/errors.h"
#include "results/diagnosis_result.h"
#include "results/full_result.h"
#include "results/scratch_folder.h"
#include "support/reading.h"

namespace gapscope {
namespace {

using testing::text_of;
namespace fs = std::filesystem;

using test::kThird;

std::vector<MapShare> halves(const std::string& low, const std::string& high) {
  return {{low, kThird, 0.5}, {high, 1.0 - kThird, 0.5}};
}

DiagnosisResult sample() {
  DiagnosisResult r{"rig", "0.1", "name: rig\n", {}, {}};
  Diagnosis& d = r.diagnosis;
  d.verdict = DiagnosisVerdict::kEffect;
  d.sentence = "The model lacks cogging torque.";
  d.effects = {"cogging_torque"};
  d.group = {"cogging_torque", "torque_ripple"};
  d.mismatch.measure = "free run";
  d.mismatch.before = 3e-3 * kThird, d.mismatch.after = 1e-5, d.mismatch.floor = kThird * 1e-6;
  d.mismatch.before_torque = kThird, d.mismatch.input_torque = 3.0;
  d.mismatch.floor_from = FloorSource::kNoise, d.mismatch.floor_of = "the noise of x1";
  d.mismatch.shrink = 0.9, d.mismatch.shrink_ci95 = {0.8, 1.1}, d.mismatch.remains = 1.5;
  d.added = {{"cogging_torque",
              true,
              d.group,
              0.9,
              {{"amplitude_nm", "N m", kThird, {0.3, 0.4}}},
              0.9,
              {0.8, 1.1},
              kThird,
              {"amplitude_nm"}}};
  d.whole_run = WholeRun{0.4, kNaN, kThird};
  d.as_configured = AsConfigured{kThird};
  d.exhausted = d.better_swapped = true;
  d.budget.band_hz = 30.0, d.budget.nominal = kThird;
  d.budget.rungs = {{"cogging_torque", "cogging_torque", true, 1.0, kThird, 0.8, {0.7, 0.9}, 0.8, kThird}};
  d.detectable = {
      {"torque_ripple", {"ratio", "-", kThird}, {{"periods_per_turn", "1/rev", 24.0}}, "", "", 0.1},
      {"actuator_lag", {"time_constant_s", "s", kNaN}, {}, "input_delay", "it acts alike", kNaN}};
  d.measures = {{"free run", "rad", 1.0, kThird, kNaN}};
  d.closed_loop = ClosedLoop{0.0142, kNaN, {{"a.csv", kThird, 0.00754}}};
  RankedEffect first;
  first.effect = "cogging_torque";
  first.probability = 0.9;
  first.parameters = {{"amplitude_nm", "N m", kThird}, {"periods_per_turn", "1/rev", 24.0}};
  RankedEffect last;
  last.effect = "input_delay";
  last.remark = "the motion with it diverges";
  d.ranking = {first, last};
  DiagnosisStep step;
  step.on_top_of = {"cogging_torque"};
  step.effect = "input_delay";
  step.accepted = true;
  step.group = {"input_delay", "actuator_lag"};
  step.mismatch.shrink = kThird;
  step.remaining = "in the gap";
  step.ranking = {last};
  d.steps = {step};
  d.outside_probability = 0.05;
  d.laws = {{"friction_curve",
             "speed",
             {"friction_curve"},
             {"cogging_torque"},
             {{"torque_0_nm", "N m", kThird}},
             0.8,
             {0.7, 0.9},
             2e-4,
             4e-5,
             0.02,
             0.004,
             {{-3.0, -1, kThird, {0.1, 0.5}}},
             {{0.5, 1, 30, 0.1, kNaN}},
             {}}};
  d.periodic = {{24.3, kThird, 0.002, 0.4, kNaN, 20, 19, true, true}};
  d.next_experiment = {
      "Record a sine.", 1000.0, 5.0, {{{}, "a sine", kThird, {{"a", "b", kThird, false}}, kThird}}, {}};
  d.where.headline = "in engagement";
  d.where.mode = halves("gap", "engagement");
  d.where.direction = halves("backward", "forward");
  d.where.periods_per_turn = 24.0;
  d.remaining.headline = "nowhere";
  d.blame = {{"motor_damping", "N m s/rad", 0.08, 0.06, BoundReached::kNone, BoundReached::kUpper}};
  d.model_gap = ModelGap{GapOrigin::kEstimated, kThird, {0.3, 0.4}, EncoderSide::kLoad};
  d.warnings = {"a warning"};
  d.observer_hz = 3.0;
  MismatchTrace t;
  t.file = "held.csv", t.start = 0.1, t.dt = 1e-3 * kThird, t.scored_from = 2;
  for (int i = 0; i < 5; ++i) {
    t.u.push_back(i * kThird), t.x1.push_back(i * kThird * kThird);
    t.error_before.push_back(1e-3 * i * kThird), t.error_after.push_back(1e-6 * i);
    t.torque_before.push_back(kThird), t.torque_after.push_back(-kThird);
    t.simulated_before.push_back(2e-3 * i * kThird), t.simulated_after.push_back(2e-6 * i);
    t.mode.push_back(i % 2 == 0 ? Mode::kGap : Mode::kEngagementPlus);
  }
  d.traces = {t};
  return r;
}

SimulatorComparison simulator() {
  SimulatorComparison c;
  c.sentence = "Your simulator differs from the drive: it has no cogging torque.";
  c.verdict = DiagnosisVerdict::kNone;
  c.floor = kThird, c.errors.simulator = 2.0 * kThird, c.shrink = 0.9;
  SimulatorRow row;
  row.name = "cogging_torque", row.is_effect = row.differs = true, row.found_in = FoundIn::kDrive;
  row.numbers = {{"amplitude_nm", "N m", kThird, 0.0, {0.3, 0.4}, {}}};
  row.floors = 12.0;
  c.rows = {row};
  c.files = {{"sim.csv", std::string(64, 'a')}};
  SimulatorTrace t;
  t.file = "held.csv", t.simulated = "sim.csv", t.start = 0.1, t.dt = 1e-3 * kThird, t.scored_from = 1;
  t.u = {0.0, 1.0, 0.5}, t.x1 = {0.0, kThird, 1.0}, t.simulator = {0.0, 0.3, 0.9}, t.stand_in = t.simulator;
  c.traces = {t};
  return c;
}

TEST(DiagnosisResult, ReadsBackTheSimulatorBesideTheDrive) {
  ScratchFolder scratch;
  DiagnosisResult written = sample();
  written.simulated = simulator();
  write_diagnosis_result(scratch.path.string(), written);
  const SimulatorComparison read = *read_diagnosis_result(scratch.path.string()).simulated;
  const SimulatorComparison& as = *written.simulated;
  EXPECT_EQ(read.sentence, as.sentence);
  EXPECT_EQ(read.verdict, as.verdict);
  EXPECT_EQ(read.floor, as.floor);
  EXPECT_EQ(read.errors.simulator, as.errors.simulator);
  EXPECT_TRUE(std::isnan(read.errors.mended));
  ASSERT_EQ(read.rows.size(), 1u);
  EXPECT_EQ(read.rows[0].found_in, FoundIn::kDrive);
  EXPECT_EQ(read.rows[0].numbers[0].drive, kThird);
  EXPECT_TRUE(std::isnan(read.rows[0].numbers[0].simulator_ci95.low));
  EXPECT_EQ(read.files, as.files);
  ASSERT_EQ(read.traces.size(), 1u);
  EXPECT_EQ(read.traces[0].simulator, as.traces[0].simulator);
  EXPECT_EQ(read.traces[0].scored_from, 1u);
  EXPECT_TRUE(read.traces[0].mended.empty());
  EXPECT_FALSE(read_diagnosis_result(scratch.path.string()).diagnosis.traces.empty());
}

TEST(DiagnosisResult, ReadsBackWhatWasWritten) {
  ScratchFolder scratch;
  const DiagnosisResult written = sample();
  write_diagnosis_result(scratch.path.string(), written);
  const DiagnosisResult read = read_diagnosis_result(scratch.path.string());
  const Diagnosis &a = written.diagnosis, &b = read.diagnosis;
  EXPECT_EQ(read.configuration, "name: rig\n");
  EXPECT_EQ(b.verdict, a.verdict);
  EXPECT_EQ(b.effects, a.effects);
  EXPECT_EQ(b.group, a.group);
  EXPECT_EQ(b.mismatch.before, a.mismatch.before);
  EXPECT_EQ(b.mismatch.floor_from, a.mismatch.floor_from);
  ASSERT_EQ(b.ranking.size(), 2u);
  EXPECT_EQ(b.ranking[0].parameters[0].value, kThird);
  EXPECT_EQ(b.added[0].parameters[0].ci95.high, 0.4);
  EXPECT_EQ(b.ranking[0].parameters[1].unit, "1/rev");
  EXPECT_TRUE(std::isnan(b.ranking[1].probability));
  EXPECT_EQ(b.ranking[1].remark, a.ranking[1].remark);
  ASSERT_EQ(b.steps.size(), 1u);
  EXPECT_EQ(b.steps[0].on_top_of, a.steps[0].on_top_of);
  EXPECT_EQ(b.steps[0].group, a.steps[0].group);
  EXPECT_EQ(b.steps[0].mismatch.shrink, kThird);
  EXPECT_EQ(b.steps[0].ranking[0].effect, "input_delay");
  ASSERT_EQ(b.detectable.size(), 2u);
  EXPECT_EQ(b.detectable[0].smallest.key, "ratio");
  EXPECT_EQ(b.detectable[0].smallest.value, kThird);
  EXPECT_EQ(b.detectable[0].at[0].unit, "1/rev");
  EXPECT_EQ(b.detectable[0].torque, 0.1);
  EXPECT_TRUE(std::isnan(b.detectable[1].smallest.value));
  EXPECT_EQ(b.detectable[1].hidden_by, "input_delay");
  EXPECT_EQ(b.detectable[1].why, "it acts alike");
  EXPECT_EQ(b.outside_probability, 0.05);
  ASSERT_TRUE(b.closed_loop);
  EXPECT_EQ(b.closed_loop->before, 0.0142);
  EXPECT_TRUE(std::isnan(b.closed_loop->after));
  ASSERT_EQ(b.closed_loop->recordings.size(), 1u);
  EXPECT_EQ(b.closed_loop->recordings[0].before, kThird);
  EXPECT_EQ(b.closed_loop->recordings[0].file, "a.csv");
  ASSERT_EQ(b.laws.size(), 1u);
  EXPECT_EQ(b.laws[0].variable, "speed");
  EXPECT_EQ(b.laws[0].parameters[0].value, kThird);
  EXPECT_EQ(b.laws[0].curve[0].torque, kThird);
  EXPECT_EQ(b.laws[0].curve[0].direction, -1);
  EXPECT_EQ(b.laws[0].residual[0].samples, 30);
  EXPECT_TRUE(std::isnan(b.laws[0].residual[0].after));
  ASSERT_EQ(b.periodic.size(), 1u);
  EXPECT_EQ(b.periodic[0].period, kThird);
  EXPECT_EQ(b.periodic[0].better, 19);
  EXPECT_TRUE(b.periodic[0].given);
  EXPECT_TRUE(std::isnan(b.periodic[0].stands_out));
  ASSERT_EQ(b.next_experiment.tried.size(), 1u);
  EXPECT_EQ(b.next_experiment.sentence, "Record a sine.");
  EXPECT_EQ(b.next_experiment.tried[0].separations[0].excess, kThird);
  EXPECT_EQ(b.where.mode[1].share, a.where.mode[1].share);
  EXPECT_EQ(b.where.mode[1].expected, 0.5);
  EXPECT_EQ(b.where.periods_per_turn, 24.0);
  EXPECT_EQ(b.blame[0].key, "motor_damping");
  EXPECT_EQ(b.blame[0].without_at, BoundReached::kNone);
  EXPECT_EQ(b.blame[0].with_at, BoundReached::kUpper);
  EXPECT_EQ(b.added[0].at_bound, a.added[0].at_bound);
  ASSERT_TRUE(b.whole_run.has_value());
  EXPECT_EQ(b.whole_run->travel, kThird);
  EXPECT_TRUE(std::isnan(b.whole_run->after));
  ASSERT_TRUE(b.as_configured.has_value());
  EXPECT_EQ(b.as_configured->error, kThird);
  EXPECT_TRUE(b.exhausted && b.better_swapped);
  ASSERT_TRUE(b.model_gap.has_value());
  EXPECT_EQ(b.model_gap->origin, GapOrigin::kEstimated);
  EXPECT_EQ(b.model_gap->value, kThird);
  EXPECT_EQ(b.model_gap->ci95.high, 0.4);
  EXPECT_EQ(b.model_gap->encoder, EncoderSide::kLoad);
  ASSERT_EQ(b.traces.size(), 1u);
  EXPECT_EQ(b.traces[0].x1, a.traces[0].x1);
  EXPECT_EQ(b.traces[0].torque_after, a.traces[0].torque_after);
  EXPECT_EQ(b.traces[0].mode, a.traces[0].mode);
  EXPECT_EQ(b.traces[0].scored_from, 2u);
}

TEST(DiagnosisResult, KeepsTheTimesOfUnevenSamples) {
  ScratchFolder scratch;
  DiagnosisResult written = sample();
  MismatchTrace& t = written.diagnosis.traces[0];
  t.stamps = {0.1, 0.1004, 0.1005, 0.1012, 0.2};
  write_diagnosis_result(scratch.path.string(), written);
  const MismatchTrace read = read_diagnosis_result(scratch.path.string()).diagnosis.traces[0];
  EXPECT_EQ(read.stamps, t.stamps);
  EXPECT_EQ(read.time(3), 0.1012);
}

TEST(DiagnosisResult, KeepsThatTheEncoderWasOnTheLoad) {
  ScratchFolder scratch;
  DiagnosisResult written = sample();
  written.diagnosis.traces[0].encoder = EncoderSide::kLoad;
  write_diagnosis_result(scratch.path.string(), written);
  const MismatchTrace read = read_diagnosis_result(scratch.path.string()).diagnosis.traces[0];
  EXPECT_EQ(read.encoder, EncoderSide::kLoad);
  EXPECT_EQ(read.x1, written.diagnosis.traces[0].x1);
}

TEST(DiagnosisResult, IsReadWithoutWhatEarlierVersionsDidNotStore) {
  ScratchFolder scratch;
  write_diagnosis_result(scratch.path.string(), sample());
  const fs::path file = scratch.path / "diagnosis.json";
  nlohmann::json before = nlohmann::json::parse(std::ifstream(file));
  before.erase("configuration"), before.erase("detectable");
  ASSERT_EQ(before["gap"].erase("floor_of"), 1u);
  std::ofstream(file) << before;
  EXPECT_EQ(read_diagnosis_result(scratch.path.string()).diagnosis.mismatch.floor_of, "");
  EXPECT_TRUE(read_diagnosis_result(scratch.path.string()).diagnosis.detectable.empty());
}

TEST(DiagnosisResult, WritesTheSameTextAgain) {
  ScratchFolder one, other;
  write_diagnosis_result(one.path.string(), sample());
  write_diagnosis_result(other.path.string(), read_diagnosis_result(one.path.string()));
  EXPECT_EQ(text_of(one.path / "diagnosis.json"), text_of(other.path / "diagnosis.json"));
  EXPECT_EQ(text_of(one.path / "diagnosis.json"), stored_diagnosis_result(sample()).json);
  EXPECT_NE(text_of(one.path / "diagnosis.json").find("\"floor\": null"), std::string::npos);
}

TEST(DiagnosisResult, RefusesAnotherSchemaAndAContradiction) {
  ScratchFolder scratch;
  std::ofstream(scratch.path / "diagnosis.json") << R"({"schema": "gapscope.diagnosis/9"})";
  EXPECT_THROW(read_diagnosis_result(scratch.path.string()), ConfigError);
  DiagnosisResult contradiction = sample();
  contradiction.diagnosis.verdict = DiagnosisVerdict::kUnknown;  // with an effect
  EXPECT_THROW(write_diagnosis_result(scratch.path.string(), contradiction), std::logic_error);
}

}  // namespace
}  // namespace gapscope

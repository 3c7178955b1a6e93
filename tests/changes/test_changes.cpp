#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "base/random.h"
#include "changes/changes.h"
#include "gapscope/base/errors.h"
#include "results/scratch_folder.h"
#include "support/reading.h"

namespace gapscope {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

FittedParameter estimated(const std::string& key, double value, double std) {
  FittedParameter p;
  p.key = key, p.unit = "N m", p.value = value, p.std = std;
  p.ci95 = {value - 1.96 * std, value + 1.96 * std};
  p.estimated = p.identifiable = true;
  return p;
}

FittedParameter given(const std::string& key, double value) {
  FittedParameter p;
  p.key = key, p.unit = "kg m^2", p.value = value;
  return p;
}

DriveReport report(const std::string& folder, double gap, double std,
                   std::vector<FittedParameter> fitted = {}) {
  DriveReport r;
  r.folder = folder;
  r.model_free.emplace();
  r.model_free->verdict = GapVerdict::kBacklash;
  r.model_free->gap = gap, r.model_free->std = std;
  r.model_free->ci95 = {gap - 1.96 * std, gap + 1.96 * std};
  r.reference.emplace();
  r.reference->status = FitStatus::kConverged;
  r.reference->trust = FitTrust::kGood;
  r.reference->parameters = std::move(fitted);
  r.reference->innovation_rmse = r.reference->floor = 1e-5;
  ExcitationFacts e;
  e.samples = 10000, e.rate = 1000.0, e.quantum = 1e-5, e.input_rms = 0.4, e.input_peak = 0.58,
  e.input_frequency = 1.0;
  e.position_rms = gap;  // of another recording in every report
  r.recordings = {e};
  return r;
}

DriveChanges compared(std::initializer_list<DriveReport> reports) {
  return changes(std::vector<DriveReport>(reports));
}

const DriveQuantity& quantity(const DriveChanges& all, const std::string& from, const std::string& key) {
  const DriveQuantity* q = all.find(from, key);
  if (q == nullptr) throw std::logic_error("no quantity " + key);
  return *q;
}

TEST(Changes, HoldEachReportAgainstTheFirstAndBothErrors) {
  const auto friction = [](double value) {
    return std::vector{estimated("load_coulomb_friction", value, 0.004)};
  };
  const DriveChanges c =
      compared({report("a", 0.020, 3e-4, friction(0.05)), report("b", 0.030, 4e-4, friction(0.06)),
                report("c", 0.0205, 4e-4, friction(0.09))});
  const DriveQuantity& gap = quantity(c, "model_free", "gap");
  ASSERT_EQ(gap.changes.size(), 2u);
  EXPECT_NEAR(gap.changes[0].difference, 0.010, 1e-12);
  EXPECT_NEAR(gap.changes[0].ci95.low, 0.010 - 1.96 * 5e-4, 1e-9);  // √(3² + 4²) = 5
  EXPECT_NEAR(gap.changes[0].ci95.high, 0.010 + 1.96 * 5e-4, 1e-9);
  EXPECT_EQ(gap.changes[0].verdict, ChangeVerdict::kChanged);
  EXPECT_EQ(gap.changes[1].verdict, ChangeVerdict::kSame);  // 0.5 ± 1.25 of 20.5 mrad
  EXPECT_NEAR(gap.changes[1].p, 0.3173, 1e-4);
  const DriveQuantity& fitted = quantity(c, "reference", "load_coulomb_friction");
  EXPECT_EQ(fitted.changes[0].verdict, ChangeVerdict::kOpen);  // 1.77 standard errors
  EXPECT_EQ(fitted.changes[0].reason, ChangeReason::kTooWide);
  EXPECT_EQ(fitted.changes[1].verdict, ChangeVerdict::kChanged);
  EXPECT_EQ(c.compared, 4);
  EXPECT_NEAR(c.quantile, 2.498, 1e-3);  // 5 % over four rows
  EXPECT_NEAR(gap.changes[0].together.low, 0.010 - 2.498 * 5e-4, 1e-6);
  EXPECT_EQ(c.lead, 1);
  EXPECT_THAT(c.codes, ElementsAre("changed.reference.load_coulomb_friction.rose"));
  EXPECT_THAT(c.warnings, IsEmpty());
}

TEST(Changes, NumbersOfARejectedModelAreLeftOutAndTheReasonIsTold) {
  const std::vector friction = {estimated("load_coulomb_friction", 0.05, 1e-4)};
  const std::vector another = {estimated("load_coulomb_friction", 0.09, 1e-4)};
  DriveReport rejected = report("b", 0.03, 4e-4, another);
  rejected.reference->trust = FitTrust::kRejected;
  rejected.reference->why = Remark::said("The model misses 65 % of what the torque does to the motion.");
  const DriveChanges c = compared({report("a", 0.020, 3e-4, friction), rejected});
  const DriveQuantity& q = quantity(c, "reference", "load_coulomb_friction");
  EXPECT_TRUE(std::isnan(q.observed[1].value));
  EXPECT_EQ(q.observed[1].remark, "left out, the model is rejected");
  EXPECT_EQ(q.changes[0].reason, ChangeReason::kUntold);
  EXPECT_EQ(quantity(c, "model_free", "gap").changes[0].verdict, ChangeVerdict::kChanged);
  ASSERT_FALSE(c.warnings.empty());
  EXPECT_THAT(c.warnings.front(), HasSubstr("b: its fitted numbers are left out, the model is rejected. "
                                            "The model misses 65 %"));
}

TEST(Changes, AnIntervalWiderThanItsStandardErrorCounts) {
  DriveReport wide = report("a", 0.020, 1e-4);
  wide.model_free->ci95 = {0.018, 0.022};  // ± 2 mrad
  const DriveChanges c = compared({wide, report("b", 0.0215, 1e-4)});
  EXPECT_EQ(quantity(c, "model_free", "gap").changes[0].verdict, ChangeVerdict::kOpen);
}

TEST(Changes, AnIntervalThatIsWiderOnOneSideKeepsItsSides) {
  // Laws of contact that explain as much leave the first gap up to 3 mrad more, and 0.2 less.
  DriveReport first = report("a", 0.020, 1e-4, {estimated("gap", 0.020, 1e-4)});
  first.reference->parameters[0].ci95 = {0.0198, 0.023};
  const auto verdict = [&](double now) {
    return quantity(compared({first, report("b", now, 1e-4, {estimated("gap", now, 1e-4)})}), "reference",
                    "gap")
        .changes[0];
  };
  EXPECT_EQ(verdict(0.0225).verdict, ChangeVerdict::kOpen);
  EXPECT_NEAR(verdict(0.0225).ci95.low, 0.0025 - std::hypot(0.003, 1.96e-4), 1e-6);
  EXPECT_NEAR(verdict(0.0225).ci95.high, 0.0025 + std::hypot(0.0002, 1.96e-4), 1e-5);
  EXPECT_EQ(verdict(0.0175).verdict, ChangeVerdict::kChanged);
}

TEST(Changes, OneOfManyThatChanceWouldBringIsNotCalledAChange) {
  std::vector<FittedParameter> before, after;
  for (int i = 0; i < 20; ++i) {
    before.push_back(estimated("effect.p" + std::to_string(i), 1.0, 0.1));
    after.push_back(
        estimated("effect.p" + std::to_string(i), i == 0 ? 1.3 : 1.05, 0.1));  // 2.1 standard errors
  }
  const DriveChanges many = compared({report("a", 0.02, 1e-4, before), report("b", 0.02, 1e-4, after)});
  EXPECT_EQ(quantity(many, "reference", "effect.p0").changes[0].verdict, ChangeVerdict::kOpen);
  const DriveChanges one =
      compared({report("a", kNaN, kNaN, {before[0]}), report("b", kNaN, kNaN, {after[0]})});
  EXPECT_EQ(quantity(one, "reference", "effect.p0").changes[0].verdict, ChangeVerdict::kChanged);
}

TEST(Changes, OfAnUnchangedDriveAreCalledInAtMostOneComparisonOfTwenty) {
  // 7 quantities in 4 reports; the standard deviation of 400 counts of 5 % is 4.4.
  std::mt19937_64 random = random_stream(7, "unchanged drives");
  int alarms = 0;
  for (int drive = 0; drive < 400; ++drive) {
    std::vector<DriveReport> reports;
    for (int i = 0; i < 4; ++i) {
      std::vector<FittedParameter> p;
      for (int k = 0; k < 6; ++k)
        p.push_back(estimated("effect.p" + std::to_string(k), 1.0 + 0.1 * normal(random), 0.1));
      reports.push_back(report(std::to_string(i), 0.02 + 1e-4 * normal(random), 1e-4, p));
    }
    bool alarm = false;
    for (const DriveQuantity& q : changes(reports).quantities)
      for (const Change& c : q.changes) alarm = alarm || c.verdict == ChangeVerdict::kChanged;
    alarms += alarm;
  }
  EXPECT_LE(alarms, 20 + 3 * 4.4);
  EXPECT_GE(alarms, 1);  // it can alarm at all
}

TEST(Changes, WhatIsCalledTheSameMatteredInAtMostOneComparisonOfTwenty) {
  std::mt19937_64 random = random_stream(8, "drives that changed by what matters");
  int wrong = 0;
  for (int drive = 0; drive < 400; ++drive) {
    std::vector<FittedParameter> before, after;
    for (int k = 0; k < 6; ++k) {  // by a tenth of the larger one
      const std::string key = "effect.p" + std::to_string(k);
      before.push_back(estimated(key, 0.9 + 0.02 * normal(random), 0.02));
      after.push_back(estimated(key, 1.0 + 0.02 * normal(random), 0.02));
    }
    bool same = false;
    for (const DriveQuantity& q :
         changes(std::vector{report("a", kNaN, kNaN, before), report("b", kNaN, kNaN, after)}).quantities)
      same = same || q.changes[0].verdict == ChangeVerdict::kSame;
    wrong += same;
  }
  EXPECT_LE(wrong, 20 + 3 * 4.4);
}

TEST(Changes, ABoundAgainstAValueIsAComparison) {
  DriveReport after = report("b", kNaN, kNaN);
  after.model_free->verdict = GapVerdict::kNone;
  for (const double visible : {0.005, 0.030}) {
    after.model_free->smallest_visible_gap = visible;
    const DriveChanges c = compared({report("a", 0.020, 1e-4), after});
    const DriveQuantity& gap = quantity(c, "model_free", "gap");
    EXPECT_EQ(gap.changes[0].verdict, visible < 0.01 ? ChangeVerdict::kChanged : ChangeVerdict::kOpen);
    EXPECT_TRUE(std::isnan(gap.changes[0].difference));
    EXPECT_NEAR(gap.changes[0].ci95.high, visible - (0.020 - 1.96e-4), 1e-12);
    EXPECT_NEAR(gap.changes[0].ci95.low, -(0.020 + 1.96e-4), 1e-12);
    EXPECT_EQ(gap.observed[1].at_most, visible);
    EXPECT_EQ(c.lead, visible < 0.01 ? 0 : -1);
  }
  after.model_free->verdict = GapVerdict::kInconclusive;
  after.model_free->gap_at_most = 0.004;  // a loop bounds it, whatever the verdict
  EXPECT_EQ(quantity(compared({report("a", 0.020, 1e-4), after}), "model_free", "gap").changes[0].verdict,
            ChangeVerdict::kChanged);
  after.model_free->gap_at_most = kNaN;
  EXPECT_EQ(quantity(compared({report("a", 0.020, 1e-4), after}), "model_free", "gap").changes[0].reason,
            ChangeReason::kUntold);
}

TEST(Changes, WhereTheFirstOfSeveralWasReadTheWholeIsNoSmaller) {
  DriveReport first = report("b", 0.030, 1e-4);
  first.model_free->quantity = GapQuantity::kFirstGap;
  const DriveChanges c = compared({report("a", 0.020, 1e-4), first});
  const DriveQuantity& gap = quantity(c, "model_free", "gap");
  EXPECT_NEAR(gap.observed[1].at_least, 0.030 - 1.96e-4, 1e-12);
  EXPECT_EQ(gap.changes[0].verdict, ChangeVerdict::kChanged);
  EXPECT_TRUE(std::isnan(gap.changes[0].ci95.high));
  EXPECT_EQ(quantity(c, "model_free", "first_gap").changes[0].reason, ChangeReason::kUntold);
}

TEST(Changes, TwoBoundsAreTheSameOnlyWithinAStatedTolerance) {
  DriveReport before = report("a", kNaN, kNaN), after = report("b", kNaN, kNaN);
  for (DriveReport* r : {&before, &after}) {
    r->model_free->verdict = GapVerdict::kNone;
    r->model_free->smallest_visible_gap = 0.002;
  }
  EXPECT_EQ(quantity(compared({before, after}), "model_free", "gap").changes[0].verdict,
            ChangeVerdict::kOpen);
  before.answer.emplace();
  before.answer->tolerance.gap = 0.003;
  EXPECT_EQ(quantity(compared({before, after}), "model_free", "gap").changes[0].verdict,
            ChangeVerdict::kSame);
}

LostMotionLevel level(double amplitude, double lost, double half, double free_run) {
  LostMotionLevel l;
  l.amplitude = amplitude, l.lost_motion = lost, l.ci95 = {lost - half, lost + half}, l.free_run = free_run;
  l.ramps = 10;
  return l;
}

/// A locked output, of which no gap is told.
DriveReport locked(const std::string& folder, std::vector<LostMotionLevel> levels) {
  DriveReport r = report(folder, kNaN, kNaN);
  r.model_free->verdict = GapVerdict::kInconclusive;
  r.model_free->lost_motion.levels = std::move(levels);
  return r;
}

TEST(Changes, ALostMotionIsHeldAgainstThatOfTheSameTorqueAndHeadsTheText) {
  const DriveReport worn = locked("a", {level(3.95, 0.0337, 0.0015, 0.031), level(25, 0.0375, 0.01, 0.037)});
  const DriveReport tight = locked("b", {level(3.96, 0.0029, 0.0003, 0.0), level(40, 0.0495, 0.002, 0.0)});
  const DriveChanges c = compared({worn, tight});
  const DriveQuantity& small = quantity(c, "model_free", "lost_motion");
  EXPECT_EQ(small.level, 3.95);
  EXPECT_EQ(small.changes[0].verdict, ChangeVerdict::kChanged);
  EXPECT_EQ(c.lead, 0);
  EXPECT_THAT(c.codes, ElementsAre("changed.model_free.lost_motion.fell"));
  EXPECT_EQ(c.compared, 1);  // 25 and 40 are not the same torque
}

TEST(Changes, WhatAnotherTorqueExplainsIsNoChange) {
  // A loop of friction and compliance grows up to the square of its torque: by 21 % here.
  const DriveReport a = locked("a", {level(4.0, 0.0050, 1e-4, 0.0)}),
                    b = locked("b", {level(4.4, 0.0058, 1e-4, 0.0)});
  const Change c = quantity(compared({a, b}), "model_free", "lost_motion").changes[0];
  EXPECT_EQ(c.verdict, ChangeVerdict::kOpen);
  EXPECT_EQ(c.reason, ChangeReason::kTheRecordings);
  EXPECT_NEAR(c.by_recordings, 0.21 * 0.005, 1e-9);
  const DriveReport gap = locked("b", {level(4.4, 0.0058, 1e-4, 0.0058)});  // a gap does not grow
  EXPECT_EQ(
      quantity(compared({locked("a", {level(4.0, 0.0050, 1e-4, 0.0050)}), gap}), "model_free", "lost_motion")
          .changes[0]
          .verdict,
      ChangeVerdict::kChanged);
}

TEST(Changes, AnEffectThatOneDiagnosisFoundIsHeldAgainstWhatTheOtherWouldHaveFound) {
  DriveReport before = report("a", 0.02, 1e-4), after = report("b", 0.02, 1e-4);
  before.diagnosis.emplace(), after.diagnosis.emplace();
  AddedEffect cogging;
  cogging.effect = "cogging_torque";
  cogging.parameters = {{"amplitude_nm", "N m", 0.008, {0.007, 0.009}}};
  after.diagnosis->added = {cogging};
  const auto row = [&] {
    return quantity(compared({before, after}), "diagnosis", "cogging_torque.amplitude_nm").changes[0];
  };
  EXPECT_EQ(row().reason, ChangeReason::kUntold);  // nobody asked what would have been seen
  DetectableEffect d;
  d.effect = "cogging_torque", d.smallest = {"amplitude_nm", "N m", 0.002};
  before.diagnosis->detectable = {d};
  EXPECT_EQ(row().verdict, ChangeVerdict::kChanged);
  EXPECT_NEAR(row().ci95.low, 0.007 - 0.002, 1e-12);
}

TEST(Changes, WhatWasGivenOrNotDeterminedIsNoFinding) {
  FittedParameter vague = estimated("mass_ratio", 2.0, 1.0);
  vague.identifiable = false;
  FittedParameter pressed = estimated("motor_damping", 0.1, 0.01);
  pressed.at_bound = true;
  const DriveChanges c =
      compared({report("a", 0.02, 1e-4,
                       {given("motor_inertia", 1e-3), vague, estimated("motor_damping", 0.05, 0.001)}),
                report("b", 0.021, 1e-4, {given("motor_inertia", 1.1e-3), vague, pressed})});
  EXPECT_EQ(c.quantities.size(), 2u);  // gap and motor_damping
  const DriveQuantity& damping = quantity(c, "reference", "motor_damping");
  EXPECT_EQ(damping.changes[0].reason, ChangeReason::kUntold);
  EXPECT_EQ(damping.observed[1].remark, "at a bound");
  EXPECT_THAT(c.warnings,
              ElementsAre(HasSubstr("b: motor_inertia was given as 0.0011 kg m², in a as 0.001")));
}

TEST(Changes, OtherRecordingsAndPoorModelsAreTold) {
  const DriveReport first = report("a", 0.020, 1e-4);
  DriveReport other = report("b", 0.021, 1e-4), poor = report("c", 0.022, 1e-4),
              same = report("d", 0.020, 1e-4);
  other.recordings[0].input_rms = 0.3;
  other.recordings[0].input_frequency = 2.5;
  poor.reference->innovation_rmse = 5e-5;
  const DriveChanges c = compared({first, other, poor, same});
  ASSERT_EQ(c.warnings.size(), 3u);
  EXPECT_THAT(c.warnings[0],
              HasSubstr("b: another excitation or another encoder than in a (input rms 0.3 instead of "
                        "0.4 units of u, input frequency 2.5 instead of 1 Hz)"));
  EXPECT_THAT(
      c.warnings[1],
      HasSubstr("c: the model leaves more than the encoder explains (prediction error 5 encoder floors)"));
  EXPECT_THAT(c.warnings[2], HasSubstr("d: the recording is the one of a"));
}

TEST(Changes, ReportsOfAnotherKindOfAxisAreRefused) {
  DriveReport screw = report("b", 0.02, 1e-4);
  screw.coordinates = Coordinates::kTranslation;
  try {
    compared({report("a", 0.02, 1e-4), screw});
    FAIL();
  } catch (const ConfigError& e) {
    EXPECT_THAT(e.what(),
                HasSubstr("b/result.json: has coordinates: translation, expected rotation as in a"));
  }
}

TEST(Changes, ComeBackFromTheFileAndADamagedOneIsRefused) {
  ScratchFolder scratch;
  const std::string folder = scratch.path.string(), path = folder + "/compare.json";
  FittedParameter damping = estimated("load_damping", 0.03, 0.001);
  damping.unit = "N m s/rad";
  DriveReport first = report("a", 0.02, 1e-4, {damping});
  first.model_free->lost_motion.levels = {level(3.95, 0.0337, 0.0015, 0.031)};
  LoopFacts loop;
  loop.amplitude = 3.95, loop.u = {-1.0, 1.0, -1.0}, loop.x1 = {-0.1, 0.1, -0.1};
  first.loops = {loop};
  const DriveChanges c = compared({first, report("b", 0.03, 1e-4, {damping})});
  write_drive_changes(folder, c);
  const std::string text = testing::text_of(path);
  EXPECT_THAT(text, HasSubstr("\"model_free.gap_rad\""));
  EXPECT_THAT(text, HasSubstr("\"model_free.lost_motion_at_3.95_u_rad\""));
  EXPECT_THAT(text, HasSubstr("\"reference.load_damping_nm_s_rad\""));
  const DriveChanges back = read_drive_changes(folder);
  EXPECT_EQ(back.quantities[0].changes[0].p, c.quantities[0].changes[0].p);
  EXPECT_EQ(back.loops.at(0).x1, loop.x1);
  EXPECT_EQ(back.codes, c.codes);
  EXPECT_EQ(back.quantities[0].changes[0].verdict, ChangeVerdict::kChanged);
  EXPECT_EQ(back.find("reference", "load_damping")->observed[1].ci95.high,
            c.find("reference", "load_damping")->observed[1].ci95.high);
  const auto damaged = [&](const std::string& from, const std::string& to) {
    std::string other = text;
    std::ofstream(path) << other.replace(other.find(from), from.size(), to);
    try {
      read_drive_changes(folder);
    } catch (const ConfigError& e) {
      return std::string(e.what());
    }
    return std::string("read");
  };
  EXPECT_THAT(damaged("compare/2", "compare/3"), HasSubstr("schema is \"gapscope.compare/3\", expected"));
  EXPECT_THAT(damaged("\"a\",", ""), HasSubstr("expected 1 and one less"));
  EXPECT_THAT(damaged("\"lead\": 0", "\"lead\": 9"), HasSubstr("lead is 9, expected the place of one of"));
  EXPECT_THAT(damaged("\"changed\"", "\"grown\""), HasSubstr("expected one of open, same, changed"));
}

}  // namespace
}  // namespace gapscope

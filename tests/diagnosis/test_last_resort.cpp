// A free-form law finds the variable that an effect outside the catalogue is a function of, and its table.
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>

#include "diagnosis/fitted_model.h"
#include "diagnosis/last_resort.h"
#include "diagnosis/mismatch_size.h"
#include "diagnosis/one_inertia.h"
#include "diagnosis/verdict.h"

namespace gapscope::internal::diagnosis {
namespace {

/// The law over the nominal model of a drive that lacks what is outside the catalogue.
struct Searched {
  blind::BlindPair pair;
  DiagnosisOptions options;
  std::optional<Study> study;
  std::optional<LawSearch> law;
  std::set<std::string> progress = {};  ///< what it said of itself

  explicit Searched(const independent_plant::OutsideEffects& outside)
      : Searched(test::one_inertia({}, 5, outside)) {}
  explicit Searched(blind::BlindPair drawn) : pair(std::move(drawn)) {
    options.progress = [this](const std::string& what) { progress.insert(what); };
    const MotorTrace train[] = {pair.train.motor_trace()}, held[] = {pair.held_out.motor_trace()};
    study.emplace(make_study(train, held, pair.sheet, options));
    law = search_last_resort(
        *study, judge(nullptr, fit_nominal(study->train, study->sheet, options.fit, study->observer_hz),
                      study->held_out, study->observer_hz));
  }
};

TEST(LastResort, AFrictionWithAMaximumIsAFunctionOfSpeed) {
  const Searched s({.hump_nm = 0.02, .hump_speed_rad_s = 0.5});
  ASSERT_TRUE(s.law);
  const LastResortLaw law = told(*s.study, *s.law);
  EXPECT_EQ(law.law, "friction_curve");
  EXPECT_GE(s.progress.size(), 6u) << "of each of three laws it tells at least twice";
  EXPECT_EQ(law.variable, "speed");
  EXPECT_GT(law.shrink, 0.7);
  EXPECT_LT(law.after_torque, law.before_torque);
  const std::size_t half = law.curve.size() / 2;
  ASSERT_GE(half, 25u);  // four points in each of six pieces of each direction, backward first
  EXPECT_LT(law.curve.front().at, 0.0);
  EXPECT_EQ(law.curve[half - 1].at, 0.0);
  EXPECT_EQ(law.curve[half].at, 0.0);
  EXPECT_EQ(law.curve[half - 1].direction, -1);
  EXPECT_EQ(law.curve[half].direction, 1);
  for (const CurvePoint& p : law.curve) EXPECT_LE(p.ci95.low, p.torque);
  EXPECT_FALSE(law.residual.empty());
}

TEST(LastResort, AGainThatDiffersWithTheSignIsAFunctionOfTheInput) {
  const Searched s({.one_sided_gain = 0.1, .gain_input = 0.2});
  ASSERT_TRUE(s.law);
  const LastResortLaw law = told(*s.study, *s.law);
  EXPECT_EQ(law.variable, "input");
  EXPECT_GT(law.shrink, 0.7);
  // Its even part is gain u tanh(u/0.2): what the drive has beside Km u at the largest input.
  const double most = law.curve.back().at;
  EXPECT_NEAR(law.curve.back().torque, 0.172 * 0.1 * most * std::tanh(most / 0.2), 0.3 * 0.172 * 0.1 * most);
}

TEST(LastResort, ACableThatPullsBehindAGapIsAFunctionOfPositionThoughFewHarmonicsLeaveMore) {
  const Searched s(blind::blind_pair("geared", "cable_pull", 0.825, 1200010));
  ASSERT_TRUE(s.law);  // on held-out data two and four harmonics do worse than none
  EXPECT_STREQ(s.law->after.entry->name, "position_torque");
  EXPECT_LT(s.law->after.fitted.mean_cost, kExplained);
  EXPECT_LT(s.law->after.median_free, 0.1 * s.law->before.median_free);
}

/// Windows of free runs of a given size [floor].
ScoredModel with_windows(const std::vector<double>& sizes) {
  ScoredModel model;
  for (const double size : sizes) model.windows.free.push_back(size * size);
  return model;
}

TEST(Helps, NoEffectThatHasEndedWhereThereIsNoneOfIt) {
  ScoredModel before = with_windows(std::vector<double>(20, 10.0)),
              after = with_windows(std::vector<double>(20, 5.0));
  before.fitted.mean_cost = 100.0, after.fitted.mean_cost = 25.0;
  ModelEffect sag{find_effect("supply_sag"), {}};
  sag.parameters[0].value = 0.03, sag.parameters[1].value = 1.0;
  after.fitted.model.effects = {sag};
  EXPECT_TRUE(helps(before, after, false));
  after.fitted.model.effects.back().parameters[0].value = 0.0;
  EXPECT_FALSE(helps(before, after, false));
}

TEST(LastResort, ALawThatLeavesMoreOfWhatWasFittedHasNoClearLead) {
  const auto leaving = [](double size) {
    ScoredModel model = with_windows(std::vector<double>(20, size));
    model.windows.innovation = model.windows.free;
    return model;
  };
  LawSearch law;
  law.after = leaving(10.0);
  ScoredModel effects = leaving(14.0);
  law.after.fitted.mean_cost = 300.0, effects.fitted.mean_cost = 320.0;
  const Lead ahead = lead_over(law, effects);
  EXPECT_NEAR(ahead.score, 2.0 * std::log(1.4), 0.02);
  EXPECT_TRUE(ahead.is_clear());
  law.after.fitted.mean_cost = 330.0;
  EXPECT_FALSE(lead_over(law, effects).is_clear()) << "what it has ahead is luck of what was held out";
  EXPECT_EQ(lead_over(law, effects).score, ahead.score);
  law.after.fitted.mean_cost = 300.0;
  EXPECT_FALSE(lead_over(law, leaving(11.0)).is_clear());
}

TEST(LastResort, ALawThatFailsInAFewWindowsMayFailOnTheNextRecording) {
  const DiagnosisOptions options;
  const Study study{{}, {}, {}, {}, kMeasure.slow_hz, 0.0, {}, options};
  const std::vector<double> none(20, 1000.0), everywhere(20, 10.0);
  std::vector<double> mostly = everywhere;
  mostly[7] = 900.0, mostly[8] = 1.0, mostly[9] = 1.0, mostly[10] = 1.0;
  const ScoredModel before = with_windows(none);
  const Interval even = law_shrink_interval(study, before, with_windows(everywhere));
  EXPECT_NEAR(even.low, 1.0 - 4.0 * 0.01, 0.005);
  EXPECT_NEAR(even.high, 1.0 - 0.01 / 4.0, 0.005);
  const Interval uneven = law_shrink_interval(study, before, with_windows(mostly));
  EXPECT_NEAR(uneven.low, 1.0 - 4.0 * 0.2, 0.02);  // 900/1000 in one of twenty: 0.2 in the mean square
  EXPECT_GT(uneven.high, even.high);
  EXPECT_TRUE(std::isnan(law_shrink_interval(study, with_windows({1.0, 1.0}), before).low));
}

TEST(LastResort, ALawOfAnEffectsOwnVariableMakesTheEffectAPartOfIt) {
  LawSearch law;
  law.after.entry = find_effect("friction_curve");
  Additions added;
  added.effects = {{find_effect("cogging_torque"), {}}, {find_effect("measurement_lag"), {}}};
  EXPECT_FALSE(continues_one(law, added));
  added.effects.push_back({find_effect("stribeck_friction"), {}});
  EXPECT_TRUE(continues_one(law, added));
}

TEST(LastResort, ALawByTheirPeriodIsTheSeriesThatCogsBegin) {
  const auto over = [](double cycles) {
    LawSearch law;
    law.after.entry = find_effect("position_torque");
    law.after.fitted.model.effects.push_back(
        {law.after.entry, {ParameterSetting::known(2.0 * kPi / cycles)}});
    return law;
  };
  ModelEffect cogs{find_effect("cogging_torque"), {}};
  cogs.parameters[1].value = 24.0;
  EXPECT_TRUE(is_series_of(over(23.9), cogs));
  EXPECT_TRUE(is_series_of(over(72.1), cogs)) << "its third harmonic";
  EXPECT_FALSE(is_series_of(over(0.3), cogs)) << "over twice the travel";
  EXPECT_FALSE(is_series_of(over(36.0), cogs));
  ModelEffect ripple{find_effect("torque_ripple"), {}};
  ripple.parameters[1].value = 24.0;
  EXPECT_FALSE(is_series_of(over(24.0), ripple)) << "goes with the input";
  LawSearch friction;
  friction.after.entry = find_effect("friction_curve");
  friction.after.fitted.model.effects.push_back({friction.after.entry, {}});
  EXPECT_FALSE(is_series_of(friction, cogs));
}

TEST(LastResort, NothingIsLaidOverADriveThatLacksNothing) {
  EXPECT_FALSE(Searched(independent_plant::OutsideEffects{}).law);
}

}  // namespace
}  // namespace gapscope::internal::diagnosis

// What a fit leaves undetermined, against fits of the same motion under other noise.
#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "blind/blind_pair.h"
#include "diagnosis/mismatch_size.h"
#include "gapscope/base/errors.h"

namespace gapscope::internal::diagnosis {
namespace {

constexpr int kFits = 8;

/// A recording with another noise on top [rad].
Recording noisier(Recording r, double noise, std::uint64_t seed) {
  auto g = random_stream(seed, "other noise");
  for (double& x : r.x1) x += noise * normal(g);
  return r;
}

class Undetermined : public ::testing::TestWithParam<std::uint64_t> {};

TEST_P(Undetermined, IsTheScatterOfPredictionsOverOtherNoise) {
  const blind::BlindPair pair = blind::blind_pair("geared", "none", 0.0, GetParam());
  const double noise = 2e-3;  // far above the recording's own, which all fits share
  const MotorTrace held[] = {pair.held_out.motor_trace()};
  DiagnosisOptions options;
  double foretold = 0.0;
  std::vector<double> sum(held[0].size()), square(sum.size());
  for (int k = 0; k < kFits; ++k) {
    const Recording heard = noisier(pair.train, noise, static_cast<std::uint64_t>(k));
    const MotorTrace train[] = {heard.motor_trace()};
    const Study study = make_study(train, held, pair.sheet, options);
    const FittedModel fitted = fit_nominal(train, pair.sheet, {}, study.observer_hz);
    foretold += undetermined_by(study, fitted.model) / kFits;
    const std::vector<double> left =
        play(fitted.model, study.held_out, study.observer_hz, false)[0].innovation;
    for (std::size_t i = 0; i < left.size(); ++i) sum[i] += left[i], square[i] += left[i] * left[i];
  }
  double scatter = 0.0;
  for (std::size_t i = 0; i < sum.size(); ++i)
    scatter += (square[i] - sum[i] * sum[i] / kFits) / (kFits - 1) / static_cast<double>(sum.size());
  EXPECT_GT(foretold, 0.7 * std::sqrt(scatter));
  EXPECT_LT(foretold, 2.5 * std::sqrt(scatter));  // on the third drive it foretells twice too much
}

/// Positions of 6 s, of a motion that lasts until `rest`.
std::vector<double> moving_until(double rest) {
  std::vector<double> x1;
  for (int i = 0; i < 6000; ++i) x1.push_back(std::sin(2.0 * kPi * std::min(1e-3 * i, rest)));
  return x1;
}

TEST(HalfOfTheHeldOut, IsOfTheWayWhereTheDriveRestsThroughAHalf) {
  const DiagnosisOptions options;
  Study study{.train = {}, .held_out = {}, .sheet = {}, .catalogue = {}, .effort = {}, .options = options};
  const std::vector<double> recorded[] = {moving_until(6.0), moving_until(4.5), moving_until(3.0),
                                          moving_until(1.0)};
  for (const std::vector<double>& x1 : recorded) {
    MotorTrace t;
    t.dt = 1e-3, t.u = x1, t.x1 = x1;
    study.held_out.traces.push_back(t);
  }
  study.held_out.scored_from.assign(4, 0);
  fit_half_of_the_held_out(study);
  EXPECT_EQ(study.held_out.scored_from[0], 3000u);
  EXPECT_EQ(study.held_out.scored_from[1], 3000u) << "both halves move";
  EXPECT_NEAR(static_cast<double>(study.held_out.scored_from[2]), 1500.0, 2.0);
  EXPECT_EQ(study.held_out.scored_from[3], 1500u) << "no half is shorter than a fourth of it";
  ASSERT_EQ(study.train.size(), 4u);
  EXPECT_EQ(study.train[2].size(), study.held_out.scored_from[2]);
}

/// The first rows of a drive that sooner rests.
MotorTrace rows_of(const std::vector<double>& x1, std::size_t rows, const char* file) {
  MotorTrace t;
  t.file = file, t.dt = 1e-3;
  t.u = std::span(x1).first(rows), t.x1 = std::span(x1).first(rows);
  return t;
}

TEST(HalfOfTheHeldOut, CanBeFittedHoweverShort) {
  const std::vector<double> x1 = moving_until(0.01);
  const DiagnosisOptions options;
  Study study{.train = {}, .held_out = {}, .sheet = {}, .catalogue = {}, .effort = {}, .options = options};
  study.held_out.traces = {rows_of(x1, 50, "short.csv")}, study.held_out.scored_from = {0};
  fit_half_of_the_held_out(study);
  EXPECT_GE(study.train[0].size(), kFewestFitted);
  EXPECT_GE(study.held_out.traces[0].size() - study.held_out.scored_from[0], kFewestFitted);
}

TEST(TheLastThird, IsNotHeldOutWhereItCouldNotBeFitted) {
  const std::vector<double> x1 = moving_until(6.0);
  const std::vector<MotorTrace> files = {rows_of(x1, 600, "long.csv"), rows_of(x1, 57, "short.csv")};
  const Study study = make_study(files, {}, ReferenceModel(), {});
  EXPECT_EQ(study.judge_nothing, std::vector<std::string>{"short.csv"});
  ASSERT_EQ(study.held_out.traces.size(), 1u);
  EXPECT_EQ(study.held_out.traces[0].file, "long.csv");
  ASSERT_EQ(study.train.size(), 2u);
  EXPECT_EQ(study.train[0].size(), 57u) << "fitted whole";
  EXPECT_EQ(study.train[1].size(), study.held_out.scored_from[0]);
  ASSERT_EQ(everything(study).size(), 2u) << "the file that is judged is whole in it, the other as it is";
  EXPECT_EQ(everything(study)[1].size(), 600u);
  EXPECT_THROW(make_study(std::span(files).last(1), {}, ReferenceModel(), {}), ConfigError);
}

INSTANTIATE_TEST_SUITE_P(Drives, Undetermined, ::testing::Values(500001u, 500002u, 500003u));

}  // namespace
}  // namespace gapscope::internal::diagnosis

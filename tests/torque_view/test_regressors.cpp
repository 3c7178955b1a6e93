#include <gtest/gtest.h>

#include <cmath>

#include "drives.h"
#include "torque_view/band.h"
#include "torque_view/model.h"

namespace gapscope::internal::torque_view {
namespace {

using test::kDamping, test::kInertia, test::Motion;

double nothing(const Motion&) { return 0.0; }

TEST(Regressors, InertiaAndDampingComeOutOfUnevenStampsInEveryBand) {
  const StampedTrace traces[] = {test::recorded(nothing, 0.3)};
  for (const double hz : {3.0, 8.0, 16.0}) {
    Rows rows = stacked(traces, hz, false, {});
    const Model model = fitted(rows, nominal_model());
    EXPECT_NEAR(first_coefficient(model, "inertia"), kInertia, 0.01 * kInertia) << hz;
    EXPECT_NEAR(first_coefficient(model, "viscous"), kDamping, 0.02 * kDamping) << hz;
  }
}

TEST(Regressors, StatesAndTheRestOfTheFilterMakeTheFilterOfTheInput) {
  const StampedTrace trace = test::recorded([](const Motion& m) { return -kDamping * m.w; }, 0.3, 0.0);
  const StampedTrace traces[] = {trace};
  Rows rows = stacked(traces, 10.0, false, {});  // u is J a, and nothing else
  Eigen::VectorXd column(rows.size());
  fill_columns(rows, law("inertia"), kNaN, column);
  EXPECT_LT((rows.u - kInertia * column).norm(), 0.01 * rows.u.norm());
}

TEST(Regressors, RowsBesideLostSamplesAndJumpsAreDropped) {
  StampedTrace trace = test::recorded(nothing, 0.3);
  const std::size_t lost = trace.t.size() / 2;
  const double at = trace.t[lost];
  trace.t.erase(trace.t.begin() + static_cast<std::ptrdiff_t>(lost),
                trace.t.begin() + static_cast<std::ptrdiff_t>(lost + 50));
  trace.u.erase(trace.u.begin() + static_cast<std::ptrdiff_t>(lost),
                trace.u.begin() + static_cast<std::ptrdiff_t>(lost + 50));
  trace.x.erase(trace.x.begin() + static_cast<std::ptrdiff_t>(lost),
                trace.x.begin() + static_cast<std::ptrdiff_t>(lost + 50));
  for (std::size_t i = trace.x.size() / 4; i < trace.x.size(); ++i) trace.x[i] += 1.0;
  const double jump = trace.t[trace.x.size() / 4];
  const BandRecord record = in_band(trace, 8.0, {});
  for (const double t : record.row_time) {
    EXPECT_GT(std::abs(t - jump), 0.9 * 3.0 * kernel_sigma(8.0));
    EXPECT_FALSE(t > at - 0.9 * 3.0 * kernel_sigma(8.0) && t < at + 0.1);
  }
  EXPECT_GT(record.masked, 0.0);
  EXPECT_LT(record.masked, 0.1);
}

TEST(Regressors, WhereTheDriveStandsNoRowIsLeft) {
  StampedTrace trace = test::recorded(nothing, 0.3);
  for (std::size_t i = 0; i < trace.x.size(); ++i)
    if (trace.t[i] > 4.0 && trace.t[i] < 8.0) trace.x[i] = 1.0;
  for (const double t : in_band(trace, 8.0, {}).row_time) EXPECT_FALSE(t > 4.1 && t < 7.9);
}

TEST(Regressors, TheNoiseOfTheEncoderIsReadAndItsAccelerationForeseen) {
  StampedTrace trace;
  std::mt19937_64 generator = random_stream(5, "noise");
  for (int i = 0; i < 20000; ++i)
    trace.t.push_back(0.001 * i), trace.x.push_back(1e-4 * normal(generator)), trace.u.push_back(0.0);
  EXPECT_NEAR(position_noise(trace), 1e-4, 5e-6);
  const std::vector<double> cells = cell_lengths(trace.t);
  SmoothingKernel kernel(trace.t, cells, kernel_sigma(20.0), 4.0);
  std::vector<double> a;
  for (double T = 0.1; T < 19.9; T += 0.01) a.push_back(kernel.motion(trace.x, T).a);
  EXPECT_NEAR(rms(a), noise_acceleration(1e-4, 0.001, 20.0),
              0.1 * rms(a));  // some 500 independent values
}

TEST(Band, EndsWhereTheEncodersNoiseBeginsToEatTheInertia) {
  StampedTrace trace = test::recorded(nothing, 0.3);
  StampedTrace noisy = trace;
  std::mt19937_64 generator = random_stream(6, "noise");
  for (double& x : noisy.x) x += 2e-3 * normal(generator);
  const FrequencyBand clean = choose_band({&trace, 1}, {}, {}), rough = choose_band({&noisy, 1}, {}, {});
  EXPECT_LT(rough.hz, clean.hz);
  for (const Octave& o : rough.octaves)
    if (o.top_hz <= rough.hz && o.inertial > 0.1) {
      EXPECT_NEAR(o.inertia, kInertia, 0.12 * kInertia) << o.top_hz;
    }
}

TEST(Band, OneSpeedAsksForAFreeConstant) {
  StampedTrace trace = test::recorded(nothing, 0.3);
  EXPECT_FALSE(choose_band({&trace, 1}, {}, {}).free_constant);
  for (std::size_t i = 0; i < trace.x.size(); ++i) trace.x[i] = 30.0 * trace.t[i] + 0.1 * trace.x[i];
  EXPECT_TRUE(choose_band({&trace, 1}, {}, {}).free_constant);
}

}  // namespace
}  // namespace gapscope::internal::torque_view

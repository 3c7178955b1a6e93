#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "report/decimate.h"
#include "report/report_view.h"
#include "report/signals.h"

namespace gapscope::internal::report {
namespace {

TEST(DecimateColumns, KeepsTheExtremesOfEveryColumn) {
  constexpr std::size_t n = 60000, columns = 500;
  auto generator = random_stream(2, "trace");
  std::vector<double> x(n), y(n);
  for (std::size_t i = 0; i < n; ++i) {
    x[i] = static_cast<double>(i) / static_cast<double>(n - 1);
    y[i] = normal(generator);
  }
  y[31234] = 50.0;  // a spike of one sample
  const auto kept = decimate_columns(x, y, columns);
  EXPECT_LE(kept.size(), 4 * (columns + 1));
  EXPECT_TRUE(std::is_sorted(kept.begin(), kept.end()));
  EXPECT_TRUE(std::adjacent_find(kept.begin(), kept.end()) == kept.end()) << "none twice";
  EXPECT_EQ(kept.front(), 0u);
  EXPECT_EQ(kept.back(), n - 1);
  std::vector<double> all_low(columns + 1, 1e9), all_high(columns + 1, -1e9), low = all_low, high = all_high;
  const auto column = [&](std::size_t i) { return static_cast<std::size_t>(x[i] * columns); };
  for (std::size_t i = 0; i < n; ++i) {
    all_low[column(i)] = std::min(all_low[column(i)], y[i]);
    all_high[column(i)] = std::max(all_high[column(i)], y[i]);
  }
  for (const std::size_t i : kept) {
    low[column(i)] = std::min(low[column(i)], y[i]);
    high[column(i)] = std::max(high[column(i)], y[i]);
  }
  EXPECT_EQ(low, all_low);
  EXPECT_EQ(high, all_high);
}

TEST(DecimateColumns, LeavesAShortTraceAlone) {
  const std::vector<double> x = {0.0, 1.0, 2.0}, y = {1.0, NAN, 3.0};
  EXPECT_EQ(decimate_columns(x, y, 10), (std::vector<std::size_t>{0, 1, 2}));
}

RunResult long_run(std::size_t samples) {
  RunResult run;
  Recording r;
  r.dt = 1e-3;
  for (std::size_t i = 0; i < samples; ++i) r.x1.push_back(std::sin(1e-5 * static_cast<double>(i)));
  r.u = r.x1;
  run.recordings.push_back(std::move(r));
  return run;
}

TEST(OverTime, KeepsTheSpikesOfALongLineButNotAllOfIt) {
  RunResult run = long_run(1'000'000);
  std::vector<double>& x1 = run.recordings[0].x1;
  x1[123'457] = 7.0, x1[876'543] = -7.0;
  const ReportView view(run);
  const Series line = view.over_time("", {}, x1, {view.time.front(), view.time.back()});
  EXPECT_LT(line.x.size(), 140'000u);
  EXPECT_EQ(line.x.size(), line.y.size());
  EXPECT_EQ(peak_to_peak(line.y), 14.0);
  EXPECT_EQ(line.x.front(), view.time.front());
  EXPECT_EQ(line.x.back(), view.time.back());
  EXPECT_EQ(view.part(x1, {view.time.front(), view.time.back()}).size(), x1.size());
}

TEST(OverTime, LeavesAnInterruptedLineAlone) {
  RunResult run = long_run(200'000);
  run.recordings[0].x1[1000] = kNaN;
  const ReportView view(run);
  EXPECT_EQ(view.over_time("", {}, run.recordings[0].x1, {0.0, 1e9}).y.size(), 200'000u);
}

TEST(ThinOut, LeavesNoHoleWiderThanOneStepMoreThanAsked) {
  Polyline circle;
  for (int i = 0; i <= 10000; ++i) circle.push_back({100.0 * std::cos(i * 1e-3), 100.0 * std::sin(i * 1e-3)});
  const Polyline thin = thin_out(circle, 0.5);
  EXPECT_LT(thin.size(), circle.size() / 4);
  for (std::size_t i = 1; i < thin.size(); ++i)
    EXPECT_LE(std::hypot(thin[i].x - thin[i - 1].x, thin[i].y - thin[i - 1].y), 0.5 + 0.1 + 1e-9);
  EXPECT_EQ(thin.back().x, circle.back().x);
}

}  // namespace
}  // namespace gapscope::internal::report

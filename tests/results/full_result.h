#pragma once

#include <array>
#include <cmath>
#include <string>

#include "results/run_result.h"

/// A result that has something everywhere.
namespace gapscope::test {

// Numbers that show a lost digit: none of them is short in decimal.
inline constexpr double kThird = 1.0 / 3.0;

inline Recording recording(const std::string& file, double offset, bool simulated) {
  Recording r{
      file, 0.1, 1e-3 * kThird, {}, {}, {}, {}, 5.992112452678286e-06, simulated ? "" : "400 Hz, linear"};
  for (int i = 0; i < 60; ++i) {
    r.u.push_back(std::sin(i * kThird));
    r.x1.push_back(offset + std::sin(i * 0.7) / 7.0);
    if (simulated) r.x2.push_back(r.x1.back() * kThird);
    if (simulated)
      r.mode.push_back(std::array{Mode::kEngagementMinus, Mode::kGap, Mode::kImpact,
                                  Mode::kEngagementPlus}[static_cast<std::size_t>(i % 4)]);
  }
  return r;
}

inline GapEstimate estimate(const RunResult& run) {
  GapEstimate g;
  g.verdict = GapVerdict::kBacklash;
  g.reason = Remark::said("6 passages, \"both\" directions, 2β");
  g.method = GapMethod::kLostMotion;
  g.quantity = GapQuantity::kPlayAtZeroTorque;
  g.gap = 0.0187 * kThird;
  g.std = 1e-4 * kThird;
  g.ci95 = {0.018 * kThird, 0.019 * kThird};
  g.smallest_visible_gap = 4e-4 * kThird;
  g.lost_motion = {0.02 * kThird,
                   {0.019, 0.021},
                   0.022,
                   1.2,
                   {{1.2, 0.02, {0.019, 0.021}, 9, 0.018 * kThird, 1e-3}},
                   LostMotionCause::kGap,
                   Remark::said("mostly a gap")};
  g.bound = 4.1 * kThird;
  g.bound_t1 = 3.7 * kThird;
  g.scale = 50.0;
  g.events.push_back({"a.csv", kThird, 2 * kThird, -kThird, kThird, 0.018, 0.017, 1e-5, -1, false,
                      "bounced, \n", 0.1 * kThird});
  g.events.push_back({"b.csv", 1.0, kNaN, 1e-300, kNaN, kNaN, kNaN, kNaN, 1, true, ""});
  g.traces = {{"a.csv", run.recordings[0].x1, run.recordings[0].u}, {"b.csv", run.recordings[1].x1, {}}};
  g.traces[0].error[3] = kNaN;
  g.warnings = {Remark::said("one"), Remark::said("two")};
  g.paper_bound = 98.0 * kThird;
  g.map =
      BoundMap{"a.csv", 0.5 * kThird, 1e-3 * kThird, {kThird, 1.0}, {0.12, 3.45, 6.78, 1e-3, 0.0, 9999.0}};
  return g;
}

inline FitSummary summary(const RunResult& run) {
  FitSummary f;
  f.status = FitStatus::kNotConverged;
  f.message = Remark::said("100 iterations");
  f.trust = FitTrust::kRejected;
  f.why = Remark::said("It misses 40 % of the motion.");
  f.fit_percent = 96.0 * kThird;
  f.coasting_rmse = 1e-4 * kThird;
  f.without_gap_ratio = 7.0 * kThird;
  f.rmse = 1e-5 * kThird;
  f.floor = 1e-6 * kThird;
  f.innovation_rmse = 1e-7 * kThird;
  f.observer_hz = 40.0 * kThird;
  f.objective_hz = 4.0 * kThird;
  f.starts = 8;
  f.simulations = 345;
  f.lag1_autocorrelation = -kThird;
  f.input_timing = {0.25 * kThird, 0.5 * kThird};
  f.parameters.push_back({"gap", "rad", 0.02, 0.0188, 1e-5, {0.01878, 0.01882}, 0.0, 0.3, true, true, false});
  f.parameters.push_back({"a_fixed", "-", 1.2, 1.2, kNaN, {}, -kInfinity, kInfinity, false, false, false});
  f.parameters.push_back({"bound", "N m", 1.2, 0.0, 3.0, {}, kNaN, 1.0, true, false, true});
  FitTrace& trace = f.traces.emplace_back();
  trace.file = "b.csv";
  trace.x1 = run.recordings[1].u;
  trace.predicted = run.recordings[1].x1;
  f.mode_errors = {{Mode::kGap, 12, kThird}, {Mode::kEngagementMinus, 0, kNaN}};
  f.pieces = {{1, 100, 90.0 * kThird, {kThird, -2.0}, {1e20 * kThird, -1.0, 4.0}}};
  f.start_costs = {kThird, 2.0, kNaN};
  f.warnings = {Remark::said("advice")};
  return f;
}

inline RunResult full_result() {
  RunResult run;
  run.name = "rig_p";
  run.version = "0.1.0";
  run.configuration = "name: \"rig_p\"  # 2β\n";
  run.coordinates = Coordinates::kTranslation;
  run.recordings = {recording("a.csv", 0.0, true), recording("b.csv", 2.0, false)};
  run.model_free = estimate(run);
  run.reference = summary(run);
  run.comparison = Comparison{-1e-4 * kThird, 1e-4, true, 0.0188 * kThird};
  run.answer = Answer{0.0187 * kThird,       {0.018 * kThird, 0.019 * kThird}, AnswerSource::kModelFree,
                      AnswerTrust::kLimited, "The backlash gap is \"6\" mm.",  {"one", "two"}};
  run.simulated_gap = 0.0188;
  run.notes = {"resampled to 400 Hz"};
  run.doubts = {{"fresh_samples", "x1 is held", "record anew"}};
  return run;
}

}  // namespace gapscope::test

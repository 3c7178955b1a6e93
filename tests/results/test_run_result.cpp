#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "gapscope/base/errors.h"
#include "results/full_result.h"
#include "results/run_result.h"
#include "results/scratch_folder.h"
#include "support/reading.h"

namespace gapscope {
namespace {

using test::full_result;
using test::kThird;
using testing::text_of;
namespace fs = std::filesystem;

/// Equal bits, or both undefined.
void expect_same(double a, double b, const char* what) {
  EXPECT_TRUE(a == b || (std::isnan(a) && std::isnan(b))) << what << ": " << a << " and " << b;
}
#define EXPECT_SAME(member) expect_same(a.member, b.member, #member)

RunResult round_trip(const RunResult& run) {
  ScratchFolder scratch;
  write_run_result(scratch.path.string(), run);
  return read_run_result(scratch.path.string());
}

TEST(RunResult, ComesBackExactly) {
  const RunResult a = full_result();
  const RunResult b = round_trip(a);
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.version, b.version);
  EXPECT_EQ(a.configuration, b.configuration);
  EXPECT_EQ(a.coordinates, b.coordinates);
  EXPECT_EQ(a.notes, b.notes);
  EXPECT_EQ(a.doubts, b.doubts);
  EXPECT_SAME(simulated_gap);
  EXPECT_SAME(comparison->difference);
  EXPECT_SAME(comparison->joint_std);
  EXPECT_SAME(comparison->map_width);
  EXPECT_EQ(a.comparison->agree, b.comparison->agree);
}

TEST(RunResult, ItsRecordingsComeBackExactly) {
  const RunResult x = full_result();
  const RunResult y = round_trip(x);
  ASSERT_EQ(y.recordings.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    const Recording &a = x.recordings[i], &b = y.recordings[i];
    EXPECT_EQ(a.file, b.file);
    EXPECT_SAME(start);
    EXPECT_SAME(dt);
    EXPECT_SAME(quantum);
    EXPECT_EQ(a.resampling, b.resampling);
    EXPECT_EQ(a.u, b.u);
    EXPECT_EQ(a.x1, b.x1);
    EXPECT_EQ(a.x2, b.x2);
    EXPECT_EQ(a.mode, b.mode);
  }
}

TEST(RunResult, TheModelFreeEstimateComesBackExactly) {
  const GapEstimate a = *full_result().model_free;
  const GapEstimate b = *round_trip(full_result()).model_free;
  EXPECT_EQ(a.verdict, b.verdict);
  EXPECT_EQ(a.reason, b.reason);
  EXPECT_EQ(a.method, b.method);
  EXPECT_EQ(a.quantity, b.quantity);
  EXPECT_SAME(gap);
  EXPECT_SAME(std);
  EXPECT_SAME(ci95.low);
  EXPECT_SAME(ci95.high);
  EXPECT_SAME(smallest_visible_gap);
  EXPECT_SAME(bound);
  EXPECT_SAME(bound_t1);
  EXPECT_SAME(paper_bound);
  EXPECT_SAME(scale);
  ASSERT_TRUE(b.map);
  EXPECT_EQ(a.map->file, b.map->file);
  EXPECT_SAME(map->start);
  EXPECT_SAME(map->dt);
  EXPECT_EQ(a.map->bounds, b.map->bounds);
  EXPECT_EQ(a.map->levels, b.map->levels);
  EXPECT_EQ(a.warnings, b.warnings);
  ASSERT_EQ(b.traces.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(a.traces[i].file, b.traces[i].file);
    EXPECT_EQ(a.traces[i].velocity, b.traces[i].velocity);
    ASSERT_EQ(a.traces[i].error.size(), b.traces[i].error.size());
    for (std::size_t k = 0; k < a.traces[i].error.size(); ++k) EXPECT_SAME(traces[i].error[k]);
  }
}

TEST(RunResult, StampsOfUnevenRecordingsComeBackExactly) {
  RunResult run = full_result();
  Recording& r = run.recordings[0];
  for (std::size_t i = 0; i < r.size(); ++i)
    r.stamps.push_back(r.start +
                       r.dt * (static_cast<double>(i) + 0.3 * std::sin(7.0 * static_cast<double>(i))));
  const RunResult read = round_trip(run);
  EXPECT_EQ(read.recordings[0].stamps, r.stamps);
  EXPECT_TRUE(read.recordings[1].even());
}

TEST(RunResult, EventsComeBackExactly) {
  const auto x = full_result().model_free->events;
  const auto y = round_trip(full_result()).model_free->events;
  ASSERT_EQ(x.size(), y.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    const GapEvent &a = x[i], &b = y[i];
    EXPECT_EQ(a.file, b.file);
    EXPECT_SAME(t1);
    EXPECT_SAME(t2);
    EXPECT_SAME(x1_t1);
    EXPECT_SAME(x1_t2);
    EXPECT_SAME(gap);
    EXPECT_SAME(gap_uncorrected);
    EXPECT_SAME(std);
    EXPECT_SAME(t_c);
    EXPECT_EQ(a.direction, b.direction);
    EXPECT_EQ(a.accepted, b.accepted);
    EXPECT_EQ(a.remark, b.remark);
  }
}

TEST(RunResult, TheAnswerComesBackExactly) {
  const Answer a = *full_result().answer;
  const Answer b = *round_trip(full_result()).answer;
  EXPECT_SAME(gap);
  EXPECT_SAME(ci95.low);
  EXPECT_SAME(ci95.high);
  EXPECT_EQ(a.from, b.from);
  EXPECT_EQ(a.trust, b.trust);
  EXPECT_EQ(a.sentence, b.sentence);
  EXPECT_EQ(a.next, b.next);
}

TEST(RunResult, OfATimeBeforeTrustWasJudgedIsLimitedAndHasNoAnswer) {
  ScratchFolder scratch;
  write_run_result(scratch.path.string(), full_result());
  const fs::path file = scratch.path / "result.json";
  auto json = nlohmann::json::parse(text_of(file));
  json.erase("answer");
  for (const char* key : {"trust", "why", "fit_percent", "coasting_rmse_rad", "without_gap_ratio"})
    ASSERT_EQ(json["reference"].erase(key), 1u) << key;
  std::ofstream(file) << json;
  const RunResult old = read_run_result(scratch.path.string());
  EXPECT_FALSE(old.answer);
  EXPECT_EQ(old.reference->trust, FitTrust::kLimited);
  EXPECT_TRUE(std::isnan(old.reference->fit_percent));
}

TEST(RunResult, TheReferenceComesBackExactly) {
  const FitSummary a = *full_result().reference;
  const FitSummary b = *round_trip(full_result()).reference;
  EXPECT_EQ(a.status, b.status);
  EXPECT_EQ(a.message, b.message);
  EXPECT_EQ(a.trust, b.trust);
  EXPECT_EQ(a.why, b.why);
  EXPECT_SAME(fit_percent);
  EXPECT_SAME(coasting_rmse);
  EXPECT_SAME(without_gap_ratio);
  EXPECT_SAME(rmse);
  EXPECT_SAME(floor);
  EXPECT_SAME(innovation_rmse);
  EXPECT_SAME(observer_hz);
  EXPECT_SAME(objective_hz);
  EXPECT_EQ(a.starts, b.starts);
  EXPECT_EQ(a.simulations, b.simulations);
  EXPECT_SAME(lag1_autocorrelation);
  EXPECT_SAME(input_timing.early_rows);
  EXPECT_SAME(input_timing.std_rows);
  ASSERT_EQ(a.start_costs.size(), b.start_costs.size());
  for (std::size_t i = 0; i < a.start_costs.size(); ++i) EXPECT_SAME(start_costs[i]);
  EXPECT_EQ(a.warnings, b.warnings);
  ASSERT_EQ(a.mode_errors.size(), b.mode_errors.size());
  for (std::size_t i = 0; i < a.mode_errors.size(); ++i) {
    EXPECT_EQ(a.mode_errors[i].mode, b.mode_errors[i].mode);
    EXPECT_EQ(a.mode_errors[i].samples, b.mode_errors[i].samples);
    EXPECT_SAME(mode_errors[i].rmse);
  }
  ASSERT_EQ(a.pieces.size(), b.pieces.size());
  for (std::size_t i = 0; i < a.pieces.size(); ++i) {
    EXPECT_EQ(a.pieces[i].recording, b.pieces[i].recording);
    EXPECT_EQ(a.pieces[i].samples, b.pieces[i].samples);
    EXPECT_SAME(pieces[i].square);
    EXPECT_EQ(a.pieces[i].slope, b.pieces[i].slope);
    EXPECT_EQ(a.pieces[i].normal, b.pieces[i].normal);
  }
  ASSERT_EQ(b.traces.size(), 1u);
  EXPECT_EQ(a.traces[0].file, b.traces[0].file);
  EXPECT_EQ(a.traces[0].x1, b.traces[0].x1);
  EXPECT_EQ(a.traces[0].predicted, b.traces[0].predicted);
  EXPECT_EQ(a.traces[0].x2, b.traces[0].x2);
  EXPECT_EQ(a.traces[0].mode, b.traces[0].mode);
}

TEST(RunResult, FittedParametersKeepTheirOrderAndNumbers) {
  const auto x = full_result().reference->parameters;
  const auto y = round_trip(full_result()).reference->parameters;
  ASSERT_EQ(x.size(), y.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    const FittedParameter &a = x[i], &b = y[i];
    EXPECT_EQ(a.key, b.key);
    EXPECT_EQ(a.unit, b.unit);
    EXPECT_SAME(start);
    EXPECT_SAME(value);
    EXPECT_SAME(std);
    EXPECT_SAME(ci95.low);
    EXPECT_SAME(ci95.high);
    EXPECT_SAME(low);
    EXPECT_SAME(high);
    EXPECT_EQ(a.estimated, b.estimated);
    EXPECT_EQ(a.identifiable, b.identifiable);
    EXPECT_EQ(a.at_bound, b.at_bound);
  }
}

TEST(RunResult, WhatWasNotAskedForStaysAbsent) {
  RunResult run = full_result();
  run.model_free.reset();
  run.reference.reset();
  run.comparison.reset();
  const RunResult back = round_trip(run);
  EXPECT_FALSE(back.model_free || back.reference || back.comparison);
  EXPECT_EQ(back.recordings.size(), 2u);
}

TEST(RunResult, ReadAndWrittenAgainGivesTheSameBytes) {
  ScratchFolder first, second;
  write_run_result(first.path.string(), full_result());
  write_run_result(second.path.string(), read_run_result(first.path.string()));
  for (const char* file : {"result.json", "traces/1_a.csv", "traces/2_b.csv"})
    EXPECT_EQ(text_of(first.path / file), text_of(second.path / file)) << file;
}

TEST(RunResult, AMissingNumberIsNullInTheFile) {
  RunResult run = full_result();
  run.model_free->verdict = GapVerdict::kInconclusive;
  run.model_free->gap = run.model_free->std = kNaN;
  run.model_free->ci95 = {};
  ScratchFolder scratch;
  write_run_result(scratch.path.string(), run);
  const std::string text = text_of(scratch.path / "result.json");
  EXPECT_NE(text.find("\"gap_rad\": null"), std::string::npos);
  EXPECT_NE(text.find("\"ci95_rad\": null"), std::string::npos);
  EXPECT_EQ(text.find("nan"), std::string::npos);
}

TEST(RunResult, AFolderWithoutAResultIsRefused) {
  ScratchFolder scratch;
  EXPECT_THROW(read_run_result(scratch.path.string()), ConfigError);
  write_run_result(scratch.path.string(), full_result());
  fs::remove(scratch.path / "traces" / "2_b.csv");
  EXPECT_THROW(read_run_result(scratch.path.string()), ConfigError);
}

TEST(RunResult, AContradictionIsTheCallersBug) {
  ScratchFolder scratch;
  RunResult run = full_result();
  run.model_free->verdict = GapVerdict::kNone;
  EXPECT_THROW(write_run_result(scratch.path.string(), run), std::logic_error) << "none with a gap";
  run = full_result();
  run.model_free->traces[0].file = "c.csv";
  EXPECT_THROW(write_run_result(scratch.path.string(), run), std::logic_error) << "a trace of no recording";
  run = full_result();
  run.recordings[0].x2.pop_back();
  EXPECT_THROW(write_run_result(scratch.path.string(), run), std::logic_error)
      << "columns of different length";
}

TEST(RunResult, AnUnwritablePlaceIsNamed) {
  ScratchFolder scratch;
  try {
    write_run_result((scratch.path / "missing").string(), full_result());
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("missing/traces"), std::string::npos) << error.what();
  }
}

TEST(Timing, ComesBackAndIsUnknownWhereNoFileIs) {
  ScratchFolder scratch;
  EXPECT_TRUE(std::isnan(read_timing(scratch.path.string()).model_free_s));
  write_timing(scratch.path.string(), {.model_free_s = 0.1 * kThird, .wall_s = 0.2 * kThird});
  const Timing back = read_timing(scratch.path.string());
  EXPECT_EQ(back.model_free_s, 0.1 * kThird);
  EXPECT_TRUE(std::isnan(back.reference_s));
  EXPECT_EQ(back.wall_s, 0.2 * kThird);
  std::ofstream(scratch.path / "timing.json")
      << "{\"model_free_s\": 1, \"reference_s\": 2}";  // of version 0.1.0
  EXPECT_TRUE(std::isnan(read_timing(scratch.path.string()).wall_s));
}

}  // namespace
}  // namespace gapscope

// A contact that holds under pull until it tears, on the independent plant.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "gapscope/sliding_mode/detector.h"
#include "independent_plant/random_drive.h"

namespace gapscope {
namespace {

/// The source paper's application example, its first two periods and a half: 0.1 Hz, 20 bit.
independent_plant::BlindCase slow_drive(double release_nm) {
  independent_plant::BlindCase c;
  c.drive.effects.contact.release_nm = release_nm;
  c.excitation.frequency = 0.1, c.excitation.amplitude = 0.5;
  c.sensor.quantum = 2.0 * std::acos(-1.0) / 1048576.0;
  c.options.duration = 25.0, c.options.tolerance = independent_plant::kFastTolerance;
  return c;
}

GapEstimate detect(const independent_plant::BlindCase& c) {
  const independent_plant::BlindRun run = independent_plant::simulate_blind(c);
  MotorTrace trace = run.recording.motor_trace();
  trace.quantum = c.sensor.quantum;
  return detect_gap({&trace, 1});
}

TEST(Adhesion, WithoutItTheGapIsRead) {
  const independent_plant::BlindCase c = slow_drive(0.0);
  const GapEstimate estimate = detect(c);
  ASSERT_EQ(estimate.verdict, GapVerdict::kBacklash) << estimate.brief_report();
  EXPECT_LE(estimate.ci95.low, c.drive.gap);
  EXPECT_GE(estimate.ci95.high, c.drive.gap);
}

TEST(Adhesion, WhatFreesTheMotorIsNoImpact) {
  for (const double release_nm : {0.012, 0.06}) {  // torn from rest, 0.3 mrad on; torn after 120 mrad of drag
    const GapEstimate estimate = detect(slow_drive(release_nm));
    EXPECT_EQ(estimate.verdict, GapVerdict::kInconclusive) << release_nm << ": " << estimate.brief_report();
    const auto torn = std::ranges::count_if(estimate.events, [](const GapEvent& e) {
      return !e.accepted && e.remark.find("tore") != std::string::npos;
    });
    EXPECT_GE(torn, 3) << release_nm;
  }
}

}  // namespace
}  // namespace gapscope

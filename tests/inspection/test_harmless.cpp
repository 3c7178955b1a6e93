// What is unusual in a recording and spoils nothing.
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
using test::ramped;
using test::rules_with;
using test::trapezoid;
using test::two_tones;
using testing::closed_loop;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::rig;
using testing::Rows;
using testing::TemporaryFile;

/// A pendulum that hangs askew: gravity takes most of u.
Rows pendulum() {
  constexpr double kInertia = 0.01, kDamping = 0.05, kGravity = 0.47, kPhase = 0.5, kQuantum = 6.28 / 16384;
  double x = -kPhase, w = 0.0;
  Rows rows;
  for (int i = 0; i < 10000; ++i) {
    const double t = 1e-3 * i, swept = std::sin(2.0 * kPi * (0.3 * t + 0.185 * t * t));
    const double u = 0.35 * std::min(1.0, t / 0.3) * (swept + 0.4 * std::sin(2.32 * t));
    rows.t.push_back(t), rows.u.push_back(u), rows.x1.push_back(kQuantum * std::round(x / kQuantum));
    for (int j = 0; j < 20; ++j) {
      w += 5e-5 * (u - kDamping * w - kGravity * std::sin(x + kPhase)) / kInertia;
      x += 5e-5 * w;
    }
  }
  return rows;
}

struct Harmless {
  const char* name;
  std::function<Rows()> make;
  const char* rule;
  Severity severity;
  const char* words;
};

void PrintTo(const Harmless& h, std::ostream* out) { *out << h.name; }

class HarmlessTest : public ::testing::TestWithParam<Harmless> {};

TEST_P(HarmlessTest, SpoilsNothing) {
  const Inspection i = inspected(GetParam().make());
  EXPECT_THAT(rules_with(i, Severity::kSpoils), IsEmpty()) << i.report();
  const Finding& f = finding(i, GetParam().rule);
  EXPECT_EQ(f.severity, GetParam().severity) << i.report();
  EXPECT_THAT(f.found, HasSubstr(GetParam().words));
  EXPECT_EQ(f.advice.empty(), f.severity == Severity::kFine);
}

const std::vector<Harmless> kHarmless = {
    {"a_pendulum", pendulum, "scale of u", Severity::kNote,
     "a torque that goes with the position hides them, as gravity on a pendulum; beside one as sin(x1 + "
     "phase), inertia 0.01, damping 0.047"},
    {"jitter_within_a_thousandth",
     [] {
       return changed([](Rows& r) {
         for (std::size_t i = 0; i < r.t.size(); ++i) r.t[i] += 4e-7 * noise_of(i);
       });
     },
     "time", Severity::kFine, "uniform"},
    {"positions_without_steps",
     [] {
       return changed([](Rows& r) {
         for (std::size_t i = 0; i < r.x1.size(); ++i) r.x1[i] += 1e-5 * noise_of(i);
       });
     },
     "encoder", Severity::kNote, "no smallest step is seen"},
    {"ramps_and_flat_tops", [] { return rig(ramped); }, "clipping", Severity::kFine, "as it was commanded"},
    {"cut_off", [] { return rig(trapezoid); }, "clipping", Severity::kNote,
     "u is cut off at 0.6 in 16 plateaus"},
    {"rounded_crests",
     [] {
       return changed([](Rows& r) {
         for (double& u : r.u) u = std::round(1e3 * u) / 1e3;
       });
     },
     "clipping", Severity::kFine, "does not stay"},
    {"positions_of_four_decimals",
     [] {
       return changed([](Rows& r) {
         for (double& x : r.x1) x = std::round(1e4 * x) / 1e4;
       });
     },
     "encoder", Severity::kNote, "so many decimals"},
    {"two_frequencies", [] { return rig(two_tones); }, "spectrum", Severity::kFine, "90 % of the power"},
    {"input_in_percent",
     [] {
       return changed([](Rows& r) {
         for (double& u : r.u) u = std::round(100.0 * u);
       });
     },
     "input", Severity::kNote, "whole numbers"},
    {"a_drive_that_was_switched_off",
     [] {
       return changed([](Rows& r) {
         for (std::size_t i = r.u.size() / 2; i < r.u.size(); ++i) r.u[i] = 0.0;
       });
     },
     "input", Severity::kNote, "while x1 goes on moving"},
    {"a_weight_on_the_input",
     [] {
       return changed([](Rows& r) {
         for (double& u : r.u) u += 1.0;
       });
     },
     "input", Severity::kNote, "never changes its sign"},
    {"coarse_encoder", [] { return rig(sine(0.5814, 1.0), {}, 12); }, "speed", Severity::kNote,
     "steps of the encoder per sample"},
    {"closed_loop", closed_loop, "feedback", Severity::kNote, "a closed loop"},
    {"measured_current",
     [] {
       return changed([](Rows& r) {
         for (std::size_t i = 0; i < r.u.size(); ++i) r.u[i] += 0.01 * noise_of(i);
       });
     },
     "feedback", Severity::kFine, "does not answer"},
    {"inertia_measured_late",
     [] {
       TestDrive heavy;
       heavy.m2 = 0.0, heavy.d1 = 1e-4;
       return changed(rig([](double t) { return 0.5 * std::cos(94.25 * t); }, heavy), [](Rows& r) {
         r.x1.insert(r.x1.begin(), 3, r.x1.front());
         r.x1.resize(r.u.size());
       });
     },
     "sign", Severity::kNote, "late"},
    {"a_motion_that_dwells",
     [] {
       return rig([](double t) {
         return std::abs(std::sin(3.14159 * t)) < 0.7 ? 0.0 : 0.6 * std::copysign(1.0, std::sin(3.14159 * t));
       });
     },
     "standstill", Severity::kFine, "x1 rests"},
};

INSTANTIATE_TEST_SUITE_P(Inspection, HarmlessTest, ::testing::ValuesIn(kHarmless),
                         [](const auto& tested) { return std::string(tested.param.name); });

/// Of a duty as it is limited, and a supply that sags under it.
std::string servo_log(const Rows& rows) {
  std::string text = "t,duty,x1,volts\n";
  for (std::size_t i = 0; i < rows.t.size(); ++i)
    text += fmt::format("{:.9g},{},{:.12g},{}\n", rows.t[i], rows.u[i], rows.x1[i],
                        12.0 - std::abs(rows.u[i]) - 0.01 * static_cast<double>(i % 7));
  return text;
}

TEST(Inspection, ADutyThatIsCutOffIsSeenThroughTheSupplyThatMultipliesIt) {
  ReadOptions options;
  options.columns.input = "duty", options.columns.voltage = "volts";
  const TemporaryFile cut(servo_log(rig(trapezoid))), whole(servo_log(good()));
  const Inspection i = inspect(cut.path(), options);
  EXPECT_EQ(finding(i, "clipping").severity, Severity::kNote);
  EXPECT_THAT(finding(i, "clipping").found, HasSubstr("the duty is cut off at 0.6 in 16 plateaus"));
  EXPECT_GT(i.facts.clipped_share, 0.3);
  EXPECT_EQ(finding(inspect(whole.path(), options), "clipping").severity, Severity::kFine);
}

}  // namespace
}  // namespace gapscope

// What the tables and the figure of a diagnosis say their numbers are of.
#include <gmock/gmock.h>

#include <cmath>

#include "report/added_table.h"
#include "report/diagnosis_figures.h"
#include "support/told.h"

namespace gapscope {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using testing::line_with;
using ::testing::Not;

/// A servo as the torque balance has it: the constant stands where the nominal fit left it.
DiagnosisResult servo() {
  DiagnosisResult r;
  r.name = "servo";
  Diagnosis& d = r.diagnosis;
  d.verdict = DiagnosisVerdict::kEffect;
  d.effects = d.group = {"load_dependent_friction"};
  d.added.resize(1);
  AddedEffect& a = d.added.front();
  a.effect = "load_dependent_friction", a.established = true, a.group = d.group;
  a.parameters = {{"level_nm", "N m", 0.0}, {"ratio", "-", 0.36, {0.1, 0.61}}};
  a.share_of = ShareOf::kTorque;
  d.balanced = true;
  d.mismatch.measure = "free run restarted every 0.5 s";
  d.mismatch.shrink = 0.46, d.mismatch.shrink_ci95 = {-2.57, 0.83};
  d.ranking.resize(1);
  d.ranking.front().effect = a.effect;
  d.ranking.front().parameters = {{"level_nm", "N m", 3.4e-3}, {"ratio", "-", 0.636}};
  BlameShift constant{"torque_constant", "N m per unit of u", 0.0956, 0.0956};
  constant.held = true;
  d.blame = {constant, {"motor_damping", "N m s/rad", 0.104, 0.0424}};
  return r;
}

TEST(DiagnosisBasis, TheNumbersOfTheRankingAreNotThoseOfWhatWasAddedAndBothSayWhy) {
  const std::string text = internal::report::diagnosis_text(servo());
  EXPECT_TOLD(line_with(text, "The numbers of the"));
  EXPECT_TOLD(line_with(text, "| `load_dependent_friction` (likely, by"));
  EXPECT_TOLD(line_with(text, "## Which effect, judged"));
  EXPECT_TOLD(line_with(text, "not of the missing"));
  DiagnosisResult r = servo();
  r.diagnosis.balanced = false, r.diagnosis.mismatch.shrink_ci95 = {0.59, 1.0};
  EXPECT_TOLD(line_with(internal::report::added_table(r), "refitted together to the"));
  EXPECT_THAT(internal::report::added_table(r), HasSubstr("| `load_dependent_friction` (established) |"));
}

TEST(DiagnosisBasis, ANumberThatWasHeldIsNotToldAsRefitted) {
  const std::string text = internal::report::diagnosis_text(servo());
  EXPECT_TOLD(line_with(text, "| `torque_constant` | 0.0956"));
  EXPECT_TOLD(line_with(text, "| `motor_damping` | 0.104"));
  EXPECT_THAT(text, HasSubstr("\nHeld: the torque balance"));
  DiagnosisResult r = servo();
  r.diagnosis.blame.erase(r.diagnosis.blame.begin());
  EXPECT_THAT(internal::report::diagnosis_text(r), Not(HasSubstr("Held:")));
}

TEST(DiagnosisBasis, TheRecordingIsDrawnOverTheModelWithTheFitOfEach) {
  DiagnosisResult r = servo();
  MismatchTrace t;
  t.file = "held.csv", t.dt = 1e-2;
  for (int i = 0; i < 1000; ++i) {
    const double x = std::sin(0.02 * i);
    t.u.push_back(0.0), t.x1.push_back(x), t.mode.push_back(Mode::kOneBody);
    t.simulated_before.push_back(10.0 * x), t.simulated_after.push_back(0.9 * x);
  }
  t.error_before = t.error_after = t.torque_before = t.torque_after = t.u;
  r.diagnosis.traces = {t};
  const internal::report::FigureData figure = internal::report::diagnosis_traces(r);
  const auto& lines = figure.panels.front().series;
  EXPECT_EQ(figure.panels.front().title, "Recorded, and simulated without a restart");
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(lines[0].label, "recorded");
  EXPECT_THAT(lines[1].label, HasSubstr("nominal model, fit −80"));
  EXPECT_THAT(lines[1].label, EndsWith(" % (leaves the frame)"));
  EXPECT_EQ(lines[2].label, "with load-dependent friction, fit 90 %");
  for (const double y : lines[1].y) EXPECT_FALSE(y > 2.0 || y < -2.0) << "it would flatten the recording";
  r.diagnosis.closed_loop = ClosedLoop{};
  EXPECT_THAT(internal::report::diagnosis_traces(r).panels.front().title,
              EndsWith("under the drive's controller"));
  r.diagnosis.traces.front().simulated_before.clear(), r.diagnosis.traces.front().simulated_after.clear();
  EXPECT_EQ(internal::report::diagnosis_traces(r).panels.front().title, "Held-out recording")
      << "an older result";
}

}  // namespace
}  // namespace gapscope

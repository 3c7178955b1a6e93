#include <gmock/gmock.h>

#include "report/diagnosis_figures.h"
#include "support/told.h"

namespace gapscope {
namespace {

using ::testing::HasSubstr;
using testing::line_with;

TEST(AddedEffectsReport, TellsTheNumbersOfWhatWasAddedWithTheirIntervals) {
  DiagnosisResult r;
  AddedEffect cogging;
  cogging.effect = "cogging_torque", cogging.established = true;
  cogging.parameters = {{"amplitude_nm", "N m", 0.004, {0.0038, 0.0042}},
                        {"periods_per_turn", "1/rev", 24.0}};
  r.diagnosis.added = {cogging};
  const std::string text = internal::report::diagnosis_text(r);
  EXPECT_TOLD(line_with(text, "| `cogging_torque` (established) |"));
  EXPECT_TOLD(line_with(text, "|  | periods"));
}

TEST(AddedEffectsReport, OfALinearAxisTellsThePeriod) {
  DiagnosisResult r;
  r.coordinates = Coordinates::kTranslation;
  AddedEffect cogging;
  cogging.effect = "cogging_torque";
  cogging.parameters = {
      {"periods_per_turn", "1/rev", 2.0 * kPi / 2.5e-3, {2.0 * kPi / 2.6e-3, 2.0 * kPi / 2.4e-3}}};
  r.diagnosis.added = {cogging};
  EXPECT_TOLD(line_with(internal::report::diagnosis_text(r), "| `cogging_torque` (cause open)"));
}

}  // namespace
}  // namespace gapscope

#include <gmock/gmock.h>

#include "report/diagnosis_figures.h"

namespace gapscope {
namespace {

using ::testing::HasSubstr;

TEST(AddedEffectsReport, TellsTheNumbersOfWhatWasAddedWithTheirIntervals) {
  DiagnosisResult r;
  AddedEffect cogging;
  cogging.effect = "cogging_torque", cogging.established = true;
  cogging.parameters = {{"amplitude_nm", "N m", 0.004, {0.0038, 0.0042}},
                        {"periods_per_turn", "1/rev", 24.0}};
  r.diagnosis.added = {cogging};
  const std::string text = internal::report::diagnosis_text(r);
  EXPECT_THAT(text,
              HasSubstr("| `cogging_torque` (established) | amplitude | 4.00 mN·m (95 %: 3.80 to 4.20) |"));
  EXPECT_THAT(text, HasSubstr("|  | periods per turn | 24.0 1/rev |"));
}

TEST(AddedEffectsReport, OfALinearAxisTellsThePeriod) {
  DiagnosisResult r;
  r.coordinates = Coordinates::kTranslation;
  AddedEffect cogging;
  cogging.effect = "cogging_torque";
  cogging.parameters = {
      {"periods_per_turn", "1/rev", 2.0 * kPi / 2.5e-3, {2.0 * kPi / 2.6e-3, 2.0 * kPi / 2.4e-3}}};
  r.diagnosis.added = {cogging};
  EXPECT_THAT(internal::report::diagnosis_text(r),
              HasSubstr("| `cogging_torque` (cause open) | period | 2.50 mm (95 %: 2.40 to 2.60) |"));
}

}  // namespace
}  // namespace gapscope

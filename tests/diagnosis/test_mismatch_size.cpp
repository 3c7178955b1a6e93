// What the error of a model is measured against.
#include <gtest/gtest.h>

#include "diagnosis/mismatch_size.h"
#include "independent_plant/simulate.h"

namespace gapscope::internal::diagnosis {
namespace {

ScoredModel of_one_window(double square) {
  ScoredModel model;
  model.windows.innovation = model.windows.free = {square};
  return model;
}

TEST(MismatchSize, IsNotMeasuredByARepetitionThatAModelGoesBelow) {
  const Recording recording = simulate_blind({}, {}, independent_plant::BlindSensor::with_bits(18),
                                             {1000.0, 4.0, 1, independent_plant::kFastTolerance})
                                  .recording;
  const MotorTrace traces[] = {recording.motor_trace()};
  ReferenceModel sheet;
  const DiagnosisOptions options;
  Study study = make_study(traces, traces, sheet, options);
  const double encoder = study.held_out.floors.front();
  study.held_out.innovation_repeats = 20.0 * encoder;
  const ScoredModel before = of_one_window(100.0);
  const MismatchSize above = mismatch_size(study, before, of_one_window(0.9 * 0.9));
  EXPECT_EQ(above.floor_from, FloorSource::kRepeatability) << "a tenth below is chance";
  EXPECT_DOUBLE_EQ(above.floor, 20.0 * encoder);
  EXPECT_DOUBLE_EQ(above.remains, 0.9);
  const MismatchSize below = mismatch_size(study, before, of_one_window(0.3 * 0.3));
  EXPECT_NE(below.floor_from, FloorSource::kRepeatability);
  EXPECT_DOUBLE_EQ(below.floor, encoder);
  EXPECT_DOUBLE_EQ(below.remains, 6.0);
  EXPECT_DOUBLE_EQ(below.before, above.before) << "the error is the same";
}

}  // namespace
}  // namespace gapscope::internal::diagnosis

// Inputs and positions that look like what they are called, and are something else.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "inspection/inspected.h"

namespace gapscope {
namespace {

using test::changed;
using test::finding;
using test::inspected;
using testing::closed_loop;
using ::testing::HasSubstr;
using testing::rig;
using testing::Rows;

/// Some drives with nothing wrong: open and closed loop, with a gap and without, fine and coarse.
std::vector<Rows> faultless() {
  TestDrive stiff, rubbing;
  stiff.gap = 0.0, rubbing.m2 = 0.0, rubbing.Fc1 = 0.02;
  return {rig(),
          rig(test::two_tones),
          rig(test::two_tones, stiff, 14),
          rig(test::two_tones, rubbing, 16),
          rig(test::trapezoid, stiff),
          closed_loop()};
}

/// What a row holds acted before it.
void late(Rows& r) {
  r.u.insert(r.u.begin(), r.u.front());
  r.u.pop_back();
}

TEST(SeemingInput, NothingIsSaidOfWhatIsAsItIsCalled) {
  for (const Rows& rows : faultless()) {
    const Inspection i = inspected(rows);
    EXPECT_NE(finding(i, "input").severity, Severity::kSpoils) << i.report();
    EXPECT_NE(finding(i, "scale of u").severity, Severity::kSpoils) << i.report();
    EXPECT_NE(finding(i, "unit of x1").severity, Severity::kSpoils) << i.report();
  }
}

TEST(SeemingInput, AMagnitudeIsOne) {
  for (const Rows& rows : faultless()) {
    const Inspection i = inspected(changed(rows, [](Rows& r) {
      for (double& u : r.u) u = std::abs(u);
    }));
    EXPECT_EQ(finding(i, "input").severity, Severity::kSpoils) << i.report();
    EXPECT_THAT(finding(i, "input").found, HasSubstr("a magnitude"));
  }
}

/// Where its sign turns in a step, nothing touches 0.
TEST(SeemingInput, AMagnitudeOfStepsIsOne) {
  TestDrive drive;
  drive.m2 = 0.0, drive.Fc1 = 0.02;
  const auto steps = [](double t) { return std::sin(9.0 * t) > 0.0 ? 0.5 : -0.5; };
  const auto waves = [](double t) {
    return (std::sin(9.0 * t) > 0.0 ? 0.5 : -0.5) + 0.1 * std::sin(31.0 * t);
  };
  for (const Rows& rows : {rig(steps, drive, 14), rig(waves, drive, 14)}) {
    const Inspection i = inspected(changed(rows, [](Rows& r) {
      for (double& u : r.u) u = std::abs(u);
    }));
    if (finding(i, "input").found.find("all the time") != std::string::npos) continue;  // one level is none
    EXPECT_THAT(finding(i, "input").found, HasSubstr("a magnitude")) << i.report();
  }
}

TEST(SeemingInput, APositiveOneWithItsSignIsNone) {
  const Inspection i = inspected(rig([](double t) { return 0.3 * (1.0 - std::cos(6.0 * t)); }));
  EXPECT_NE(finding(i, "input").severity, Severity::kSpoils) << i.report();
}

TEST(SeemingInput, ARowThatHasWhatActedBeforeIsTold) {
  TestDrive one_body;
  one_body.m2 = 0.0;
  const auto lively = [](double t) { return 0.5 * std::sin(6.0 * t) + 0.5 * std::sin(150.0 * t); };
  for (const Rows& rows : {rig(lively, one_body), closed_loop()}) {
    const Rows moved = changed(rows, late);
    const Inspection i = inspected(moved);
    EXPECT_EQ(finding(i, "scale of u").severity, Severity::kSpoils) << i.report();
    EXPECT_THAT(finding(i, "scale of u").advice, HasSubstr("--input-rows -1"));
    ReadOptions options;
    options.input_rows = -1;
    EXPECT_NE(finding(inspected(moved, options), "scale of u").severity, Severity::kSpoils);
  }
}

/// What acts later than it stands may be the drive's own delay: told, and nothing is spoilt.
TEST(SeemingInput, ARowThatHasWhatActsLaterIsNoted) {
  TestDrive one_body;
  one_body.m2 = 0.0;
  const auto lively = [](double t) { return 0.5 * std::sin(6.0 * t) + 0.5 * std::sin(150.0 * t); };
  const Inspection i = inspected(changed(rig(lively, one_body), [](Rows& r) {
    r.u.erase(r.u.begin());
    r.u.push_back(r.u.back());
  }));
  EXPECT_EQ(finding(i, "scale of u").severity, Severity::kNote) << i.report();
  EXPECT_THAT(finding(i, "scale of u").advice, HasSubstr("--input-rows 1"));
}

/// A damped drive follows u as a speed does; what counts as an encoder is an angle.
TEST(SeemingInput, CountsOfAnEncoderAreNoSpeed) {
  TestDrive damped;
  damped.m2 = 0.0, damped.d1 = 1.5;
  const auto input = [](double t) { return 0.5 * std::sin(6.0 * t) + 0.3 * std::sin(21.3 * t); };
  EXPECT_NE(finding(inspected(rig(input, damped, 16)), "unit of x1").severity, Severity::kSpoils);
}

TEST(SeemingInput, ASpeedInPlaceOfAPositionIsTold) {
  TestDrive drive;
  drive.m2 = 0.0, drive.Fc1 = 0.03;
  const auto input = [](double t) { return 0.5 * std::sin(6.0 * t) + 0.3 * std::sin(21.3 * t); };
  const Inspection i = inspected(changed(rig(input, drive, 20), [](Rows& r) {
    for (std::size_t j = r.x1.size() - 1; j > 0; --j) r.x1[j] = 1e3 * (r.x1[j] - r.x1[j - 1]);
    r.x1[0] = r.x1[1];
  }));
  EXPECT_EQ(finding(i, "unit of x1").severity, Severity::kSpoils) << i.report();
  EXPECT_THAT(finding(i, "unit of x1").advice, HasSubstr("--speed"));
}

/// The second difference of a sine is the sine itself, as is the torque of a damping below 0.
TEST(SeemingInput, APositionUnderASineIsNoSpeed) {
  TestDrive drive;
  drive.m2 = 4.0 * drive.m1, drive.Fc1 = 0.005, drive.Fc2 = 0.02, drive.d1 = 0.005, drive.d2 = 0.003,
  drive.gap = 0.003;
  const Rows rows = changed(rig(sine(0.3, 1.33), drive, 0), [](Rows& r) { r.erase(0, 2000); });
  const Inspection i = inspected(rows);
  EXPECT_EQ(finding(i, "unit of x1").severity, Severity::kFine) << i.report();
}

TEST(SeemingInput, AConstantLoadIsNoted) {
  const Inspection i = inspected(changed([](Rows& r) {
    for (double& u : r.u) u += 1.0;
  }));
  EXPECT_EQ(finding(i, "input").severity, Severity::kNote) << i.report();
  EXPECT_THAT(finding(i, "input").advice, HasSubstr("constant_load_torque"));
}

TEST(SeemingInput, ARegisterWhoseBitIsTheSignIsSeen) {
  const Inspection i = inspected(changed([](Rows& r) {
    for (double& u : r.u) u = u < 0.0 ? 1024.0 + std::round(-300.0 * u) : std::round(300.0 * u);
  }));
  EXPECT_EQ(finding(i, "input").severity, Severity::kSpoils) << i.report();
  EXPECT_THAT(finding(i, "input").advice, HasSubstr("--input-register sign10"));
}

}  // namespace
}  // namespace gapscope

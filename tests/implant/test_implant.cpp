#include <set>

#include "implant/implant.h"
#include "implanted_drive.h"

namespace {

using namespace gapscope;
using namespace gapscope::internal::implant;
using namespace gapscope::internal::implant::test;
using testing::HasSubstr;
using testing::IsEmpty;

/// Two recordings of one drive under different inputs.
class Implants : public testing::Test {
 protected:
  Implants() {
    for (const std::uint64_t seed : {3u, 4u})
      recordings.push_back(driven(one_body(), commanded(seed)).recording);
    for (double& u : recordings[1].u) u *= 0.7;  // another rms: a size of each would be another value
    for (const Recording& r : recordings) subjects.push_back({&r, SmoothedMotion(r.motor_trace())});
  }
  const Receiver drive = receiver_of(one_body());
  std::vector<Recording> recordings;
  std::vector<Subject> subjects;

  Recording with(const char* law, double first, std::size_t recording = 0) const {
    Implant implant{find_implant_law(law), {first, 0.3}, 9};
    return implanted(subjects[recording], recording, implant, drive);
  }
};

TEST_F(Implants, HaveTheSizeThatIsAskedForOverAllRecordingsTogether) {
  for (const ImplantLaw* law : implant_laws())
    for (const double size : {0.02, 0.1}) {
      const auto drawn = drawn_implant(*law, subjects, drive, size, 11);
      ASSERT_TRUE(drawn) << law->name << " " << size;
      if (law->by_size != nullptr) continue;
      EXPECT_NEAR(implant_size(subjects, *drawn, drive), size, 0.011 * size) << law->name;
    }
}

TEST_F(Implants, AreTheSameForTheSameSeedAndOthersForAnother) {
  for (const ImplantLaw* law : implant_laws()) {
    const auto first = drawn_implant(*law, subjects, drive, 0.1, 11),
               again = drawn_implant(*law, subjects, drive, 0.1, 11);
    ASSERT_TRUE(first && again);
    const Recording a = implanted(subjects[1], 1, *first, drive),
                    b = implanted(subjects[1], 1, *again, drive);
    EXPECT_EQ(a.u, b.u) << law->name;
    EXPECT_EQ(a.x1, b.x1) << law->name;
    EXPECT_TRUE(a.u != recordings[1].u || a.x1 != recordings[1].x1) << law->name;
  }
  EXPECT_NE(drawn_implant(*find_implant_law("cogging_torque"), subjects, drive, 0.1, 11)->values,
            drawn_implant(*find_implant_law("cogging_torque"), subjects, drive, 0.1, 12)->values);
}

TEST_F(Implants, OfASizeThatNoValueComesToAreRefused) {
  EXPECT_FALSE(drawn_implant(*find_implant_law("torque_ripple"), subjects, drive, 20.0, 1));
  EXPECT_FALSE(drawn_implant(*find_implant_law("input_delay"), subjects, drive, 50.0, 1));
}

TEST_F(Implants, OfTheEncoderAreItsLaw) {
  const plant::BlindRun run = driven(one_body(), commanded(3));
  const Recording off = with("encoder_eccentricity", 0.01);
  double worst = 0.0;
  for (std::size_t i = 0; i < off.size(); ++i) {
    const double x = run.truth.x1[i];
    worst = std::max(worst, std::abs(off.x1[i] - (x + 0.01 * std::sin(x + 0.3))));
  }
  EXPECT_LT(worst, 1.6 * kCount);  // its own rounding and that of the recording
  EXPECT_EQ(off.u, recordings[0].u);

  const Recording late = with("measurement_lag", 0.004);
  const SmoothedMotion motion(recordings[0].motor_trace());
  worst = 0.0;  // far from its start a lag T is a delay of T but for terms of T²
  for (std::size_t i = 500; i < late.size(); ++i)
    worst = std::max(worst, std::abs(late.x1[i] - (motion.at(i).x - 0.004 * motion.at(i).w +
                                                   0.004 * 0.004 * motion.at(i).a)));
  EXPECT_LT(worst, 100.0 * kCount);

  const double coarse = 16.0 * kCount;
  for (const double x : with("encoder_quantization", coarse).x1)
    EXPECT_LT(std::abs(x / coarse - std::round(x / coarse)), 1e-6);
}

TEST_F(Implants, ThatLoseCountsJumpByWholeOnesAndStay) {
  const Recording lost = with("lost_counts", 40.0 * kCount);
  std::set<long> jumps;
  double before = 0.0;
  for (std::size_t i = 0; i < lost.size(); ++i) {
    const double off = lost.x1[i] - recordings[0].x1[i];
    if (std::abs(off - before) > 0.5 * kCount) jumps.insert(std::lround((off - before) / kCount));
    before = off;
  }
  EXPECT_THAT(jumps, testing::Not(IsEmpty()));
  for (const long jump : jumps) EXPECT_EQ(std::abs(jump), 40);
}

TEST_F(Implants, ThatTheRecordingCannotShowAreRefusedByName) {
  for (const char* contact : {"shaft_compliance", "impact_damping", "backlash", "gap_eccentricity",
                              "gap_growth", "contact_adhesion"})
    EXPECT_THAT(why_not(contact, drive, kCount), HasSubstr("no encoder has recorded")) << contact;
  Receiver slide = drive, geared = drive;
  slide.rotates = false, geared.one_body = false;
  EXPECT_THAT(why_not("encoder_eccentricity", slide, kCount), HasSubstr("turn"));
  EXPECT_THAT(why_not("load_unbalance", geared, kCount), HasSubstr("load"));
  EXPECT_THAT(why_not("constant_load_torque", geared, kCount), HasSubstr("load"));
  EXPECT_THAT(why_not("encoder_quantization", drive, 0.0), HasSubstr("quantum"));
  for (const ImplantLaw* law : implant_laws()) EXPECT_THAT(why_not(law->name, drive, kCount), IsEmpty());
}

/// The same physical drive, read at stamps that are its own.
TEST_F(Implants, KeepTheStampsOfARecording) {
  Recording uneven = recordings[0];
  auto g = random_stream(2, "stamps");
  for (std::size_t i = 0; i < uneven.size(); ++i)
    uneven.stamps.push_back(uneven.dt * (static_cast<double>(i) + 0.3 * uniform(g, -1.0, 1.0)));
  const std::vector<Subject> one = {{&uneven, SmoothedMotion(uneven.motor_trace())}};
  const auto drawn = drawn_implant(*find_implant_law("input_delay"), one, drive, 0.1, 4);
  ASSERT_TRUE(drawn);
  const Recording r = implanted(one[0], 0, *drawn, drive);
  EXPECT_EQ(r.stamps, uneven.stamps);
  // u' is u as it was the delay later.
  const double later = drawn->values[0];
  double worst = 0.0, scale = 0.0;
  for (std::size_t i = 0; i + 200 < r.size(); ++i) {
    const double t = uneven.stamps[i] + 0.5 * (uneven.stamps[i + 1] - uneven.stamps[i]) + later;
    const auto at =
        std::upper_bound(uneven.stamps.begin(), uneven.stamps.end(), t) - uneven.stamps.begin() - 1;
    worst = std::max(worst, std::abs(r.u[i] - uneven.u[static_cast<std::size_t>(at)]));
    scale = std::max(scale, std::abs(r.u[i]));
  }
  EXPECT_LT(worst, 0.05 * scale);
}

}  // namespace

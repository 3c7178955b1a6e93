// The numbers of an answer, once its structure is decided.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "blind/blind_pair.h"
#include "diagnosis/long_runs.h"
#include "independent_plant/random_drive.h"

namespace gapscope::internal::diagnosis {
namespace {

/// The data sheet of a drive, as `gapscope blind drives` writes it, the gap and all that the fit can see
/// free.
ReferenceModel sheet_of(const independent_plant::BlindCase& c, std::uint64_t seed) {
  const independent_plant::BlindDrive sheet = data_sheet(c.drive, seed);
  const double ratio = sheet.load_inertia / sheet.motor_inertia;
  const double most_friction = c.drive.torque_constant * c.excitation.amplitude;
  ReferenceModel model;
  model.set("motor_inertia", ParameterSetting::known(sheet.motor_inertia));
  model.set("torque_constant", ParameterSetting::known(sheet.torque_constant));
  const auto seek = [&](const char* key, double value, double low, double high) {
    model.set(key, {value, true, low, high, {}});
  };
  seek("motor_damping", sheet.motor_damping, 0.0, 10.0 * sheet.motor_damping);
  seek("mass_ratio", ratio, 0.02 * ratio, 50.0 * ratio);
  seek("gap", sheet.gap, 0.0, 0.3);
  seek("load_damping", sheet.load_damping, 0.0, 10.0 * sheet.load_damping);
  seek("load_coulomb_friction", std::min(sheet.load_coulomb, most_friction), 0.0, most_friction);
  seek("contact_stiffness", sheet.contact_stiffness, 0.05 * sheet.contact_stiffness,
       20.0 * sheet.contact_stiffness);
  seek("contact_damping", sheet.contact_damping, 0.0, 20.0 * sheet.contact_damping);
  return model;
}

/// A drive of the independent plant that lacks nothing, the last third of its recording held out.
struct RandomDrive {
  explicit RandomDrive(std::uint64_t seed) : drive(independent_plant::random_drive(seed)) {
    recording = simulate_blind(drive).recording;
    options.fit.work = std::make_shared<std::atomic<std::int64_t>>(0);
    sheet = sheet_of(drive, seed);
  }
  RandomDrive(const RandomDrive&) = delete;

  Study study() const {
    const MotorTrace trace = recording.motor_trace();
    return make_study({&trace, 1}, {}, sheet, options);
  }

  independent_plant::BlindCase drive;
  Recording recording;
  ReferenceModel sheet;
  DiagnosisOptions options;
};

ScoredModel nominal(const Study& study) {
  return judge(nullptr, fit_nominal(study.train, study.sheet, study.options.fit, study.observer_hz),
               study.held_out, study.observer_hz);
}

double gap_of(const ScoredModel& m) { return m.fitted.model.parameters[place::kGap].value; }

/// Standard deviation of the gap; NaN: it is not determined.
double gap_error(const ScoredModel& m) {
  for (const auto& [id, error] : m.fitted.errors.value().numbers)
    if (id == reference::drive_number(place::kGap)) return error;
  return kNaN;
}

/// Where the search may stop: beside the minimum, and in another one.
class SettledGap : public ::testing::TestWithParam<std::uint64_t> {};

TEST_P(SettledGap, IsTheDrivesWithinItsInterval) {
  const RandomDrive r(GetParam());
  const Study study = r.study();
  const ScoredModel found = nominal(study);
  ASSERT_TRUE(at_floor(found));
  const ScoredModel told = settled(study, found);
  ASSERT_TRUE(told.fitted.errors);
  EXPECT_TRUE(at_floor(told));
  EXPECT_LT(std::abs(gap_of(told) - r.drive.drive.gap), 1.96 * gap_error(told));
  EXPECT_LT(std::abs(gap_of(told) - r.drive.drive.gap), std::abs(gap_of(found) - r.drive.drive.gap));
}

INSTANTIATE_TEST_SUITE_P(Drives, SettledGap, ::testing::Values(5111u, 5139u));

TEST(Settled, NumbersAreThoseOfWhatIsFittedAlone) {
  const RandomDrive r(5139);
  Study study = r.study();
  const ScoredModel found = nominal(study);
  const double gap = gap_of(settled(study, found));
  std::vector<double> other = r.recording.x1;
  for (std::size_t i = study.held_out.scored_from[0]; i < other.size(); ++i) other[i] *= 1.1;
  study.held_out.traces[0].x1 = other;
  const ScoredModel told = settled(study, found);
  EXPECT_DOUBLE_EQ(gap_of(told), gap);
  EXPECT_FALSE(at_floor(told)) << "and what is held out judges it anew";
}

TEST(Settled, NumbersStayWhereTheModelIsNotTheDrive) {
  const blind::BlindPair pair = blind::blind_pair("geared", "motor_coulomb_friction", 1.0, 1);
  const MotorTrace train[] = {pair.train.motor_trace()}, held_out[] = {pair.held_out.motor_trace()};
  const DiagnosisOptions options;
  const Study study = make_study(train, held_out, pair.sheet, options);
  const ScoredModel found = nominal(study);
  ASSERT_FALSE(at_floor(found));
  const ScoredModel told = settled(study, found);
  EXPECT_DOUBLE_EQ(gap_of(told), gap_of(found));
  EXPECT_FALSE(told.fitted.errors);
}

}  // namespace
}  // namespace gapscope::internal::diagnosis

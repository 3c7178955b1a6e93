// The numbers of a drawn effect are those with which the catalogue's law moves as the independent plant does.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "blind/drawn_law.h"
#include "gapscope/plant/effect_hooks.h"
#include "gapscope/simulation/simulate.h"
#include "gapscope/simulation/stepper.h"
#include "independent_plant/severity.h"

namespace gapscope {
namespace {

using blind::LawForm;

constexpr double kCount20Bit = 2.0 * kPi / (1 << 20);
constexpr double kDuration = 4.0;

/// The source paper's rig, as the independent plant has it by default.
independent_plant::BlindCase paper_case(std::uint64_t seed) {
  independent_plant::BlindCase c;
  c.sensor.quantum = kCount20Bit;
  c.options.duration = kDuration;
  c.options.rate = 1250.0;
  c.options.seed = seed;
  c.excitation.amplitude = 4.0 * c.drive.load_coulomb / c.drive.torque_constant;
  c.excitation.frequency = 0.9;
  return c;
}

PlantModel<double> model_of(const independent_plant::BlindDrive& d) {
  return plant_model(DriveParameters<double>{d.motor_inertia, d.torque_constant, d.motor_damping,
                                             d.load_inertia / d.motor_inertia, d.gap, d.load_damping,
                                             d.load_coulomb, d.contact_stiffness, d.contact_damping},
                     {});
}

/// Largest difference of the motor angles as they are before the encoder's counts [rad].
double difference(const independent_plant::BlindCase& c, const PlantModel<double>& model) {
  const independent_plant::BlindRun run =
      independent_plant::simulate_blind(c.drive, c.excitation, {}, c.options);
  DriveStepper<double> stepper(model, 1.0 / c.options.rate);
  stepper.reset({});
  double largest = 0.0;
  for (std::size_t i = 0; i < run.recording.u.size(); ++i) {
    largest = std::max(largest, std::abs(stepper.measured() - run.recording.x1[i]));
    stepper.step(run.recording.u[i]);
  }
  return largest;
}

/// Of that law: by its specification, what is not drawn at its neutral value.
std::vector<double> numbers_of(const blind::DrawnLaw& law) {
  std::vector<double> numbers(find_effect(law.effect)->parameters.size(), 0.0);
  for (std::size_t i = 0; i < law.numbers.size(); ++i) numbers[i] = law.numbers[i].value;
  return numbers;
}

TEST(DrawnLaw, MovesAsTheDriveDoesWhereItsFormIsTheSame) {
  for (const independent_plant::DrawnEffect& e : independent_plant::effect_entries()) {
    if (blind::form_of(e.name) != LawForm::kSame || e.name == "encoder_quantization") continue;
    independent_plant::BlindCase c = paper_case(11);
    independent_plant::give_effect(c, e.name, 0.5, 11);
    const blind::DrawnLaw law = blind::drawn_law(c.drive.effects, e.name);
    PlantModel<double> model = model_of(c.drive);
    add_effect<double>(model, *find_effect(law.effect), numbers_of(law));
    EXPECT_LT(difference(c, model), 0.2 * kCount20Bit) << e.name;
    EXPECT_GT(difference(c, model_of(c.drive)), 2.0 * kCount20Bit) << e.name << " is without a trace";
  }
}

TEST(DrawnLaw, OfASeriesHasItsFirstHarmonics) {
  constexpr double kSkew = 0.2, kAmplitude = 0.03;
  independent_plant::Effects effects;
  effects.motor.cogging = {kAmplitude, 12.0, 0.4, kSkew};
  const blind::DrawnLaw law = blind::drawn_law(effects, "cogging_torque");
  EXPECT_EQ(law.form, LawForm::kSeries);
  ASSERT_EQ(law.numbers.size(), 4U);
  constexpr int kPoints = 64;  // exact for fewer than 64 harmonics
  double first = 0.0, second = 0.0;
  for (int i = 0; i < kPoints; ++i) {
    const double y = 2.0 * kPi * i / kPoints, wave = std::sin(y + kSkew * std::sin(y));
    first += 2.0 * wave * std::sin(y) / kPoints, second += 2.0 * wave * std::sin(2.0 * y) / kPoints;
  }
  EXPECT_NEAR(law.numbers[0].value, kAmplitude * first, 1e-12);
  EXPECT_EQ(law.numbers[1].value, 12.0);
  EXPECT_EQ(law.numbers[2].value, 0.4);
  EXPECT_NEAR(law.numbers[3].value, second / first, 1e-12);
}

TEST(DrawnLaw, OfAnotherFormHasNoNumbersAndEveryOtherTheCataloguesKeysAndUnits) {
  for (const independent_plant::DrawnEffect& e : independent_plant::effect_entries()) {
    if (e.name == "backlash") continue;
    independent_plant::BlindCase c = paper_case(12);
    independent_plant::give_effect(c, e.name, 0.5, 12);
    const blind::DrawnLaw law = blind::drawn_law(c.drive.effects, e.name);
    EXPECT_EQ(law.form == LawForm::kAnother, law.numbers.empty()) << e.name;
    if (law.form == LawForm::kAnother) continue;
    ASSERT_TRUE(e.in_catalogue) << e.name;
    const EffectEntry* entry = find_effect(law.effect);
    ASSERT_NE(entry, nullptr) << e.name;
    ASSERT_LE(law.numbers.size(), entry->parameters.size()) << e.name;
    for (std::size_t i = 0; i < law.numbers.size(); ++i) {
      EXPECT_EQ(law.numbers[i].key, entry->parameters[i].key);
      EXPECT_EQ(law.numbers[i].unit, entry->parameters[i].unit);
      EXPECT_TRUE(std::isfinite(law.numbers[i].value)) << e.name;
    }
  }
}

}  // namespace
}  // namespace gapscope

// The simulator against a plant code that it shares nothing with: 10 s of free run, bare and with each effect
// that both state by the same law.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>

#include "gapscope/plant/effect_hooks.h"
#include "gapscope/simulation/stepper.h"
#include "independent_plant/simulate.h"
#include "simulation/drives.h"

namespace gapscope {
namespace {

constexpr double kCount20Bit = 2.0 * kPi / (1 << 20);

struct Rig {
  const char* name;
  DriveParameters<double> drive;
  double amplitude;  ///< [unit of u]
  double rate;       ///< [Hz]
};

const Rig kRigs[] = {{"paper", test::paper_rig(), 0.6, 2000.0},
                     {"geared", test::geared_axis(), 1.0, 1000.0},
                     {"heavy", test::heavy_load(), 0.6, 4000.0}};

independent_plant::BlindDrive independent(const DriveParameters<double>& p) {
  independent_plant::BlindDrive d;
  d.motor_inertia = p.motor_inertia;
  d.torque_constant = p.torque_constant;
  d.motor_damping = p.motor_damping;
  d.load_inertia = p.motor_inertia * p.mass_ratio;
  d.load_damping = p.load_damping;
  d.load_coulomb = p.load_coulomb_friction;
  d.gap = p.gap;
  d.contact_stiffness = p.contact_stiffness;
  d.contact_damping = p.contact_damping;
  return d;
}

/// Two lines that start at zero together: impacts of several strengths.
std::vector<double> input(const Rig& rig) {
  std::vector<double> u = test::sine(0.7 * rig.amplitude, 0.8, rig.rate, 10.0);
  const std::vector<double> second = test::sine(0.3 * rig.amplitude, 2.1, rig.rate, 10.0);
  for (std::size_t i = 0; i < u.size(); ++i) u[i] += second[i];
  return u;
}

double largest_difference(const Rig& rig, const PlantModel<double>& model, long fewest_events,
                          const independent_plant::BlindDrive& truth) {
  const std::vector<double> u = input(rig);
  independent_plant::BlindOptions options;
  options.rate = rig.rate;
  options.duration = 10.0;
  const independent_plant::BlindRun run = independent_plant::simulate_blind_command(truth, u, {}, options);
  DriveStepper<double> stepper(model, 1.0 / rig.rate);
  stepper.reset({});
  double largest = 0.0;
  for (std::size_t i = 0; i < u.size(); ++i) {
    largest = std::max(largest, std::abs(stepper.measured() - run.recording.x1[i]));
    stepper.step(u[i]);
  }
  EXPECT_GT(stepper.events(), fewest_events);
  return largest;
}

/// An effect that both codes state by the same law, with numbers for a rig of unit torque, as parameters of
/// the catalogue and as a change of the independent drive.
struct EqualForm {
  const char* name;
  std::function<std::vector<double>(const Rig&)> parameters;
  std::function<void(const std::vector<double>&, independent_plant::Effects&)> apply;
};

/// Sines and cosines of the harmonics as amplitudes and phases.
independent_plant::AngleHarmonic with_harmonics(const std::vector<double>& p) {
  return {p[0],
          p[1],
          p[2],
          0.0,
          std::hypot(p[3], p[4]),
          std::atan2(p[4], p[3]),
          std::hypot(p[5], p[6]),
          std::atan2(p[6], p[5])};
}

double torque(const Rig& rig) { return rig.amplitude * rig.drive.torque_constant; }

const std::vector<EqualForm>& equal_forms() {
  using V = std::vector<double>;
  static const std::vector<EqualForm> forms = {
      {"motor_coulomb_friction", [](const Rig& r) { return V{0.1 * torque(r)}; },
       [](const V& p, independent_plant::Effects& e) { e.motor.friction.level_nm = p[0]; }},
      {"friction_asymmetry",
       [](const Rig& r) {
         return V{0.1 * torque(r), 0.3, 0.2};
       },
       [](const V& p, independent_plant::Effects& e) {
         e.motor.friction.level_nm = p[0];
         e.motor.friction.coulomb_ratio = p[1];
         e.motor.friction.viscous_ratio = p[2];
       }},
      {"stribeck_friction",
       [](const Rig& r) {
         return V{0.08 * torque(r), 0.5, 0.3, 1.4};
       },
       [](const V& p, independent_plant::Effects& e) {
         e.motor.friction.level_nm = p[0];
         e.motor.friction.stiction_ratio = p[1];
         e.motor.friction.stribeck_speed_rad_s = p[2];
         e.motor.friction.stribeck_exponent = p[3];
       }},
      {"load_dependent_friction",
       [](const Rig& r) {
         return V{0.05 * torque(r), 0.2};
       },
       [](const V& p, independent_plant::Effects& e) {
         e.motor.friction.level_nm = p[0], e.motor.friction.gear_ratio = p[1];
       }},
      {"presliding_friction",
       [](const Rig& r) {
         return V{0.1 * torque(r), 2e-3, 1e-4};
       },
       [](const V& p, independent_plant::Effects& e) {
         e.motor.bristle = {p[0], p[1], p[2]};
       }},
      {"quadratic_drag",
       [](const Rig& r) {
         return V{0.05 * torque(r), 2.1};
       },
       [](const V& p, independent_plant::Effects& e) {
         e.motor.drag_nms2 = p[0], e.motor.drag_exponent = p[1];
       }},
      {"cogging_torque", [](const Rig& r) { return V{0.1 * torque(r), 24.0, 0.3, 0.0, 0.0, 0.0, 0.0}; },
       [](const V& p, independent_plant::Effects& e) {
         e.motor.cogging = {p[0], p[1], p[2], 0.0};
       }},
      {"cogging_torque", [](const Rig& r) { return V{0.06 * torque(r), 18.0, 0.3, 0.3, -0.2, 0.1, 0.25}; },
       [](const V& p, independent_plant::Effects& e) { e.motor.cogging = with_harmonics(p); }},
      {"torque_ripple", [](const Rig&) { return V{0.1, 12.0, 0.3, 0.0, 0.0, 0.0, 0.0}; },
       [](const V& p, independent_plant::Effects& e) {
         e.command.ripple = {p[0], p[1], p[2], 0.0};
       }},
      {"torque_ripple", [](const Rig&) { return V{0.1, 9.0, 0.3, -0.2, 0.3, 0.25, 0.1}; },
       [](const V& p, independent_plant::Effects& e) { e.command.ripple = with_harmonics(p); }},
      {"load_resonance",
       [](const Rig&) {
         return V{0.3, 12.0, 0.04, 0.0, 0.0};
       },
       [](const V& p, independent_plant::Effects& e) {
         const double rate = 2.0 * kPi * p[1];
         e.load.resonator_inertia = p[0];  // of the load's
         e.load.resonator_stiffness = p[0] * rate * rate;
         e.load.resonator_damping = 2.0 * p[2] * p[0] * rate;
       }},
      {"supply_sag",
       [](const Rig& r) {
         return V{1.0, 0.2 * torque(r) * torque(r) / r.drive.motor_damping};
       },
       [](const V& p, independent_plant::Effects& e) {
         e.command.sag_per_w = 1.0 / p[1], e.command.sag_exponent = 1.0;
       }},
      {"load_unbalance",
       [](const Rig& r) {
         return V{0.1 * torque(r), 0.7, 2.5};
       },
       [](const V& p, independent_plant::Effects& e) {
         e.load.unbalance_nm = p[0], e.load.unbalance_phase_rad = p[1];
         e.load.unbalance_periods = p[2];
       }},
      {"constant_load_torque", [](const Rig& r) { return V{0.05 * torque(r)}; },
       [](const V& p, independent_plant::Effects& e) { e.load.constant_torque_nm = p[0]; }},
      {"input_dead_zone", [](const Rig& r) { return V{0.1 * r.amplitude}; },
       [](const V& p, independent_plant::Effects& e) { e.command.dead_zone = p[0]; }},
      {"input_delay", [](const Rig& r) { return V{2.3 / r.rate}; },
       [](const V& p, independent_plant::Effects& e) { e.command.delay_s = p[0]; }},
      {"actuator_lag", [](const Rig& r) { return V{3.0 / r.rate}; },
       [](const V& p, independent_plant::Effects& e) { e.command.lag_s = p[0]; }},
      {"shaft_compliance", [](const Rig& r) { return V{0.5 * r.drive.contact_stiffness}; },
       [](const V& p, independent_plant::Effects& e) { e.contact.stiffness_nm_rad = p[0]; }},
      {"impact_damping", [](const Rig& r) { return V{2.0 * r.drive.contact_damping}; },
       [](const V& p, independent_plant::Effects& e) { e.contact.damping_nms_rad = p[0]; }},
      {"contact_hardening",
       [](const Rig& r) {
         return V{2.0, 0.3 * torque(r) / r.drive.contact_stiffness};
       },
       [](const V& p, independent_plant::Effects& e) {
         e.contact.hardening_per_rad2 = p[0] / (p[1] * p[1]), e.contact.hardening_knee_rad = p[1];
       }},
      {"gap_eccentricity",
       [](const Rig& r) {
         return V{0.1 * r.drive.gap, 0.4, 2.5};
       },
       [](const V& p, independent_plant::Effects& e) {
         e.contact.eccentricity_rad = p[0], e.contact.eccentricity_phase_rad = p[1];
         e.contact.eccentricity_periods = p[2];
       }},
      {"gap_growth", [](const Rig& r) { return V{0.05 * r.drive.gap}; },
       [](const V& p, independent_plant::Effects& e) { e.contact.growth_rad_s = p[0]; }},
      {"contact_adhesion", [](const Rig& r) { return V{0.1 * torque(r)}; },
       [](const V& p, independent_plant::Effects& e) { e.contact.release_nm = p[0]; }},
      {"encoder_eccentricity",
       [](const Rig&) {
         return V{1e-3, 0.4, 2.5};
       },
       [](const V& p, independent_plant::Effects& e) {
         e.sensor.eccentricity_rad = p[0], e.sensor.eccentricity_phase_rad = p[1];
         e.sensor.eccentricity_periods = p[2];
       }},
      {"measurement_lag", [](const Rig& r) { return V{2.0 / r.rate}; },
       [](const V& p, independent_plant::Effects& e) { e.sensor.lag_s = p[0]; }},
      {"viscous_drift",
       [](const Rig&) {
         return V{0.3, 4.0};
       },
       [](const V& p, independent_plant::Effects& e) {
         e.motor.viscous_drift_ratio = p[0], e.motor.viscous_drift_time_s = p[1];
       }}};
  return forms;
}

class OnThreeRigs : public ::testing::TestWithParam<Rig> {};

TEST_P(OnThreeRigs, BareDriveFreeRunsTenSecondsWithinAFifthOfACount) {
  const Rig& rig = GetParam();
  const double difference = largest_difference(rig, plant_model(rig.drive, {}), 50, independent(rig.drive));
  std::cout << rig.name << ": " << difference / kCount20Bit << " counts of 20 bit\n";
  EXPECT_LT(difference, 0.2 * kCount20Bit);
}

TEST_P(OnThreeRigs, EachEffectOfEqualFormFreeRunsTenSecondsWithinAFifthOfACount) {
  const Rig& rig = GetParam();
  for (const EqualForm& form : equal_forms()) {
    const std::vector<double> p = form.parameters(rig);
    PlantModel<double> model = plant_model(rig.drive, {});
    add_effect<double>(model, *find_effect(form.name), p);
    independent_plant::BlindDrive truth = independent(rig.drive);
    form.apply(p, truth.effects);
    independent_plant::LoadEffects& load = truth.effects.load;
    for (double* of_load : {&load.resonator_inertia, &load.resonator_stiffness, &load.resonator_damping})
      *of_load *= truth.load_inertia;
    const double difference = largest_difference(rig, model, 50, truth);
    std::cout << rig.name << " " << form.name << ": " << difference / kCount20Bit << " counts of 20 bit\n";
    EXPECT_LT(difference, 0.2 * kCount20Bit) << form.name;
  }
}

TEST(OneBody, WithGearsThatRubUnderAnUnbalanceAndItsOwnInertiaFreeRunsTenSecondsWithinAFifthOfACount) {
  const Rig& rig = kRigs[0];
  DriveStructure one;
  one.has_load = false;
  PlantModel<double> model = plant_model(rig.drive, one);
  const double peak = torque(rig);
  add_effect<double>(model, *find_effect("load_unbalance"), std::vector<double>{0.2 * peak, 0.7, 1.0});
  add_effect<double>(model, *find_effect("constant_load_torque"), std::vector<double>{0.05 * peak});
  add_effect<double>(model, *find_effect("load_dependent_friction"), std::vector<double>{0.05 * peak, 0.3});
  independent_plant::BlindDrive truth = independent(rig.drive);
  truth.load = independent_plant::BlindLoad::kNone;
  truth.effects.load.unbalance_nm = 0.2 * peak, truth.effects.load.unbalance_phase_rad = 0.7;
  truth.effects.load.constant_torque_nm = 0.05 * peak;
  truth.effects.motor.friction.level_nm = 0.05 * peak, truth.effects.motor.friction.gear_ratio = 0.3;
  const double difference = largest_difference(rig, model, 10, truth);
  std::cout << "one body: " << difference / kCount20Bit << " counts of 20 bit\n";
  EXPECT_LT(difference, 0.2 * kCount20Bit);
}

/// Its dry friction grows to its level over a slow stretch, where the other plant's is set-valued.
TEST(OneBody, WithAFurtherInertiaThatRubsIsTwoBodiesOnASpring) {
  const Rig& rig = kRigs[0];
  DriveStructure one;
  one.has_load = false;
  PlantModel<double> model = plant_model(rig.drive, one);
  const double peak = torque(rig), hz = 12.0, omega = 2.0 * kPi * hz;
  add_effect<double>(model, *find_effect("load_resonance"),
                     std::vector<double>{1.2, hz, 0.05, 0.5 * rig.drive.motor_damping, 0.1 * peak});
  independent_plant::BlindDrive truth = independent(rig.drive);
  truth.contact = independent_plant::ContactKind::kBonded, truth.gap = 0.0;
  truth.load_inertia = 1.2 * rig.drive.motor_inertia;
  truth.contact_stiffness = truth.load_inertia * omega * omega;
  truth.contact_damping = 0.1 * truth.load_inertia * omega;
  truth.load_damping = 0.5 * rig.drive.motor_damping, truth.load_coulomb = 0.1 * peak;
  const double difference = largest_difference(rig, model, -1, truth);
  std::cout << "one body with a further inertia that rubs: " << difference << " rad\n";
  EXPECT_LT(difference, 0.01);
}

INSTANTIATE_TEST_SUITE_P(Rigs, OnThreeRigs, ::testing::ValuesIn(kRigs),
                         [](const auto& rig) { return std::string(rig.param.name); });

}  // namespace
}  // namespace gapscope

// How exact an implant is: a drive is simulated without an effect, the effect is implanted into its
// recording, and a drive that really has it is simulated under the input that the implant declares. Were the
// implant exact, both trajectories would be the same.
#include <fmt/format.h>

#include "implanted_drive.h"

namespace {

using namespace gapscope;
using namespace gapscope::internal::implant;
using namespace gapscope::internal::implant::test;

struct Exactness {
  const char* law;
  double counts;  ///< of 20 bit within which both trajectories are the same
  /// Gives the drive of the independent plant the effect with these values.
  void (*give)(plant::BlindDrive&, const Values&);
};

void give_coulomb(plant::BlindDrive& d, const Values& v) { d.effects.motor.friction.level_nm += v[0]; }
void give_asymmetry(plant::BlindDrive& d, const Values& v) {
  auto& f = d.effects.motor.friction;
  f.coulomb_ratio = v[0] * v[1] / f.level_nm;
  f.viscous_ratio = v[0] * v[1] / v[2] / d.motor_damping;
}
void give_stribeck(plant::BlindDrive& d, const Values& v) {
  auto& f = d.effects.motor.friction;
  f.stiction_ratio = v[0] / f.level_nm, f.stribeck_speed_rad_s = v[1], f.stribeck_exponent = v[2];
}
void give_presliding(plant::BlindDrive& d, const Values& v) {
  d.effects.motor.bristle = {v[0], v[1], v[0] * v[2] / v[1]};
}
void give_drag(plant::BlindDrive& d, const Values& v) {
  d.effects.motor.drag_nms2 = v[0], d.effects.motor.drag_exponent = v[1];
}
void give_cogging(plant::BlindDrive& d, const Values& v) {
  d.effects.motor.cogging = {v[0], v[1], v[2], 0.2};
}
void give_drift(plant::BlindDrive& d, const Values& v) {
  d.effects.motor.viscous_drift_ratio = v[0] * v[2] / d.motor_damping;
  d.effects.motor.viscous_drift_time_s = v[1];
}
void give_unbalance(plant::BlindDrive& d, const Values& v) {
  d.effects.load.unbalance_nm = v[0], d.effects.load.unbalance_phase_rad = v[1];
}
void give_constant(plant::BlindDrive& d, const Values& v) { d.effects.load.constant_torque_nm = v[0] * v[1]; }
void give_inertia(plant::BlindDrive& d, const Values& v) {
  auto& e = d.effects.load;
  e.inertia_ratio = v[0], e.inertia_time_s = v[1], e.inertia_duration_s = v[2];
}
void give_ripple(plant::BlindDrive& d, const Values& v) {
  d.effects.command.ripple = {v[0], v[1], v[2], 0.2};
}
void give_saturation(plant::BlindDrive& d, const Values& v) { d.effects.command.saturation_knee = v[0]; }
void give_dead_zone(plant::BlindDrive& d, const Values& v) { d.effects.command.dead_zone = v[0]; }
void give_delay(plant::BlindDrive& d, const Values& v) { d.effects.command.delay_s = v[0]; }
void give_lag(plant::BlindDrive& d, const Values& v) { d.effects.command.lag_s = v[0]; }

constexpr Exactness kLaws[] = {
    {"motor_coulomb_friction", 100.0, give_coulomb},
    {"friction_asymmetry", 300.0, give_asymmetry},
    {"stribeck_friction", 300.0, give_stribeck},
    {"presliding_friction", 10.0, give_presliding},
    {"quadratic_drag", 0.2, give_drag},
    {"cogging_torque", 0.2, give_cogging},
    {"viscous_drift", 0.2, give_drift},
    {"load_unbalance", 0.2, give_unbalance},
    {"constant_load_torque", 0.2, give_constant},
    {"load_inertia_variation", 10.0, give_inertia},
    {"torque_ripple", 0.5, give_ripple},
    {"torque_saturation", 0.2, give_saturation},
    {"input_dead_zone", 0.2, give_dead_zone},
    {"input_delay", 10.0, give_delay},
    {"actuator_lag", 15.0, give_lag},
};

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double most = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
  return most;
}

class Implanted : public testing::TestWithParam<Exactness> {};

TEST_P(Implanted, MovesAsADriveThatHasTheEffect) {
  const plant::BlindDrive without = one_body();
  const plant::BlindRun run = driven(without, commanded());
  const std::vector<Subject> subjects = {{&run.recording, SmoothedMotion(run.recording.motor_trace())}};
  const ImplantLaw* law = find_implant_law(GetParam().law);
  ASSERT_NE(law, nullptr);
  for (const std::uint64_t seed : {1u, 2u}) {
    const auto implant = drawn_implant(*law, subjects, receiver_of(without), 0.1, seed);
    ASSERT_TRUE(implant);
    EXPECT_NEAR(implant_size(subjects, *implant, receiver_of(without)), 0.1, 1e-3);
    plant::BlindDrive with = without;
    GetParam().give(with, implant->values);
    const Recording declared = implanted(subjects[0], 0, *implant, receiver_of(without));
    const double off = largest_difference(driven(with, declared.u).truth.x1, run.truth.x1) / kCount;
    fmt::print("{:24} {:10.3f} counts; of {:.2f} that it moves the drive without\n", GetParam().law, off,
               largest_difference(driven(without, declared.u).truth.x1, run.truth.x1) / kCount);
    EXPECT_LE(off, GetParam().counts);
  }
}

INSTANTIATE_TEST_SUITE_P(Law, Implanted, testing::ValuesIn(kLaws),
                         [](const auto& law) { return std::string(law.param.law); });

}  // namespace

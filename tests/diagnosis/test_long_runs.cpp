// Numbers that a model runs freely with.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "diagnosis/long_runs.h"
#include "diagnosis/one_inertia.h"

namespace gapscope::internal::diagnosis {
namespace {

/// Of whole runs without a correction [rad].
double whole_run_rms(const Study& study, const ReferenceModel& model) {
  const HeldOut own = fitted_as_held_out(study);
  const Positions x = whole_runs(model, own, study.observer_hz);
  if (x.empty()) return kInfinity;
  double square = 0.0;
  for (std::size_t i = 0; i < x.front().size(); ++i)
    square += std::pow(own.traces.front().x1[i] - x.front()[i], 2);
  return std::sqrt(square / static_cast<double>(x.front().size()));
}

double torque_rms(const Study& study, const ReferenceModel& model) {
  const auto played = play(model, fitted_as_held_out(study), study.observer_hz, true);
  return played.empty() ? kInfinity : rms(played.front().torque);
}

/// Friction that changes along the way, which the model has not: an observer's numbers drift off with it.
TEST(LongRuns, NumbersThatRunFreelyMissLessAndStayPhysical) {
  independent_plant::OutsideEffects outside;
  outside.tight_nm = 0.02, outside.tight_speed_rad_s = 0.05;
  const blind::BlindPair pair = test::one_inertia({}, 80, outside);
  ReferenceModel sheet = pair.sheet;
  const EffectEntry* friction = find_effect("motor_coulomb_friction");
  sheet.effects.push_back({friction, {ParameterSetting::sought(0.01)}});
  DiagnosisOptions options;
  options.fit.work = std::make_shared<std::atomic<std::int64_t>>(0);
  const MotorTrace train = pair.train.motor_trace(), held_out = pair.held_out.motor_trace();
  const Study study = make_study({&train, 1}, {&held_out, 1}, sheet, options);
  const FittedModel observed = fit_nominal(study.train, sheet, options.fit, study.observer_hz);
  const FittedModel runs = fitted_for_runs(study, observed);
  EXPECT_LT(whole_run_rms(study, runs.model), 0.8 * whole_run_rms(study, observed.model));
  EXPECT_LT(torque_rms(study, runs.model), 1.3 * torque_rms(study, observed.model));
  EXPECT_NEAR(runs.model.parameters[place::kMotorInertia].value, 2.0 * 8.78e-4, 0.1 * 2.0 * 8.78e-4);
}

}  // namespace
}  // namespace gapscope::internal::diagnosis

// fit_drive FILE: what a data sheet does not give, fitted to a recording: the gap, the load, the friction.
// The sheet is that of configs/03_recording.csv; for a drive of your own change the numbers.
#include <gapscope/base/errors.h>
#include <gapscope/base/statistics.h>
#include <gapscope/recording/recording_file.h>
#include <gapscope/reference/fit.h>

#include <cstdio>

namespace {

namespace place = gapscope::place;

gapscope::ParameterSetting known(double value) {
  gapscope::ParameterSetting setting;
  setting.value = value;
  return setting;
}

/// Sought within bounds around a start; without one, the recording suggests both.
gapscope::ParameterSetting sought(double start = gapscope::kNaN) {
  gapscope::ParameterSetting setting = known(start);
  setting.estimate = true;
  return setting;
}

/// From the sheet what the motor is; from the recording what hangs on it.
gapscope::ReferenceModel model_of_the_drive() {
  gapscope::ReferenceModel model;
  auto& parameters = model.parameters;
  parameters[place::kMotorInertia] = known(8.78e-4);      // [kg m²]
  parameters[place::kTorqueConstant] = known(0.172);      // [N m per unit of u]
  parameters[place::kContactStiffness] = sought(1300.0);  // [N m/rad]
  parameters[place::kContactDamping] = sought(0.171);     // [N m s/rad]
  for (const int unknown :
       {place::kMotorDamping, place::kMassRatio, place::kGap, place::kLoadDamping, place::kLoadCoulomb})
    parameters[unknown] = sought();
  return model;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: fit_drive FILE (a CSV with columns t [s], u and x1 [rad])\n");
    return 2;
  }
  try {
    const gapscope::Recording recording = gapscope::read_recording(argv[1]);
    const gapscope::MotorTrace traces[] = {recording.motor_trace()};
    const gapscope::FitSummary fit = gapscope::fit(traces, model_of_the_drive());
    std::printf("%s", fit.full_report().c_str());
    return fit.converged() ? 0 : 1;
  } catch (const gapscope::ConfigError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}

// fit_drive FILE: what a data sheet does not give, fitted to a recording: the gap, the load, the friction.
// The sheet is that of configs/03_recording.csv; for a drive of your own change the numbers.
#include <gapscope/base/errors.h>
#include <gapscope/recording/recording_file.h>
#include <gapscope/reference/fit.h>

#include <cstdio>

namespace {

/// From the sheet what the motor is; from the recording what hangs on it.
gapscope::ReferenceModel model_of_the_drive() {
  using gapscope::ParameterSetting;
  gapscope::ReferenceModel model;
  model.set("motor_inertia", ParameterSetting::known(8.78e-4));      // [kg m²]
  model.set("torque_constant", ParameterSetting::known(0.172));      // [N m per unit of u]
  model.set("contact_stiffness", ParameterSetting::sought(1300.0));  // [N m/rad]
  model.set("contact_damping", ParameterSetting::sought(0.171));     // [N m s/rad]
  for (const char* unknown : {"motor_damping", "mass_ratio", "gap", "load_damping", "load_coulomb_friction"})
    model.set(unknown, ParameterSetting::sought());
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

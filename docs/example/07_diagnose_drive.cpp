// diagnose_drive FILE: what a drive of one inertia with viscous friction lacks to move like the recorded one.
// The last third of the recording is held out and judges.
#include <gapscope/base/errors.h>
#include <gapscope/diagnosis/diagnosis.h>
#include <gapscope/recording/recording_file.h>
#include <gapscope/telling/card.h>

#include <cstdio>

namespace {

/// Inertia in units of the torque: a torque constant that nobody knows is one.
gapscope::ReferenceModel one_body() {
  using gapscope::ParameterSetting;
  gapscope::ReferenceModel model;
  model.structure.has_load = false;
  model.set("motor_inertia", ParameterSetting::sought());
  model.set("torque_constant", ParameterSetting::known(1.0));
  model.set("motor_damping", ParameterSetting::sought());
  model.set("mass_ratio", ParameterSetting::known(0.0));
  return model;
}

void print(gapscope::Diagnosis diagnosis) {
  gapscope::put_into_words(diagnosis, {});
  std::printf("%s\n", diagnosis.sentence.c_str());
  std::printf("held-out error %.3g -> %.3g rad, encoder floor %.3g rad\n", diagnosis.mismatch.before,
              diagnosis.mismatch.after, diagnosis.mismatch.floor);
  for (const std::string& effect : diagnosis.effects) std::printf("  added: %s\n", effect.c_str());
  for (const std::string& warning : diagnosis.warnings) std::printf("warning: %s\n", warning.c_str());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: diagnose_drive FILE (a CSV with columns t [s], u and x1 [rad])\n");
    return 2;
  }
  try {
    const gapscope::Recording recording = gapscope::read_recording(argv[1]);
    const gapscope::MotorTrace traces[] = {recording.motor_trace()};
    print(gapscope::diagnose(traces, {}, one_body()));
    return 0;
  } catch (const gapscope::ConfigError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}

// One diagnosis of 2 × 16,000 samples over the whole catalogue, in fits of the nominal model: the public one
// (several starts, polished, with intervals) and the plain descent from the data sheet that the diagnosis
// itself begins with. Processor time of one thread.
#include <fmt/format.h>

#include <ctime>

#include "diagnosis/candidates.h"
#include "gapscope/diagnosis/diagnosis.h"
#include "independent_plant/severity.h"

namespace {

using namespace gapscope;

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

template <class Work>
double seconds_of(const Work& work) {
  const double begin = processor_seconds();
  work();
  return processor_seconds() - begin;
}

struct Drive {
  Recording train, held_out;
  ReferenceModel sheet;
};

/// The source paper's rig at 2 kHz for 8 s, 16 bit with noise; a sine to be fitted, a multisine held out.
Drive drive_with(const char* effect) {
  independent_plant::BlindCase c;
  c.options = {2000.0, 8.0, 1, independent_plant::kFastTolerance};
  c.sensor = independent_plant::BlindSensor::with_bits(16, 0.5);
  c.excitation.amplitude = 0.8;
  const independent_plant::BlindDrive sheet = independent_plant::data_sheet(c.drive, 1);
  if (effect != std::string("none")) give_effect(c, effect, 0.5, 3);
  Drive drive;
  drive.train = simulate_blind(c).recording;
  c.excitation.waveform = independent_plant::Waveform::kMultisine;
  c.options.seed = 2;
  drive.held_out = simulate_blind(c).recording;
  const double values[kDriveParameterCount] = {sheet.motor_inertia,
                                               sheet.torque_constant,
                                               sheet.motor_damping,
                                               sheet.load_inertia / sheet.motor_inertia,
                                               sheet.gap,
                                               sheet.load_damping,
                                               sheet.load_coulomb,
                                               c.drive.contact_stiffness,
                                               c.drive.contact_damping};
  for (std::size_t i = 0; i < kDriveParameterCount; ++i) {
    drive.sheet.parameters[i].value = values[i];
    drive.sheet.parameters[i].estimate = i >= 2 && i <= 6;
  }
  return drive;
}

void measure(const char* effect) {
  const Drive drive = drive_with(effect);
  const MotorTrace train[] = {drive.train.motor_trace()}, held_out[] = {drive.held_out.motor_trace()};
  DiagnosisOptions options;
  options.threads = 1;
  Diagnosis d;
  const double whole = seconds_of([&] { fit(train, drive.sheet, options.fit); });
  const double descent =
      seconds_of([&] { internal::diagnosis::fit_nominal(train, drive.sheet, options.fit, 3.0); });
  const double diagnosis = seconds_of([&] { d = diagnose(train, held_out, drive.sheet, options); });
  fmt::print("{:<24} {:>8.2f} s = {:6.1f} fits of {:.3f} s = {:6.1f} descents of {:.3f} s   {}\n", effect,
             diagnosis, diagnosis / whole, whole, diagnosis / descent, descent, to_string(d.verdict));
}

}  // namespace

int main() {
  for (const char* effect : {"cogging_torque", "motor_coulomb_friction", "stribeck_friction", "input_delay",
                             "gap_eccentricity", "viscous_drift", "external_knocks", "none"})
    measure(effect);
}

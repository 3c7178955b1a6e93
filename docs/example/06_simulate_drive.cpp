// simulate_drive FILE: a recording of a drive with play, made by the simulator: what its encoder would have
// seen.
#include <gapscope/base/errors.h>
#include <gapscope/recording/recording_file.h>
#include <gapscope/simulation/simulate.h>

#include <cmath>
#include <cstdio>
#include <exception>
#include <vector>

namespace {

gapscope::PlantModel<double> drive_with_play() {
  gapscope::DriveParameters<double> drive;
  drive.motor_inertia = 8.78e-4;       // [kg m²]
  drive.torque_constant = 0.172;       // [N m per unit of u]
  drive.motor_damping = 0.035;         // [N m s/rad]
  drive.mass_ratio = 1.0;              // [-]
  drive.gap = 0.02;                    // [rad]
  drive.load_damping = 0.02;           // [N m s/rad]
  drive.load_coulomb_friction = 0.02;  // [N m]
  drive.contact_stiffness = 200.0;     // [N m/rad]
  drive.contact_damping = 0.05;        // [N m s/rad]
  return gapscope::plant_model(drive, {});
}

/// A sine of 0.5 Hz, held from sample to sample.
std::vector<double> excitation(double rate, double duration) {
  std::vector<double> u;
  for (int i = 0; i < static_cast<int>(rate * duration); ++i)
    u.push_back(0.9 * std::sin(2.0 * 3.14159265358979 * 0.5 * i / rate));
  return u;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: simulate_drive FILE (a CSV to write)\n");
    return 2;
  }
  try {
    gapscope::SimulationOptions options;
    options.rate = 1000.0;             // [Hz]
    options.encoder = {1.5e-5, 5e-6};  // quantum and noise [rad]
    const auto u = excitation(options.rate, 12.0);
    const gapscope::Recording recording = gapscope::simulate(drive_with_play(), u, options);
    gapscope::write_csv(argv[1], recording);
    std::printf("%s: %zu samples\n", argv[1], recording.size());
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}

// close_loop: what play does to a position loop: the same controller on a drive with a gap and without.
#include <gapscope/simulation/closed_loop.h>

#include <cmath>
#include <cstdio>
#include <exception>
#include <vector>

namespace {

gapscope::PlantModel<double> drive_with_gap(double gap) {
  gapscope::DriveParameters<double> drive;
  drive.motor_inertia = 8.78e-4;       // [kg m²]
  drive.torque_constant = 1.0;         // u is a torque [N m]
  drive.motor_damping = 0.035;         // [N m s/rad]
  drive.mass_ratio = 1.0;              // [-]
  drive.gap = gap;                     // [rad]
  drive.load_damping = 0.02;           // [N m s/rad]
  drive.load_coulomb_friction = 0.02;  // [N m]
  drive.contact_stiffness = 200.0;     // [N m/rad]
  drive.contact_damping = 0.05;        // [N m s/rad]
  return gapscope::plant_model(drive, {});
}

/// How far the load is off the goal [rad, rms].
double load_error(double gap) {
  gapscope::DriveController controller;
  controller.gain = 2.0;         // [N m/rad]
  controller.derivative = 0.02;  // [N m s/rad]
  gapscope::SimulationOptions options;
  options.rate = 1000.0;            // [Hz]
  options.encoder = {1.5e-5, 0.0};  // quantum and noise [rad]
  std::vector<double> goal;
  for (int i = 0; i < 4000; ++i) goal.push_back(0.2 * std::sin(2.0 * 3.14159265358979 * i / 1000.0));
  const gapscope::Recording run =
      gapscope::simulate_under_controller(drive_with_gap(gap), controller, goal, options);
  double sum = 0.0;
  for (std::size_t i = 0; i < run.size(); ++i) sum += std::pow(goal[i] - run.x2[i], 2);
  return std::sqrt(sum / static_cast<double>(run.size()));
}

}  // namespace

int main() {
  try {
    for (const double gap : {1e-4, 0.02})
      std::printf("gap %.1f mrad: the load is %.2f mrad off its goal\n", 1e3 * gap, 1e3 * load_error(gap));
    return 0;
  } catch (const std::exception& error) {  // a loop that diverges
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}

#include "run/fastest_motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "gapscope/base/errors.h"

namespace gapscope::internal::run {

double fastest_rate(const SimulatedPlant& plant) {
  const DriveParameters<double>& p = plant.drive;
  const double motor = p.motor_damping / p.motor_inertia;
  if (!plant.structure.has_load) return motor;
  const bool locked = plant.structure.load == LoadKind::kLocked;
  const double of_load = locked ? 0.0 : 1.0 / (p.motor_inertia * p.mass_ratio);
  const double bodies = std::max(motor, p.load_damping * of_load);
  if (plant.structure.contact == ContactLaw::kRigid) return bodies;
  const double mobility = 1.0 / p.motor_inertia + of_load;
  return bodies + std::max(std::sqrt(p.contact_stiffness * mobility), p.contact_damping * mobility);
}

void require_followable(const Configuration& c) {
  const SimulationConfig& s = *c.simulation;
  const double rate = fastest_rate(s.plant);
  if (rate <= kMostTimesInARow * s.rate) return;
  throw ConfigError(
      c.file, s.line,
      fmt::format(
          "simulates a drive whose fastest motion, of its inertias against dampers and contact, has a "
          "time constant of {:.2g} s: a row holds {:.2g} of them, expected at most {:.0f}: a larger "
          "motor_inertia, a softer contact, less damping, or a rate of {:.2g} Hz",
          1.0 / rate, rate / s.rate, kMostTimesInARow, rate / kMostTimesInARow));
}

}  // namespace gapscope::internal::run

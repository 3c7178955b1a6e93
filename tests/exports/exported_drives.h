#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <string>

#include "config/configuration.h"
#include "independent_plant/random_drive.h"

namespace gapscope::testing {

/// Four seconds of a drive that the independent plant's laws draw.
inline Configuration random_drive_configuration(std::uint64_t seed) {
  const independent_plant::BlindCase c = independent_plant::random_drive(seed);
  const independent_plant::BlindDrive& d = c.drive;
  return parse_configuration(
      fmt::format(
          "name: random_{}\nencoder: {{bits: 20}}\n"
          "simulation:\n  rate: {}\n  duration: 4\n  initial: {{x1: {}, w1: {}, x2: {}, w2: {}}}\n"
          "  excitation: {{sine: {{amplitude: {}, frequency: {}}}}}\n"
          "model:\n  parameters: {{motor_inertia: {}, torque_constant: {}, motor_damping: {}, "
          "mass_ratio: {}, gap: {}, load_damping: {}, load_coulomb_friction: {}, contact_stiffness: {}, "
          "contact_damping: {}}}\n",
          seed, c.options.rate, d.x1, d.w1, d.x2, d.w2, c.excitation.amplitude, c.excitation.frequency,
          d.motor_inertia, d.torque_constant, d.motor_damping, d.load_inertia / d.motor_inertia, d.gap,
          d.load_damping, d.load_coulomb, d.contact_stiffness, d.contact_damping),
      "random.yaml");
}

/// Two seconds of the paper's rig, with other lines under `model:` and its numbers replaced.
inline Configuration rig_configuration(const std::string& numbers, const std::string& model = "",
                                       const std::string& top = "encoder: {bits: 20}") {
  return parse_configuration(
      fmt::format(
          "name: rig\n{}\n"
          "simulation: {{rate: 2500, duration: 2, excitation: {{sine: {{amplitude: 0.6, frequency: 1}}}}}}\n"
          "model:\n  parameters: {{motor_inertia: 8.78e-4, torque_constant: 0.172, motor_damping: 0.062{}}}\n"
          "{}",
          top, numbers, model),
      "rig.yaml");
}

inline const std::string kTwoBodies =
    ", mass_ratio: 1.5, gap: 0.019, load_damping: 0.035, load_coulomb_friction: 0.03, contact_stiffness: 200, "
    "contact_damping: 0.05";

}  // namespace gapscope::testing

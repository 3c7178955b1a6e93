#pragma once

#include <string>

namespace gapscope::testing {

/// A configuration of recorded data with every key of the schema, line by line.
inline const std::string kRecorded = R"(name: rig_p
recording:
  file: train.csv
  held_out: [a.csv, b.csv]
  columns: {time: t, input: u, position: x1, load_position: x2}
  window: [0, 20.31]
  resample: {rate: 400}
encoder: {bits: 20}
coordinates: rotation
model:
  contact: compliant
  load: free
  parameters:
    motor_inertia: 8.78e-4
    torque_constant: 0.172
    motor_damping: {value: 0.06, estimate: true, bounds: [0, 1]}
    mass_ratio: {value: 1.2, estimate: true, bounds: [0.05, 20]}
    gap: {value: 0.02, estimate: true, bounds: [0, 0.3], prior: {std: 0.01}}
    load_damping: {value: 0.03, estimate: true, bounds: [0, 1]}
    load_coulomb_friction: {value: 0.05, estimate: true, bounds: [0, 1]}
    contact_stiffness: 200
    contact_damping: 0.05
  effects: []
detector: {bound: auto}
)";

/// The shortest configuration of simulated data with a plant.
inline const std::string kSimulated = R"(name: sim
simulation:
  rate: 1000
  duration: 1
  excitation: {sine: {amplitude: 0.5, frequency: 2}}
model:
  parameters:
    motor_inertia: 1.0e-3
    torque_constant: 0.1
    motor_damping: 0.01
    mass_ratio: 2
    gap: 0.02
    contact_stiffness: 200
)";

/// The text with its first `what` replaced; the text must contain it.
inline std::string with(std::string text, const std::string& what, const std::string& by) {
  return text.replace(text.find(what), what.size(), by);
}

}  // namespace gapscope::testing

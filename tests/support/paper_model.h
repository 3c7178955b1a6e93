#pragma once

#include <string>

namespace gapscope::testing {

/// The paper's rig as the value of `model:`, at any depth of a configuration; damping and gap are asked for.
inline const std::string kPaperModel = R"({parameters: {
        motor_inertia: 8.78e-4, torque_constant: 0.172, motor_damping: {value: 0.062, estimate: true},
        mass_ratio: 1, gap: {value: 0.019, estimate: true}, load_damping: 0.035, load_coulomb_friction: 0.05,
        contact_stiffness: 200, contact_damping: 0.05}}
)";

}  // namespace gapscope::testing

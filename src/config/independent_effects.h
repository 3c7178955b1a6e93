#pragma once

namespace gapscope::internal::config {

/// Effects of the catalogue that `simulation: plant: independent` has as well: other laws of contact and
/// friction, which its code states alike.
inline constexpr const char* kIndependentEffects[] = {"contact_adhesion", "contact_hardening",
                                                      "motor_coulomb_friction", "presliding_friction",
                                                      "stribeck_friction"};

}  // namespace gapscope::internal::config

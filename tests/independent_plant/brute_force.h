#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "independent_plant/drive.h"

namespace gapscope::independent_plant {

/// Two inertias, compliant contact and dry friction on both, by the semi-implicit Euler rule on a fixed fine
/// grid; friction stops a body whenever it can within a step. No modes, no events: first order, but nothing
/// to go wrong. Returns x1 at every sample of u, taken `fine` steps apart.
inline std::vector<double> brute_force(const BlindDrive& d, const std::vector<double>& u, double dt,
                                       int fine) {
  const auto rub = [](double w, double impulse) {
    return w > impulse ? w - impulse : (w < -impulse ? w + impulse : 0.0);
  };
  const double h = dt / fine, motor_level = d.effects.motor.friction.level_nm;
  double x1 = d.x1, w1 = d.w1, x2 = d.x2, w2 = d.w2;
  std::vector<double> result;
  for (const double input : u) {
    result.push_back(x1);
    for (int i = 0; i < fine; ++i) {
      const double delta = x1 - x2, side = delta > 0.0 ? 1.0 : -1.0, p = side * delta - 0.5 * d.gap;
      const double push =
          p > 0.0 ? std::max(0.0, d.contact_stiffness * p + d.contact_damping * side * (w1 - w2)) : 0.0;
      w1 += h / d.motor_inertia * (d.torque_constant * input - d.motor_damping * w1 - side * push);
      w2 += h / d.load_inertia * (side * push - d.load_damping * w2);
      w1 = rub(w1, h / d.motor_inertia * motor_level);
      w2 = rub(w2, h / d.load_inertia * d.load_coulomb);
      x1 += h * w1;
      x2 += h * w2;
    }
  }
  return result;
}

}  // namespace gapscope::independent_plant

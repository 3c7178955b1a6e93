#pragma once

#include <Eigen/Dense>
#include <array>
#include <vector>

#include "gapscope/base/statistics.h"

namespace gapscope::internal::torque_view {

/// What a law is tried at: one number, and of a load on a spring three more.
struct Shape {
  double at = kNaN;
  double damping = 0.1;  ///< ratio of the spring's [-]
  double drag = 0.0;     ///< the load's viscous friction over its inertia [1/s]
  double rub = 0.0;      ///< the load's Coulomb friction over its inertia [rad/s² or m/s²]
  Shape(double value = kNaN) : at(value) {}
  operator double() const { return at; }
};

/// What the coefficients of a law are told relative to.
struct Drive {
  double inertia = kNaN, viscous = kNaN;  ///< of the same model
  double coulomb = 0.0;                   ///< Coulomb friction of the same model; 0: none
  double torque_constant = 1.0;           ///< [N m per unit of u]
  double torque_rms = kNaN;               ///< of the model's torque [N m]
};

/// The values of the effect of the catalogue, in the order of its parameters, that coefficients and a shape
/// stand for. What the law leaves open (an exponent, a second harmonic) is as small or as usual as can be.
using EffectValues = std::vector<double> (*)(const Eigen::VectorXd& theta, const Shape& shape,
                                             const Drive& drive);

std::vector<double> coulomb_values(const Eigen::VectorXd& theta, const Shape& shape, const Drive& drive);
std::vector<double> constant_values(const Eigen::VectorXd& theta, const Shape& shape, const Drive& drive);
std::vector<double> asymmetry_values(const Eigen::VectorXd& theta, const Shape& shape, const Drive& drive);
std::vector<double> stribeck_values(const Eigen::VectorXd& theta, const Shape& shape, const Drive& drive);
std::vector<double> presliding_values(const Eigen::VectorXd& theta, const Shape& shape, const Drive& drive);
std::vector<double> load_friction_values(const Eigen::VectorXd&, const Shape&, const Drive&);
std::vector<double> drag_values(const Eigen::VectorXd& theta, const Shape& shape, const Drive& drive);
std::vector<double> unbalance_values(const Eigen::VectorXd& theta, const Shape& shape, const Drive& drive);
std::vector<double> cogging_values(const Eigen::VectorXd& theta, const Shape& shape, const Drive& drive);
std::vector<double> ripple_values(const Eigen::VectorXd& theta, const Shape& shape, const Drive& drive);
/// Sine and cosine of a harmonic relative to its line A sin(y), both of a cogging or both of a ripple.
/// @param line  coefficients of the line
std::array<double, 2> harmonic_values(const Eigen::VectorXd& theta, int harmonic,
                                      const Eigen::VectorXd& line);
std::vector<double> drift_values(const Eigen::VectorXd& theta, const Shape& shape, const Drive& drive);
std::vector<double> inertia_step_values(const Eigen::VectorXd& theta, const Shape& shape, const Drive& drive);
std::vector<double> resonance_values(const Eigen::VectorXd& theta, const Shape& shape, const Drive& drive);
std::vector<double> delay_values(const Eigen::VectorXd& theta, const Shape& shape, const Drive& drive);
std::vector<double> dead_zone_values(const Eigen::VectorXd& theta, const Shape& shape, const Drive& drive);
std::vector<double> saturation_values(const Eigen::VectorXd& theta, const Shape& shape, const Drive& drive);

}  // namespace gapscope::internal::torque_view

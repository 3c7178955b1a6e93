#include "torque_view/effect_values.h"

#include <algorithm>
#include <cmath>

namespace gapscope::internal::torque_view {
namespace {

constexpr double kAlmostNothing = 1e-9;  ///< [N m or N]: where a ratio has nothing to refer to

double over(double value, double reference) {
  return value / (std::abs(reference) > kAlmostNothing ? reference : kAlmostNothing);
}

/// θ0 sin y + θ1 cos y = A sin(y + phase)
double amplitude(const Eigen::VectorXd& theta) { return std::hypot(theta[0], theta[1]); }
double phase(const Eigen::VectorXd& theta) { return std::atan2(theta[1], theta[0]); }

}  // namespace

std::vector<double> coulomb_values(const Eigen::VectorXd& theta, const Shape&, const Drive&) {
  return {theta[0]};
}

/// What drives the load stands on the other side of u = τ.
std::vector<double> constant_values(const Eigen::VectorXd& theta, const Shape&, const Drive&) {
  return {-theta[0]};
}

std::vector<double> asymmetry_values(const Eigen::VectorXd& theta, const Shape&, const Drive& d) {
  return {d.coulomb, over(theta[0], d.coulomb), over(theta[1], d.viscous)};
}

std::vector<double> stribeck_values(const Eigen::VectorXd& theta, const Shape& speed, const Drive& d) {
  return {d.coulomb, over(theta[0], d.coulomb), speed, 2.0};
}

/// The bristles bear a part of the Coulomb friction that was found before them.
std::vector<double> presliding_values(const Eigen::VectorXd& theta, const Shape& length, const Drive&) {
  return {theta[0], length, 0.0};
}

/// Coulomb friction that was found before it is its level at no torque.
std::vector<double> load_friction_values(const Eigen::VectorXd& theta, const Shape&, const Drive& d) {
  return {std::max(0.0, d.coulomb), theta[0]};
}

std::vector<double> drag_values(const Eigen::VectorXd& theta, const Shape&, const Drive&) {
  return {theta[0], 2.0};
}

std::vector<double> unbalance_values(const Eigen::VectorXd& theta, const Shape& periods, const Drive&) {
  return {amplitude(theta), phase(theta), periods};
}

std::vector<double> cogging_values(const Eigen::VectorXd& theta, const Shape& periods, const Drive&) {
  return {amplitude(theta), periods, phase(theta), 0.0, 0.0, 0.0, 0.0};
}

/// u = τ/(1 + s sin y), nearly τ − τ s sin y.
std::vector<double> ripple_values(const Eigen::VectorXd& theta, const Shape& periods, const Drive&) {
  return {amplitude(theta), periods, phase(-theta), 0.0, 0.0, 0.0, 0.0};
}

/// θ0 sin h(y − φ) + θ1 cos h(y − φ) over A, with y and A of the line whose coefficients are given.
std::array<double, 2> harmonic_values(const Eigen::VectorXd& theta, int harmonic,
                                      const Eigen::VectorXd& line) {
  const double turn = harmonic * phase(line), sine = std::sin(turn), cosine = std::cos(turn);
  return {(theta[0] * cosine + theta[1] * sine) / amplitude(line),
          (theta[1] * cosine - theta[0] * sine) / amplitude(line)};
}

std::vector<double> drift_values(const Eigen::VectorXd& theta, const Shape& span, const Drive& d) {
  return {over(theta[0], d.viscous), span};
}

std::vector<double> inertia_step_values(const Eigen::VectorXd& theta, const Shape& time, const Drive& d) {
  return {over(theta[0], d.inertia), time, 0.0};
}

/// What hangs on the spring is a part of the inertia that the balance has, and of its friction.
std::vector<double> resonance_values(const Eigen::VectorXd& theta, const Shape& spring, const Drive& d) {
  return {over(theta[0], d.inertia - theta[0]), spring.at, spring.damping, theta[0] * spring.drag,
          theta[0] * spring.rub};
}

std::vector<double> delay_values(const Eigen::VectorXd& theta, const Shape&, const Drive&) {
  return {theta[0]};
}

std::vector<double> dead_zone_values(const Eigen::VectorXd& theta, const Shape&, const Drive& d) {
  return {theta[0] / d.torque_constant};
}

/// u/(1 + |u/knee|^s)^(1/s) = τ, nearly u = τ + τ |τ/knee|^s / s.
std::vector<double> saturation_values(const Eigen::VectorXd& theta, const Shape& sharpness, const Drive& d) {
  const double share = std::max(sharpness * theta[0], kAlmostNothing);
  return {d.torque_rms / d.torque_constant * std::pow(share, -1.0 / sharpness), sharpness};
}

}  // namespace gapscope::internal::torque_view

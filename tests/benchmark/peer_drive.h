#pragma once

#include <array>
#include <cmath>

#include "gapscope/plant/drive.h"

namespace gapscope::benchmark_peers {

using PeerState = std::array<double, 4>;  ///< x1, w1, x2, w2
constexpr int kGuards = 4;
using PeerGuards = std::array<double, kGuards>;

/// The drive with a compliant contact and a load with Coulomb friction, mode by mode, for an integrator that
/// locates events: in each mode the right-hand side is smooth, and the mode ends when a guard falls from
/// positive to zero. Guards that the mode does not need stay at one.
///   contact closed on side s:  s τc falls to zero → opens
///   released beyond the edge:  s δ − β → back in the gap;  −s τ → the contact closes again
///   in the gap:                β ∓ δ → closes on that side
///   load slips towards l:      l w2 → stops; sticks if |τc| ≤ Fc2, else starts in the torque's direction
///   load sticks in contact:    Fc2 ∓ τc → slips towards that side
class PeerDrive {
 public:
  explicit PeerDrive(const DriveParameters<double>& p)
      : p_(p),
        beta_(0.5 * p.gap),
        inverse_m1_(1.0 / p.motor_inertia),
        inverse_m2_(inverse_m1_ / p.mass_ratio) {
    set_mode(0, 0, 0);
  }

  void set_input(double u) { input_ = p_.torque_constant * u; }

  /// Derivative of z, without a branch.
  void derivative(const double* z, double* dz) const {
    const double torque = k_ * (z[0] - z[2]) + c_ * (z[1] - z[3]) - offset_;
    dz[0] = z[1];
    dz[1] = (input_ - p_.motor_damping * z[1] - torque) * inverse_m1_;
    dz[2] = z[3];
    dz[3] = (torque - p_.load_damping * z[3] - friction_) * free_load_;
  }

  /// ∂(derivative)/∂z, column by column.
  void jacobian(double (*column)[4]) const {
    const double m1 = inverse_m1_, m2 = free_load_;
    const double columns[4][4] = {{0.0, -k_ * m1, 0.0, k_ * m2},
                                  {1.0, -(p_.motor_damping + c_) * m1, 0.0, c_ * m2},
                                  {0.0, k_ * m1, 0.0, -k_ * m2},
                                  {0.0, c_ * m1, 1.0, -(p_.load_damping + c_) * m2}};
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) column[i][j] = columns[i][j];
  }

  void guards(const double* z, double* g) const {
    const double delta = z[0] - z[2];
    const double speed = z[1] - z[3];
    g[0] = g[1] = g[2] = g[3] = 1.0;
    if (contact_ != 0) {
      const double torque = contact_torque(contact_, delta, speed);
      g[0] = contact_ * torque;
      if (load_ == 0) {
        g[2] = p_.load_coulomb_friction - torque;
        g[3] = p_.load_coulomb_friction + torque;
      }
    } else if (outside_ != 0) {
      g[0] = outside_ * delta - beta_;
      g[1] = -outside_ * contact_torque(outside_, delta, speed);
    } else {
      g[0] = beta_ - delta;
      g[1] = beta_ + delta;
    }
    if (load_ != 0) g[2] = load_ * z[3];
  }

  /// Changes the mode after guard `index` has fallen to zero at z.
  void cross(int index, double* z) {
    ++events;
    if (index >= 2)
      load_ != 0 ? stop_load(z) : set_mode(contact_, 0, index == 2 ? 1 : -1);
    else if (contact_ != 0)
      set_mode(0, contact_ * (z[0] - z[2]) > beta_ ? contact_ : 0, load_);
    else if (outside_ != 0 && index == 0)
      set_mode(0, 0, load_);
    else
      close(outside_ != 0 ? outside_ : (index == 0 ? 1 : -1), z);
  }

  long events = 0;

 private:
  double contact_torque(int side, double delta, double speed) const {
    return p_.contact_stiffness * (delta - side * beta_) + p_.contact_damping * speed;
  }

  void close(int side, const double* z) {
    set_mode(side, 0, load_);
    if (load_ == 0) release_load(z);
  }

  void stop_load(double* z) {
    z[3] = 0.0;
    set_mode(contact_, outside_, 0);
    release_load(z);
  }

  void release_load(const double* z) {
    if (contact_ == 0) return;
    const double torque = contact_torque(contact_, z[0] - z[2], z[1] - z[3]);
    if (std::abs(torque) > p_.load_coulomb_friction) set_mode(contact_, 0, torque > 0.0 ? 1 : -1);
  }

  void set_mode(int contact, int outside, int load) {
    contact_ = contact, outside_ = outside, load_ = load;
    k_ = contact != 0 ? p_.contact_stiffness : 0.0;
    c_ = contact != 0 ? p_.contact_damping : 0.0;
    offset_ = k_ * contact * beta_;
    friction_ = load * p_.load_coulomb_friction;
    free_load_ = load != 0 ? inverse_m2_ : 0.0;
  }

  DriveParameters<double> p_;
  double beta_, inverse_m1_, inverse_m2_;
  double input_ = 0.0;  ///< Km u [N m]
  int contact_ = 0, outside_ = 0, load_ = 0;
  double k_ = 0.0, c_ = 0.0, offset_ = 0.0, friction_ = 0.0, free_load_ = 0.0;  ///< of the mode
};

}  // namespace gapscope::benchmark_peers

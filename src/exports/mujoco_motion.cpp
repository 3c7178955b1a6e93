#include "exports/mujoco_motion.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace gapscope::internal::exports {
namespace {

constexpr double kMostOfEngine = 1e10;  ///< mjMAXVAL: beyond, MuJoCo starts the motion anew
constexpr int kBodies = 2;
using Pair = std::array<double, kBodies>;

struct MujocoState {
  Pair x{}, v{};
  double torque = 0.0;  ///< behind the actuator's lag, in units of u
};
struct MujocoRates {
  Pair v{}, a{};
  double torque = 0.0;
};

/// A row of the constraints: the torque λ = −D (J a − a*) along J, within its limits.
struct SoftConstraint {
  Pair along{};
  double wanted = 0.0;  ///< a*
  double weight = 0.0;  ///< D = 1/R
  double low = 0.0, high = 0.0;
  int saturated = 0;  ///< −1 at low, +1 at high
};

double weight_of(double impedance, double mobility) { return impedance / ((1.0 - impedance) * mobility); }

class MujocoEngine {
 public:
  MujocoEngine(const MujocoDrive& drive, const MujocoStepping& stepping);
  void step(double u);
  double limited(double u) const;
  bool stands() const;
  double x1() const { return state_.x[0]; }

 private:
  MujocoRates rates(const MujocoState& at, double u);
  void add_friction(const MujocoState& at, int body);
  void add_contact(const MujocoState& at);
  Pair constrained(const Pair& smooth);
  bool settles(const Pair& smooth, Pair& acceleration);
  void euler(double u);
  void runge_kutta(double u);

  MujocoDrive drive_;
  MujocoStepping stepping_;
  MujocoState state_;
  int bodies_;
  std::array<SoftConstraint, 3> rows_;
  int count_ = 0;
  double fastest_ = 0.0;  ///< acceleration so far
};

MujocoEngine::MujocoEngine(const MujocoDrive& drive, const MujocoStepping& stepping)
    : drive_(drive), stepping_(stepping), bodies_(drive.has_load && !drive.locked ? 2 : 1) {
  for (std::size_t i = 0; i < kBodies; ++i) state_.x[i] = drive.place[i], state_.v[i] = drive.speed[i];
  state_.torque = limited(drive.first_input);
}

double MujocoEngine::limited(double u) const {
  return drive_.input_limit > 0.0 ? std::clamp(u, -drive_.input_limit, drive_.input_limit) : u;
}

bool MujocoEngine::stands() const {
  for (std::size_t i = 0; i < kBodies; ++i)
    if (!(std::abs(state_.x[i]) < kMostOfEngine && std::abs(state_.v[i]) < kMostOfEngine)) return false;
  return fastest_ < kMostOfEngine;
}

void MujocoEngine::add_friction(const MujocoState& at, int body) {
  const auto i = static_cast<std::size_t>(body);
  if (drive_.friction[i] <= 0.0) return;
  const bool given = !stepping_.default_friction;
  const double impedance = given ? kHardest : 0.9, hardest = given ? kHardest : 0.95;
  const double time = std::max(given ? kShortest : 0.02, 2.0 * stepping_.step);
  SoftConstraint row;
  row.along[i] = 1.0;
  row.wanted = -2.0 / (hardest * time) * at.v[i];
  row.weight = weight_of(impedance, 1.0 / drive_.inertia[i]);
  row.low = -drive_.friction[i], row.high = drive_.friction[i];
  rows_[count_++] = row;
}

/// The limit of the tendon on the side that is beyond it.
void MujocoEngine::add_contact(const MujocoState& at) {
  const double load = bodies_ == 2 ? at.x[1] : drive_.load_place, load_speed = bodies_ == 2 ? at.v[1] : 0.0;
  const double delta = at.x[0] - load;
  if (!drive_.has_load || std::abs(delta) <= drive_.half_gap) return;
  const double side = delta > 0.0 ? 1.0 : -1.0, mobility = drive_.contact_mobility();
  const double depth = std::abs(delta) - drive_.half_gap, speed = side * (at.v[0] - load_speed);
  SoftConstraint row;
  row.along = {-side, bodies_ == 2 ? side : 0.0};
  row.wanted = mobility / kSoftest * (drive_.stiffness * depth + drive_.contact_damping * speed);
  row.weight = weight_of(kSoftest, mobility);
  row.high = HUGE_VAL;
  rows_[count_++] = row;
}

/// The acceleration where each row is as `saturated` says.  @returns whether each then is within its limits
bool MujocoEngine::settles(const Pair& smooth, Pair& a) {
  double m[3] = {drive_.inertia[0], 0.0, bodies_ == 2 ? drive_.inertia[1] : 1.0};  // 11, 12, 22
  Pair right = {m[0] * smooth[0], m[2] * smooth[1]};
  for (int n = 0; n < count_; ++n) {
    const SoftConstraint& r = rows_[n];
    const double weight = r.saturated == 0 ? r.weight : 0.0;
    const double force = r.saturated == 0 ? r.weight * r.wanted : r.saturated < 0 ? r.low : r.high;
    m[0] += weight * r.along[0] * r.along[0], m[1] += weight * r.along[0] * r.along[1];
    m[2] += weight * r.along[1] * r.along[1];
    for (std::size_t i = 0; i < kBodies; ++i) right[i] += force * r.along[i];
  }
  const double determinant = m[0] * m[2] - m[1] * m[1];
  a = {(m[2] * right[0] - m[1] * right[1]) / determinant, (m[0] * right[1] - m[1] * right[0]) / determinant};
  for (int n = 0; n < count_; ++n) {
    const SoftConstraint& r = rows_[n];
    const double force = -r.weight * (r.along[0] * a[0] + r.along[1] * a[1] - r.wanted);
    if (r.saturated == 0 ? force < r.low || force > r.high : r.saturated < 0 ? force > r.low : force < r.high)
      return false;
  }
  return true;
}

/// The minimum, which is unique: of all ways in which the rows may be at their limits the one that fits.
Pair MujocoEngine::constrained(const Pair& smooth) {
  Pair a = smooth;
  const int ways = count_ == 0 ? 1 : count_ == 1 ? 3 : count_ == 2 ? 9 : 27;
  for (int way = 0; way < ways; ++way) {
    bool possible = true;
    for (int n = 0, rest = way; n < count_; ++n, rest /= 3) {
      SoftConstraint& row = rows_[n];
      row.saturated = rest % 3 - 1;
      possible = possible && !(row.saturated > 0 && std::isinf(row.high));
    }
    if (possible && settles(smooth, a)) break;
  }
  return a;
}

MujocoRates MujocoEngine::rates(const MujocoState& at, double u) {
  MujocoRates r;
  const bool lags = drive_.lag > 0.0;
  r.v = at.v;
  r.torque = lags ? (u - at.torque) / drive_.lag : 0.0;
  Pair torque = {drive_.torque_constant * (lags ? at.torque : u), 0.0};
  const std::size_t heavy = bodies_ == 2 ? 1 : 0;
  torque[heavy] -= drive_.unbalance * std::sin(at.x[heavy] + drive_.unbalance_phase);
  Pair smooth{};
  for (std::size_t i = 0; i < static_cast<std::size_t>(bodies_); ++i)
    smooth[i] = (torque[i] + drive_.constant[i] - drive_.damping[i] * at.v[i]) / drive_.inertia[i];
  count_ = 0;
  for (int body = 0; body < bodies_; ++body) add_friction(at, body);
  add_contact(at);
  r.a = constrained(smooth);
  fastest_ = std::max({fastest_, std::abs(r.a[0]), bodies_ == 2 ? std::abs(r.a[1]) : 0.0});
  return r;
}

void MujocoEngine::euler(double u) {
  const MujocoRates r = rates(state_, u);
  state_.torque += stepping_.step * r.torque;
  for (std::size_t i = 0; i < static_cast<std::size_t>(bodies_); ++i) {
    const double m = drive_.inertia[i];
    state_.v[i] += stepping_.step * r.a[i] * m / (m + stepping_.step * drive_.damping[i]);
    state_.x[i] += stepping_.step * state_.v[i];
  }
}

void MujocoEngine::runge_kutta(double u) {
  constexpr double kReach[] = {0.5, 0.5, 1.0}, kShare[] = {1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0};
  const auto moved = [](const MujocoState& from, const MujocoRates& r, double h) {
    MujocoState to = from;
    to.torque += h * r.torque;
    for (std::size_t i = 0; i < kBodies; ++i) to.x[i] += h * r.v[i], to.v[i] += h * r.a[i];
    return to;
  };
  MujocoRates stage = rates(state_, u);
  MujocoState end = moved(state_, stage, kShare[0] * stepping_.step);
  for (std::size_t n = 0; n < 3; ++n) {
    stage = rates(moved(state_, stage, kReach[n] * stepping_.step), u);
    end = moved(end, stage, kShare[n + 1] * stepping_.step);
  }
  state_ = end;
}

void MujocoEngine::step(double u) {
  u = limited(u);
  stepping_.integrator == MujocoIntegrator::kEuler ? euler(u) : runge_kutta(u);
}

}  // namespace

double MujocoDrive::contact_mobility() const { return 1.0 / inertia[0] + (locked ? 0.0 : 1.0 / inertia[1]); }

std::vector<double> mujoco_motion(const MujocoDrive& drive, const MujocoStepping& stepping,
                                  std::span<const double> u) {
  MujocoEngine engine(drive, stepping);
  std::vector<double> x1 = {engine.x1()};
  x1.reserve(u.size() + 1);
  for (const double input : u) {
    engine.step(input);
    if (!engine.stands()) break;
    x1.push_back(engine.x1());
  }
  return x1;
}

}  // namespace gapscope::internal::exports

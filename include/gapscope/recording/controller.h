#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "gapscope/base/statistics.h"
#include "gapscope/recording/loss.h"

namespace gapscope {

/// Which laws a controller has, and so what the target is.
enum class ControllerKind {
  kPosition,  ///< of the position alone
  kVelocity,  ///< of the speed alone: the target is a speed
  kCascade,   ///< the position's law asks for a speed, which the other one holds
};

/// A controller as a drive's firmware has it, of which the host commands the target. At each of its updates,
/// with e = target − position, 0 while |e| ≤ dead_band, and ẋ the position's difference to the update before,
///   position   y = gain e + derivative ė + integral ∫e dt
///   velocity   y = speed_gain v + speed_integral ∫v dt,   v = target − ẋ
///   cascade    the same with v = gain e − ẋ
/// y limited to ±saturation, where the integral rests. It acts `delay` later and is held until the next one
/// does. Where the gain falls with the error, e / (1 + |e/falls_at|^n)^(1/n) with n = falls_sharpness stands
/// for e: 1 falls from the smallest errors on, a large one limits the error. The target is the host's goal,
/// or where the firmware's own profile and filter have come to on the way to it (ShapedGoal). T is double, or
/// a Jet where derivatives are wanted.
template <class T>
struct ControllerOf {
  ControllerKind kind = ControllerKind::kPosition;
  double goal_delay = 0.0;        ///< of the goal alone, from the host to the controller [s]
  T gain{kNaN};                   ///< [input unit/rad]; in a cascade [1/s]
  T derivative{};                 ///< [input unit s/rad]
  T integral{};                   ///< [input unit/(rad s)]
  T speed_gain{};                 ///< [input unit s/rad]
  T speed_integral{};             ///< [input unit/rad]
  double rate = 0.0;              ///< of its updates [Hz]; 0: one at each row
  T delay{};                      ///< from the reading of the position to the change of the input [s]
  double saturation = kInfinity;  ///< of y [input unit]
  double dead_band = 0.0;         ///< [rad]
  double falls_at = kInfinity;    ///< error beyond which the gain falls [rad]
  double falls_sharpness = 2.0;   ///< how suddenly it does, see above
  double profile_speed = kInfinity, profile_acceleration = kInfinity;  ///< [rad/s], [rad/s²]
  double goal_filter = 0.0;   ///< time constant of a first-order filter of the goal [s]
  double off_damping = kNaN;  ///< of the motor's side while it is switched off; NaN: as ever [N m s/rad]
};
using DriveController = ControllerOf<double>;

/// The numbers of a controller that can be estimated, in the order of their settings.
struct ControllerNumberSpec {
  const char* key;   ///< "controller.position.gain"
  const char* unit;  ///< of a controller of the position
  double typical;    ///< over the leading gain: a size at which it would matter [s, 1/s, ...]
};
inline constexpr int kControllerNumberCount = 6;
inline constexpr ControllerNumberSpec kControllerNumbers[kControllerNumberCount] = {
    {"controller.position.gain", "unit of u/rad", 1.0},
    {"controller.position.derivative", "unit of u s/rad", 0.01},
    {"controller.position.integral", "unit of u/(rad s)", 1.0},
    {"controller.velocity.gain", "unit of u s/rad", 1.0},
    {"controller.velocity.integral", "unit of u/rad", 1.0},
    {"controller.delay", "s", 1.0},
};

/// Places in kControllerNumbers.
namespace controller_place {
enum : int { kGain, kDerivative, kIntegral, kSpeedGain, kSpeedIntegral, kDelay };
}

template <class T>
T& controller_number(ControllerOf<T>& c, int index) {
  T* const members[kControllerNumberCount] = {&c.gain,       &c.derivative,     &c.integral,
                                              &c.speed_gain, &c.speed_integral, &c.delay};
  return *members[index];
}

/// The number that all of y is proportional to, but for the integrals.
inline int leading_number(ControllerKind kind) {
  return kind == ControllerKind::kPosition ? controller_place::kGain : controller_place::kSpeedGain;
}

/// The goal as the firmware follows it: filtered, then under limits of speed and acceleration.
class ShapedGoal {
 public:
  /// @param span  since the last call [s]; 0: the first one, at which it stands at the goal
  /// @returns where it is [rad]
  template <class T>
  double follow(const ControllerOf<T>& c, double target, double span) {
    if (span <= 0.0) return position_ = filtered_ = target;
    filtered_ =
        c.goal_filter > 0.0 ? target + (filtered_ - target) * std::exp(-span / c.goal_filter) : target;
    if (!(c.profile_speed < kInfinity) && !(c.profile_acceleration < kInfinity)) return position_ = filtered_;
    const double pieces = c.rate > 0.0 ? 1.0 : std::ceil(span / kLongestPiece);
    for (double i = 0.0; i < pieces; ++i) move(c.profile_speed, c.profile_acceleration, span / pieces);
    return position_;
  }

 private:
  /// Of its motion, along which its speed is one [s]: a turn of the firmware, where that is not known this.
  static constexpr double kLongestPiece = 1e-3;

  void move(double speed, double acceleration, double h) {
    const double way = filtered_ - position_, far = std::abs(way);
    double wanted = std::min(speed, far / h);
    if (acceleration < kInfinity) {
      wanted = std::min(wanted, std::sqrt(2.0 * acceleration * far));
      const double most = acceleration * h;
      speed_ += std::clamp(std::copysign(wanted, way) - speed_, -most, most);
      if (far <= most * h && std::abs(speed_) <= 2.0 * most) speed_ = way / h;
    } else {
      speed_ = std::copysign(wanted, way);
    }
    position_ += speed_ * h;
  }

  double position_ = 0.0, speed_ = 0.0, filtered_ = 0.0;
};

/// A controller from one update to the next.
template <class T>
class ControllerLaw {
 public:
  explicit ControllerLaw(const ControllerOf<T>& numbers) : c_(numbers) {}

  /// @param time later than that of the update before [s]
  /// @returns y
  T update(double time, double target, const T& position) {
    const double span = started_ ? time - time_ : 0.0;
    const T e = error(goal_.follow(c_, target, span), position, span);
    const T sum = sum_ + e * span;
    T y = c_.kind == ControllerKind::kPosition ? c_.gain * e + c_.integral * sum
                                               : c_.speed_gain * e + c_.speed_integral * sum;
    if (started_ && c_.kind == ControllerKind::kPosition) y += c_.derivative * ((e - error_) / span);
    if (y < c_.saturation && y > -c_.saturation)
      sum_ = sum;
    else
      limit(y, e, sum);
    error_ = e, position_ = position, time_ = time, started_ = true;
    return y;
  }

 private:
  T error(double target, const T& position, double span) const {
    const T speed = started_ ? T((position - position_) / span) : T(0.0);
    if (c_.kind == ControllerKind::kVelocity) return target - speed;
    T e = target - position;
    if (e <= c_.dead_band && e >= -c_.dead_band) e = T(0.0);
    if (c_.falls_at < kInfinity) {
      using std::abs, std::pow, std::sqrt;
      const T over = e / c_.falls_at;
      const double n = c_.falls_sharpness;
      e = e / (n == 2.0 ? T(sqrt(1.0 + over * over)) : T(pow(1.0 + pow(abs(over), n), 1.0 / n)));
    }
    return c_.kind == ControllerKind::kPosition ? e : T(c_.gain * e - speed);
  }

  void limit(T& y, const T& e, const T& sum) {
    if (e * sum_ < 0.0) sum_ = sum;
    y = T(y > 0.0 ? c_.saturation : -c_.saturation);
  }

  const ControllerOf<T>& c_;
  ShapedGoal goal_;
  T error_{}, position_{}, sum_{};
  double time_ = 0.0;
  bool started_ = false;
};

/// What a host commanded and what the drive answered, the rows of a whole file.
struct CommandRows {
  std::vector<double> t;         ///< strictly increasing, 2 or more [s]
  std::vector<double> target;    ///< [rad]; [rad/s] for a controller of the speed
  std::vector<double> position;  ///< [rad]
  std::vector<double> supply;    ///< that multiplies what the controller asks for [V]; 1 without
  double gain_times = 1.0;       ///< the controller's leading number then, over the declared one [-]
  /// Lost rows over which the input is drawn to the next one; others hold it.
  std::vector<Loss> bridged = {};
  double off_from = kInfinity, off_to = kInfinity;  ///< times between which it was switched off [s]

  bool is_off(double time) const { return time >= off_from && time < off_to; }
};

/// The controller that was at work while rows were recorded.
template <class T>
ControllerOf<T> controller_during(const CommandRows& rows, ControllerOf<T> controller) {
  controller_number(controller, leading_number(controller.kind)) *= rows.gain_times;
  return controller;
}

namespace internal::recording {

/// A controller beside recorded rows. Between the rows the position is taken as linear and the target as
/// held; its first update is at the first row.
template <class T>
class RunningController {
 public:
  RunningController(const ControllerOf<T>& numbers, const CommandRows& rows)
      : c_(controller_during(rows, numbers)), rows_(rows), law_(c_) {
    output_ = update_at(rows_.t.front());
  }

  const T& output() const { return output_; }
  /// When the next output begins to act [s].
  T next_change() const { return next_update() + c_.delay; }
  RunningController(const RunningController&) = delete;
  RunningController& operator=(const RunningController&) = delete;

  void update() {
    output_ = update_at(next_update());
    ++updates_;
  }

 private:
  static constexpr double kSameTime = 1e-6;  ///< of a step: an update that close before a row is at it

  double next_update() const {
    if (c_.rate > 0.0) return rows_.t.front() + static_cast<double>(updates_ + 1) / c_.rate;
    return updates_ + 1 < rows_.t.size() ? rows_.t[updates_ + 1] : kInfinity;
  }

  T update_at(double time) {
    const std::vector<double>& t = rows_.t;
    while (row_ + 1 < t.size() && t[row_ + 1] - kSameTime * (t[row_ + 1] - t[row_]) <= time) ++row_;
    double x = rows_.position[row_];
    if (row_ + 1 < t.size()) x += (time - t[row_]) / (t[row_ + 1] - t[row_]) * (rows_.position[row_ + 1] - x);
    while (goal_ + 1 < t.size() &&
           t[goal_ + 1] - kSameTime * (t[goal_ + 1] - t[goal_]) <= time - c_.goal_delay)
      ++goal_;
    return law_.update(time, rows_.target[goal_], T(x));
  }

  ControllerOf<T> c_;
  const CommandRows& rows_;
  ControllerLaw<T> law_;
  std::size_t row_ = 0, goal_ = 0, updates_ = 0;
  T output_{};
};

}  // namespace internal::recording

/// What the controller made of the rows, times the supply: the mean of its held output over each row's
/// interval, so that the impulse is that of the drive.
/// @param first  row of the result; the controller is at work from the first row of all on
/// @param count  of rows
template <class T>
std::vector<T> commanded_input(const ControllerOf<T>& controller, const CommandRows& rows, std::size_t first,
                               std::size_t count) {
  internal::recording::RunningController<T> running(controller, rows);
  std::vector<T> u(count);
  for (std::size_t i = 0; i < first + count; ++i) {
    const double from = rows.t[i], to = i + 1 < rows.t.size() ? rows.t[i + 1] : from + (from - rows.t[i - 1]);
    T at(from), impulse(0.0);
    while (running.next_change() < to) {
      const T change = running.next_change();
      if (change > at) {
        impulse += (change - at) * running.output();
        at = change;
      }
      running.update();
    }
    if (i < first) continue;
    if (rows.is_off(from)) {
      u[i - first] = T(0.0);
      continue;
    }
    const T held = at == from ? running.output() : T((impulse + (to - at) * running.output()) / (to - from));
    u[i - first] = held * rows.supply[i];
  }
  for (const Loss& loss : rows.bridged)
    if (loss.row >= first && loss.row + 1 < first + count) bridge({loss.row - first, loss.lost}, u);
  return u;
}
std::vector<double> commanded_input(const DriveController& controller, const CommandRows& rows);

/// What the controller's input and one that was recorded beside it have in common.
struct InputComparison {
  double scale = kNaN;  ///< recorded over commanded, by least squares [-]
  double left = kNaN;  ///< rms of recorded − scale · commanded, over that of the recorded about its mean [-]
};

InputComparison compare_inputs(std::span<const double> recorded, std::span<const double> commanded);

}  // namespace gapscope

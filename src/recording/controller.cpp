#include "gapscope/recording/controller.h"

#include <algorithm>
#include <cmath>

#include "gapscope/base/require.h"

namespace gapscope {
namespace {

constexpr double kSameTime = 1e-6;  ///< of a step: an update that close before a row is at it

/// The controller beside a recording, from one update to the next.
class RunningController {
 public:
  RunningController(const PositionController& numbers, std::span<const double> t,
                    std::span<const double> target, std::span<const double> position)
      : c_(numbers), t_(t), target_(target), position_(position) {
    previous_ = error_at(t_.front());
    output_ = output_of(previous_, 0.0, 0.0);
  }

  double output() const { return output_; }
  /// When the next output begins to act [s].
  double next_change() const { return next_update() + c_.delay; }

  void update() {
    const double time = next_update(), span = time - last_, e = error_at(time);
    const double slope = (e - previous_) / span, sum = sum_ + e * span;
    output_ = output_of(e, slope, sum);
    if (std::abs(output_) < c_.saturation || e * sum_ < 0.0) sum_ = sum;
    previous_ = e, last_ = time, ++updates_;
  }

 private:
  double next_update() const {
    if (c_.rate > 0.0) return t_.front() + static_cast<double>(updates_ + 1) / c_.rate;
    return updates_ + 1 < t_.size() ? t_[updates_ + 1] : kInfinity;
  }

  double error_at(double time) {
    while (row_ + 1 < t_.size() && t_[row_ + 1] - kSameTime * (t_[row_ + 1] - t_[row_]) <= time) ++row_;
    double x = position_[row_];
    if (row_ + 1 < t_.size()) x += (time - t_[row_]) / (t_[row_ + 1] - t_[row_]) * (position_[row_ + 1] - x);
    const double e = target_[row_] - x;
    return std::abs(e) <= c_.dead_band ? 0.0 : e;
  }

  double output_of(double e, double slope, double sum) const {
    return std::clamp(c_.gain * e + c_.derivative * slope + c_.integral * sum, -c_.saturation, c_.saturation);
  }

  const PositionController& c_;
  std::span<const double> t_, target_, position_;
  std::size_t row_ = 0, updates_ = 0;
  double last_ = t_.front(), previous_ = 0.0, sum_ = 0.0, output_ = 0.0;
};

}  // namespace

std::vector<double> commanded_input(const PositionController& controller, std::span<const double> t,
                                    std::span<const double> target, std::span<const double> position) {
  GAPSCOPE_REQUIRE(t.size() >= 2 && target.size() == t.size() && position.size() == t.size());
  RunningController running(controller, t, target, position);
  std::vector<double> u(t.size());
  for (std::size_t i = 0; i < t.size(); ++i) {
    const double from = t[i], to = i + 1 < t.size() ? t[i + 1] : from + (from - t[i - 1]);
    double at = from, impulse = 0.0;
    while (running.next_change() < to) {
      const double change = std::max(running.next_change(), at);
      impulse += (change - at) * running.output();
      at = change;
      running.update();
    }
    u[i] = at == from ? running.output() : (impulse + (to - at) * running.output()) / (to - from);
  }
  return u;
}

InputComparison compare_inputs(std::span<const double> recorded, std::span<const double> commanded) {
  double product = 0.0, square = 0.0, left = 0.0, moved = 0.0;
  for (std::size_t i = 0; i < recorded.size(); ++i)
    product += recorded[i] * commanded[i], square += commanded[i] * commanded[i];
  InputComparison found;
  if (!(square > 0.0)) return found;
  found.scale = product / square;
  const double center = mean(recorded);
  for (std::size_t i = 0; i < recorded.size(); ++i) {
    left += std::pow(recorded[i] - found.scale * commanded[i], 2);
    moved += std::pow(recorded[i] - center, 2);
  }
  if (moved > 0.0) found.left = std::sqrt(left / moved);
  return found;
}

}  // namespace gapscope

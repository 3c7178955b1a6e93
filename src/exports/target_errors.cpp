#include "exports/target_errors.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "base/interrupt.h"

namespace gapscope::internal::exports {
namespace {

/// Steps per kCommonTime, and beyond it: 0.01, 0.02, 0.05, 0.1, 0.2, 0.4, 1, 2, 4, 8, 12, 20 ms.
constexpr double kListed[] = {400, 200, 80, 40, 20, 10, 4, 2, 1, 1.0 / 2, 1.0 / 3, 1.0 / 5};

// In parts of the travel: an error below which a target is not asked whether it is unstable, and a difference
// that says it is, ten thousand times what a billionth of the input is there at most.
constexpr double kWorthAsking = 1e-3, kGrown = 1e-5;

/// The input as a loop would set it that runs once a step.
std::vector<double> input_at_steps(const ExportSource& source, double step) {
  const double ratio = step / source.dt;
  const auto count = static_cast<std::size_t>(std::floor(source.duration() / step + 1e-9));
  std::vector<double> u(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto sample = static_cast<std::size_t>(static_cast<double>(i) * ratio + 1e-7);
    u[i] = source.u[std::min(sample, source.u.size() - 1)];
  }
  return u;
}

/// Whether one is a whole multiple of the other.
bool is_whole(double large, double small) {
  const double ratio = large / small;
  return ratio > 0.5 && std::abs(ratio - std::round(ratio)) <= 1e-6 * ratio;
}

/// Calls tell(i, k) for every step i that falls on the k-th place of comparison.
template <class Tell>
void at_judged(std::size_t steps, double step, const Tell& tell) {
  for (std::size_t i = 0; i < steps; ++i) {
    const double place = static_cast<double>(i) * step / kJudgedEvery, whole = std::round(place);
    if (std::abs(place - whole) <= 1e-6) tell(i, static_cast<std::size_t>(whole));
  }
}

}  // namespace

TargetError compared(const std::vector<double>& model, const std::vector<double>& target) {
  TargetError error;
  double sum = 0.0;
  error.max = 0.0;
  for (std::size_t i = 0; i < std::min(model.size(), target.size()); ++i) {
    const double e = target[i] - model[i];
    sum += e * e, error.max = std::max(error.max, std::abs(e));
  }
  error.rms = std::sqrt(sum / static_cast<double>(model.size()));
  error.diverges = target.size() < model.size() || !std::isfinite(error.rms);
  return error;
}

double range_of(const std::vector<double>& x1) {
  const auto [low, high] = std::minmax_element(x1.begin(), x1.end());
  return *high - *low;
}

TargetErrors::TargetErrors(const ExportSource& source) : source_(source) {
  std::vector<double> times;
  const auto count = static_cast<std::size_t>(std::floor(source.duration() / kJudgedEvery + 1e-9));
  for (std::size_t i = 0; i <= count; ++i) times.push_back(kJudgedEvery * static_cast<double>(i));
  model_ = model_motion(source, times);
  travel_ = range_of(model_);
}

TargetError TargetErrors::at(double step, const TargetMotion& motion) const {
  return against(model_, step, motion);
}

TargetError TargetErrors::against(const std::vector<double>& reference, double step,
                                  const TargetMotion& motion) const {
  stop_point();
  const std::vector<double> u = input_at_steps(source_, step);
  const std::vector<double> x1 = motion(step, u);
  TargetError error;
  error.step = step;
  if (x1.size() <= u.size()) {
    error.diverges = true;
    return error;
  }
  double sum = 0.0, compared = 0.0;
  error.max = 0.0;
  at_judged(x1.size(), step, [&](std::size_t i, std::size_t k) {
    if (k >= reference.size()) return;
    const double e = x1[i] - reference[k];
    sum += e * e, compared += 1.0;
    error.max = std::max(error.max, std::abs(e));
  });
  error.rms = std::sqrt(sum / compared);
  error.within_encoder = error.rms <= source_.encoder_floor;
  error.unstable = error.max > kWorthAsking * travel_ && grows(step, u, x1, motion);
  return error;
}

/// Whether a motion whose first input is another by a billionth is another one in the end: what a stable
/// engine forgets.
bool TargetErrors::grows(double step, std::vector<double> u, const std::vector<double>& x1,
                         const TargetMotion& motion) const {
  u.front() += 1e-9 * std::abs(*std::max_element(
                          u.begin(), u.end(), [](double a, double b) { return std::abs(a) < std::abs(b); }));
  const std::vector<double> other = motion(step, u);
  for (std::size_t i = 0; i < std::min(x1.size(), other.size()); ++i)
    if (std::abs(x1[i] - other[i]) > kGrown * travel_) return true;
  return other.size() < x1.size();
}

std::vector<double> TargetErrors::own_motion(double step, const TargetMotion& motion) const {
  const std::vector<double> x1 = motion(step, input_at_steps(source_, step));
  std::vector<double> judged(model_.size(), kNaN);
  at_judged(x1.size(), step, [&](std::size_t i, std::size_t k) {
    if (k < judged.size()) judged[k] = x1[i];
  });
  while (!judged.empty() && std::isnan(judged.back())) judged.pop_back();
  return judged;
}

/// Of the steps kCommonTime/n, by bisection of n.
double TargetErrors::between(double good, double bad, const std::vector<double>& reference,
                             const TargetMotion& motion) const {
  double most = std::round(kCommonTime / good), fewest = std::round(kCommonTime / bad);
  while (most - fewest > std::max(1.0, 0.05 * most)) {
    const double middle = std::floor(0.5 * (most + fewest));
    (stands(against(reference, kCommonTime / middle, motion)) ? most : fewest) = middle;
  }
  return kCommonTime / most;
}

bool TargetErrors::steps_fall_on_rows() const {
  return std::any_of(std::begin(kListed), std::end(kListed),
                     [&](double n) { return is_whole(source_.dt, kCommonTime / n); });
}

StepLimits TargetErrors::scan(const std::string& integrator, const TargetMotion& motion,
                              std::vector<TargetError>& errors) const {
  StepLimits limits;
  limits.integrator = integrator;
  bool within = true;
  const bool on_rows = steps_fall_on_rows();
  std::vector<double> own;
  for (const double n : kListed) {
    const double step = kCommonTime / n;
    if (on_rows && !is_whole(source_.dt, step) && !is_whole(step, source_.dt)) continue;
    TargetError error = at(step, motion);
    error.integrator = integrator;
    errors.push_back(error);
    within = within && error.within_encoder;
    if (within) limits.within_encoder = step;
    const bool finest = std::isnan(limits.largest);
    if (finest && is_steady(error) && !stands(error)) own = own_motion(step, motion);
    limits.against_itself = !own.empty();
    if (!stands(own.empty() ? error : against(own, step, motion))) {
      if (!std::isnan(limits.largest) && n >= 1.0)
        limits.largest = between(limits.largest, step, own.empty() ? model_ : own, motion);
      break;
    }
    limits.largest = step;
  }
  return limits;
}

}  // namespace gapscope::internal::exports

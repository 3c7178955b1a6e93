#include "diagnosis/second_encoder.h"

#include <algorithm>
#include <cmath>

#include "diagnosis/comparison.h"
#include "signals/encoder.h"

namespace gapscope {
namespace {

/// Squared error of a model's x2 about its mean, and that of the recorded x2: what standing still leaves.
struct LoadError {
  double missed = 0.0, moved = 0.0;
};

LoadError load_error(const std::vector<double>& recorded, const std::vector<double>& run) {
  std::vector<double> e;
  for (std::size_t i = 0; i < run.size(); ++i) e.push_back(recorded[i] - run[i]);
  const double offset = mean(e), center = mean(recorded);
  LoadError sum;
  for (const double v : e) sum.missed += std::pow(v - offset, 2);
  for (const double x : recorded) sum.moved += std::pow(x - center, 2);
  return sum;
}

/// What quantum and noise of the load's encoder leave, read off its samples, over all recordings [rad].
double load_floor(std::span<const Recording> recordings) {
  double sum = 0.0, count = 0.0;
  for (const Recording& r : recordings) {
    const MotorTrace trace{r.file, r.start, r.dt, r.u, r.x2, seen_quantum(r.x2), r.stamps};
    const double n = static_cast<double>(r.x2.size());
    sum += n * std::pow(internal::signals::encoder_floor(trace), 2), count += n;
  }
  return std::sqrt(sum / count);
}

void judge_run(std::span<const Recording> recordings, const FitSummary& fit, SecondEncoder& second) {
  double missed = 0.0, count = 0.0, worst = kInfinity;
  for (std::size_t r = 0; r < std::min(recordings.size(), fit.traces.size()); ++r) {
    const std::vector<double>& run = fit.traces[r].x2;
    if (run.size() != recordings[r].x2.size()) return;
    const LoadError error = load_error(recordings[r].x2, run);
    missed += error.missed, count += static_cast<double>(run.size());
    worst = std::min(worst, 100.0 * (1.0 - std::sqrt(error.missed / error.moved)));
  }
  if (!(count > 0.0)) return;
  second.rmse = std::sqrt(missed / count);
  second.motor_rmse = fit.rmse;
  if (std::isfinite(worst)) second.fit_percent = worst;
}

}  // namespace

SecondEncoder validate_by_load(std::span<const Recording> recordings, const FitSummary* reference) {
  SecondEncoder second;
  const bool recorded = std::all_of(recordings.begin(), recordings.end(),
                                    [](const Recording& r) { return !r.x1.empty() && !r.x2.empty(); });
  if (recordings.empty() || !recorded) return second;
  second.floor = load_floor(recordings);
  second.gap = map_width(recordings);
  if (reference == nullptr) return second;
  judge_run(recordings, *reference, second);
  const FittedParameter* gap = reference->find("gap");
  if (gap != nullptr && gap->identifiable && !reference->rejected())
    second.difference = gap->value - second.gap;
  return second;
}

}  // namespace gapscope

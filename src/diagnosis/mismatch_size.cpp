#include "diagnosis/mismatch_size.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "gapscope/base/statistics.h"

namespace gapscope::internal::diagnosis {
namespace {

/// √ of the variance that white noise of variance 1 leaves in the innovations of an observer on a free mass:
/// (1 − z⁻¹)²/(1 − p z⁻¹)².
double noise_gain(double hz, double dt) {
  const double p = std::exp(-2.0 * kPi * hz * dt);
  double sum = 0.0, e1 = 0.0, e2 = 0.0;
  for (int k = 0; k < 5000; ++k) {
    const double input = k == 0 ? 1.0 : k == 1 ? -2.0 : k == 2 ? 1.0 : 0.0;
    const double e = input + 2.0 * p * e1 - p * p * e2;
    sum += e * e;
    e2 = e1, e1 = e;
  }
  return std::sqrt(sum);
}

/// Where the shrink of the next recording of the same drive lies, by its size in floors. Another excitation
/// shows more or less of what is missing and of what remains, and near the floor recordings differ anyway.
/// @param least, most  shares that a model may leave
Interval shrink_interval(double before, double least, double most) {
  const double room = std::max(before / kTelling.other_recording, std::min(before, 2.0)) - 1.0;
  const double spread = kTelling.floor_spread / room;
  return {1.0 - kTelling.other_recording * most - spread, 1.0 - least / kTelling.other_recording + spread};
}

/// The same of what leaves one share.
Interval shrink_interval(double before, double shrink) {
  if (!std::isfinite(shrink)) return {};
  const double remaining = std::max(0.0, 1.0 - shrink);
  const Interval i = shrink_interval(before, remaining, remaining);
  return {std::min(i.low, shrink), std::max(i.high, shrink)};
}

/// Of the free runs, in any recording.
double pooled(const HeldOut& held_out, double (HeldOut::*floor)(std::size_t) const) {
  double sum = 0.0;
  for (std::size_t r = 0; r < held_out.traces.size(); ++r) sum += std::pow((held_out.*floor)(r), 2);
  return std::sqrt(sum / static_cast<double>(held_out.traces.size()));
}
double pooled_free_floor(const HeldOut& held_out) { return pooled(held_out, &HeldOut::free_floor); }

/// Whether what the supply's readings leave open is more than what the encoder does.
bool is_open_by_supply(const HeldOut& held_out) {
  return !held_out.free_open.empty() &&
         pooled_free_floor(held_out) > std::sqrt(2.0) * pooled(held_out, &HeldOut::free_encoder_floor);
}

/// What a floor was read from.
std::string floor_words(const HeldOut& held, FloorSource from) {
  if (from == FloorSource::kRepeatability) return held.repeats_in;
  std::string files;
  for (const MotorTrace& t : held.traces) files += (files.empty() ? "" : ", ") + t.file;
  if (is_open_by_supply(held)) return "the steps in which the supply is read in " + files;
  return (from == FloorSource::kNoise ? "the noise of x1 in " : "the quantum of the encoder in ") + files;
}

}  // namespace

double pooled_floor(const HeldOut& held_out) {
  double sum = 0.0;
  for (const double floor : held_out.floors) sum += floor * floor;
  return std::sqrt(sum / static_cast<double>(held_out.floors.size()));
}

double shrink_of(double before, double after) {
  return before >= kRule.floor_ratio ? (before - after) / (before - 1.0) : kNaN;
}

std::vector<double> Windows::*judged_windows(const Study& study) {
  // Free runs of a drive that does not repeat itself drift.
  return study.repeats_badly() ? &Windows::innovation : &Windows::free;
}

double judged_floor(const Study& study) {
  const HeldOut& held = study.held_out;
  return study.repeats_badly() ? std::max(pooled_floor(held), held.innovation_repeats)
                               : pooled_free_floor(held);
}

namespace {

/// Whether a model leaves clearly less than the drive is taken to vary by itself: then it does not. Where x1
/// slides from period to period, what repeats with the angle reads as if it did not repeat.
bool refutes(double left, double varies) { return left * kRule.floor_ratio < varies; }

}  // namespace

MismatchSize mismatch_size(const Study& study, const ScoredModel& before, const ScoredModel& after) {
  const HeldOut& held = study.held_out;
  const bool predicted = study.repeats_badly() || is_led_astray(after, before);
  const auto windows = predicted ? &Windows::innovation : &Windows::free;
  const double encoder = pooled_floor(held);
  const double varies = predicted ? std::max(encoder, held.innovation_repeats) : judged_floor(study);
  const double restart = held.traces.front().dt * static_cast<double>(held.restart(0));
  MismatchSize size;
  size.judged_by = predicted ? JudgedBy::kPrediction : JudgedBy::kFreeRun;
  size.measure =
      predicted ? fmt::format("prediction of an observer at {:g} Hz, median over windows of the rms",
                              study.observer_hz)
                : fmt::format("free run restarted every {:.3g} s, median over windows of the rms", restart);
  size.before = varies * median_size(before.windows.*windows);
  size.after = varies * median_size(after.windows.*windows);
  const bool repeats = study.repeats_badly() && !refutes(size.after, varies);
  size.floor = predicted && !repeats ? encoder : varies;
  const double b = size.before / size.floor, a = size.after / size.floor;
  const bool noisy = is_open_by_supply(held) || encoder > 1.1 * held.traces.front().quantum / std::sqrt(12.0);
  size.floor_from = repeats ? FloorSource::kRepeatability
                    : noisy ? FloorSource::kNoise
                            : FloorSource::kEncoder;
  size.floor_of = floor_words(held, size.floor_from);
  size.shrink = shrink_of(b, a);
  if (&after != &before) size.shrink_ci95 = shrink_interval(b, size.shrink);
  size.remains = a;
  return size;
}

std::optional<AsConfigured> as_configured(const Study& study) {
  const ReferenceModel& sheet = study.sheet;
  const reference::ModelFit fit(study.held_out.traces, sheet, study.options.fit, study.observer_hz);
  if (!fit.values_are_given() || fit.given_point().q.empty()) return {};
  const std::vector<Playback> played = play(sheet, study.held_out, study.observer_hz, false);
  if (played.empty()) return AsConfigured{};
  const Windows windows = windows_of(played, study.held_out);
  return AsConfigured{judged_floor(study) * median_size(windows.*judged_windows(study))};
}

Interval law_shrink_interval(const Study& study, const ScoredModel& before, const ScoredModel& after) {
  const auto windows = judged_windows(study);
  const std::vector<double>&b = before.windows.*windows, &a = after.windows.*windows;
  const double size = median_size(b), shrink = shrink_of(size, median_size(a));
  if (!std::isfinite(shrink)) return {};
  std::vector<double> shares;
  for (std::size_t i = 0; i < b.size(); ++i)
    if (b[i] > kRule.floor_ratio * kRule.floor_ratio) shares.push_back(std::sqrt(a[i] / b[i]));
  const double remaining = std::max(0.0, 1.0 - shrink);
  const double most = std::max(remaining, std::sqrt(mean(a) / mean(b)));
  const double least = shares.empty() ? remaining : std::min(remaining, quantile(shares, kRule.best_windows));
  return shrink_interval(size, least, most);
}

std::vector<MismatchMeasure> measures_of(const Study& study, const std::vector<Playback>& before,
                                         const std::vector<Playback>& after) {
  if (before.empty() || after.empty()) return {};
  const HeldOut& held = study.held_out;
  const Windows b = windows_of(before, held), a = windows_of(after, held);
  const double encoder = pooled_floor(held), dt = held.traces.front().dt;
  const double free = pooled_free_floor(held);
  const auto row = [&](const std::string& name, double unit, double floor,
                       std::vector<double> Windows::*squares) {
    return MismatchMeasure{name, study.options.coordinates.position_unit(), unit * median_size(b.*squares),
                           unit * median_size(a.*squares), floor};
  };
  const double slow_floor = study.repeats_badly() ? kNaN : encoder * noise_gain(kMeasure.slow_hz, dt);
  const bool refuted = refutes(encoder * median_size(a.fast), held.innovation_repeats);
  const double fast_floor =
      std::max(encoder * noise_gain(kMeasure.fast_hz, dt), refuted ? 0.0 : held.innovation_repeats);
  // The correcting torque is that observer's and goes with what it fails to predict: so does its floor.
  return {
      row(fmt::format("free run restarted every {:.3g} s", dt * static_cast<double>(held.restart(0))), free,
          free, &Windows::free),
      row(fmt::format("prediction at {:g} Hz", kMeasure.slow_hz), encoder, slow_floor, &Windows::slow),
      row(fmt::format("prediction at {:g} Hz", kMeasure.fast_hz), encoder, fast_floor, &Windows::fast),
      {std::string("residual ") + study.options.coordinates.torque_word(),
       study.options.coordinates.torque_unit(), median_size(b.torque), median_size(a.torque),
       study.repeats_badly() ? kNaN : median_size(a.torque) * fast_floor / (encoder * median_size(a.fast))}};
}

double undetermined_by(const Study& study, const ReferenceModel& model) {
  const double hz = study.observer_hz;
  const std::vector<MotorTrace>& held = study.held_out.traces;
  const reference::ModelFit fit(study.train, model, study.options.fit, hz),
      other(held, model, study.options.fit, hz);
  return pooled_floor(study.held_out) *
         fit.prediction_std(fit.point_of(model, settled_starts(study.train, model, hz)), other,
                            other.point_of(model, settled_starts(held, model, hz)));
}

namespace {

/// Of each recording; empty where a motion diverges.
std::vector<double> largest_errors(const HeldOut& held, const Positions& positions) {
  std::vector<double> errors(positions.size());
  for (std::size_t r = 0; r < errors.size(); ++r)
    for (std::size_t i = held.scored_from[r]; i < positions[r].size(); ++i)
      errors[r] = std::max(errors[r], std::abs(held.traces[r].x1[i] - positions[r][i]));
  return errors;
}

}  // namespace

WholeRun whole_run(const HeldOut& held, const Positions& before, const Positions& after) {
  const std::vector<double> b = largest_errors(held, before), a = largest_errors(held, after);
  const auto largest = [](const std::vector<double>& errors) {
    return errors.empty() ? kNaN : *std::max_element(errors.begin(), errors.end());
  };
  const std::size_t worst =
      b.empty() ? 0 : static_cast<std::size_t>(std::max_element(b.begin(), b.end()) - b.begin());
  const auto [low, high] = std::minmax_element(held.traces[worst].x1.begin(), held.traces[worst].x1.end());
  return {largest(b), largest(a), *high - *low};
}

double weight_of(const ScoredModel& candidate, const ScoredModel& best) {
  return std::isfinite(candidate.score)
             ? std::exp(-std::max(0.0, candidate.score - best.score) / kRule.tells_apart)
             : 0.0;
}

}  // namespace gapscope::internal::diagnosis

namespace gapscope {

bool is_told_in_torque(const Diagnosis& d) {
  using internal::diagnosis::kRule;
  const MismatchSize& m = d.mismatch;
  if (d.added.empty() || !std::isfinite(m.before_torque)) return std::isfinite(m.before_torque);
  const double motion_left = std::max(0.0, (m.after - m.floor) / (m.before - m.floor));
  const bool tellable = m.before >= kRule.floor_ratio * m.floor;  // at the floor no motion falls any more
  // The encoder's noise is torque, too: what is left at its floor may be most of what there was.
  const bool noise_hides = m.after < kRule.floor_ratio * m.floor && 2.0 * m.after_torque > m.before_torque;
  if (tellable && noise_hides) return false;
  if (!d.budget.uncounted.empty())
    return tellable && m.after_torque <= (motion_left + kRule.torque_behind_motion) * m.before_torque;
  // An elasticity moves x1, and takes no torque.
  const double fall = 1.0 - m.after_torque / m.before_torque;
  return !(tellable && fall < kRule.torque_behind_motion * (1.0 - motion_left));
}

}  // namespace gapscope

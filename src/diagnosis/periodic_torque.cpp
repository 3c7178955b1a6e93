#include "diagnosis/periodic_torque.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "diagnosis/step.h"
#include "gapscope/base/statistics.h"

namespace gapscope::internal::diagnosis {
namespace {

using Values = std::vector<double>;

/// What the observer makes of a torque: the double pole that its correcting torque answers with, of uneven
/// sampling at the mean step.
class Passed {
 public:
  explicit Passed(double dt) : p_(std::exp(-2.0 * kPi * kMeasure.ripple_hz * dt)) {}
  /// @param torque mean of the step that begins at this sample
  double operator()(double torque) {
    second_ = p_ * second_ + (1.0 - p_) * first_;
    first_ = p_ * first_ + (1.0 - p_) * 0.5 * (torque + last_);
    last_ = torque;
    return second_;
  }

 private:
  double p_, first_ = 0.0, second_ = 0.0, last_ = 0.0;
};

struct Waves {
  Values sine, cosine;
};

Waves waves_of(const MotorTrace& trace, double periods) {
  Waves w;
  Passed sine(trace.dt), cosine(trace.dt);
  for (std::size_t i = 0; i < trace.size(); ++i) {
    const double middle = 0.5 * (trace.x1[i] + trace.x1[std::min(i + 1, trace.size() - 1)]);
    w.sine.push_back(sine(std::sin(periods * middle)));
    w.cosine.push_back(cosine(std::cos(periods * middle)));
  }
  return w;
}

void add(const Waves& w, const Values& torque, std::size_t from, std::size_t to, LineSums& sums) {
  for (std::size_t i = from; i < to; ++i) {
    sums.add(w.sine[i], w.cosine[i], torque[i]);
    sums.square += torque[i] * torque[i];
  }
}

bool improves(const Harmonic& line, const Waves& w, const Values& torque, std::size_t from, std::size_t to) {
  double before = 0.0, after = 0.0;
  for (std::size_t i = from; i < to; ++i) {
    const double left = torque[i] - line.sine * w.sine[i] - line.cosine * w.cosine[i];
    before += torque[i] * torque[i], after += left * left;
  }
  return after < before;
}

void take_out(const Harmonic& line, std::span<const MotorTrace> traces, std::vector<Values>& torque) {
  for (std::size_t r = 0; r < traces.size(); ++r) {
    const Waves w = waves_of(traces[r], line.periods);
    for (std::size_t i = 0; i < torque[r].size(); ++i)
      torque[r][i] -= line.sine * w.sine[i] + line.cosine * w.cosine[i];
  }
}

/// The observer's answer run backwards in time: Σ (passed s) τ = Σ s (passed back τ) for every line s.
std::vector<Values> passed_back(std::span<const Values> torque, std::span<const MotorTrace> traces) {
  std::vector<Values> back(torque.begin(), torque.end());
  for (std::size_t r = 0; r < back.size(); ++r) {
    Passed passed(traces[r].dt);
    for (std::size_t i = back[r].size(); i-- > 0;) back[r][i] = passed(back[r][i]);
  }
  return back;
}

/// Speeds that the recordings come by, of differences that an observer as fast as this follows.
Values speeds_of(std::span<const MotorTrace> traces) {
  constexpr std::size_t kSpeeds = 400;  // of one recording
  Values speeds;
  for (const MotorTrace& t : traces) {
    const std::size_t reach = 1 + static_cast<std::size_t>(0.5 / (kMeasure.ripple_hz * t.dt));
    for (std::size_t i = 0; i + reach < t.size(); i += 1 + t.size() / kSpeeds)
      speeds.push_back((t.x1[i + reach] - t.x1[i]) / (static_cast<double>(reach) * t.dt));
  }
  return speeds;
}

/// What each line explains, as the observer passes it on: one that it follows late and in part, as the drive
/// runs fast, is not spread over its neighbours. Amplitudes are those of fitted_line().
std::vector<Harmonic> passed_spectrum(std::span<const Values> torque, std::span<const MotorTrace> traces) {
  const std::vector<Values> back = passed_back(torque, traces);
  const Values speeds = speeds_of(traces);
  double square = 0.0, square_back = 0.0;
  for (std::size_t r = 0; r < back.size(); ++r)
    for (std::size_t i = 0; i < back[r].size(); ++i)
      square += torque[r][i] * torque[r][i], square_back += back[r][i] * back[r][i];
  std::vector<Harmonic> spectrum = angle_spectrum(back, traces, 0.0);
  for (Harmonic& line : spectrum) {
    double passed = speeds.empty() ? 1.0 : 0.0;  // power of a line of unit power that two poles leave
    for (const double w : speeds) {
      const double f = line.periods * w / (2.0 * kPi * kMeasure.ripple_hz);
      passed += 1.0 / ((1.0 + f * f) * (1.0 + f * f)) / static_cast<double>(speeds.size());
    }
    line.explained *= square_back / std::max(passed * square, 1e-300);
  }
  return spectrum;
}

/// Share of each line over the median of its neighbours'.
Values standing_of(const std::vector<Harmonic>& spectrum, double per_cycle) {
  Values over;
  for (const Harmonic& line : spectrum) {
    const double apart = kLineSearch.neighbours * per_cycle;
    Values around;
    for (const Harmonic& other : spectrum)
      if (const double distance = std::abs(other.periods - line.periods);
          distance > per_cycle && distance < apart)
        around.push_back(other.explained);
    over.push_back(around.empty() ? 0.0 : line.explained / std::max(median(std::move(around)), 1e-12));
  }
  return over;
}

/// The line that stands out, and its share over its neighbours': one that explains more than half of the
/// torque, as no two can, whatever its side lobes are; else the one that is farthest above its neighbours.
std::optional<std::pair<Harmonic, double>> standing_out(const std::vector<Harmonic>& spectrum,
                                                        double per_cycle) {
  if (spectrum.empty()) return {};
  const Values over = standing_of(spectrum, per_cycle);
  const auto strongest = static_cast<std::size_t>(
      std::max_element(spectrum.begin(), spectrum.end(),
                       [](const Harmonic& a, const Harmonic& b) { return a.explained < b.explained; }) -
      spectrum.begin());
  const bool repeats = spectrum[strongest].periods > 2.0 * per_cycle;  // more than once over the travel
  const bool most = repeats && spectrum[strongest].explained > 0.5;
  const std::size_t best =
      most ? strongest : static_cast<std::size_t>(std::max_element(over.begin(), over.end()) - over.begin());
  if (!most && !(over[best] > kLineSearch.stands_out)) return {};
  return std::pair(spectrum[best], over[best]);
}

/// The period at the top of the parabola through what a line explains and what those beside it do.
Harmonic refined(std::span<const Values> torque, std::span<const MotorTrace> traces, double periods) {
  const double step = kLineSearch.step * one_cycle(traces);
  Harmonic best = fitted_line(torque, traces, periods).line;
  const double below = fitted_line(torque, traces, periods - step).line.explained;
  const double above = fitted_line(torque, traces, periods + step).line.explained;
  const double bend = below - 2.0 * best.explained + above;
  if (!(bend < 0.0)) return best;
  const double top = std::clamp(0.5 * (below - above) / bend, -1.0, 1.0);
  const Harmonic line = fitted_line(torque, traces, periods + top * step).line;
  return line.explained > best.explained ? line : best;
}

}  // namespace

std::vector<Values> ripples_of(const std::vector<Playback>& playbacks) {
  std::vector<Values> torque;
  for (const Playback& p : playbacks) {
    const double most = kLineSearch.spike * robust_std(p.ripple);
    torque.push_back(p.ripple);
    for (double& t : torque.back()) t = std::clamp(t, -most, most);
  }
  return torque;
}

TorqueLine fitted_line(std::span<const Values> torque, std::span<const MotorTrace> traces, double periods) {
  LineSums sums;
  for (std::size_t r = 0; r < traces.size(); ++r)
    add(waves_of(traces[r], periods), torque[r], 0, torque[r].size(), sums);
  return {sums.line(periods), kNaN};
}

std::vector<TorqueLine> standing_lines(std::vector<Values> torque, std::span<const MotorTrace> traces) {
  std::vector<TorqueLine> lines;
  if (torque.size() != traces.size()) return lines;
  while (lines.size() < SearchEffort{}.lines) {
    const std::vector<Harmonic> spectrum = passed_spectrum(torque, traces);
    const auto found = standing_out(spectrum, one_cycle(traces));
    if (!found) break;
    const Harmonic line = refined(torque, traces, found->first.periods);
    lines.push_back({line, found->second});
    take_out(line, traces, torque);
  }
  return lines;
}

bool LineCheck::holds() const { return windows > 0 && wilson(better, windows).low > 0.5; }

LineCheck check_line(double periods, std::span<const Values> torque, const HeldOut& held_out) {
  LineCheck check;
  for (std::size_t r = 0; r < torque.size(); ++r) {
    const Waves w = waves_of(held_out.traces[r], periods);
    const std::size_t restart = held_out.restart(r), half = restart / 2;
    const std::size_t from = (held_out.scored_from[r] + restart) / restart * restart;
    const std::size_t windows = torque[r].size() > from ? (torque[r].size() - from) / half : 0;
    LineSums every_other[2];
    for (std::size_t k = 0; k < windows; ++k)
      add(w, torque[r], from + k * half, from + (k + 1) * half, every_other[k % 2]);
    for (std::size_t k = 0; k < windows; ++k) {
      const Harmonic line = every_other[1 - k % 2].line(periods);
      ++check.windows;
      check.better += improves(line, w, torque[r], from + k * half, from + (k + 1) * half) ? 1 : 0;
    }
  }
  return check;
}

std::vector<double> given_periods(const DiagnosisKnowledge& known) {
  std::vector<double> n = known.periods_per_turn;
  for (const double period : known.periods) n.push_back(2.0 * kPi / period);
  return n;
}

std::vector<PeriodicTorque> periodic_torques(const Study& study, const ReferenceModel& model,
                                             const std::vector<Playback>& held_out) {
  const std::vector<Values> fitted = ripples_of(play_on_train(study, model));
  const std::vector<Values> held = ripples_of(held_out);
  if (fitted.empty() || held.empty()) return {};
  std::vector<PeriodicTorque> found;
  const auto tell = [&](const TorqueLine& line, bool given) {
    const LineCheck check = check_line(line.line.periods, held, study.held_out);
    if (!given && !check.holds()) return;
    found.push_back({line.line.periods, 2.0 * kPi / line.line.periods,
                     std::hypot(line.line.sine, line.line.cosine),
                     std::atan2(-line.line.cosine, -line.line.sine), line.over, check.windows, check.better,
                     check.holds(), given});
  };
  for (const double n : given_periods(study.options.known)) tell(fitted_line(fitted, study.train, n), true);
  for (const TorqueLine& line : standing_lines(fitted, study.train))
    if (!is_of_encoder(line.line.periods, study.train) &&
        std::none_of(found.begin(), found.end(), [&](const PeriodicTorque& other) {
          return std::abs(other.periods_per_turn - line.line.periods) < one_cycle(study.train);
        }))
      tell(line, false);
  return found;
}

}  // namespace gapscope::internal::diagnosis

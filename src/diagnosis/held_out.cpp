#include "diagnosis/held_out.h"

#include <algorithm>
#include <cmath>

#include "reference/observer.h"

namespace gapscope::internal::diagnosis {
namespace {

constexpr double kAsWrongAsCanBe = 1e12;  // a mean square of a window, in floors²

/// What an error is beyond the half count that a coarser encoder explains.
double beyond_count(double error, double quantum) {
  if (quantum <= 0.0) return error;
  return std::copysign(std::max(0.0, std::abs(error) - 0.5 * quantum), error);
}

/// The quantum that the model itself gives the encoder; 0 without such an effect.
double model_quantum(const PlantModel<double>& model) {
  for (const ActiveEffect<double>& e : model.effects)
    if (e.hooks->quantum != nullptr) return e.hooks->quantum(e.parameters);
  return 0.0;
}

bool play_scored(const PlantModel<double>& model, const DriveState<double>& start, const MotorTrace& trace,
                 std::size_t restart, double hz, Playback& out) {
  const reference::ObserverGains gains(hz, trace);
  const double quantum = model_quantum(model);
  DriveStepper<double> runner = reference::stepper_for(model, trace);
  out.innovation.resize(trace.size());
  out.free.resize(trace.size());
  const auto [low, high] = std::minmax_element(trace.x1.begin(), trace.x1.end());
  const double lost = *high - *low;  // the error of a free run that diverges
  return reference::roll_out(
      model, start, trace, gains, [&](std::size_t i, const DriveStepper<double>& observer) {
        if (i % restart == 0) runner = observer;
        out.innovation[i] = beyond_count(trace.x1[i] - observer.measured(), quantum);
        out.free[i] = runner.healthy() ? beyond_count(trace.x1[i] - runner.measured(), quantum) : lost;
        if (runner.healthy()) reference::play_step(runner, trace, i);
      });
}

bool play_slow(const PlantModel<double>& model, const DriveState<double>& start, const MotorTrace& trace,
               Playback& out) {
  const double quantum = model_quantum(model);
  return reference::roll_out(model, start, trace, reference::ObserverGains(kMeasure.slow_hz, trace),
                             [&](std::size_t i, const DriveStepper<double>& observer) {
                               out.slow.push_back(beyond_count(trace.x1[i] - observer.measured(), quantum));
                             });
}

/// Correcting torque of an observer's innovation.
class ResidualTorque {
 public:
  ResidualTorque(const PlantModel<double>& model, const reference::ObserverGains& gains)
      : gains_(gains), inertia_(model.drive.motor_inertia) {
    if (model.structure.has_load && model.structure.load == LoadKind::kFree)
      both_ = 1.0 + model.drive.mass_ratio;
  }
  /// At sample i, of the interval that ends there.
  double operator()(std::size_t i, const DriveStepper<double>& observer, double error) const {
    const double motor = inertia_ * gains_.at(i).speed / gains_.interval(i);
    return (observer.mode().contact != 0 ? motor * both_ : motor) * error;
  }

 private:
  const reference::ObserverGains& gains_;
  double inertia_, both_ = 1.0;
};

bool play_fast(const PlantModel<double>& model, const DriveState<double>& start, const MotorTrace& trace,
               Playback& out) {
  const reference::ObserverGains gains(kMeasure.fast_hz, trace);
  const double quantum = model_quantum(model);
  const ResidualTorque torque(model, gains);
  return reference::roll_out(
      model, start, trace, gains, [&](std::size_t i, const DriveStepper<double>& observer) {
        const double e = beyond_count(trace.x1[i] - observer.measured(), quantum);
        out.fast.push_back(e);
        out.torque.push_back(torque(i, observer, e));
        out.w1.push_back(observer.state().w1);
        out.mode.push_back(model.structure.has_load ? mode_of(observer) : Mode::kEngagementPlus);
      });
}

bool play_ripple(const PlantModel<double>& model, const DriveState<double>& start, const MotorTrace& trace,
                 Playback& out) {
  const reference::ObserverGains gains(kMeasure.ripple_hz, trace);
  const ResidualTorque torque(model, gains);
  return reference::roll_out(model, start, trace, gains,
                             [&](std::size_t i, const DriveStepper<double>& observer) {
                               out.ripple.push_back(torque(i, observer, trace.x1[i] - observer.measured()));
                             });
}

/// The input of a recording as it may have been, in place of the one that was read.
class Scaled {
 public:
  Scaled(MotorTrace& trace, const HeldOut& held_out, std::size_t r) {
    if (held_out.input_factors.empty() || held_out.input_factors[r].empty()) return;
    trace.u = scaled(trace.u, held_out.input_factors[r], u_);
    trace.sent = scaled(trace.sent, held_out.input_factors[r], sent_);
  }

 private:
  static std::span<const double> scaled(std::span<const double> u, const std::vector<double>& by,
                                        std::vector<double>& to) {
    to.assign(u.begin(), u.end());
    for (std::size_t i = 0; i < to.size(); ++i) to[i] *= by[i];
    return to;
  }
  std::vector<double> u_, sent_;
};

/// Mean squares over windows of `length` samples of the scored part, over `floor`².
void append_windows(const std::vector<double>& errors, std::size_t from, std::size_t length, double floor,
                    std::vector<double>& squares) {
  for (std::size_t i = from; i + length <= errors.size(); i += length) {
    double sum = 0.0;
    for (std::size_t k = i; k < i + length; ++k) sum += errors[k] * errors[k];
    const double square = sum / static_cast<double>(length) / (floor * floor);
    squares.push_back(std::isfinite(square) ? std::min(square, kAsWrongAsCanBe) : kAsWrongAsCanBe);
  }
}

/// How far a free mass runs astray in `length` seconds, rms, that an observer with both poles at λ = 2π hz
/// has let go, in deviations of the encoder's white noise: √(λ dt (5/4 + λ T/2 + (λ T)²/12)), by the steady
/// covariance of its state.
double observer_noise(double hz, double dt, double length) {
  const double rate = 2.0 * kPi * hz, way = rate * length;
  return std::sqrt(rate * dt * (1.25 + 0.5 * way + way * way / 12.0));
}

/// The first restart is left to the observer, which does not know the load's place yet.
std::size_t first_window(const HeldOut& held_out, std::size_t r) {
  const std::size_t restart = held_out.restart(r);
  return (held_out.scored_from[r] + restart) / restart * restart;
}

}  // namespace

ReferenceModel all_fixed(ReferenceModel model) {
  for (ParameterSetting& p : model.parameters) p.estimate = false;
  for (ModelEffect& e : model.effects)
    for (ParameterSetting& p : e.parameters) p.estimate = false;
  if (model.controller)
    for (ParameterSetting& p : model.controller->numbers) p.estimate = false;
  return model;
}

std::size_t HeldOut::restart(std::size_t r) const {
  const double scored = traces[r].dt * static_cast<double>(traces[r].size() - scored_from[r]);
  double length = std::min(kMeasure.restart, scored / kMeasure.fewest_restarts);
  // A whole number of restarts in a period: periods can then be compared.
  if (const double period = traces[r].dt * periods[r]; period > length)
    length = period / std::round(period / length);
  return 2 * std::max<std::size_t>(5, static_cast<std::size_t>(0.5 * length / traces[r].dt + 0.5));
}

double HeldOut::innovation_floor(std::size_t r) const {
  const double open = innovation_open.empty() ? 0.0 : innovation_open[r];
  return std::max(std::hypot(floors[r], open), innovation_repeats);
}

double HeldOut::free_encoder_floor(std::size_t r) const {
  const double length = traces[r].dt * static_cast<double>(restart(r));
  return floors[r] * std::hypot(1.0, observer_noise(kMeasure.slow_hz, traces[r].dt, length));
}

double HeldOut::free_floor(std::size_t r) const {
  const double open = free_open.empty() ? 0.0 : free_open[r];
  return std::max(std::hypot(free_encoder_floor(r), open), free_repeats);
}

std::vector<reference::RecordingStart> settled_starts(std::span<const MotorTrace> recordings,
                                                      const ReferenceModel& model, double observer_hz) {
  const reference::ModelFit fit(recordings, all_fixed(model), {}, observer_hz);
  const reference::FitPoint given = fit.given_point();
  if (!model.structure.has_load) return given.starts;  // the observer knows where its only body is
  const reference::FitPoint placed = fit.with_loads_placed(given).value_or(given);
  const reference::RefinedFit better = fit.refine(placed, SearchEffort{}.quick);
  return better.usable() ? better.starts : placed.starts;
}

PlantModel<double> stepper_of(const ReferenceModel& model, std::span<const MotorTrace> like) {
  return reference::ModelFit(like, all_fixed(model), {}, 0.0).run_at({}).plant;
}

std::vector<Playback> play(const ReferenceModel& model, const HeldOut& held_out, double observer_hz,
                           bool all) {
  return play_from(settled_starts(held_out.traces, model, observer_hz), model, held_out, observer_hz, all);
}

std::vector<Playback> play_from(const std::vector<reference::RecordingStart>& from,
                                const ReferenceModel& model, const HeldOut& held_out, double observer_hz,
                                bool all) {
  const reference::ModelFit fit(held_out.traces, all_fixed(model), {}, observer_hz);
  const reference::ModelRun run = fit.run_at({{}, from});
  const PlantModel<double>& plant = run.plant;
  std::vector<Playback> playbacks(held_out.traces.size());
  for (std::size_t r = 0; r < playbacks.size(); ++r) {
    const DriveState<double>& state = run.starts[r];
    MotorTrace trace = run.under_own_input(held_out.traces[r], r);
    const Scaled scaled(trace, held_out, r);
    if (!play_scored(plant, state, trace, held_out.restart(r), observer_hz, playbacks[r])) return {};
    if (!all) continue;
    if (!play_slow(plant, state, trace, playbacks[r]) || !play_fast(plant, state, trace, playbacks[r]) ||
        !play_ripple(plant, state, trace, playbacks[r]))
      return {};
  }
  return playbacks;
}

Positions whole_runs(const ReferenceModel& model, const HeldOut& held_out, double observer_hz) {
  const reference::ModelFit fit(held_out.traces, all_fixed(model), {}, observer_hz);
  const reference::ModelRun run = fit.run_at({{}, settled_starts(held_out.traces, model, observer_hz)});
  Positions positions(held_out.traces.size());
  for (std::size_t r = 0; r < positions.size(); ++r) {
    MotorTrace trace = run.under_own_input(held_out.traces[r], r);
    const Scaled scaled(trace, held_out, r);
    positions[r].resize(trace.size());
    const auto visit = [&](std::size_t i, const DriveStepper<double>& runner) {
      positions[r][i] = runner.measured();
    };
    if (!reference::roll_out(run.plant, run.starts[r], trace, reference::ObserverGains(), visit)) return {};
  }
  return positions;
}

Positions judged_runs(const ReferenceModel& model, const HeldOut& held_out, double observer_hz) {
  const reference::ModelFit fit(held_out.traces, all_fixed(model), {}, observer_hz);
  const reference::ModelRun run = fit.run_at({{}, settled_starts(held_out.traces, model, observer_hz)});
  Positions positions(held_out.traces.size());
  for (std::size_t r = 0; r < positions.size(); ++r) {
    MotorTrace trace = run.under_own_input(held_out.traces[r], r);
    const Scaled scaled(trace, held_out, r);
    DriveStepper<double> runner = reference::stepper_for(run.plant, trace);
    bool healthy = true;
    const auto visit = [&](std::size_t i, const DriveStepper<double>& observer) {
      if (i < held_out.scored_from[r] || !healthy) return;
      if (i == held_out.scored_from[r]) runner = observer;
      positions[r].push_back(runner.measured());
      reference::play_step(runner, trace, i);
      healthy = runner.healthy();
    };
    const reference::ObserverGains gains(observer_hz, trace);
    if (!reference::roll_out(run.plant, run.starts[r], trace, gains, visit) || !healthy) return {};
  }
  return positions;
}

Windows windows_of(const std::vector<Playback>& playbacks, const HeldOut& held_out) {
  Windows w;
  for (std::size_t r = 0; r < playbacks.size(); ++r) {
    const std::size_t restart = held_out.restart(r), half = restart / 2;
    const std::size_t from = first_window(held_out, r);
    append_windows(playbacks[r].innovation, from, half, held_out.innovation_floor(r), w.innovation);
    append_windows(playbacks[r].free, from, restart, held_out.free_floor(r), w.free);
    append_windows(playbacks[r].slow, from, half, held_out.floors[r], w.slow);
    append_windows(playbacks[r].fast, from, half, held_out.floors[r], w.fast);
    append_windows(playbacks[r].torque, from, half, 1.0, w.torque);
  }
  return w;
}

std::vector<double> still_windows(const HeldOut& held_out) {
  std::vector<double> squares;
  for (std::size_t r = 0; r < held_out.traces.size(); ++r) {
    const std::span<const double> x1 = held_out.traces[r].x1;
    const std::size_t length = held_out.restart(r), from = first_window(held_out, r);
    std::vector<double> away(x1.size(), 0.0);
    for (std::size_t i = from; i + length <= x1.size(); i += length) {
      const double centre = mean(x1.subspan(i, length));
      for (std::size_t k = i; k < i + length; ++k) away[k] = x1[k] - centre;
    }
    append_windows(away, from, length, held_out.free_floor(r), squares);
  }
  return squares;
}

double mean_log(const std::vector<double>& squares) {
  double sum = 0.0;
  for (const double w : squares) sum += std::log(w + kMeasure.score_offset);
  return sum / static_cast<double>(std::max<std::size_t>(1, squares.size()));
}

double log_score(const Windows& w) {
  if (w.innovation.empty() || w.free.empty()) return kInfinity;
  return 0.5 * mean_log(w.innovation) + 0.5 * mean_log(w.free);
}

double median_size(const std::vector<double>& squares) { return std::sqrt(median(squares)); }

}  // namespace gapscope::internal::diagnosis

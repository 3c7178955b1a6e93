#include "independent_plant/simulate.h"

#include <algorithm>
#include <cmath>

#include "gapscope/base/random.h"
#include "gapscope/base/require.h"

namespace gapscope::independent_plant {
namespace {

std::vector<Knock> draw_knocks(const Knocks& e, const BlindOptions& options) {
  std::mt19937_64 generator = random_stream(options.seed, "blind knocks");
  std::vector<Knock> knocks;
  for (int i = 0; i < e.count; ++i) {
    const double start = uniform(generator, 0.0, options.duration);
    knocks.push_back({start, uniform(generator, -1.0, 1.0) < 0.0 ? -e.torque_nm : e.torque_nm});
  }
  std::sort(knocks.begin(), knocks.end(),
            [](const Knock& a, const Knock& b) { return a.start_s < b.start_s; });
  return knocks;
}

/// What the torque loop is told, and from when.
struct Update {
  double time = 0.0;
  double command = 0.0;
};

std::vector<Update> updates(const Dynamics& dynamics, const std::vector<double>& u, double dt,
                            std::uint64_t seed) {
  const CommandEffects& e = dynamics.drive().effects.command;
  GAPSCOPE_REQUIRE(e.jitter_s < dt);
  std::mt19937_64 jitter = random_stream(seed, "blind jitter"), noise = random_stream(seed, "blind command");
  std::vector<Update> result(u.size());
  for (std::size_t k = 0; k < u.size(); ++k) {
    double time = dt * static_cast<double>(k) + e.delay_s;
    if (e.jitter_s > 0.0) time += uniform(jitter, 0.0, e.jitter_s);
    const double disturbed = e.noise > 0.0 ? u[k] + e.noise * normal(noise) : u[k];
    result[k] = {time, dynamics.shape_command(disturbed)};
  }
  return result;
}

/// The encoder with all its faults; asked for the samples in order.
class EncoderReading {
 public:
  EncoderReading(const Dynamics& dynamics, const BlindSensor& sensor, const BlindOptions& options)
      : dynamics_(dynamics),
        effects_(dynamics.drive().effects.sensor),
        quantum_(std::max(sensor.quantum, effects_.quantum_rad)),
        noise_rms_(sensor.noise),
        noise_(random_stream(options.seed, "blind noise")) {
    std::mt19937_64 generator = random_stream(options.seed, "blind counts");
    for (int i = 0; i < effects_.lost_count_times; ++i)
      losses_.push_back(uniform(generator, 0.0, options.duration));
    for (double& time : losses_)
      if (generator() & 1u) time = -time;  // the sign stands for the direction of the loss
  }

  double read(double t, const State& s) {
    double angle = effects_.lag_s > 0.0 ? s[kFilter] : dynamics_.measured_angle(s[kX1]);
    if (noise_rms_ > 0.0) angle += noise_rms_ * normal(noise_);
    if (quantum_ == 0.0) return angle;
    double counts = std::nearbyint(angle / quantum_);
    for (const double time : losses_)
      if (std::abs(time) <= t) counts += time < 0.0 ? -effects_.lost_counts : effects_.lost_counts;
    return counts * quantum_;
  }

 private:
  const Dynamics& dynamics_;
  const SensorEffects& effects_;
  double quantum_, noise_rms_;
  std::mt19937_64 noise_;
  std::vector<double> losses_;
};

std::vector<GapPassage> passages(const std::vector<ContactEvent>& events, const Dynamics& dynamics) {
  std::vector<GapPassage> result;
  GapPassage open;
  double x2_t1 = dynamics.drive().x2;
  open.x1_t1 = dynamics.drive().x1;
  for (const ContactEvent& e : events) {
    if (!e.closed) {
      open = {};
      open.from_flank = e.flank, open.t1 = e.time, open.x1_t1 = e.x1;
      x2_t1 = e.x2;
    } else {
      open.to_flank = e.flank, open.t2 = e.time, open.x1_t2 = e.x1;
      open.load_travel = e.x2 - x2_t1;
      open.gap = 2.0 * dynamics.half_gap(e.time, e.x2);
      result.push_back(open);
    }
  }
  return result;
}

/// Mode of every sample: what the coupling does there, or impact where a contact closes before the next.
void mark_impacts(Recording& recording, const std::vector<ContactEvent>& events) {
  for (const ContactEvent& e : events) {
    const std::size_t k = static_cast<std::size_t>(e.time / recording.dt);
    if (e.closed && k < recording.size()) recording.mode[k] = Mode::kImpact;
  }
}

void note_sample(const Motion& motion, bool has_load, BlindRun& run) {
  const State& s = motion.state();
  run.truth.x1.push_back(s[kX1]);
  run.truth.w1.push_back(s[kW1]);
  if (!has_load) return;
  run.truth.x2.push_back(s[kX2]);
  run.truth.w2.push_back(s[kW2]);
  run.recording.mode.push_back(static_cast<Mode>(motion.flank_in_contact()));
}

}  // namespace

BlindSensor BlindSensor::with_bits(int bits, double noise_quanta) {
  const double quantum = 2.0 * kPi / std::exp2(bits);
  return {quantum, noise_quanta * quantum};
}

BlindRun simulate_blind(const BlindDrive& drive, const BlindExcitation& excitation, const BlindSensor& sensor,
                        const BlindOptions& options) {
  return simulate_blind_command(drive, command(excitation, options.rate, options.duration, options.seed),
                                sensor, options);
}

BlindRun simulate_blind_command(const BlindDrive& drive, const std::vector<double>& u,
                                const BlindSensor& sensor, const BlindOptions& options) {
  const Dynamics dynamics(drive, draw_knocks(drive.effects.motor.knocks, options));
  const double dt = 1.0 / options.rate;
  const std::vector<Update> queue = updates(dynamics, u, dt, options.seed);
  const bool has_load = drive.load != BlindLoad::kNone;
  Motion motion(dynamics, options.tolerance);
  EncoderReading encoder(dynamics, sensor, options);
  BlindRun run;
  run.recording.file = "blind";
  run.recording.dt = dt;
  run.recording.quantum = sensor.quantum;
  run.recording.u = u;
  std::size_t next = 0;
  for (std::size_t k = 0; k < u.size(); ++k) {
    const double t = dt * static_cast<double>(k);
    for (; next < queue.size() && queue[next].time <= t; ++next) {
      motion.advance(queue[next].time);
      if (queue[next].time == t) break;  // the sample is read before its command acts
      motion.hold(queue[next].command);
    }
    motion.advance(t);
    run.recording.x1.push_back(encoder.read(t, motion.state()));
    note_sample(motion, has_load, run);
    if (next < queue.size() && queue[next].time == t) motion.hold(queue[next++].command);
  }
  run.recording.x2 = run.truth.x2;
  run.truth.contact_events = motion.contact_events();
  run.truth.passages = passages(run.truth.contact_events, dynamics);
  run.truth.steps = motion.steps();
  mark_impacts(run.recording, run.truth.contact_events);
  return run;
}

}  // namespace gapscope::independent_plant

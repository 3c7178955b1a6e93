#include "independent_plant/rig.h"

#include <algorithm>
#include <cmath>

#include "base/random.h"

namespace gapscope::independent_plant {
namespace {

std::vector<Knock> draw_knocks(const Knocks& e, double duration, std::uint64_t seed) {
  std::mt19937_64 generator = random_stream(seed, "blind knocks");
  std::vector<Knock> knocks;
  for (int i = 0; i < e.count; ++i) {
    const double start = uniform(generator, 0.0, duration);
    knocks.push_back({start, uniform(generator, -1.0, 1.0) < 0.0 ? -e.torque_nm : e.torque_nm});
  }
  std::sort(knocks.begin(), knocks.end(),
            [](const Knock& a, const Knock& b) { return a.start_s < b.start_s; });
  return knocks;
}

}  // namespace

BlindSensor BlindSensor::with_bits(int bits, double noise_quanta) {
  const double quantum = 2.0 * kPi / std::exp2(bits);
  return {quantum, noise_quanta * quantum};
}

EncoderReading::EncoderReading(const Dynamics& dynamics, const BlindSensor& sensor, double until,
                               std::uint64_t seed)
    : dynamics_(dynamics),
      effects_(dynamics.drive().effects.sensor),
      quantum_(std::max(sensor.quantum, effects_.quantum_rad)),
      noise_rms_(sensor.noise),
      noise_(random_stream(seed, "blind noise")) {
  std::mt19937_64 generator = random_stream(seed, "blind counts");
  for (int i = 0; i < effects_.lost_count_times; ++i) losses_.push_back(uniform(generator, 0.0, until));
  for (double& time : losses_)
    if (generator() & 1u) time = -time;
}

double EncoderReading::read(double t, const State& s) {
  double angle = effects_.lag_s > 0.0 ? s[kFilter] : dynamics_.measured_angle(s[kX1]);
  if (noise_rms_ > 0.0) angle += noise_rms_ * normal(noise_);
  if (quantum_ == 0.0) return angle;
  double counts = std::nearbyint(angle / quantum_);
  for (const double time : losses_)
    if (std::abs(time) <= t) counts += time < 0.0 ? -effects_.lost_counts : effects_.lost_counts;
  return counts * quantum_;
}

Rig::Rig(const BlindDrive& drive, const BlindSensor& sensor, double duration, double tolerance,
         std::uint64_t seed)
    : dynamics_(drive, draw_knocks(drive.effects.motor.knocks, duration, seed)),
      motion_(dynamics_, tolerance),
      encoder_(dynamics_, sensor, duration, seed),
      jitter_(random_stream(seed, "blind jitter")),
      noise_(random_stream(seed, "blind command")) {}

void Rig::act_on(const Update& update) {
  held_ = update.command;
  motion_.hold(update.command);
}

void Rig::send(double t, double u) {
  const CommandEffects& e = dynamics_.drive().effects.command;
  double time = t + e.delay_s;
  if (e.jitter_s > 0.0) time += uniform(jitter_, 0.0, e.jitter_s);
  const double disturbed = e.noise > 0.0 ? u + e.noise * normal(noise_) : u;
  queue_.push_back({time, dynamics_.shape_command(disturbed)});
  for (; !queue_.empty() && queue_.front().time <= motion_.time(); queue_.pop_front()) act_on(queue_.front());
}

void Rig::advance(double t) {
  for (; !queue_.empty() && queue_.front().time < t; queue_.pop_front()) {
    motion_.advance(queue_.front().time);
    act_on(queue_.front());
  }
  motion_.advance(t);
}

double Rig::acting() const {
  return dynamics_.drive().effects.command.lag_s > 0.0 ? motion_.state()[kTorqueLoop] : held_;
}

}  // namespace gapscope::independent_plant

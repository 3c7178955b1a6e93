#include "implant/implant.h"

#include <algorithm>
#include <cmath>

#include "implant/drawn_shape.h"

namespace gapscope::internal::implant {
namespace {

constexpr int kHalvings = 48;     ///< of the range of a size: to the last bit that matters
constexpr double kWithin = 0.01;  ///< of the size that is asked for
constexpr double kOnGrid = 0.05;  ///< quanta off the grid, of readings that lie on it

/// Mean torque over each step [N m].
std::vector<double> mean_torques(const Subject& s, const Implant& implant, const Receiver& drive) {
  std::vector<double> means(s.recording->size());
  double memory = 0.0;
  MotionPoint before = s.motion.at(0);
  for (std::size_t i = 0; i < means.size(); ++i) {
    double sum = 0.0;
    for (int k = 0; k < kPointsOfStep; ++k) {
      TorquePoint p{s.motion.between(i, (k + 0.5) / kPointsOfStep), 0, 0.0, 0.0};
      p.direction = s.motion.direction(i, p.at);
      p.moved = p.at.x - before.x, p.lasted = p.at.t - before.t;
      before = p.at;
      sum += implant.law->torque(p, implant.values, drive, memory);
    }
    means[i] = sum / kPointsOfStep;
  }
  return means;
}

/// Readings back on the grid of an encoder, where they were on it.
void count_again(std::vector<double>& x, const Recording& r) {
  if (!(r.quantum > 0.0)) return;
  const auto off = [&](double value) {
    const double counts = (value - r.x1[0]) / r.quantum;
    return std::abs(counts - std::round(counts));
  };
  const auto beside =
      std::count_if(r.x1.begin(), r.x1.end(), [&](double value) { return off(value) > kOnGrid; });
  if (20 * beside > std::ssize(r.x1)) return;
  for (double& value : x) value = r.x1[0] + r.quantum * std::round((value - r.x1[0]) / r.quantum);
}

std::mt19937_64 own_stream(const Implant& implant, std::size_t number) {
  return random_stream(implant.seed + number, "implant of a recording");
}

double square(double value) { return value * value; }

/// Torque that a shift of the readings looks like: m d²/dt² + d d/dt of it, by differences over the steps.
double shift_square(const Subject& s, const std::vector<double>& shifted, const Receiver& drive) {
  const std::vector<double>& x = s.recording->x1;
  double sum = 0.0;
  for (std::size_t i = 1; i + 1 < x.size(); ++i) {
    const double back = s.motion.step(i - 1), on = s.motion.step(i);
    const double before = (shifted[i] - x[i] - shifted[i - 1] + x[i - 1]) / back,
                 after = (shifted[i + 1] - x[i + 1] - shifted[i] + x[i]) / on;
    sum += square(drive.inertia * (after - before) / (0.5 * (back + on)) +
                  0.5 * drive.damping * (before + after));
  }
  return sum;
}

}  // namespace

CaseScale scale_of(std::span<const Subject> subjects) {
  CaseScale s;
  double input = 0.0, speed = 0.0, count = 0.0;
  s.travel = s.shortest = kInfinity;
  for (const Subject& subject : subjects) {
    const Recording& r = *subject.recording;
    for (std::size_t i = 0; i < r.size(); ++i) {
      const double w = subject.motion.at(i).w;
      input += square(r.u[i]), speed += square(w), count += 1.0;
      s.peak_input = std::max(s.peak_input, std::abs(r.u[i]));
      s.peak_speed = std::max(s.peak_speed, std::abs(w));
    }
    const auto [low, high] = std::minmax_element(r.x1.begin(), r.x1.end());
    s.travel = std::min(s.travel, *high - *low);
    s.shortest = std::min(s.shortest, r.duration());
    s.step = std::max(s.step, r.dt);
    s.quantum = std::max(s.quantum, r.quantum);
  }
  s.input_rms = std::sqrt(input / count), s.rms_speed = std::sqrt(speed / count);
  return s;
}

Recording implanted(const Subject& subject, std::size_t number, const Implant& implant,
                    const Receiver& drive) {
  Recording r = *subject.recording;
  r.x2.clear(), r.mode.clear();
  r.sent.clear(), r.delay = 0.0;  // an input that is changed stands for itself
  auto own = own_stream(implant, number);
  switch (implant.law->way) {
    case Way::kTorque: {
      const std::vector<double> torque = mean_torques(subject, implant, drive);
      for (std::size_t i = 0; i < r.size(); ++i) r.u[i] -= torque[i] / drive.torque_constant;
      break;
    }
    case Way::kCommand:
      r.u = implant.law->change(subject, implant.values, own);
      break;
    case Way::kSensor:
      r.x1 = implant.law->change(subject, implant.values, own);
      count_again(r.x1, *subject.recording);
      break;
  }
  return r;
}

double implant_size(std::span<const Subject> subjects, const Implant& implant, const Receiver& drive) {
  double input = 0.0, changed = 0.0;
  for (std::size_t n = 0; n < subjects.size(); ++n) {
    const Subject& s = subjects[n];
    const std::vector<double>& u = s.recording->u;
    for (const double value : u) input += square(drive.torque_constant * value);
    auto own = own_stream(implant, n);
    if (implant.law->way == Way::kTorque) {
      for (const double torque : mean_torques(s, implant, drive)) changed += square(torque);
    } else if (implant.law->way == Way::kCommand) {
      const std::vector<double> other = implant.law->change(s, implant.values, own);
      for (std::size_t i = 0; i < u.size(); ++i) changed += square(drive.torque_constant * (other[i] - u[i]));
    } else {
      changed += shift_square(s, implant.law->change(s, implant.values, own), drive);
    }
  }
  return std::sqrt(changed / input);
}

std::optional<Implant> sized_implant(Implant implant, std::span<const Subject> subjects,
                                     const Receiver& drive, double size) {
  const ImplantLaw& law = *implant.law;
  const auto size_at = [&](double first) {
    implant.values[0] = first;
    return implant_size(subjects, implant, drive);
  };
  if (law.way == Way::kTorque) {
    const double one = size_at(1.0);
    implant.values[0] = size / one;
    if (!(one > 0.0)) return {};
    return implant;
  }
  const CaseScale scale = scale_of(subjects);
  if (law.by_size != nullptr) {
    implant.values[0] = law.by_size(size, scale);
    return implant;
  }
  auto [weak, strong] = law.range(scale);
  if (!(size_at(strong) > size)) return {};
  for (int i = 0; i < kHalvings; ++i) {
    const double between = std::sqrt(weak * strong);
    (size_at(between) < size ? weak : strong) = between;
  }
  if (std::abs(size_at(std::sqrt(weak * strong)) / size - 1.0) > kWithin) return {};
  return implant;
}

Implant drawn_shape(const ImplantLaw& law, std::span<const Subject> subjects, const Receiver& drive,
                    std::uint64_t seed) {
  auto g = random_stream(seed, law.name);
  Implant implant{&law, {}, seed};
  law.draw(implant.values, scale_of(subjects), drive, g);
  return implant;
}

std::optional<Implant> drawn_implant(const ImplantLaw& law, std::span<const Subject> subjects,
                                     const Receiver& drive, double size, std::uint64_t seed) {
  return sized_implant(drawn_shape(law, subjects, drive, seed), subjects, drive, size);
}

}  // namespace gapscope::internal::implant

#include "sliding_mode/test_drive.h"

namespace gapscope {
namespace {

double soft(double value, double threshold) {
  return std::copysign(std::fmax(std::fabs(value) - threshold, 0.0), value);
}

}  // namespace

void integrate(TestState& s, const TestDrive& p, double torque, double h) {
  const double delta = s.x1 - s.x2;
  const double depth = std::fabs(delta) - 0.5 * p.gap;
  double contact = 0.0;
  if (p.m2 > 0.0 && depth > 0.0) {
    const double side = delta > 0.0 ? 1.0 : -1.0;
    contact = side * std::fmax(p.k * depth + p.c * side * (s.w1 - s.w2), 0.0);
  }
  double motor = torque - p.d1 * s.w1 - contact;
  if (p.cogging != 0.0) motor -= p.cogging * std::sin(p.periods * s.x1);
  const double level = p.Fc1 + (p.Fs1 > p.Fc1 ? (p.Fs1 - p.Fc1) * std::exp(-std::pow(s.w1 / p.vs, 2)) : 0.0);
  if (p.bristle > 0.0) {
    const double rate = s.w1 - std::fabs(s.w1) * p.bristle * s.z / std::fmax(level, 1e-12);
    s.z += h * rate;
    motor -= p.bristle * s.z + 0.02 * rate;
  }
  s.w1 += h * motor / p.m1;
  if (p.bristle <= 0.0) s.w1 = soft(s.w1, h * level / p.m1);
  s.x1 += h * s.w1;
  if (p.m2 <= 0.0) return;
  s.w2 = soft(s.w2 + h * (contact - p.d2 * s.w2) / p.m2, h * p.Fc2 / p.m2);
  s.x2 += h * s.w2;
}

TestRecording record(const TestDrive& drive, const std::function<double(double)>& input,
                     const TestEncoder& encoder) {
  TestRecording r;
  r.dt = 1.0 / encoder.rate;
  r.quantum = encoder.bits > 0 ? 2.0 * 3.14159265358979323846 / std::ldexp(1.0, encoder.bits) : 0.0;
  const auto n = static_cast<std::size_t>(encoder.duration * encoder.rate);
  const int inner = static_cast<int>(std::ceil(r.dt / encoder.step));
  auto generator = random_stream(encoder.seed, "test encoder");
  const double offset = uniform(generator, 0.0, 1.0);
  TestState s{drive.x1, 0.0, drive.x2, 0.0, 0.0};
  for (std::size_t i = 0; i < n; ++i) {
    const double u = input(r.dt * static_cast<double>(i));
    const double noise = encoder.noise > 0.0 ? encoder.noise * r.quantum * normal(generator) : 0.0;
    r.u.push_back(u);
    r.x1.push_back(r.quantum > 0.0 ? r.quantum * std::floor((s.x1 + noise) / r.quantum + offset) : s.x1);
    r.true_x1.push_back(s.x1);
    r.true_x2.push_back(s.x2);
    for (int j = 0; j < inner; ++j) integrate(s, drive, drive.Km * u, r.dt / inner);
  }
  return r;
}

}  // namespace gapscope

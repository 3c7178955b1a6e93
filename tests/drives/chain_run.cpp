#include "drives/chain_run.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "base/random.h"

namespace gapscope::independent_plant {
namespace {

/// A controller, its course, and on which side of it the target is led.
struct PositionLoop {
  PositionTask task;
  Reference course;
  Controller controller;
  double lead_rad = 0.0;

  double step(double t, double x1) {
    Target target = course.at(t);
    const double side = target.w > 0.0 ? 1.0 : (target.w < 0.0 ? -1.0 : 0.0);
    const double share = std::min(1.0, 1.0 / (task.controller.rate * task.compensation_s));
    lead_rad += share * (side * task.compensation_rad - lead_rad);
    target.x += lead_rad;
    return controller.step(t, x1, target);
  }
};

}  // namespace

ChainInput position_input(const PositionTask& task, double duration, std::uint64_t seed) {
  auto loop = std::make_shared<PositionLoop>(
      PositionLoop{task, Reference(task.course, duration, seed), Controller(task.controller)});
  return [loop](double t, double x1) { return loop->step(t, x1); };
}

ChainInput torque_input(const BlindExcitation& excitation, const BlindOptions& options) {
  auto u = std::make_shared<std::vector<double>>(
      command(excitation, options.rate, options.duration, options.seed));
  return [u, rate = options.rate](double t, double) {
    return u->at(static_cast<std::size_t>(std::llround(t * rate)));
  };
}

ChainRun simulate_chain(const ChainDrive& drive, const ChainInput& input, const BlindSensor& sensor,
                        const BlindOptions& options) {
  const ChainDynamics dynamics(drive);
  ChainMotion motion(dynamics, options.tolerance);
  std::mt19937_64 noise = random_stream(options.seed, "chain encoder");
  ChainRun run;
  Recording& r = run.recording;
  r.file = "chain", r.dt = 1.0 / options.rate, r.quantum = sensor.quantum;
  const auto rows = static_cast<std::size_t>(std::llround(options.rate * options.duration));
  const std::size_t last = angle_of(drive.bodies.size() - 1);
  for (std::size_t k = 0; k < rows; ++k) {
    const double t = r.dt * static_cast<double>(k);
    motion.advance(t);
    const double x1 = motion.state()[angle_of(0)];
    const double seen = sensor.noise > 0.0 ? x1 + sensor.noise * normal(noise) : x1;
    run.x1.push_back(x1);
    r.x1.push_back(sensor.quantum > 0.0 ? sensor.quantum * std::nearbyint(seen / sensor.quantum) : seen);
    r.x2.push_back(motion.state()[last]);
    r.u.push_back(input(t, r.x1.back()));
    motion.hold(r.u.back());
  }
  run.events = motion.events();
  return run;
}

}  // namespace gapscope::independent_plant

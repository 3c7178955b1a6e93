#include "drives/closed_loop.h"

#include <algorithm>
#include <cmath>
#include <deque>

#include "base/random.h"
#include "base/require.h"
#include "independent_plant/run_recorder.h"

namespace gapscope::independent_plant {
namespace {

/// A turn of the controller, a row of the recording, or both.
struct Instant {
  double t = 0.0;
  bool turn = false, row = false;
};

constexpr double kSameTime = 1e-9;  ///< sums of times that should be equal differ by less [s]

std::vector<Instant> turns(const ControllerSettings& controller, double end, std::uint64_t seed) {
  std::mt19937_64 jitter = random_stream(seed, "blind loop jitter");
  std::vector<Instant> all;
  for (long k = 0; static_cast<double>(k) < end * controller.rate - 0.5; ++k) {
    const double late = controller.jitter_s > 0.0 ? uniform(jitter, 0.0, controller.jitter_s) : 0.0;
    all.push_back({static_cast<double>(k) / controller.rate + late, true, false});
  }
  return all;
}

std::vector<Instant> instants(const ControllerSettings& controller, const LoopRecorder& recorder,
                              const BlindOptions& options) {
  std::vector<Instant> all = turns(controller, recorder.lead_s + options.duration, options.seed);
  const std::size_t count = all.size();
  if (recorder.rate == 0.0) {
    const auto first = static_cast<std::size_t>(std::llround(recorder.lead_s * controller.rate));
    for (std::size_t k = first; k < count; ++k) all[k].row = true;
    return all;
  }
  for (long k = 0; static_cast<double>(k) < options.duration * recorder.rate - 0.5; ++k) {
    const double t = recorder.lead_s + static_cast<double>(k) / recorder.rate;
    const auto turn = static_cast<std::size_t>(std::llround(t * controller.rate));
    if (turn < count && std::abs(all[turn].t - t) < kSameTime)
      all[turn].row = true;
    else
      all.push_back({t, false, true});
  }
  std::stable_sort(all.begin(), all.end(), [](const Instant& x, const Instant& y) { return x.t < y.t; });
  return all;
}

/// The command in force, as the controller's electronics know it.
class CommandLine {
 public:
  void send(double from, double u) { coming_.push_back({from, u}); }
  double at(double t) {
    for (; !coming_.empty() && coming_.front().from <= t + kSameTime; coming_.pop_front())
      now_ = coming_.front().u;
    return now_;
  }

 private:
  struct Sent {
    double from = 0.0, u = 0.0;
  };
  std::deque<Sent> coming_;
  double now_ = 0.0;
};

/// Which rows arrive: losses come in runs of random length.
std::vector<bool> arriving_rows(std::size_t count, const LoopRecorder& recorder, std::uint64_t seed) {
  std::mt19937_64 losses = random_stream(seed, "blind lost rows");
  std::vector<bool> arrives(count, true);
  const double per_row = recorder.lost_share / recorder.lost_run;
  for (std::size_t k = 1; k + 1 < count; ++k) {
    if (!(uniform(losses, 0.0, 1.0) < per_row)) continue;
    const auto run = static_cast<std::size_t>(std::ceil(uniform(losses, 0.0, 2.0 * recorder.lost_run)));
    for (const std::size_t end = std::min(k + run, count - 1); k < end; ++k) arrives[k] = false;
  }
  return arrives;
}

template <class T>
void keep(std::vector<T>& column, const std::vector<bool>& arrives) {
  if (column.size() != arrives.size()) return;  // a column that this drive does not have
  std::size_t kept = 0;
  for (std::size_t k = 0; k < arrives.size(); ++k)
    if (arrives[k]) column[kept++] = column[k];
  column.resize(kept);
}

void lose_rows(LoopRun& loop, const LoopRecorder& recorder, std::uint64_t seed) {
  if (recorder.lost_share == 0.0) return;
  const std::vector<bool> arrives = arriving_rows(loop.stamps.size(), recorder, seed);
  keep(loop.stamps, arrives);
  keep(loop.target, arrives);
  keep(loop.supply, arrives);
  for (auto* column : {&loop.run.recording.u, &loop.run.recording.x1, &loop.run.recording.x2,
                       &loop.run.truth.x1, &loop.run.truth.w1, &loop.run.truth.x2, &loop.run.truth.w2})
    keep(*column, arrives);
  keep(loop.run.recording.mode, arrives);
}

}  // namespace

LoopRun simulate_closed_loop(const BlindDrive& drive, const ReferenceMotion& reference,
                             const ControllerSettings& settings, const BlindSensor& sensor,
                             const LoopRecorder& recorder, const BlindOptions& options) {
  GAPSCOPE_REQUIRE(recorder.lead_s >= 0.0 && recorder.lost_share < 1.0 && recorder.lost_run >= 1.0);
  GAPSCOPE_REQUIRE(drive.effects.command.jitter_s * settings.rate < 1.0);
  const double end = recorder.lead_s + options.duration;
  const double row_rate = recorder.rate == 0.0 ? settings.rate : recorder.rate;
  const Reference course(reference, end, options.seed);
  Controller controller(settings);
  Rig rig(drive, sensor, end, options.tolerance, options.seed);
  RunRecorder rows(sensor, recorder.lead_s, 1.0 / row_rate);
  CommandLine line;
  std::mt19937_64 noise = random_stream(options.seed, "blind current");
  LoopRun loop;
  double supply = 1.0;
  for (const Instant& i : instants(settings, recorder, options)) {
    rig.advance(i.t);
    const double x = rig.read();
    if (i.turn) {
      const double duty = controller.step(i.t, x, course.at(i.t));
      if (settings.supply_sag > 0.0) supply = 1.0 - settings.supply_sag * std::abs(duty) / settings.limit;
      const double u = duty * supply, from = i.t + settings.dead_time_s;
      line.send(from, u);
      rig.send(from, u);
    }
    if (!i.row) continue;
    const double u = recorder.input == RecordedInput::kCommand
                         ? line.at(i.t)
                         : rig.acting() + recorder.input_noise * normal(noise);
    rows.note(rig, u, x);
    loop.stamps.push_back(i.t);
    loop.target.push_back(course.at(i.t));
    loop.supply.push_back(supply);
  }
  loop.run = rows.finished(rig);
  lose_rows(loop, recorder, options.seed);
  loop.run.recording.start = loop.stamps.front();
  if (settings.jitter_s > 0.0 || recorder.lost_share > 0.0)
    loop.run.recording.dt =
        (loop.stamps.back() - loop.stamps.front()) / static_cast<double>(loop.stamps.size() - 1);
  return loop;
}

}  // namespace gapscope::independent_plant

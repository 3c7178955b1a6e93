// Random quasi-static drives for the lost-motion route: how often it answers, how well, and how honest its
// intervals are. study_lost_motion [first seed] [number of drives]
//
// Laws: torque amplitude log-uniform 0.05–0.5 N m, triangle or sine (2 : 1) of 0.1–0.5 Hz, 5 periods at 400
// Hz, 20 or 16 bit, half with noise of 0.7 quanta; gap log-uniform 5–50 mrad or none; elastic wind-up a/k
// log-uniform 0.07–6.7 mrad; motor damping ×0.2–2; friction of the motor uniform 2–60 % of the torque
// (stiction: half of that, 1.2–2.2 times as much at rest); cogging of 10 % on half of the gap-free drives
// that do not stick.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "gapscope/base/random.h"
#include "gapscope/base/statistics.h"
#include "gapscope/sliding_mode/detector.h"
#include "independent_plant/simulate.h"

namespace gapscope {
namespace {

constexpr std::array kKinds{"gap, no friction",     "gap, Coulomb",         "gap, stiction",
                            "gap, very heavy load", "none, Coulomb",        "none, stiction",
                            "none, presliding",     "none, very heavy load"};
constexpr std::size_t kWithGap = 4;

struct Case {
  std::size_t kind = 0;
  independent_plant::BlindDrive drive;
  independent_plant::BlindExcitation excitation;
  independent_plant::BlindSensor sensor;
  independent_plant::BlindOptions options;
};

void draw_friction(Case& c, std::mt19937_64& g, double torque) {
  const double level = torque * uniform(g, 0.02, 0.6);
  independent_plant::MotorEffects& motor = c.drive.effects.motor;
  if (c.kind == 1 || c.kind == 4) motor.friction.level_nm = level;
  if (c.kind == 3 || c.kind == 7) {
    motor.friction.level_nm = 0.3 * level;
    c.drive.load_inertia = c.drive.motor_inertia * log_uniform(g, 50.0, 1000.0);
    c.drive.load_coulomb = 2.0 * torque;
  }
  if (c.kind == 2 || c.kind == 5)
    motor.friction = {
        .level_nm = 0.5 * level, .stiction_ratio = uniform(g, 0.2, 1.2), .stribeck_speed_rad_s = 0.1};
  if (c.kind == 6) motor.bristle = {.level_nm = level, .length_rad = log_uniform(g, 1e-4, 1e-2)};
  const bool cogs = uniform(g, 0.0, 1.0) < 0.5;
  if (c.kind >= kWithGap && c.kind != 5 && cogs) motor.cogging.amplitude = 0.1 * torque;
}

Case draw(std::uint64_t seed) {
  auto g = random_stream(seed, "quasi-static drive");
  Case c;
  c.kind = static_cast<std::size_t>(seed % kKinds.size());
  const double torque = log_uniform(g, 0.05, 0.5), gap = log_uniform(g, 0.005, 0.05);
  c.drive.gap = c.kind < kWithGap ? gap : 0.0;
  c.drive.load =
      c.kind % kWithGap == 3 ? independent_plant::BlindLoad::kFree : independent_plant::BlindLoad::kLocked;
  c.drive.contact_stiffness = 3.0 * torque * log_uniform(g, 50.0, 5000.0);
  c.drive.motor_damping *= log_uniform(g, 0.2, 2.0);
  draw_friction(c, g, torque);
  c.excitation.waveform = uniform(g, 0.0, 3.0) < 2.0 ? independent_plant::Waveform::kTriangle
                                                     : independent_plant::Waveform::kSine;
  c.excitation.amplitude = torque / c.drive.torque_constant;
  c.excitation.frequency = log_uniform(g, 0.1, 0.5);
  const int bits = uniform(g, 0.0, 1.0) < 0.5 ? 16 : 20;
  c.sensor = independent_plant::BlindSensor::with_bits(bits, uniform(g, 0.0, 1.0) < 0.5 ? 0.0 : 0.7);
  c.options = {.rate = 400.0,
               .duration = 5.0 / c.excitation.frequency,
               .seed = seed,
               .tolerance = independent_plant::kFastTolerance};
  return c;
}

/// Distance of the true x1 at the zeros of the command after its two directions.
double true_play(const Case& c, const independent_plant::BlindRun& run) {
  std::vector<double> after_plus, after_minus;
  for (double t = 1.0 / c.excitation.frequency; t < c.options.duration - 1e-9;
       t += 0.5 / c.excitation.frequency) {
    const auto i = static_cast<std::size_t>(std::lround(t * c.options.rate));
    const bool falling = std::lround(2.0 * t * c.excitation.frequency) % 2 != 0;
    if (i < run.truth.x1.size()) (falling ? after_plus : after_minus).push_back(run.truth.x1[i]);
  }
  return median(after_plus) - median(after_minus);
}

struct Tally {
  int cases = 0, backlash = 0, none = 0, too_small = 0, covered = 0;
  std::vector<double> errors;
};

void add(Tally& tally, const Case& c, const independent_plant::BlindRun& run) {
  const MotorTrace trace = run.recording.motor_trace();
  const GapEstimate e = detect_gap({&trace, 1});
  ++tally.cases;
  tally.none += e.verdict == GapVerdict::kNone;
  tally.too_small += e.verdict == GapVerdict::kNone && e.smallest_visible_gap < c.drive.gap;
  if (e.verdict != GapVerdict::kBacklash) return;
  ++tally.backlash;
  const double truth = e.method == GapMethod::kLostMotion ? true_play(c, run) : c.drive.gap;
  tally.errors.push_back(std::abs(e.gap / truth - 1.0));
  tally.covered += e.ci95.low <= truth && truth <= e.ci95.high;
}

void print(const std::string& name, const Tally& t) {
  const Interval share = wilson(t.backlash, t.cases), covered = wilson(t.covered, t.backlash);
  fmt::print(
      "{:22s} n {:4d}  backlash {:3d} [{:.1f}, {:.1f}] %  none {:3d} (limit below the gap: {})  play: error "
      "median "
      "{:.2f} 95 % {:.2f} max {:.2f} %, covered {} [{:.2f}, {:.2f}]\n",
      name, t.cases, t.backlash, 100.0 * share.low, 100.0 * share.high, t.none, t.too_small,
      100.0 * quantile(t.errors, 0.5), 100.0 * quantile(t.errors, 0.95), 100.0 * quantile(t.errors, 1.0),
      t.covered, covered.low, covered.high);
}

Tally sum(const std::array<Tally, kKinds.size()>& tallies, std::size_t from, std::size_t to) {
  Tally all;
  for (std::size_t k = from; k < to; ++k) {
    const Tally& t = tallies[k];
    all.cases += t.cases, all.backlash += t.backlash, all.none += t.none;
    all.too_small += t.too_small, all.covered += t.covered;
    all.errors.insert(all.errors.end(), t.errors.begin(), t.errors.end());
  }
  return all;
}

int main_study(int argc, char** argv) {
  const std::uint64_t first = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 1;
  const int count = argc > 2 ? std::atoi(argv[2]) : 80;
  std::array<Tally, kKinds.size()> tallies;
  for (int i = 0; i < count; ++i) {
    const Case c = draw(first + static_cast<std::uint64_t>(i));
    add(tallies[c.kind], c, simulate_blind(c.drive, c.excitation, c.sensor, c.options));
  }
  for (std::size_t k = 0; k < kKinds.size(); ++k) print(kKinds[k], tallies[k]);
  print("all with a gap", sum(tallies, 0, kWithGap));
  print("all without", sum(tallies, kWithGap, kKinds.size()));
  return 0;
}

}  // namespace
}  // namespace gapscope

int main(int argc, char** argv) { return gapscope::main_study(argc, argv); }

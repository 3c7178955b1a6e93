// Random quasi-static drives for the lost-motion route: how often it answers, how well, and how honest its
// intervals are, and what it says the lost motion consists of. study_lost_motion [first seed] [number of
// drives] [each]
//
// Laws: torque amplitude log-uniform 0.05–0.5 N m, triangle or sine (2 : 1) of 0.1–0.5 Hz, 5 periods at 400
// Hz, 20 or 16 bit, half with noise of 0.7 quanta; gap log-uniform 5–50 mrad or none; elastic wind-up a/k
// log-uniform 0.07–6.7 mrad; motor damping ×0.2–2; friction of the motor uniform 2–60 % of the torque
// (stiction: half of that, 1.2–2.2 times as much at rest); cogging of 10 % on half of the gap-free drives
// that do not stick; half with noise of the recorded torque of 2–8 % of its amplitude.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "base/random.h"
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
  double torque_noise = 0.0;  ///< of the recorded u, not of the torque that acts [unit of u]
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
  if (uniform(g, 0.0, 1.0) < 0.5) c.torque_noise = c.excitation.amplitude * uniform(g, 0.02, 0.08);
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
  int cases = 0, backlash = 0, none = 0, too_small = 0;
  int told = 0, covered = 0;             // lost motion
  int gap = 0, friction = 0, limit = 0;  // what it is said to consist of; the gap is above its limit
  std::vector<double> errors, widths;    // of the lost motion [%]
};

void add_noise(const Case& c, Recording& r) {
  auto g = random_stream(c.options.seed, "torque noise");
  if (c.torque_noise > 0.0)
    for (double& u : r.u) u += c.torque_noise * normal(g);
}

void add(Tally& tally, const Case& c, independent_plant::BlindRun& run, bool each) {
  add_noise(c, run.recording);
  const MotorTrace trace = run.recording.motor_trace();
  const GapEstimate e = detect_gap({&trace, 1});
  const LostMotion& m = e.lost_motion;
  ++tally.cases;
  tally.backlash += e.verdict == GapVerdict::kBacklash;
  tally.none += e.verdict == GapVerdict::kNone;
  tally.too_small += e.verdict == GapVerdict::kNone && e.smallest_visible_gap < c.drive.gap;
  const double truth = true_play(c, run);
  if (each)
    fmt::print(
        "{} {}: gap {:.3f}, lost motion {:.4f}, told {:.4f} [{:.4f}, {:.4f}] mrad, {}; noise {:.2f}; {}\n",
        c.options.seed, kKinds[c.kind], 1e3 * c.drive.gap, 1e3 * truth, 1e3 * m.value, 1e3 * m.ci95.low,
        1e3 * m.ci95.high, to_string(m.cause), c.torque_noise / c.excitation.amplitude, e.brief_report());
  if (!m.read()) return;
  ++tally.told;
  tally.covered += m.ci95.low <= truth && truth <= m.ci95.high;
  tally.errors.push_back(100.0 * std::abs(m.value / truth - 1.0));
  tally.widths.push_back(100.0 * 0.5 * (m.ci95.high - m.ci95.low) / truth);
  tally.gap += m.cause == LostMotionCause::kGap;
  tally.friction += m.cause == LostMotionCause::kFriction;
  tally.limit += m.gap_limit < c.drive.gap;
}

void print(const std::string& name, const Tally& t) {
  const Interval share = wilson(t.backlash, t.cases), covered = wilson(t.covered, t.told);
  fmt::print("{:22s} n {:4d}  backlash {:3d} [{:.1f}, {:.1f}] %, none {:3d} (limit below the gap: {})\n",
             name, t.cases, t.backlash, 100.0 * share.low, 100.0 * share.high, t.none, t.too_small);
  fmt::print(
      "  lost motion told {:4d}: error median {:.2f} 95 % {:.2f} max {:.2f} %, half width median {:.2f} %, "
      "covered {} = {:.1f} [{:.1f}, {:.1f}] %; a gap {}, friction {}, limit below the gap {}\n",
      t.told, quantile(t.errors, 0.5), quantile(t.errors, 0.95), quantile(t.errors, 1.0),
      quantile(t.widths, 0.5), t.covered, 100.0 * t.covered / std::max(t.told, 1), 100.0 * covered.low,
      100.0 * covered.high, t.gap, t.friction, t.limit);
}

Tally sum(const std::array<Tally, kKinds.size()>& tallies, std::size_t from, std::size_t to) {
  Tally all;
  for (std::size_t k = from; k < to; ++k) {
    const Tally& t = tallies[k];
    all.cases += t.cases, all.backlash += t.backlash, all.none += t.none;
    all.too_small += t.too_small, all.covered += t.covered, all.told += t.told;
    all.gap += t.gap, all.friction += t.friction, all.limit += t.limit;
    all.errors.insert(all.errors.end(), t.errors.begin(), t.errors.end());
    all.widths.insert(all.widths.end(), t.widths.begin(), t.widths.end());
  }
  return all;
}

int main_study(int argc, char** argv) {
  const std::uint64_t first = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 1;
  const int count = argc > 2 ? std::atoi(argv[2]) : 80;
  std::array<Tally, kKinds.size()> tallies;
  for (int i = 0; i < count; ++i) {
    const Case c = draw(first + static_cast<std::uint64_t>(i));
    independent_plant::BlindRun run = simulate_blind(c.drive, c.excitation, c.sensor, c.options);
    add(tallies[c.kind], c, run, argc > 3 && std::string(argv[3]) == "each");
  }
  for (std::size_t k = 0; k < kKinds.size(); ++k) print(kKinds[k], tallies[k]);
  print("all with a gap", sum(tallies, 0, kWithGap));
  print("all without", sum(tallies, kWithGap, kKinds.size()));
  return 0;
}

}  // namespace
}  // namespace gapscope

int main(int argc, char** argv) { return gapscope::main_study(argc, argv); }

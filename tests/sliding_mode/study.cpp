// Random drives for the detector: how often it answers, how well, and how honest its intervals are.
// study [first seed] [number of drives] [gap|free] [verbose]
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <map>

#include "gapscope/base/statistics.h"
#include "gapscope/sliding_mode/detector.h"
#include "sliding_mode/test_drive.h"

namespace gapscope {
namespace {

struct Case {
  TestDrive drive;
  TestEncoder encoder;
  double torque = 0.0, frequency = 0.0;
  TestRecording recording;
};

constexpr int kBits[] = {20, 16, 14, 12};

void draw_encoder(Case& c, std::mt19937_64& g, std::uint64_t seed) {
  c.frequency = uniform(g, 0.5, 3.0);
  c.encoder.rate = log_uniform(g, 1000.0, 10000.0);
  c.encoder.duration = 7.0 / c.frequency;
  c.encoder.bits = kBits[static_cast<int>(uniform(g, 0.0, 4.0))];
  c.encoder.noise = uniform(g, 0.0, 1.0) < 0.5 ? uniform(g, 0.3, 1.5) : 0.0;
  c.encoder.seed = seed;
}

double travel(const std::vector<double>& y) {
  const auto [low, high] =
      std::minmax_element(y.begin() + static_cast<std::ptrdiff_t>(y.size() / 2), y.end());
  return *high - *low;
}

/// The laws of the random drives; a travel below 1.5 gaps peak to peak is drawn again.
Case draw_drive(std::uint64_t seed) {
  auto g = random_stream(seed, "random drive");
  for (;;) {
    Case c;
    c.drive.gap = log_uniform(g, 0.005, 0.05);
    c.drive.m2 = c.drive.m1 * log_uniform(g, 0.1, 10.0);
    c.drive.k = log_uniform(g, 50.0, 5000.0);
    c.drive.d1 *= log_uniform(g, 0.2, 2.0);
    c.drive.d2 *= log_uniform(g, 0.2, 2.0);
    c.torque = log_uniform(g, 0.03, 0.5);
    c.drive.Fc2 = c.torque * uniform(g, 0.02, 0.6);
    draw_encoder(c, g, seed);
    c.encoder.step = 2e-6;
    TestEncoder rough = c.encoder;
    rough.step = 1e-5;
    rough.duration = 2.0 / c.frequency;
    if (travel(record(c.drive, sine(c.torque / c.drive.Km, c.frequency), rough).true_x1) < 1.5 * c.drive.gap)
      continue;
    c.recording = record(c.drive, sine(c.torque / c.drive.Km, c.frequency), c.encoder);
    return c;
  }
}

/// Seven kinds of drives without a gap, in turn.
Case draw_gap_free(std::uint64_t seed) {
  auto g = random_stream(seed, "gap-free drive");
  Case c;
  TestDrive& d = c.drive;
  c.torque = log_uniform(g, 0.05, 0.5);
  d.gap = 0.0;
  d.m2 = d.m1 * log_uniform(g, 0.1, 10.0);
  d.k = log_uniform(g, 30.0, 5000.0);
  d.d1 *= log_uniform(g, 0.2, 2.0);
  d.d2 *= log_uniform(g, 0.2, 2.0);
  d.Fc2 = c.torque * uniform(g, 0.02, 0.6);
  const int kind = static_cast<int>(seed % 7);
  if (kind != 1 && kind != 6) d.m1 += d.m2, d.d1 += d.d2, d.m2 = 0.0;
  if (kind == 0) d.Fc1 = d.Fc2;
  if (kind == 2) d.Fc1 = c.torque * uniform(g, 0.1, 0.7);
  if (kind == 3 || kind == 6) d.Fc1 = c.torque * uniform(g, 0.05, 0.4), d.Fs1 = d.Fc1 * uniform(g, 1.1, 1.9);
  if (kind == 4) d.Fc1 = c.torque * uniform(g, 0.05, 0.5), d.bristle = d.Fc1 / log_uniform(g, 1e-4, 1e-2);
  if (kind == 5)
    d.Fc1 = d.Fc2, d.cogging = c.torque * uniform(g, 0.05, 0.3),
    d.periods = uniform(g, 0.0, 1.0) < 0.5 ? 12 : 60;
  draw_encoder(c, g, seed);
  c.recording = record(d, sine(c.torque / d.Km, c.frequency), c.encoder);
  return c;
}

/// Share of the gap that the load travels from one flank to the other, median (true signals).
double coasting(const Case& c) {
  const auto& r = c.recording;
  std::vector<double> moved;
  int side = 0;
  double from = 0.0;
  for (std::size_t i = r.true_x1.size() / 3; i < r.true_x1.size(); ++i) {
    const double delta = r.true_x1[i] - r.true_x2[i];
    if (std::abs(delta) < 0.5 * c.drive.gap) continue;
    const int now = delta > 0.0 ? 1 : -1;
    if (side != 0 && now != side) moved.push_back(std::abs(r.true_x2[i] - from));
    side = now;
    from = r.true_x2[i];
  }
  return moved.empty() ? 0.0 : median(moved) / c.drive.gap;
}

struct Tally {
  int cases = 0, accepted = 0, none = 0, false_none = 0, covered = 0;
  std::vector<double> errors;
  void add(const Case& c, const GapEstimate& e) {
    ++cases;
    none += e.verdict == GapVerdict::kNone;
    false_none += e.verdict == GapVerdict::kNone && e.smallest_visible_gap < c.drive.gap;
    if (e.verdict != GapVerdict::kBacklash) return;
    ++accepted;
    covered += e.ci95.low <= c.drive.gap && c.drive.gap <= e.ci95.high;
    if (c.drive.gap > 0.0) errors.push_back(std::abs(e.gap / c.drive.gap - 1.0));
  }
  void print(const std::string& name) const {
    const Interval a = wilson(accepted, cases), v = wilson(covered, accepted), f = wilson(false_none, cases);
    fmt::print(
        "{:22s} n {:4d} backlash {:3d} [{:.0f}, {:.0f}] %  error median {:.1f} 95 % {:.1f} max {:.1f} %  "
        "covered "
        "{}/{} [{:.2f}, {:.2f}]  none {} (too small a limit: {} [{:.1f}, {:.1f}] %)\n",
        name, cases, accepted, 100 * a.low, 100 * a.high, 100 * quantile(errors, 0.5),
        100 * quantile(errors, 0.95), 100 * quantile(errors, 1.0), covered, accepted, v.low, v.high, none,
        false_none, 100 * f.low, 100 * f.high);
  }
};

void print_case(std::uint64_t seed, const Case& c, const GapEstimate& e) {
  fmt::print(
      "{:4d} gap {:5.1f} m2/m1 {:5.2f} k {:4.0f} Fc2/tau {:.2f} tau {:.3f} f {:.1f} {:5.0f} Hz {} bit n "
      "{:.1f} "
      "travel {:.1f} gaps coast {:.2f} | {} {:.2f} ({:+.1f} %) [{:.2f} {:.2f}] gmin {:.2f} {}\n",
      seed, 1e3 * c.drive.gap, c.drive.m2 / c.drive.m1, c.drive.k, c.drive.Fc2 / c.torque, c.torque,
      c.frequency, c.encoder.rate, c.encoder.bits, c.encoder.noise, travel(c.recording.true_x1) / c.drive.gap,
      coasting(c), to_string(e.verdict), 1e3 * e.gap, 100 * (e.gap / c.drive.gap - 1), 1e3 * e.ci95.low,
      1e3 * e.ci95.high, 1e3 * e.smallest_visible_gap, e.reason);
  for (const auto& event : e.events)
    fmt::print("       t1 {:.4f} t2 {:.4f} gap {:.3f} S5 {:.3f} std {:.3f} {} {}\n", event.t1, event.t2,
               1e3 * event.gap, 1e3 * event.gap_uncorrected, 1e3 * event.std, event.direction, event.remark);
}

int main_study(int argc, char** argv) {
  const std::uint64_t first = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 1;
  const int count = argc > 2 ? std::atoi(argv[2]) : 100;
  const bool with_gap = argc <= 3 || std::strcmp(argv[3], "free") != 0;
  const int verbose = argc > 4 ? std::atoi(argv[4]) : 0;
  std::map<std::string, Tally> tallies;
  for (int i = 0; i < count; ++i) {
    const std::uint64_t seed = first + static_cast<std::uint64_t>(i);
    const Case c = with_gap ? draw_drive(seed) : draw_gap_free(seed);
    const MotorTrace trace = c.recording.trace();
    GapEstimate e = detect_gap({&trace, 1});
    if (verbose < 2) e.events.clear();
    if (verbose > 0) print_case(seed, c, e);
    tallies["0 all"].add(c, e);
    tallies[fmt::format("1 {} bit", c.encoder.bits)].add(c, e);
    if (!with_gap) {
      tallies[fmt::format("2 kind {}", seed % 7)].add(c, e);
      continue;
    }
    const double s = coasting(c);
    tallies[s < 0.01 ? "3 load at rest" : s < 0.3 ? "4 coasting 1-30 %" : "5 coasting > 30 %"].add(c, e);
  }
  for (const auto& [name, tally] : tallies) tally.print(name);
  return 0;
}

}  // namespace
}  // namespace gapscope

int main(int argc, char** argv) { return gapscope::main_study(argc, argv); }

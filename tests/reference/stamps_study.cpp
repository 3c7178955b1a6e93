// Do the intervals hold on rows that a PC wrote: steps off by 5 to 30 %, 1 % of the rows lost, their inputs
// with them? Random drives of the independent plant, each fitted once from numbers that are wrong by a factor
// of up to 2. study_stamps [first seed] [number of drives] [held|bridged|even] [verbose]
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <map>
#include <string>

#include "base/random.h"
#include "gapscope/base/statistics.h"
#include "recording/lost_rows.h"
#include "reference/rigs.h"
#include "support/uneven.h"

namespace gapscope {
namespace {

using namespace test;

constexpr double kFarthestStart = 2.0;  ///< factor by which a start is wrong at most, either way
constexpr double kLostShare = 0.01;
constexpr int kSought[] = {kGap, kMotorDamping, kMassRatio, kLoadDamping, kLoadCoulombFriction};

struct StampedCase {
  independent_plant::BlindDrive drive;
  independent_plant::BlindSensor sensor;
  UnevenClock clock;
  double amplitude = 0.0, frequency = 0.0;

  Recording recording(bool even) const {
    const auto input = [this](double t) { return amplitude * std::sin(2.0 * kPi * frequency * t); };
    return even ? even_recording(drive, input, sensor, clock) : uneven_recording(drive, input, sensor, clock);
  }
};

/// The rig of the source paper with every number but inertia and torque constant drawn anew, at the rates of
/// PCs.
StampedCase drawn_case(std::uint64_t seed) {
  constexpr int kBits[] = {20, 16, 14, 12};
  constexpr double kRates[] = {250.0, 500.0, 1000.0};
  auto g = random_stream(seed, "stamps study");
  StampedCase c;
  independent_plant::BlindDrive& d = c.drive;
  d.gap = log_uniform(g, 5e-3, 40e-3);
  d.load_inertia = d.motor_inertia * log_uniform(g, 0.3, 4.0);
  d.contact_stiffness *= log_uniform(g, 0.5, 4.0);
  for (double* number : {&d.motor_damping, &d.load_damping, &d.load_coulomb, &d.contact_damping})
    *number *= log_uniform(g, 0.5, 2.0);
  d.x2 = 0.49 * d.gap * uniform(g, -1.0, 1.0);
  c.amplitude = uniform(g, 0.6, 1.0);
  c.frequency = uniform(g, 0.7, 1.5);
  const double noise = uniform(g, 0.3, 1.5);
  c.sensor = independent_plant::BlindSensor::with_bits(kBits[seed % 4], seed / 4 % 2 == 0 ? noise : 0.0);
  c.clock = {
      kRates[seed % 3], 4.0, uniform(g, 0.05, 0.3), kLostShare, independent_plant::kFastTolerance, seed};
  return c;
}

struct Tally {
  int told = 0, held = 0;
  std::vector<double> errors;  ///< relative
};

/// Of the gap, in travels of a sample: root mean square of x1 from row to row.
double in_travels(double error, const Recording& r) {
  double sum = 0.0;
  for (std::size_t i = 1; i < r.size(); ++i) sum += (r.x1[i] - r.x1[i - 1]) * (r.x1[i] - r.x1[i - 1]);
  return error / std::sqrt(sum / static_cast<double>(r.size() - 1));
}

int main_study(int argc, char** argv) {
  const std::uint64_t first = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 1;
  const int count = argc > 2 ? std::atoi(argv[2]) : 60;
  const std::string how = argc > 3 ? argv[3] : "bridged";
  const bool verbose = argc > 4;
  std::map<int, Tally> tallies;
  std::vector<double> biases;
  int rejected = 0;
  for (int i = 0; i < count; ++i) {
    const std::uint64_t seed = first + static_cast<std::uint64_t>(i);
    const StampedCase c = drawn_case(seed);
    Recording r = c.recording(how == "even");
    if (how == "bridged") bridge_lost_rows(r);
    auto g = random_stream(seed, "stamps starts");
    ReferenceModel model = known_model(c.drive);
    const auto truth = numbers_of(c.drive);
    for (const int n : kSought)
      estimate(model, n,
               truth[static_cast<std::size_t>(n)] * log_uniform(g, 1.0 / kFarthestStart, kFarthestStart));
    const FitSummary found = fit_one(r, model);
    rejected += found.rejected();
    if (verbose)
      fmt::print("{} {:.0f} Hz {:.2f} {} rmse/floor {:.2f}", seed, c.clock.rate, c.clock.jitter,
                 to_string(found.trust), found.rmse / found.floor);
    for (const int n : kSought) {
      const FittedParameter* p = found.find(kDriveParameters[n].key);
      const double is = truth[static_cast<std::size_t>(n)];
      Tally& t = tallies[n];
      t.told += p->identifiable && !found.rejected();
      t.held += !found.rejected() && p->identifiable && contains(found, kDriveParameters[n].key, is);
      t.errors.push_back(std::abs(p->value / is - 1.0));
      if (n == kGap && !found.rejected()) biases.push_back(in_travels(p->value - is, r));
      if (verbose)
        fmt::print("  {} {:+.2f}% ({:+.1f}s)", p->key, 100.0 * (p->value / is - 1.0),
                   (p->value - is) / p->std);
    }
    if (verbose) fmt::print("\n");
    std::fflush(stdout);
  }
  fmt::print("rejected {} of {}\n", rejected, count);
  for (const auto& [n, t] : tallies) {
    const Interval share = wilson(t.held, t.told);
    fmt::print("{:<22} told {} held {} = {:.1f} % [{:.1f}, {:.1f}], error median {:.3f} %, 95 % {:.2f} %\n",
               kDriveParameters[n].key, t.told, t.held, 100.0 * t.held / std::max(t.told, 1),
               100.0 * share.low, 100.0 * share.high, 100.0 * median(t.errors),
               100.0 * quantile(t.errors, 0.95));
  }
  std::vector<double> sizes;
  for (const double b : biases) sizes.push_back(std::abs(b));
  if (!biases.empty())
    fmt::print(
        "gap, in travels of a sample: median {:+.4f}, of its size {:.4f}, 95 % {:.4f}, largest {:.4f}\n",
        median(biases), median(sizes), quantile(sizes, 0.95), quantile(sizes, 1.0));
  return 0;
}

}  // namespace
}  // namespace gapscope

int main(int argc, char** argv) { return gapscope::main_study(argc, argv); }

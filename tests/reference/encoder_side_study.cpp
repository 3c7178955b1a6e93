// Do the intervals hold with the encoder on the load, or with one on either side? Random drives of the
// independent plant, each fitted once from numbers that are wrong by a factor of up to 2. study_encoder_side
// [first seed] [number of drives] [motor|load|both] [verbose]
// Of both the motor's is fitted, and the load's validates: how far the fitted model's x2 is from what that
// encoder alone leaves, and whether the gap between both encoders is the fitted one.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <string>

#include "base/random.h"
#include "diagnosis/second_encoder.h"
#include "gapscope/base/statistics.h"
#include "reference/rigs.h"

namespace gapscope {
namespace {

using namespace test;

constexpr double kFarthestStart = 2.0;  ///< factor by which a start is wrong at most, either way
enum class Read { kMotor, kLoad, kBoth };

constexpr int kSought[] = {kGap, kMotorDamping, kMassRatio, kLoadDamping, kLoadCoulombFriction};

/// The rig of the source paper with every number but inertia and torque constant drawn anew.
BlindRig drawn_drive(std::uint64_t seed) {
  constexpr int kBits[] = {20, 16, 14, 12};
  auto g = random_stream(seed, "encoder side study");
  BlindRig run;
  independent_plant::BlindDrive& d = run.drive;
  d.gap = log_uniform(g, 5e-3, 40e-3);
  d.load_inertia = d.motor_inertia * log_uniform(g, 0.3, 4.0);
  d.contact_stiffness *= log_uniform(g, 0.5, 4.0);
  for (double* number : {&d.motor_damping, &d.load_damping, &d.load_coulomb, &d.contact_damping})
    *number *= log_uniform(g, 0.5, 2.0);
  d.x2 = 0.49 * d.gap * uniform(g, -1.0, 1.0);
  run.excitation.amplitude = uniform(g, 0.6, 1.0);
  run.excitation.frequency = uniform(g, 0.7, 1.5);
  const double noise = uniform(g, 0.3, 1.5);
  run.sensor = independent_plant::BlindSensor::with_bits(kBits[seed % 4], seed / 4 % 2 == 0 ? noise : 0.0);
  run.options = {1000.0, 4.0, seed, independent_plant::kFastTolerance};
  return run;
}

/// With the motor's encoder, the load's, or both of one kind.
Recording recorded(const BlindRig& run, std::uint64_t seed, Read read) {
  Recording r = run.recording();
  if (read == Read::kMotor) return r;
  const Recording load = read_on_load(r, run.sensor, seed);
  if (read == Read::kLoad) return load;
  r.x2 = load.x2;
  return r;
}

FitSummary fitted(const BlindRig& run, const Recording& recording, std::uint64_t seed) {
  auto g = random_stream(seed, "encoder side starts");
  ReferenceModel model = known_model(run.drive);
  model.structure.encoder = recording.encoder;
  for (const int n : kSought)
    estimate(model, n,
             model.parameters[static_cast<std::size_t>(n)].value *
                 log_uniform(g, 1.0 / kFarthestStart, kFarthestStart));
  return fit_one(recording, model);
}

/// What the intervals of one parameter did.
struct Tally {
  int told = 0, held = 0;
  std::vector<double> errors;  ///< relative
};

/// What the load's encoder says of fits to the motor's.
struct Validation {
  std::vector<double> left;         ///< error of the fitted model's x2 [floor of that encoder]
  std::vector<double> differences;  ///< the fitted gap less the one between both encoders, over the latter
};

void validate(const Recording& recording, const FitSummary& found, Validation& all) {
  const SecondEncoder second = validate_by_load(std::span(&recording, 1), &found);
  all.left.push_back(second.rmse / second.floor);
  if (std::isfinite(second.difference)) all.differences.push_back(second.difference / second.gap);
}

void print(const Validation& all) {
  if (all.left.empty()) return;
  const auto close = static_cast<int>(
      std::count_if(all.left.begin(), all.left.end(), [](double left) { return left < 1.3; }));
  const auto count = static_cast<int>(all.left.size());
  const Interval share = wilson(close, count);
  fmt::print(
      "x2 within 1.3 of its encoder's floor {} of {} = {:.1f} % [{:.1f}, {:.1f}], median {:.3f}, 95 % {:.2f}\n",
      close, count, 100.0 * close / count, 100.0 * share.low, 100.0 * share.high, median(all.left),
      quantile(all.left, 0.95));
  if (all.differences.empty()) return;
  fmt::print("fitted gap less that between both encoders: median {:+.2f} %, 5 % {:+.2f} %, 95 % {:+.2f} %\n",
             100.0 * median(all.differences), 100.0 * quantile(all.differences, 0.05),
             100.0 * quantile(all.differences, 0.95));
}

Read side_named(const std::string& name) {
  return name == "motor" ? Read::kMotor : name == "both" ? Read::kBoth : Read::kLoad;
}

int main_study(int argc, char** argv) {
  const std::uint64_t first = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 1;
  const int count = argc > 2 ? std::atoi(argv[2]) : 60;
  const Read read = side_named(argc > 3 ? argv[3] : "load");
  const bool verbose = argc > 4;
  std::map<int, Tally> tallies;
  std::map<std::string, int> trusts;
  Validation validation;
  for (int i = 0; i < count; ++i) {
    const std::uint64_t seed = first + static_cast<std::uint64_t>(i);
    const BlindRig run = drawn_drive(seed);
    const Recording recording = recorded(run, seed, read);
    const FitSummary found = fitted(run, recording, seed);
    if (read == Read::kBoth) validate(recording, found, validation);
    const auto truth = numbers_of(run.drive);
    ++trusts[to_string(found.trust)];
    if (verbose)
      fmt::print("{} {} rmse/floor {:.2f}", seed, to_string(found.trust), found.rmse / found.floor);
    for (const int n : kSought) {
      const FittedParameter* p = found.find(kDriveParameters[n].key);
      const double is = truth[static_cast<std::size_t>(n)];
      Tally& t = tallies[n];
      t.told += p->identifiable && !found.rejected();
      t.held += !found.rejected() && contains(found, kDriveParameters[n].key, is);
      t.errors.push_back(std::abs(p->value / is - 1.0));
      if (verbose)
        fmt::print("  {} {:+.2f}% ({:+.1f}s)", p->key, 100.0 * (p->value / is - 1.0),
                   (p->value - is) / p->std);
    }
    if (verbose) fmt::print("\n");
    std::fflush(stdout);
  }
  for (const auto& [trust, n] : trusts) fmt::print("{} {}\n", trust, n);
  for (const auto& [n, t] : tallies) {
    const Interval share = wilson(t.held, t.told);
    fmt::print("{:<22} told {} held {} = {:.1f} % [{:.1f}, {:.1f}], error median {:.3f} %, 95 % {:.2f} %\n",
               kDriveParameters[n].key, t.told, t.held, 100.0 * t.held / std::max(t.told, 1),
               100.0 * share.low, 100.0 * share.high, 100.0 * median(t.errors),
               100.0 * quantile(t.errors, 0.95));
  }
  print(validation);
  return 0;
}

}  // namespace
}  // namespace gapscope

int main(int argc, char** argv) { return gapscope::main_study(argc, argv); }

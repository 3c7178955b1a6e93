// Random recordings for the reference: how often it finds the optimum from afar, how well, and whether its
// intervals hold. Three rigs, sine and multisine, by the independent plant.
// study_reference [first seed] [fits] [list] [free 5|7] [verbose] [jobs]
//   recover    20, 14 and 12 bit, every second one with noise of 0.3–1.5 quanta
//   noise      the same, all with noise
//   quantiser  12 bit without noise
// and as recover, with every number sought without a start:
//   unknown       with them a dry friction of the motor, which these drives do not have: a configuration of
//                 `gapscope init`
//   rubs          the same, of motors with a dry friction of 2–20 % of the torque
//   rotor         the same, where the inertia of the motor is known
//   coasts        those of rubs, and friction and damping of the load from a hundredth on
//   hard          those of rubs whose contact is 1 to 15 times as stiff and dissipates 1 to 8 times as much
//   left_out      the motors of rubs by a model without their friction
//   frictionless  the drives of unknown by that model
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <map>
#include <stdexcept>
#include <string>
#include <thread>

#include "base/random.h"
#include "gapscope/base/statistics.h"
#include "reference/rigs.h"

namespace gapscope {
namespace {

using namespace test;

constexpr double kFarthest = 3.0;    ///< starts are wrong by a factor up to this, either way
constexpr double kSameCost = 1.001;  ///< against a fit started at the truth
constexpr int kOrder[] = {kGap,
                          kMotorDamping,
                          kMassRatio,
                          kLoadDamping,
                          kLoadCoulombFriction,
                          kContactStiffness,
                          kContactDamping,
                          kMotorInertia};
constexpr int kAll = 8;
constexpr const char* kFriction = "motor_coulomb_friction";

/// What is drawn, and what is sought of it.
struct List {
  const char* name;
  bool unknown = false;         ///< every number is sought without a start
  bool rubs = false;            ///< the motor has a dry friction
  bool seeks_friction = false;  ///< and the model
  bool coasts = false;          ///< friction and damping of the load are small
  bool hard = false;            ///< the contact is stiffer and dissipates more
  bool rotor = false;           ///< the inertia of the motor is known
};
constexpr List kLists[] = {{"recover"},
                           {"noise"},
                           {"quantiser"},
                           {"unknown", true, false, true},
                           {"rubs", true, true, true},
                           {"rotor", true, true, true, false, false, true},
                           {"coasts", true, true, true, true},
                           {"hard", true, true, true, false, true},
                           {"left_out", true, true},
                           {"frictionless", true}};

const List& list_called(const std::string& name) {
  for (const List& list : kLists)
    if (name == list.name) return list;
  throw std::runtime_error("there is no list " + name);
}

struct Case {
  std::string rig, waveform;
  int bits = 20;
  double noise = 0.0;  ///< [quanta]
  BlindRig run;
  std::array<double, kDriveParameterCount> truth{}, start{};
  bool seeks_friction = false;  ///< of the motor
};

/// Three unlike drives: the paper's; a geared axis; a heavy load behind a small gap.
BlindRig rig_of(int kind) {
  BlindRig run;
  independent_plant::BlindDrive& d = run.drive;
  if (kind == 0) run.options.rate = 2000.0;
  if (kind == 1) {
    d.motor_inertia = 5e-4, d.load_inertia = 15e-4, d.gap = 30e-3;
    d.motor_damping = 0.02, d.load_damping = 0.03, d.load_coulomb = 0.03;
    d.contact_stiffness = 400.0, d.contact_damping = 0.1;
    run.options.rate = 1000.0;
  }
  if (kind == 2) {
    d.motor_inertia = 2e-3, d.load_inertia = 16e-3, d.gap = 5e-3;
    d.motor_damping = 0.05, d.load_damping = 0.06, d.load_coulomb = 0.08;
    d.contact_stiffness = 3000.0, d.contact_damping = 0.5;
    run.options.rate = 4000.0;
  }
  run.options.duration = 8.0;
  run.options.tolerance = independent_plant::kFastTolerance;
  return run;
}

Case draw(std::uint64_t seed, const std::string& list, int free) {
  constexpr const char* kRigs[] = {"paper", "geared", "heavy"};
  constexpr double kTorque[] = {0.1, 0.1, 0.25};  ///< typical amplitude [N m]
  constexpr int kBits[] = {20, 14, 12};
  const List& asked = list_called(list);
  auto g = random_stream(seed, "reference study");
  const int rig = static_cast<int>(seed % 3);
  Case c;
  c.rig = kRigs[rig];
  c.run = rig_of(rig);
  const bool sine = seed / 3 % 2 == 0;
  c.waveform = sine ? "sine" : "multisine";
  c.bits = list == "quantiser" ? 12 : kBits[seed / 6 % 3];
  const double drawn = uniform(g, 0.3, 1.5);
  const bool every_second = list == "recover" || asked.unknown;
  c.noise = list == "noise" || (every_second && seed / 18 % 2 == 1) ? drawn : 0.0;
  c.run.sensor = independent_plant::BlindSensor::with_bits(c.bits, c.noise);
  c.run.options.seed = seed;
  c.run.excitation.waveform =
      sine ? independent_plant::Waveform::kSine : independent_plant::Waveform::kMultisine;
  c.run.excitation.frequency = sine ? uniform(g, 0.7, 1.5) : 0.5;
  c.run.excitation.amplitude =
      kTorque[rig] / c.run.drive.torque_constant * (sine ? 1.0 : 1.5) * uniform(g, 0.8, 1.4);
  c.run.drive.x2 = 0.49 * c.run.drive.gap * uniform(g, -1.0, 1.0);
  if (asked.coasts)
    c.run.drive.load_coulomb *= log_uniform(g, 0.01, 1.0),
        c.run.drive.load_damping *= log_uniform(g, 0.01, 1.0);
  if (asked.hard)
    c.run.drive.contact_stiffness *= log_uniform(g, 1.0, 15.0),
        c.run.drive.contact_damping *= log_uniform(g, 1.0, 8.0);
  c.truth = c.start = numbers_of(c.run.drive);
  for (int i = 0; i < free; ++i)
    c.start[static_cast<std::size_t>(kOrder[i])] *=
        asked.unknown ? kNaN : log_uniform(g, 1.0 / kFarthest, kFarthest);
  if (asked.rubs)
    c.run.drive.effects.motor.friction.level_nm =
        c.run.excitation.amplitude * c.run.drive.torque_constant * uniform(g, 0.02, 0.2);
  c.seeks_friction = asked.seeks_friction;
  return c;
}

struct FitOutcome {
  Case drawn;
  FitSummary found;
  double cost_ratio = kNaN;  ///< to that of a fit started at the truth
  double seconds = 0.0;
};

ReferenceModel model_of(const Case& c, const std::array<double, kDriveParameterCount>& start, int free) {
  ReferenceModel model = known_model(c.run.drive);
  for (int i = 0; i < free; ++i) estimate(model, kOrder[i], start[static_cast<std::size_t>(kOrder[i])]);
  if (c.seeks_friction) {
    const double level = c.run.drive.effects.motor.friction.level_nm;
    const bool at_truth = std::isfinite(start[kGap]) && level > 0.0;
    model.effects.push_back(
        {find_effect(kFriction), {at_truth ? ParameterSetting::sought(level) : ParameterSetting::sought()}});
  }
  return model;
}

FitOutcome run_case(const Case& c, int free) {
  FitOutcome o;
  o.drawn = c;
  const Recording recording = c.run.recording();
  const auto begin = std::chrono::steady_clock::now();
  o.found = fit_one(recording, model_of(c, c.start, free));
  o.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const FitSummary reference = fit_one(recording, model_of(c, c.truth, free));
  if (o.found.objective_hz == 0.0 && reference.objective_hz == 0.0)
    o.cost_ratio = std::pow(o.found.rmse / reference.rmse, 2);
  else  // no free run fits: the predictions are compared
    o.cost_ratio = std::pow(o.found.innovation_rmse / reference.innovation_rmse, 2);
  return o;
}

double relative_error(const FitOutcome& o, int number) {
  const FittedParameter* p = o.found.find(kDriveParameters[number].key);
  return std::abs(p->value / o.drawn.truth[static_cast<std::size_t>(number)] - 1.0);
}

struct Tally {
  int cases = 0, at_optimum = 0, believed = 0, believed_and_holds = 0;
  std::map<int, int> covered;
  std::map<int, std::vector<double>> errors;
  std::vector<double> seconds, simulations;

  void add(const FitOutcome& o, int free) {
    ++cases;
    at_optimum += o.cost_ratio <= kSameCost;
    const bool holds = contains(o.found, kDriveParameters[kGap].key, o.drawn.truth[kGap]);
    believed += o.found.trust != FitTrust::kRejected;
    believed_and_holds += o.found.trust != FitTrust::kRejected && holds;
    seconds.push_back(o.seconds);
    simulations.push_back(o.found.simulations);
    for (int i = 0; i < free; ++i) {
      const int n = kOrder[i];
      covered[n] += contains(o.found, kDriveParameters[n].key, o.drawn.truth[static_cast<std::size_t>(n)]);
      errors[n].push_back(relative_error(o, n));
    }
  }
  void print(const std::string& name) const {
    const Interval limits = wilson(at_optimum, cases);
    fmt::print(
        "{}: at the optimum {}/{} [{:.1f}, {:.1f}] %, {:.2f} s and {:.0f} simulations in the median; "
        "not rejected {}, and the gap in its interval {}\n",
        name, at_optimum, cases, 100 * limits.low, 100 * limits.high, median(seconds), median(simulations),
        believed, believed_and_holds);
    for (const auto& [n, e] : errors) {
      const Interval v = wilson(covered.at(n), cases);
      fmt::print(
          "    {:<22} error median {:.4f} 95 % {:.4f} max {:.3f} %   covered {:3d} [{:.1f}, {:.1f}] %\n",
          kDriveParameters[n].key, 100 * median(e), 100 * quantile(e, 0.95), 100 * quantile(e, 1.0),
          covered.at(n), 100 * v.low, 100 * v.high);
    }
  }
};

void print_case(std::uint64_t seed, const FitOutcome& o, int free) {
  const Case& c = o.drawn;
  fmt::print(
      "{} {} {} {} bit noise {:.1f} | ratio {:.4f} rmse/floor {:.2f} innov/floor {:.2f} at {:.3g} Hz "
      "starts {} sims {} {:.2f} s |",
      seed, c.rig, c.waveform, c.bits, c.noise, o.cost_ratio, o.found.rmse / o.found.floor,
      o.found.innovation_rmse / o.found.floor, o.found.objective_hz, o.found.starts, o.found.simulations,
      o.seconds);
  for (int i = 0; i < free; ++i) {
    const FittedParameter* p = o.found.find(kDriveParameters[kOrder[i]].key);
    const double truth = c.truth[static_cast<std::size_t>(kOrder[i])];
    fmt::print(" {:+.3f}%({:+.1f}s)", 100 * (p->value / truth - 1), (p->value - truth) / p->std);
  }
  fmt::print("\n");
}

int main_study(int argc, char** argv) {
  const std::uint64_t first = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 1;
  const int count = argc > 2 ? std::atoi(argv[2]) : 36;
  const std::string list = argc > 3 ? argv[3] : "recover";
  const int asked = argc > 4 ? std::clamp(std::atoi(argv[4]), 1, kAll - 1) : 5;
  const List& called = list_called(list);
  const int free = called.rotor ? kAll - 1 : called.unknown ? kAll : asked;
  const bool verbose = argc > 5 && std::atoi(argv[5]) > 0;
  const int jobs = argc > 6 ? std::max(1, std::atoi(argv[6])) : 1;
  std::vector<FitOutcome> outcomes(static_cast<std::size_t>(count));
  std::atomic<int> next = 0;
  const auto work = [&] {
    for (int i = next++; i < count; i = next++) {
      outcomes[static_cast<std::size_t>(i)] =
          run_case(draw(first + static_cast<std::uint64_t>(i), list, free), free);
      outcomes[static_cast<std::size_t>(i)].found.traces.clear();
    }
  };
  std::vector<std::thread> threads;
  for (int j = 0; j < jobs; ++j) threads.emplace_back(work);
  for (std::thread& t : threads) t.join();
  std::map<std::string, Tally> tallies;
  for (int i = 0; i < count; ++i) {
    const FitOutcome& o = outcomes[static_cast<std::size_t>(i)];
    if (verbose) print_case(first + static_cast<std::uint64_t>(i), o, free);
    tallies["0 all"].add(o, free);
    tallies[fmt::format("1 {} bit", o.drawn.bits)].add(o, free);
    tallies[o.drawn.noise > 0.0 ? "2 with noise" : "2 without noise"].add(o, free);
    tallies["3 " + o.drawn.rig + " " + o.drawn.waveform].add(o, free);
  }
  for (const auto& [name, tally] : tallies) tally.print(name);
  return 0;
}

}  // namespace
}  // namespace gapscope

int main(int argc, char** argv) { return gapscope::main_study(argc, argv); }

// Drives and simulators of them whose numbers are drawn and withheld: which rows are told right.
//   study_simulator FIRST COUNT [same] [few]
// same: nothing is drawn apart, only step and solver differ; few: among ten candidates, which is three times
// as fast
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <string>

#include "base/text.h"
#include "diagnosis/simulator.h"
#include "gapscope/telling/card.h"
#include "run/simulated_pair.h"

namespace gapscope::test {
namespace {

constexpr double kNear = 0.15;  ///< of the larger amount: an amount that is right

struct Counts {
  int drawn = 0, right = 0, elsewhere = 0, missed = 0, wrong = 0, artefacts = 0, grouped = 0, pairs = 0,
      silent = 0;
};

/// What the diagnoses make of a pair, and what the same comparison makes of it when it is told every effect.
struct Compared {
  SimulatorComparison found, told;

  /// Of a number that is drawn apart [floor]: what there is to see of it.
  double floors_of(const Knob& k) const {
    for (const SimulatorRow& row : told.rows)
      if (row.name == k.name) return row.floors;
    return 0.0;
  }
  bool shows(const Knob& k) const { return k.differs() && floors_of(k) > kLeastRow; }
};

/// A side's diagnosis as it would be if nothing were withheld: what is not there begins at a tenth of the
/// other side's.
Diagnosis with_the_truth(Diagnosis side, const SimulatedPair& p, double Knob::*here, double Knob::*there) {
  side.fitted = p.sheet, side.added.clear(), side.effects.clear();
  for (const Knob& k : p.knobs) {
    const EffectEntry* entry = find_effect(k.name);
    if (entry == nullptr) {
      side.fitted.set(k.name, ParameterSetting::sought(k.*here));
      continue;
    }
    ModelEffect e;
    e.entry = entry;
    e.parameters[0] = ParameterSetting::sought(k.*here > 0.0 ? k.*here : 0.1 * k.*there);
    for (std::size_t i = 1; i < entry->parameters.size(); ++i)
      e.parameters[i] = ParameterSetting::known(p.shape_of(k.name, entry->parameters[i]));
    side.fitted.effects.push_back(e);
    side.effects.push_back(k.name);
  }
  return side;
}

Compared compared(const SimulatedPair& p, DiagnosisOptions options) {
  options.threads = 1;
  const MotorTrace train[] = {p.train.motor_trace()}, held_out[] = {p.held_out.motor_trace()};
  const MotorTrace sim_train[] = {p.simulated_train.motor_trace()},
                   sim_held_out[] = {p.simulated_held_out.motor_trace()};
  const Diagnosis drive = diagnose(train, held_out, p.sheet, options);
  const Diagnosis simulator = diagnose(sim_train, sim_held_out, p.sheet, options);
  const auto laid = [&](const Diagnosis& d, const Diagnosis& s) {
    SimulatorComparison c = compare_with_simulator({train, held_out, sim_train, sim_held_out, d, s}, options);
    put_into_words(c, {});
    return c;
  };
  return {laid(drive, simulator), laid(with_the_truth(drive, p, &Knob::drive, &Knob::simulator),
                                       with_the_truth(simulator, p, &Knob::simulator, &Knob::drive))};
}

bool is_near(double told, double truth, double scale) { return std::abs(told - truth) < kNear * scale; }

/// Told with the amounts of both and, of an effect, where it is.
bool is_right(const Knob& k, const SimulatorRow& row) {
  const double scale = std::max(k.drive, k.simulator);
  const ComparedNumber& n = row.numbers.front();
  if (!is_near(n.drive, k.drive, scale) || !is_near(n.simulator, k.simulator, scale)) return false;
  if (!row.is_effect) return true;
  return row.found_in == (k.simulator == 0.0 ? FoundIn::kDrive
                          : k.drive == 0.0   ? FoundIn::kSimulator
                                             : FoundIn::kBoth);
}

/// Told under the name of what these recordings cannot tell it from, with the truth among the names.
bool in_its_group(const SimulatedPair& p, const SimulatorRow& row) {
  const std::size_t others = row.sentence.find(" (or ");
  if (others == std::string::npos) return false;
  for (const Knob& k : p.knobs)
    if (k.differs() && row.sentence.find(readable(k.name), others) != std::string::npos) return true;
  return false;
}

void count(const SimulatedPair& p, const Compared& c, Counts& counts) {
  bool silent = true;
  for (const SimulatorRow& row : c.found.rows) {
    if (!row.differs) continue;
    silent = false;
    const Knob* k = p.find(row.name);
    if (row.sentence.find("at a step of") != std::string::npos && (k == nullptr || !k->differs()))
      ++counts.artefacts;
    else if (k != nullptr && k->differs() && is_right(*k, row))
      counts.right += c.shows(*k);
    else if (k != nullptr && k->differs())
      ++counts.elsewhere;
    else if (in_its_group(p, row))
      ++counts.grouped;
    else
      ++counts.wrong;
  }
  for (const Knob& k : p.knobs) {
    if (!c.shows(k)) continue;
    ++counts.drawn;
    bool told = false;
    for (const SimulatorRow& row : c.found.rows) told = told || (row.differs && row.name == k.name);
    if (!told) ++counts.missed;
  }
  ++counts.pairs;
  counts.silent += silent;
}

void print(std::uint64_t seed, const SimulatedPair& p, const Compared& both) {
  const SimulatorComparison& c = both.found;
  fmt::print("{} {} step {} ms {}\n", seed, p.has_load ? "gap" : "one body", 1e3 * p.step,
             p.runge_kutta ? "RK4" : "Euler");
  for (const Knob& k : p.knobs)
    fmt::print("  {} {:24} drive {:<10.4g} simulator {:<10.4g} floors {:<6.3g} told of all effects\n",
               both.shows(k) ? "*" : " ", k.name, k.drive, k.simulator, both.floors_of(k));
  for (const SimulatorRow& row : c.rows)
    fmt::print("  {} {:24} drive {:<10.4g} simulator {:<10.4g} floors {:<6.3g} shrink {:.2f}\n",
               row.differs ? ">" : "-", row.name, row.numbers.front().drive, row.numbers.front().simulator,
               row.floors, row.shrink);
  fmt::print("  {}\n", c.sentence);
  for (const std::string& warning : c.warnings) fmt::print("  {}\n", warning);
  std::fflush(stdout);
}

/// Those of the pairs, and what is most easily taken for them.
DiagnosisOptions among_few() {
  DiagnosisOptions options;
  const std::vector<std::string> candidates = {
      "motor_coulomb_friction", "stribeck_friction", "presliding_friction", "cogging_torque",
      "torque_ripple",          "input_delay",       "actuator_lag",        "quadratic_drag",
      "load_unbalance",         "input_dead_zone",   "constant_load_torque"};
  for (const EffectEntry* e : effect_table())
    if (!contains(candidates, e->name)) options.excluded.emplace_back(e->name);
  return options;
}

int run(std::uint64_t first, std::uint64_t pairs, bool same, bool few) {
  Counts counts;
  for (std::uint64_t seed = first; seed < first + pairs; ++seed) {
    const SimulatedPair p = draw_pair(seed, same);
    const Compared c = compared(p, few ? among_few() : DiagnosisOptions{});
    count(p, c, counts);
    print(seed, p, c);
    fmt::print(
        "so far: {} pairs; {} rows above two floors: {} right, {} with another amount or place, {} missed; "
        "{} rows wrong; {} with the truth behind \"or\"; {} of the solver, named so; {} pairs without a row\n",
        counts.pairs, counts.drawn, counts.right, counts.elsewhere, counts.missed, counts.wrong,
        counts.grouped, counts.artefacts, counts.silent);
  }
  return 0;
}

}  // namespace
}  // namespace gapscope::test

int main(int argc, char** argv) {
  if (argc < 3) return fmt::print(stderr, "study_simulator FIRST COUNT [same] [few]\n"), 2;
  const std::vector<std::string> words(argv + 3, argv + argc);
  return gapscope::test::run(std::strtoull(argv[1], nullptr, 10), std::strtoull(argv[2], nullptr, 10),
                             gapscope::contains(words, "same"), gapscope::contains(words, "few"));
}

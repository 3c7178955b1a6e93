// Drives and simulators of them whose numbers are drawn and withheld: which rows are told right.
//   study_simulator FIRST COUNT [same] [few]
// same: nothing is drawn apart, only step and solver differ; few: among ten candidates, which is three times
// as fast
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <string>

#include "gapscope/base/text.h"
#include "gapscope/diagnosis/simulator.h"
#include "run/simulated_pair.h"

namespace gapscope::test {
namespace {

constexpr double kNear = 0.15;  ///< of the larger amount: an amount that is right

struct Counts {
  int drawn = 0, right = 0, elsewhere = 0, missed = 0, wrong = 0, artefacts = 0, grouped = 0, pairs = 0,
      silent = 0;
};

SimulatorComparison compared(const SimulatedPair& p, DiagnosisOptions options) {
  options.threads = 1;
  const MotorTrace train[] = {p.train.motor_trace()}, held_out[] = {p.held_out.motor_trace()};
  const MotorTrace sim_train[] = {p.simulated_train.motor_trace()},
                   sim_held_out[] = {p.simulated_held_out.motor_trace()};
  const Diagnosis drive = diagnose(train, held_out, p.sheet, options);
  const Diagnosis simulator = diagnose(sim_train, sim_held_out, p.sheet, options);
  return compare_with_simulator({train, held_out, sim_train, sim_held_out, drive, simulator}, options);
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

void count(const SimulatedPair& p, const SimulatorComparison& c, Counts& counts) {
  bool silent = true;
  for (const SimulatorRow& row : c.rows) {
    if (!row.differs) continue;
    silent = false;
    const Knob* k = p.find(row.name);
    if (row.sentence.find("at a step of") != std::string::npos && (k == nullptr || !k->differs()))
      ++counts.artefacts;
    else if (k != nullptr && k->differs() && is_right(*k, row))
      ++counts.right;
    else if (k != nullptr && k->differs())
      ++counts.elsewhere;
    else if (in_its_group(p, row))
      ++counts.grouped;
    else
      ++counts.wrong;
  }
  for (const Knob& k : p.knobs) {
    if (!k.differs()) continue;
    ++counts.drawn;
    bool told = false;
    for (const SimulatorRow& row : c.rows) told = told || (row.differs && row.name == k.name);
    if (!told) ++counts.missed;
  }
  ++counts.pairs;
  counts.silent += silent;
}

void print(std::uint64_t seed, const SimulatedPair& p, const SimulatorComparison& c) {
  fmt::print("{} {} step {} ms {}\n", seed, p.has_load ? "gap" : "one body", 1e3 * p.step,
             p.runge_kutta ? "RK4" : "Euler");
  for (const Knob& k : p.knobs)
    fmt::print("  {} {:24} drive {:<10.4g} simulator {:<10.4g}\n", k.differs() ? "*" : " ", k.name, k.drive,
               k.simulator);
  for (const SimulatorRow& row : c.rows)
    fmt::print("  {} {:24} drive {:<10.4g} simulator {:<10.4g} floors {:<6.3g} shrink {:.2f}\n",
               row.differs ? ">" : "-", row.name, row.numbers.front().drive, row.numbers.front().simulator,
               row.floors, row.shrink);
  fmt::print("  {}\n", c.sentence);
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
    const SimulatorComparison c = compared(p, few ? among_few() : DiagnosisOptions{});
    count(p, c, counts);
    print(seed, p, c);
    fmt::print(
        "so far: {} pairs; {} rows drawn: {} right, {} with another amount or place, {} missed; {} rows "
        "wrong; {} with the truth behind \"or\"; {} of the solver, named so; {} pairs without a row\n",
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

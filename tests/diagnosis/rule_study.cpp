// What the decision makes of drives of the independent plant, without fitting them again for every rule.
//   study_rule collect known|outside|none FIRST_SEED COUNT FILE [THREADS [RIG]]
//   study_rule judge FILE...
//   study_rule effort FIRST_SEED COUNT [THREADS]
// "collect" appends what the first step has fitted to FILE; seeds that it holds already are not run again.
// "judge" prints what the rule makes of them, and what half and double of its numbers do. "effort" fits anew
// with half and double of how far the search goes, and prints what that costs.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <mutex>
#include <set>
#include <type_traits>

#include "base/parallel.h"
#include "diagnosis/decision_cases.h"
#include "diagnosis/diagnose.h"
#include "diagnosis/drawn_case.h"
#include "support/thread_time.h"

namespace {

using namespace gapscope;
using namespace gapscope::internal::diagnosis;
using test::DecisionCase;

DecisionCase examine(const std::string& kind, const test::DrawnCase& drawn, const SearchEffort& effort) {
  const blind::BlindPair pair = drawn.pair();
  DiagnosisOptions options;
  options.threads = 1;
  options.fit.work = std::make_shared<std::atomic<std::int64_t>>(0);
  const MotorTrace train[] = {pair.train.motor_trace()}, held[] = {pair.held_out.motor_trace()};
  const double begin = test::thread_seconds();
  Study study = make_study(train, held, pair.sheet, options);
  study.effort = effort;
  FirstSearch f = investigate(study);
  DecisionCase c{drawn.seed, kind, pair.rig, pair.effect, pair.severity, test::thread_seconds() - begin,
                 f.before,   {}};
  c.candidates = std::move(f.candidates);
  return c;
}

int collect(int argc, char** argv) {
  const std::string kind = argv[2], file = argv[5];
  const std::uint64_t first = std::strtoull(argv[3], nullptr, 10),
                      count = std::strtoull(argv[4], nullptr, 10);
  const std::vector<std::string> effects = test::effects_of_kind(kind);
  std::set<std::uint64_t> done;
  for (const DecisionCase& c : test::read_decision_cases(file)) done.insert(c.seed);
  const std::vector<std::uint64_t> seeds = test::open_seeds(first, count, done);
  std::ofstream out(file, std::ios::app);
  std::mutex writing;
  parallel_for(seeds.size(), argc > 6 ? std::atoi(argv[6]) : 0, [&](std::size_t i) {
    const DecisionCase c = examine(kind, test::drawn_case(seeds[i], effects, argc > 7 ? argv[7] : ""), {});
    const std::lock_guard lock(writing);
    out << text_of(c) << std::flush;
  });
  return 0;
}

/// What a rule makes of all cases.
struct Counts {
  int relevant = 0, in_group = 0, named = 0, wrong = 0;  ///< lacking an effect of the catalogue
  int removed = 0, removed_wrong = 0;                    ///< that effect and its look-alikes taken out
  int outside = 0, outside_wrong = 0, outside_late = 0;  ///< lacking another one; of the wrong: a mean delay
};

bool in_group(const Decision& d, const std::string& effect) {
  return std::any_of(d.group.begin(), d.group.end(), [&](const EffectEntry* e) { return e->name == effect; });
}

Decision decide_by(std::vector<ScoredModel> candidates, const ScoredModel& before,
                   std::span<const ScoredModel> parents, const DecisionRule& rule) {
  rank(candidates, rule);
  return decide_alone(candidates, before, Reach::kFloor, parents, rule);
}

void count_removed(const DecisionCase& c, const DecisionRule& rule, Counts& n) {
  const EffectEntry* truth = find_effect(c.effect);
  std::vector<ScoredModel> others, parents;
  for (const ScoredModel& m : c.candidates) {
    const bool out = m.entry == truth || look_alike(*m.entry, *truth);
    if (!out) others.push_back(m);
    if (out && m.entry->name == std::string("motor_coulomb_friction")) parents.push_back(m);
  }
  ++n.removed;
  n.removed_wrong += !others.empty() && decide_by(others, c.before, parents, rule).accepted ? 1 : 0;
}

Counts counts_of(const std::vector<DecisionCase>& cases, const DecisionRule& rule) {
  Counts n;
  for (const DecisionCase& c : cases) {
    if (std::max(c.before.median_free, c.before.median_innovation) <= 2.0) continue;
    const Decision d = c.candidates.empty() ? Decision{} : decide_by(c.candidates, c.before, {}, rule);
    if (c.kind == "known") {
      const bool right = in_group(d, c.effect);
      ++n.relevant, n.in_group += right ? 1 : 0;
      n.named += d.accepted && right ? 1 : 0, n.wrong += d.accepted && !right ? 1 : 0;
      count_removed(c, rule, n);
    } else {
      ++n.outside, n.outside_wrong += d.accepted ? 1 : 0;
      n.outside_late += d.accepted && c.effect == "input_jitter" && in_group(d, "input_delay") ? 1 : 0;
    }
  }
  return n;
}

void print_line(const std::string& name, const Counts& n) {
  fmt::print("| {} | {} | {} | {} | {} | {} ({}) |\n", name, n.in_group, n.named, n.wrong, n.removed_wrong,
             n.outside_wrong, n.outside_late);
}

/// The counts of the rule, and with half and double of each of its numbers that the first step asks.
int judge_rule(int argc, char** argv) {
  std::vector<DecisionCase> cases;
  for (int i = 2; i < argc; ++i)
    for (DecisionCase& c : test::read_decision_cases(argv[i])) cases.push_back(std::move(c));
  const Counts n = counts_of(cases, {});
  fmt::print("{} drives lack a known effect, {} one outside the catalogue; all above 2 floors\n\n",
             n.relevant, n.outside);
  fmt::print(
      "| rule | first or in the group | named | wrong name | wrong with the truth taken out | wrong outside "
      "(of these a delay where the input jitters) |\n|---|---|---|---|---|---|\n");
  print_line("as it is", n);
  const auto vary = [&](const std::string& name, double DecisionRule::*field, bool of_one,
                        std::vector<double> factors = {0.5, 2.0}) {
    for (const double factor : factors) {
      DecisionRule rule;
      rule.*field = of_one ? 1.0 - factor * (1.0 - rule.*field) : factor * rule.*field;
      print_line(fmt::format("`{}` = {:.4g}", name, rule.*field), counts_of(cases, rule));
    }
  };
  vary("tells_apart", &DecisionRule::tells_apart, false);
  vary("indistinct", &DecisionRule::indistinct, false);
  vary("least_way", &DecisionRule::least_way, false, {0.0, 0.5, 2.0});
  vary("asked_for", &DecisionRule::asked_for, true);
  vary("worth_having", &DecisionRule::worth_having, false);
  vary("all_of_cause", &DecisionRule::all_of_cause, false);
  return 0;
}

/// The counts and the mean processor time with another effort, on drives that lack a known effect.
void print_effort(const std::string& name, const SearchEffort& effort, std::uint64_t first,
                  std::uint64_t count, int threads) {
  const std::vector<std::string> effects = test::effects_of_kind("known");
  std::vector<DecisionCase> cases(count);
  parallel_for(cases.size(), threads, [&](std::size_t i) {
    cases[i] = examine("known", test::drawn_case(first + i, effects, ""), effort);
  });
  double seconds = 0.0;
  for (const DecisionCase& c : cases) seconds += c.seconds / static_cast<double>(count);
  const Counts n = counts_of(cases, {});
  fmt::print("| {} | {} of {} | {} | {} | {} | {:.1f} |\n", name, n.in_group, n.relevant, n.named, n.wrong,
             n.removed_wrong, seconds);
  std::fflush(stdout);
}

int vary_effort(int argc, char** argv) {
  const std::uint64_t first = std::strtoull(argv[2], nullptr, 10),
                      count = std::strtoull(argv[3], nullptr, 10);
  const int threads = argc > 4 ? std::atoi(argv[4]) : 0;
  fmt::print(
      "| effort | first or in the group | named | wrong name | wrong with the truth taken out | processor time "
      "[s] |\n|---|---|---|---|---|---|\n");
  const auto run = [&](const std::string& name, const SearchEffort& effort) {
    print_effort(name, effort, first, count, threads);
  };
  run("as it is", {});
  const auto vary = [&](const std::string& name, auto SearchEffort::*field) {
    for (const double factor : {0.5, 2.0}) {
      SearchEffort effort;
      using Value = std::remove_cvref_t<decltype(effort.*field)>;
      effort.*field = static_cast<Value>(factor * static_cast<double>(effort.*field));
      run(fmt::format("`{}` {}", name, effort.*field), effort);
    }
  };
  vary("race_steps", &SearchEffort::race_steps);
  vary("weaker", &SearchEffort::weaker);
  vary("leaders", &SearchEffort::leaders);
  vary("far_better", &SearchEffort::far_better);
  vary("lines", &SearchEffort::lines);
  for (const double factor : {0.5, 2.0}) {
    SearchEffort effort;
    effort.quick.jacobians = static_cast<int>(std::lround(factor * effort.quick.jacobians));
    effort.quick.trials = static_cast<int>(std::lround(factor * effort.quick.trials));
    run(fmt::format("`quick` {} Jacobians, {} trials", effort.quick.jacobians, effort.quick.trials), effort);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) return 2;
  if (std::string(argv[1]) == "collect" && argc > 5) return collect(argc, argv);
  if (std::string(argv[1]) == "effort" && argc > 3) return vary_effort(argc, argv);
  if (std::string(argv[1]) == "judge") return judge_rule(argc, argv);
  return 2;
}

// Not a test: the diagnosis on drives of the independent plant with an effect that it is not told.
//   study_diagnosis FIRST_SEED COUNT known|outside|none [RIG]
// One line a case, then counts with Wilson limits. "Removed" takes the true effect and its look-alikes out of
// the candidates that were fitted and decides again.
#include <fmt/format.h>

#include <chrono>
#include <cstdlib>
#include <mutex>
#include <string>

#include "diagnosis/blind_case.h"
#include "diagnosis/mismatch_size.h"
#include "diagnosis/pipeline.h"
#include "gapscope/base/parallel.h"
#include "gapscope/base/random.h"

namespace {

using namespace gapscope;
using namespace gapscope::internal;

struct Row {
  bool relevant = false;  ///< more than 2 floors after a refit of the nominal model
  bool first = false, in_group = false, named = false, wrong = false;
  bool none = false, removed_named = false;
  double shrink = kNaN, before = kNaN, group = kNaN, seconds = kNaN;
  std::string text, removed;
};

std::vector<std::string> effects_of(const std::string& kind) {
  if (kind == "none") return {"none"};
  std::vector<std::string> names;
  for (const blind::EffectEntry& e : blind::effect_entries())
    if (e.in_catalogue == (kind == "known") && e.name != "backlash" && e.name != "encoder_quantization")
      names.emplace_back(e.name);
  return names;
}

bool contains(const std::vector<const EffectEntry*>& group, const std::string& name) {
  for (const EffectEntry* e : group)
    if (e->name == name) return true;
  return false;
}

std::size_t place_of_truth(const std::vector<Judged>& ranked, const std::string& effect) {
  for (std::size_t i = 0; i < ranked.size(); ++i)
    if (ranked[i].entry->name == effect) return i;
  return ranked.size();
}

struct Removed {
  Decision decision;
  std::string name;
  double shrink = kNaN;
};

/// The decision without the true effect and its look-alikes.
Removed without(const std::string& effect, std::vector<Judged> candidates, const Judged& before) {
  const EffectEntry* truth = find_effect(effect);
  std::vector<Judged> parents;
  for (const Judged& c : candidates)
    if (c.entry->name == std::string("motor_coulomb_friction")) parents.push_back(c);
  std::erase_if(candidates, [&](const Judged& c) {
    bool out = c.entry->name == effect;
    if (truth != nullptr)
      for (const char* alike : truth->look_alikes) out = out || c.entry->name == std::string(alike);
    return out;
  });
  rank(candidates, before, false);
  std::erase_if(parents, [&](const Judged& p) {
    return place_of_truth(candidates, p.entry->name) < candidates.size();
  });
  const double shrink =
      candidates.empty() ? kNaN : shrink_of(before.median_free, candidates.front().median_free);
  return {decide(candidates, before, false, parents),
          candidates.empty() ? "-" : candidates.front().entry->name, shrink};
}

std::string describe(const Findings& f, const std::string& effect) {
  std::string text;
  if (f.candidates.empty()) return text;
  text += fmt::format(" rel {:.2f} margin {:.2f} gain {:.2f} p {:.2f} |", f.decision.rel, f.decision.margin,
                      f.decision.gain, f.decision.probability);
  for (std::size_t i = 0; i < std::min<std::size_t>(4, f.candidates.size()); ++i) {
    const Judged& c = f.candidates[i];
    text += fmt::format(" {} {:.2f} ({:.2g})", c.entry->name, c.score, std::sqrt(c.fitted.mean_square));
  }
  const std::size_t place = place_of_truth(f.candidates, effect);
  if (place > 0 && place < f.candidates.size())
    text += fmt::format(" | truth at {}: {:.2f} ({:.2g})", place, f.candidates[place].score,
                        std::sqrt(f.candidates[place].fitted.mean_square));
  return text;
}

Row examine(const test::BlindPair& pair, std::uint64_t seed) {
  DiagnosisOptions options;
  options.threads = 1;
  const MotorTrace train[] = {pair.train.motor_trace()}, held[] = {pair.held_out.motor_trace()};
  const auto begin = std::chrono::steady_clock::now();
  Study study = make_study(train, held, pair.sheet, options);
  const Findings f = investigate(study);
  Row row;
  row.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  row.before = std::max(f.before.median_free, f.before.median_innovation);
  row.relevant = row.before > 2.0;
  row.none = f.candidates.empty();
  if (!row.none) {
    row.first = f.candidates.front().entry->name == pair.effect;
    row.in_group = row.first || contains(f.decision.group, pair.effect);
    row.named = f.decision.accepted && row.in_group;
    row.wrong = f.decision.accepted && !row.in_group;
    row.group = static_cast<double>(f.decision.group.size());
    row.shrink = shrink_of(f.before.median_free, f.candidates.front().median_free);
    const Removed removed = without(pair.effect, f.candidates, f.before);
    row.removed_named = removed.decision.accepted;
    row.removed =
        fmt::format(" || {} {} rel {:.2f} margin {:.2f} wb {:.2f} shrink {:.2f}",
                    row.removed_named ? "REMOVED-NAMED" : "removed", removed.name, removed.decision.rel,
                    removed.decision.margin, removed.decision.windows_better, removed.shrink);
  }
  row.text =
      fmt::format("{} {} {} {:.2f}: {} free {:.3g} inn {:.3g} fit {:.3g} S {:.2f} shrink {:.3f} {:.1f}s{}{}",
                  seed, pair.rig, pair.effect, pair.severity,
                  row.none    ? "none"
                  : row.named ? "NAMED"
                  : row.wrong ? "WRONG"
                              : "unknown",
                  f.before.median_free, f.before.median_innovation, std::sqrt(f.before.fitted.mean_square),
                  f.before.score, row.shrink, row.seconds,
                  fmt::format(" wb {:.2f}", f.decision.windows_better), describe(f, pair.effect)) +
      row.removed;
  return row;
}

void count(const char* what, const std::vector<Row>& rows, bool Row::*flag) {
  int yes = 0;
  for (const Row& row : rows) yes += row.*flag ? 1 : 0;
  const Interval w = wilson(yes, static_cast<int>(rows.size()));
  fmt::print("{:<16}{} of {}  [{:.1f}, {:.1f}] %\n", what, yes, rows.size(), 100 * w.low, 100 * w.high);
}

void summarise(std::vector<Row> rows, bool known) {
  std::vector<double> shrinks, groups, seconds;
  if (known) std::erase_if(rows, [](const Row& r) { return !r.relevant; });
  for (const Row& r : rows) {
    seconds.push_back(r.seconds);
    if (r.named && r.before >= 3.0 && std::isfinite(r.shrink)) shrinks.push_back(r.shrink);
    if (r.named) groups.push_back(r.group);
  }
  count("first", rows, &Row::first);
  count("first or group", rows, &Row::in_group);
  count("named", rows, &Row::named);
  count("wrong name", rows, &Row::wrong);
  count("none", rows, &Row::none);
  count("removed, named", rows, &Row::removed_named);
  fmt::print(
      "shrink median {:.3f}, tenth percentile {:.3f}; group median {:.1f}, mean {:.2f}; {:.1f} s a case\n",
      median(shrinks), quantile(shrinks, 0.1), median(groups), groups.empty() ? kNaN : mean(groups),
      mean(seconds));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) return 2;
  const std::uint64_t first = std::strtoull(argv[1], nullptr, 10);
  const auto cases = static_cast<std::size_t>(std::atoi(argv[2]));
  const std::string kind = argv[3];
  const std::vector<std::string> effects = effects_of(kind);
  std::vector<Row> rows(cases);
  std::mutex printing;
  const char* threads = std::getenv("STUDY_THREADS");
  parallel_for(cases, threads != nullptr ? std::atoi(threads) : 0, [&](std::size_t i) {
    const std::uint64_t seed = first + i;
    auto g = random_stream(seed, "diagnosis study");
    const std::string rig = argc > 4 ? argv[4] : test::kRigs[(i / effects.size()) % 3];
    rows[i] = examine(test::blind_pair(rig, effects[i % effects.size()], uniform(g, 0.0, 1.0), seed), seed);
    const std::lock_guard lock(printing);
    fmt::print("{}\n", rows[i].text);
    std::fflush(stdout);
  });
  summarise(rows, kind == "known");
}

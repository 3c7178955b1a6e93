// The diagnosis on drives of the independent plant with an effect that it is not told.
//   study_diagnosis FIRST_SEED COUNT
//     known|outside|none|pair|one|beyond|ask|law|lawless|whole|unstarted|amount FILE [THREADS [RIG]]
// Appends one line a case to FILE and prints the counts of all of it with Wilson limits; seeds that FILE
// holds already are not run again. Effect and rig follow from the seed. "Removed" takes the true effect and
// its look-alikes out of the candidates that were fitted and decides again. "pair" are two effects, "one" and
// "beyond" a known one and one outside the catalogue where the search may take as many steps as it likes;
// "ask" the next experiment for look-alikes; "law", "lawless" and "whole" are the whole diagnosis, laws of
// last resort included, of drives that lack something outside the catalogue, nothing, and one effect of the
// catalogue; "unstarted" is the last of these where the sheet gives hardly a number. "amount" is no diagnosis
// but what its amounts rest on: the fit with the effect that the drive has, of those whose law is the
// catalogue's. "whole" and "amount" count how often the 95 % interval of an amount holds what was drawn.
#include <fmt/format.h>

#include <cstdlib>
#include <fstream>
#include <mutex>
#include <set>

#include "base/parallel.h"
#include "blind/expected_place.h"
#include "diagnosis/amount_study.h"
#include "diagnosis/diagnose.h"
#include "diagnosis/drawn_case.h"
#include "diagnosis/law_study.h"
#include "diagnosis/look_alikes.h"
#include "diagnosis/mismatch_size.h"
#include "diagnosis/pair_study.h"
#include "diagnosis/study_row.h"
#include "diagnosis/unstarted_study.h"
#include "diagnosis/where.h"
#include "support/thread_time.h"

namespace {

using namespace gapscope;
using namespace gapscope::internal::diagnosis;
using test::StudyRow;

std::vector<std::string> effects_of(const std::string& kind) {
  if (kind == "pair") return test::effect_pairs();
  if (kind == "ask") {
    std::vector<std::string> pairs;
    for (const auto& [truth, other] : test::look_alike_pairs()) pairs.push_back(truth + "/" + other);
    return pairs;
  }
  return test::effects_of_kind(kind);
}

std::size_t place_of_truth(const std::vector<ScoredModel>& ranked, const std::string& effect) {
  for (std::size_t i = 0; i < ranked.size(); ++i)
    if (ranked[i].entry->name == effect) return i;
  return ranked.size();
}

struct Removed {
  Decision decision;
  std::string details;
};

/// The decision without the true effect and its look-alikes.
Removed without(const std::string& effect, std::vector<ScoredModel> candidates, const ScoredModel& before) {
  const EffectEntry* truth = find_effect(effect);
  std::vector<ScoredModel> parents;
  for (const ScoredModel& c : candidates)
    if (c.entry->name == std::string("motor_coulomb_friction")) parents.push_back(c);
  std::erase_if(candidates, [&](const ScoredModel& c) {
    bool out = c.entry->name == effect;
    if (truth != nullptr)
      for (const char* alike : truth->look_alikes) out = out || c.entry->name == std::string(alike);
    return out;
  });
  rank(candidates);
  std::erase_if(parents, [&](const ScoredModel& p) {
    return place_of_truth(candidates, p.entry->name) < candidates.size();
  });
  Removed removed{decide_alone(candidates, before, Reach::kFloor, parents), ""};
  if (!candidates.empty())
    removed.details =
        fmt::format("; removed: {} rel {:.2f} margin {:.2f} gain {:.2f} shrink {:.2f}",
                    candidates.front().entry->name, removed.decision.rel, removed.decision.margin,
                    removed.decision.gain, shrink_of(before.median_free, candidates.front().median_free));
  return removed;
}

std::string describe(const FirstSearch& f, const std::string& effect) {
  std::string text =
      fmt::format("free {:.3g} inn {:.3g} fit {:.3g} S {:.2f}", f.before.median_free,
                  f.before.median_innovation, std::sqrt(f.before.fitted.mean_cost), f.before.score);
  if (f.candidates.empty()) return text;
  if (std::isfinite(f.alone)) text += fmt::format(" (alone {:.3g})", f.alone);
  text += fmt::format(" rel {:.2f} margin {:.2f} gain {:.2f} better {:.2f};", f.decision.rel,
                      f.decision.margin, f.decision.gain, f.decision.windows_better);
  const auto add = [&](const ScoredModel& c) {
    text += fmt::format(" {} {:.2f} ({:.2g})", c.entry->name, c.score, std::sqrt(c.fitted.mean_cost));
  };
  for (std::size_t i = 0; i < std::min<std::size_t>(4, f.candidates.size()); ++i) add(f.candidates[i]);
  if (const std::size_t place = place_of_truth(f.candidates, effect);
      place < f.candidates.size() && place > 3) {
    text += fmt::format(" ... {}:", place);
    add(f.candidates[place]);
  }
  return text;
}

/// Whether the shrink on a recording that the diagnosis has not seen is within the interval that it gave.
std::string covers(const Study& study, const FirstSearch& f, const blind::BlindPair& pair,
                   std::string& details) {
  const Interval interval = mismatch_size(study, f.before, f.candidates.front()).shrink_ci95;
  const Recording last = pair.next();
  const MotorTrace next[] = {last.motor_trace()};
  const Study other = make_study(study.train, next, pair.sheet, study.options);
  const ScoredModel before = judge(nullptr, f.before.fitted, other.held_out, study.observer_hz);
  const ScoredModel after = judge(nullptr, f.candidates.front().fitted, other.held_out, study.observer_hz);
  const double shrink = shrink_of(before.median_free, after.median_free);
  details += fmt::format(" next {:.3g} to {:.3g}, shrink {:.4g} of [{:.4g}, {:.4g}]", before.median_free,
                         after.median_free, shrink, interval.low, interval.high);
  if (!std::isfinite(shrink) || !std::isfinite(interval.low)) return "-";
  return interval.low <= shrink && shrink <= interval.high ? "yes" : "no";
}

std::string places(const Study& study, const FirstSearch& f, const blind::BlindPair& pair, bool told) {
  const ReferenceModel& fitted = f.candidates.front().fitted.model;
  const auto played = play(f.before.fitted.model, study.held_out, study.observer_hz, true);
  const MismatchPlace place =
      place_of(played, study.held_out, fitted.parameters[place::kTorqueConstant].value, {},
               told ? &fitted.effects.back() : nullptr);
  return blind::names_the_place(blind::told_place(place), pair.effect, pair.cycles_per_turn) ? "yes" : "no";
}

void note_answer(StudyRow& row, const Study& study, const FirstSearch& f, const blind::BlindPair& pair) {
  row.verdict = f.decision.accepted ? "effect" : "unknown";
  row.first = f.candidates.front().entry->name;
  row.group = static_cast<int>(f.decision.group.size());
  row.in_group = row.first == row.effect;
  for (const EffectEntry* e : f.decision.group) row.in_group = row.in_group || e->name == row.effect;
  row.shrink = shrink_of(f.before.median_free, f.candidates.front().median_free);
  row.probability = f.decision.probability;
  const Removed removed = without(row.effect, f.candidates, f.before);
  row.removed = removed.decision.accepted ? "effect" : "unknown";
  row.details += removed.details;
  const bool helped = !f.decision.accepted && helps(f.before, f.candidates.front(), study.repeats_badly());
  if (helped) row.verdict = "helps";
  if (row.named() || helped) row.covered = covers(study, f, pair, row.details);
  if (!row.named()) return;
  row.place = places(study, f, pair, true);
  row.blind_place = places(study, f, pair, false);
}

StudyRow examine(const blind::BlindPair& pair, std::uint64_t seed) {
  DiagnosisOptions options;
  options.threads = 1;
  options.fit.work = std::make_shared<std::atomic<std::int64_t>>(0);
  const MotorTrace train[] = {pair.train.motor_trace()}, held[] = {pair.held_out.motor_trace()};
  const double begin = test::thread_seconds();
  Study study = make_study(train, held, pair.sheet, options);
  const FirstSearch f = investigate(study);
  StudyRow row;
  row.seconds = test::thread_seconds() - begin;
  row.seed = seed, row.rig = pair.rig, row.effect = pair.effect, row.excitations = pair.excitations;
  row.severity = pair.severity;
  row.before = std::isfinite(f.alone) ? f.alone : std::max(f.before.median_free, f.before.median_innovation);
  row.verdict = "none";
  row.details = describe(f, pair.effect);
  if (!f.candidates.empty()) note_answer(row, study, f, pair);
  return row;
}

bool is_whole(const std::string& kind) { return kind == "law" || kind == "lawless" || kind == "whole"; }

StudyRow row_of(const std::string& kind, const test::DrawnCase& c) {
  if (kind == "amount") return test::examine_amount(c.pair(), c.seed);
  if (kind == "unstarted") return test::examine_unstarted(c.pair(), c.seed);
  if (is_whole(kind)) return test::examine_laws(c.pair(), c.seed);
  if (kind == "ask") return test::examine_question(c.effect, c.seed);
  if (kind == "pair" || kind == "one" || kind == "beyond")
    return test::examine_steps(blind::blind_pair(c.rig, test::split_effects(c.effect), c.severity, c.seed),
                               c.seed);
  return examine(c.pair(), c.seed);
}

void print_counts(const std::string& kind, const std::vector<StudyRow>& rows) {
  if (is_whole(kind)) test::print_laws(rows);
  if (kind == "whole" || kind == "amount") test::print_amounts(rows);
  if (kind == "known") print_known(rows);
  if (kind == "unstarted") test::print_unstarted(rows);
  if (kind == "none") print_none(rows);
  if (kind == "outside" || kind == "beyond" || kind == "law") print_outside(rows);
  if (kind == "pair" || kind == "one") test::print_steps(rows);
  if (kind == "ask") test::print_questions(rows);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 5) return 2;
  const std::uint64_t first = std::strtoull(argv[1], nullptr, 10),
                      cases = std::strtoull(argv[2], nullptr, 10);
  const std::string kind = argv[3], file = argv[4];
  const std::vector<std::string> effects = effects_of(kind);
  std::set<std::uint64_t> done;
  for (const StudyRow& row : test::read_rows(file)) done.insert(row.seed);
  const std::vector<std::uint64_t> seeds = test::open_seeds(first, cases, done);
  std::ofstream out(file, std::ios::app);
  std::mutex writing;
  parallel_for(seeds.size(), argc > 5 ? std::atoi(argv[5]) : 0, [&](std::size_t i) {
    const StudyRow row = row_of(kind, test::drawn_case(seeds[i], effects, argc > 6 ? argv[6] : ""));
    const std::lock_guard lock(writing);
    out << line_of(row) << std::endl;
  });
  print_counts(kind, test::read_rows(file));
}

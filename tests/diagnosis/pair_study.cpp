#include "diagnosis/pair_study.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string_view>

#include "base/random.h"
#include "diagnosis/drawn_case.h"
#include "diagnosis/further.h"
#include "diagnosis/look_alikes.h"
#include "diagnosis/mismatch_size.h"
#include "gapscope/telling/card.h"
#include "support/thread_time.h"

namespace gapscope::test {
namespace {

using namespace gapscope::internal::diagnosis;
using Names = std::vector<std::string>;

const std::vector<Names>& families() {
  static const std::vector<Names> list = {
      {"motor_coulomb_friction", "friction_asymmetry", "stribeck_friction", "presliding_friction",
       "quadratic_drag", "viscous_drift"},
      {"cogging_torque", "torque_ripple"},
      {"load_unbalance", "constant_load_torque", "load_inertia_variation"},
      {"torque_saturation", "input_dead_zone"},
      {"input_delay", "actuator_lag", "measurement_lag"},
      {"shaft_compliance", "impact_damping", "contact_adhesion"},
      {"gap_eccentricity", "gap_growth"},
      {"encoder_eccentricity"}};
  return list;
}

bool among(const std::vector<const EffectEntry*>& list, const std::string& name) {
  return std::any_of(list.begin(), list.end(), [&](const EffectEntry* e) { return e->name == name; });
}

double left(const ScoredModel& j) { return std::max(j.median_free, j.median_innovation); }

/// Least that any one of the true effects leaves alone [floor].
double left_by_one(const FirstSearch& f, const Names& truth) {
  double least = kInfinity;
  for (const ScoredModel& c : f.candidates)
    if (std::find(truth.begin(), truth.end(), c.entry->name) != truth.end() && std::isfinite(left(c)))
      least = std::min(least, left(c));
  return std::isfinite(least) ? least : left(f.before);
}

std::string describe(const ScoredModel& before, const std::vector<ScoredModel>& ranked, const Decision& d) {
  std::string text = fmt::format(
      "[{:.3g}/{:.3g} S {:.2f}; rel {:.2f} mar {:.2f} gain {:.2f} win {:.2f} fit {:.2f} of {:.3g} {}:",
      before.median_free, before.median_innovation, before.score, d.rel, d.margin, d.gain, d.windows_better,
      ranked.empty() ? kNaN : ranked.front().fitted.mean_cost / before.fitted.mean_cost,
      before.fitted.mean_cost, d.accepted ? "yes" : "no");
  for (std::size_t i = 0; i < std::min<std::size_t>(5, ranked.size()); ++i)
    text += fmt::format(" {} {:.2f}", ranked[i].entry->name, ranked[i].score);
  return text + "] ";
}

/// What a later step says, and what it would say without those true effects that it could find; both for
/// learn_probability.
std::string judgements(const FurtherStep& step, const Names& truth) {
  if (step.candidates.empty()) return "";
  Names missing;
  for (const std::string& t : truth)
    if (find_effect(t) != nullptr && !has_effect(step.before.fitted.model, find_effect(t)))
      missing.push_back(t);
  const auto numbers = [](const Decision& d) {
    return fmt::format("rel {:.4g} margin {:.4g} gain {:.4g}", d.rel, d.margin, d.gain);
  };
  const bool right = std::any_of(missing.begin(), missing.end(),
                                 [&](const std::string& t) { return among(step.decision.group, t); });
  std::string text = fmt::format("{{later {}: {}}} ", right ? "right" : "wrong", numbers(step.decision));
  std::vector<ScoredModel> others = step.candidates;
  std::erase_if(others, [&](const ScoredModel& c) {
    return std::any_of(missing.begin(), missing.end(), [&](const std::string& t) {
      return c.entry == find_effect(t) || look_alike(*c.entry, *find_effect(t));
    });
  });
  if (missing.empty() || others.empty()) return text;
  rank(others);
  return text +
         fmt::format("{{later wrong: {}}} ", numbers(decide(others, step.before, Reach::kAnyGain, {})));
}

}  // namespace

std::vector<std::string> split_effects(const std::string& joined) {
  Names names;
  std::istringstream in(joined);
  for (std::string name; std::getline(in, name, '+');) names.push_back(name);
  return names;
}

std::vector<std::string> effect_pairs() {
  std::vector<std::string> pairs;
  for (std::size_t i = 0; i < families().size(); ++i)
    for (std::size_t k = i + 1; k < families().size(); ++k)
      for (const std::string& a : families()[i])
        for (const std::string& b : families()[k])
          if (!look_alike(*find_effect(a), *find_effect(b))) pairs.push_back(a + "+" + b);
  auto order = random_stream(1, "diagnosis pairs");
  std::shuffle(pairs.begin(), pairs.end(), order);
  return pairs;
}

StudyRow examine_steps(const blind::BlindPair& pair, std::uint64_t seed) {
  const Names truth = split_effects(pair.effect);
  DiagnosisOptions options;
  options.threads = 1;
  options.fit.work = std::make_shared<std::atomic<std::int64_t>>(0);
  const MotorTrace train[] = {pair.train.motor_trace()}, held[] = {pair.held_out.motor_trace()};
  const double begin = thread_seconds();
  double first = kNaN;
  options.progress = [&](std::string_view what) {
    if (std::isnan(first) && what.starts_with("looking for a further")) first = thread_seconds() - begin;
  };
  Study study = make_study(train, held, pair.sheet, options);
  const EffectSearch search = search_effects(study);
  const FirstSearch& f = search.found;
  const Additions& a = search.added;
  StudyRow row;
  row.seconds = thread_seconds() - begin;
  row.probability = std::isnan(first) ? 1.0 : row.seconds / first;
  row.seed = seed, row.rig = pair.rig, row.effect = pair.effect, row.excitations = pair.excitations;
  row.severity = pair.severity;
  row.before = truth.size() > 1 ? left_by_one(f, truth) : left(f.before);
  row.verdict = f.candidates.empty() && at_floor(f.before) ? "none" : a.accepted ? "effect" : "unknown";
  row.details = describe(f.before, f.candidates, f.decision);
  for (const FurtherStep& s : a.steps)
    row.details += describe(s.before, s.candidates, s.decision) + judgements(s, truth);
  if (f.candidates.empty()) return row;
  row.details += fmt::format("after {:.3g}/{:.3g}{}", a.after.median_free, a.after.median_innovation,
                             a.explained ? ", explained together" : "");
  row.shrink = shrink_of(f.before.median_free, a.after.median_free);
  std::vector<Addition> standing = a.effects;  // Coulomb friction gives its place to Stribeck's, which has it
  std::erase_if(standing, [&](const Addition& e) { return !has_effect(a.after.fitted.model, e.entry); });
  Names found;
  for (const Addition& e : standing) found.push_back(e.entry->name);
  if (!found.empty()) row.first = fmt::format("{}", fmt::join(found, "+"));
  if (!a.accepted) return row;
  for (const Addition& e : standing)
    row.group +=
        std::any_of(truth.begin(), truth.end(), [&](const std::string& t) { return among(e.group, t); });
  row.in_group = row.group == static_cast<int>(truth.size());
  return row;
}

StudyRow examine_question(const std::string& names, std::uint64_t seed) {
  const std::size_t slash = names.find('/');
  const double begin = thread_seconds();
  const LookAlikes pair = look_alikes(names.substr(0, slash), names.substr(slash + 1), seed);
  const MotorTrace like = pair.recording.motor_trace();
  ExperimentLimits limits;
  limits.highest_frequency = 25.0;
  const NextExperiment next = next_experiment(pair.rivals, like, limits, 3.0, 1);
  StudyRow row;
  row.seed = seed, row.effect = names, row.rig = "paper", row.excitations = "s";
  row.seconds = thread_seconds() - begin;
  row.details = in_words(experiment_of(next, pair.rivals, false), Detail::kWhole, {});
  row.verdict = next.separates() ? "effect" : "unknown";
  if (!next.proposes()) return row;
  const TriedInput& best = next.tried.front();
  row.first = to_string(best.excitation.kind);
  row.group = static_cast<int>(std::count_if(best.separations.begin(), best.separations.end(),
                                             [](const Separation& s) { return s.contained; }));
  for (const Separation& s : best.separations)
    if (s.truth == pair.rivals[0].effect) row.before = s.excess;
  row.shrink = seen_excess(pair, played(pair, next));
  row.in_group = row.shrink >= 1.0;
  row.details += fmt::format(" As recorded: {:.3g} σ.", seen_excess(pair, pair.recording));
  return row;
}

}  // namespace gapscope::test

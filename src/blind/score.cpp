#include "blind/score.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "base/text.h"
#include "blind/scored_answer.h"
#include "gapscope/plant/effect.h"
#include "independent_plant/severity.h"

namespace gapscope {
namespace blind {

bool ScoredAnswer::outside() const {
  return label->effects.size() == 1 && find_effect(label->effects.front()) == nullptr;
}

bool ScoredAnswer::claims_no_cause() const {
  return answer->verdict == "unknown" || answer->verdict == "helps";
}

bool ScoredAnswer::in_group() const {
  return std::any_of(label->effects.begin(), label->effects.end(),
                     [&](const std::string& truth) { return contains(first.group, truth); });
}

bool ScoredAnswer::holds(const std::string& effect) const {
  return contains(answer->effects, effect) || contains(answer->group, effect);
}

std::size_t ScoredAnswer::found() const {
  const auto& truths = label->effects;
  return static_cast<std::size_t>(
      std::count_if(truths.begin(), truths.end(), [&](const std::string& t) { return holds(t); }));
}

bool ScoredAnswer::right() const {
  if (none()) return answer->verdict == "none";
  if (outside()) return claims_no_cause();
  return blamed() && found() == label->effects.size() && standing() == found();
}

std::size_t ScoredAnswer::standing() const {
  const auto& names = answer->effects;
  return static_cast<std::size_t>(std::count_if(names.begin(), names.end(), [&](const std::string& name) {
    return std::none_of(names.begin(), names.end(), [&](const std::string& other) {
      const EffectEntry* later = find_effect(other);  // a stored answer may name anything
      const EffectEntry* contained = later == nullptr ? nullptr : contained_effect(*later);
      return contained != nullptr && contained == find_effect(name);
    });
  }));
}

std::size_t ScoredAnswer::place() const {
  const auto at = std::find(first.ranking.begin(), first.ranking.end(), label->effects.front());
  return static_cast<std::size_t>(at - first.ranking.begin());
}

std::vector<ScoredAnswer> scored(const BlindLabels& labels, const BlindAnswers& answers) {
  std::map<std::string, const BlindLabel*> by_name;
  for (const BlindLabel& l : labels.cases) by_name[l.name] = &l;
  std::vector<ScoredAnswer> cases;
  for (const BlindAnswer& a : answers.cases)
    cases.push_back({by_name.at(a.name), &a, decide_again(a.evidence)});
  return cases;
}

std::vector<std::string> truth_of(const ScoredAnswer& c, bool and_look_alikes) {
  std::vector<std::string> names = {c.label->effects.front()};
  if (const auto* truth = find_effect(names.front()); truth != nullptr && and_look_alikes)
    for (const char* alike : truth->look_alikes) names.emplace_back(alike);
  return names;
}

namespace {

std::string truth_name(const ScoredAnswer& s) {
  return s.none() ? "none" : s.outside() ? "outside" : s.label->effects.front();
}

std::string answer_name(const ScoredAnswer& s) {
  if (s.claims_no_cause()) return "unknown";
  if (!s.blamed()) return s.answer->verdict;
  return s.known() && s.named() ? s.label->effects.front() : s.answer->effects.front();
}

std::vector<ConfusionCell> confusion_of(const std::vector<ScoredAnswer>& cases) {
  std::vector<std::string> words;
  for (const gapscope::EffectEntry* entry : effect_table()) words.emplace_back(entry->name);
  words.insert(words.end(), {"outside", "unknown", "none"});
  std::vector<ConfusionCell> cells;
  for (const std::string& truth : words)
    for (const std::string& answer : words) {
      const auto count = std::count_if(cases.begin(), cases.end(), [&](const ScoredAnswer& s) {
        return s.reported() && !s.pair() && truth_name(s) == truth && answer_name(s) == answer;
      });
      if (count > 0) cells.push_back({truth, answer, static_cast<int>(count)});
    }
  return cells;
}

bool has_another_law(const std::string& effect) {
  const independent_plant::DrawnEffect* drawn = independent_plant::find_drawn_effect(effect);
  return drawn != nullptr && drawn->traits.another_law;
}

void fill_shrinks(const std::vector<ScoredAnswer>& cases, BlindScore& score) {
  std::vector<double> groups, shrinks, others;
  for (const ScoredAnswer& s : cases) {
    if (!s.reported() || !s.known() || !s.seen() || !s.named()) continue;
    groups.push_back(static_cast<double>(s.answer->group.size()));
    if (s.answer->evidence.before() < 3.0 || !std::isfinite(s.answer->shrink)) continue;
    shrinks.push_back(s.answer->shrink);
    if (has_another_law(s.label->effects.front())) others.push_back(s.answer->shrink);
  }
  if (!groups.empty()) score.group_median = median(groups), score.group_mean = mean(groups);
  if (!shrinks.empty()) score.shrink_median = median(shrinks), score.shrink_tenth = quantile(shrinks, 0.1);
  if (!others.empty()) score.shrink_other_law = median(others);
}

std::optional<ScoredImplant> implant_for_the_reader(const ScoredAnswer& s) {
  if (!s.label->implant) return {};
  const ImplantLabel& label = *s.label->implant;
  ScoredImplant implant{label.size, label.foretold_share, "", "", kNaN, s.told(), s.stranger()};
  if (!label.values.empty()) {
    implant.parameter = label.values.front().key, implant.unit = label.values.front().unit;
    implant.amount = label.values.front().value;
  }
  return implant;
}

ScoredCase for_the_reader(const ScoredAnswer& s, const BlindCalibration& calibration) {
  const std::string truth = s.none() ? "none" : fmt::format("{}", fmt::join(s.label->effects, "+"));
  return {s.label->name,     s.label->part,
          s.label->rig,      truth,
          s.answer->verdict, fmt::format("{}", fmt::join(s.answer->effects, "+")),
          s.label->severity, s.answer->evidence.before(),
          s.answer->shrink,  s.first.ranking.empty() ? kNaN : probability_of(s.first, calibration),
          s.right(),         implant_for_the_reader(s)};
}

}  // namespace
}  // namespace blind

BlindScore score_blind_answers(const BlindLabels& labels, const BlindAnswers& answers) {
  using namespace blind;
  const std::vector<ScoredAnswer> cases = scored(labels, answers);
  BlindScore score;
  score.name = answers.name, score.version = answers.version;
  score.manifest_sha256 = answers.manifest_sha256, score.answers_seal = answers.seal();
  score.configuration = labels.configuration;
  for (const ScoredAnswer& s : cases) ++(s.reported() ? score.report_cases : score.calibration_cases);
  score.confusion = confusion_of(cases);
  const bool of_implants = !cases.empty() && cases.front().label->implant.has_value();
  score.counts = of_implants ? count_implants(cases) : count_answers(cases);
  for (const ScoredAnswer& s : cases) score.cases.push_back(for_the_reader(s, score.calibration));
  if (of_implants) return score;  // a real drive has no floor to count from, and lacks more than one thing
  score.cases.clear();
  fill_shrinks(cases, score);
  score.slices = slice_answers(cases);
  const std::vector<Judgement> judged = judgements(cases, "report");
  score.calibration = calibrate(judgements(cases, "calibration"), judged);
  score.abstention = abstention_of(judged, score.calibration);
  for (const ScoredAnswer& s : cases) score.cases.push_back(for_the_reader(s, score.calibration));
  return score;
}

}  // namespace gapscope

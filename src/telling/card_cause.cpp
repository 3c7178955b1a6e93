#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "diagnosis/numbers.h"
#include "diagnosis/rule.h"
#include "diagnosis/simulator.h"
#include "diagnosis/told_facts.h"
#include "telling/card_lines.h"
#include "telling/names.h"
#include "torque_view/options.h"

namespace gapscope::internal::telling {

using diagnosis::kRule;
using diagnosis::kTelling;

CauseDoubt doubt_of(const Diagnosis& d) {
  const bool shown = d.added.empty() || d.is_shown_by_motion();
  const bool balance = !d.added.empty() && d.added.front().share_of == ShareOf::kTorque;
  if (!shown && balance) return CauseDoubt::kByBalance;
  if (!shown && std::isfinite(d.mismatch.shrink_ci95.low)) return CauseDoubt::kRecordings;
  return rival_of_first(d).empty() ? CauseDoubt::kNone : CauseDoubt::kRival;
}

bool rests_on_open_cause(const Diagnosis& d) {
  return !d.added.empty() && !d.added.front().established &&
         std::ranges::any_of(d.added, &AddedEffect::established);
}

const BudgetRung* suspected_rung(const Diagnosis& d) {
  if (d.verdict != DiagnosisVerdict::kUnknown || d.budget.rungs.empty()) return nullptr;
  const BudgetRung& first = d.budget.rungs.front();
  return first.share > kTelling.rival_share ? &first : nullptr;
}

bool are_one_law(const std::vector<std::string>& group, const Diagnosis& d) {
  const bool one_body = d.model_gap && d.model_gap->origin == GapOrigin::kNone;  // with a gap they differ
  return one_body && group.size() == 2 && contains(group, "constant_load_torque") &&
         contains(group, "friction_asymmetry");
}

bool ended_early(const Diagnosis& d) {
  const bool at_floor = d.mismatch.remains < kRule.floor_ratio;
  return d.exhausted && !d.stopped && !at_floor && d.verdict != DiagnosisVerdict::kNone;
}

std::size_t differing_rows(const SimulatorComparison* c) {
  return c == nullptr ? 0 : static_cast<std::size_t>(std::ranges::count_if(c->rows, &SimulatorRow::differs));
}

Told simulator_of(const CardFacts& f) {
  if (f.simulated == nullptr) return {};
  const std::size_t rows = differing_rows(f.simulated);
  if (rows == 0) return {{"simulator.alike", {}, f.simulated->in_brief}};
  return {{"simulator.row",
           {word("row", f.simulated->rows.front().sentence),
            ratio("more", rows > 1 ? static_cast<double>(rows - 1) : kNaN)}}};
}

bool input_is_made(const Diagnosis& d) { return !d.traces.empty() && !d.traces.front().target.empty(); }

Fact source_word(const Diagnosis& d) {
  return word("source", input_is_made(d) ? "model's controller computes from the goal" : "input applies");
}
Fact judged_word(const Diagnosis& d) {
  return word("judged", d.mismatch.judged_by == JudgedBy::kPrediction ? "prediction" : "free run");
}
Fact error_word(const Diagnosis& d) {
  return word("error", d.mismatch.judged_by == JudgedBy::kPrediction ? "prediction error" : "free-run error");
}
Fact added_names(const Diagnosis& d) {
  std::vector<std::string> all;
  for (const AddedEffect& a : d.added) all.push_back(readable(a.effect));
  return names("added", all);
}
Fact parts_word(const Diagnosis& d) {
  const bool parts = !d.traces.empty() &&
                     std::ranges::all_of(d.traces, [](const MismatchTrace& t) { return t.scored_from > 0; });
  return word("parts", parts ? "recording's parts" : "recordings");
}
Fact floor_of_the_motion(const MismatchSize& m) {
  return word("floor", m.floor_from == FloorSource::kRepeatability
                           ? "what the drive itself varies by from period to period"
                           : "the encoder's noise");
}

Fact encoder_word(const Diagnosis& d) {
  const bool load = !d.traces.empty() && d.traces.front().encoder == EncoderSide::kLoad;
  return word("x", load ? "x2" : "x1");
}

bool is_of_the_drive(const ErrorBudget& b) {
  return b.repeatability >= b.floor() && !(b.repeatability < kRule.floor_ratio * b.encoder);
}

namespace {

/// The names of what is established, by itself, or of what is open.
std::vector<ToldName> names_of(const CardFacts& f, bool established) {
  std::vector<ToldName> all;
  for (const AddedEffect& a : f.diagnosis->added)
    if (a.established == established && (!established || others_of(a, *f.diagnosis).empty()))
      all.push_back(name_of(a, *f.diagnosis, f.coordinates));
  return all;
}

Fact open_names(const CardFacts& f) {
  return names("open", rests_on_open_cause(*f.diagnosis) ? names_of(f, false) : std::vector<ToldName>());
}

/// Of every group that holds a cause, which of it is not known.
Told groups(const CardFacts& f, CauseDoubt doubt) {
  Told told;
  for (const AddedEffect& a : f.diagnosis->added) {
    std::vector<std::string> group = others_of(a, *f.diagnosis);
    if (!a.established || group.empty()) continue;
    const std::string first = name_of(a, *f.diagnosis, f.coordinates).name;
    group.insert(group.begin(), first);
    told.push_back({are_one_law(a.group, *f.diagnosis) ? "cause.group.one_law"
                    : doubt == CauseDoubt::kNone       ? "cause.group"
                                                       : "cause.group.likely",
                    {names("group", group), word("first", first), open_names(f)}});
  }
  return told;
}

/// Causes, and what they rest on where that is open.
Told established(const CardFacts& f) {
  const CauseDoubt doubt = doubt_of(*f.diagnosis);
  static constexpr const char* kCodes[] = {"cause.established", "cause.likely.rival", "cause.likely.balance",
                                           "cause.likely.recordings"};
  Told told;
  if (std::vector<ToldName> causes = names_of(f, true); !causes.empty())
    told.push_back({kCodes[static_cast<int>(doubt)],
                    {names("causes", std::move(causes)), open_names(f), judged_word(*f.diagnosis),
                     word("rival", rival_of_first(*f.diagnosis))}});
  for (Statement& group : groups(f, doubt)) told.push_back(std::move(group));
  return told;
}

/// Of a share of the mean square, the fall of the rms [%].
double fall_of_rms(double share) { return 100.0 * (1.0 - std::sqrt(1.0 - std::clamp(share, 0.0, 1.0))); }

/// Where the torque balance has chosen an effect: by which of its conditions it is no cause.
Statement doubt_of_balance(const AddedEffect& a, const Diagnosis& d) {
  const torque_view::TorqueViewOptions conditions;
  for (const BudgetRung& r : d.budget.rungs) {
    if (!r.added || r.effect != a.effect) continue;
    if (r.share < conditions.least_share) return {"open.little", {per_cent("fall", fall_of_rms(r.share))}};
    if (r.share_ci95.low < conditions.least_low)
      return {
          "open.uncertain",
          {per_cent("low", fall_of_rms(r.share_ci95.low)), per_cent("high", fall_of_rms(r.share_ci95.high))}};
    if (r.last < conditions.least_share) return {"open.same"};
    return {"open.rival",
            {word("rival", r.rivals.empty() ? "another torque" : readable_law(r.rivals.front()))}};
  }
  return {};
}

/// Why the cause of what was added is open; without a code: no condition of its own says it.
Statement why_open(const AddedEffect& a, const Diagnosis& d) {
  if (diagnosis::outlasts_motion(a, d)) return {"open.outlasts"};
  if (const std::vector<std::string> rivals = others_of(a, d); !rivals.empty())
    return {"open.rivals", {names("rivals", rivals)}};
  if (diagnosis::may_be_absent(a, d)) return {"open.amount"};
  return doubt_of_balance(a, d);
}

/// What has an open cause, with why it is.
Told open_causes(const CardFacts& f) {
  std::vector<ToldName> open;
  bool little = false;
  for (const AddedEffect& a : f.diagnosis->added) {
    if (a.established) continue;
    ToldName name = name_of(a, *f.diagnosis, f.coordinates);
    const Statement why = why_open(a, *f.diagnosis);
    little = little || why.code == "open.little";
    if (!why.code.empty()) name.aside += (name.aside.empty() ? "" : "; ") + as_clause(why, f.coordinates);
    open.push_back(std::move(name));
  }
  if (open.empty()) return {};
  Told told = {{"cause.open", {names("open", std::move(open))}}};
  const double least = torque_view::TorqueViewOptions{}.least_share;
  if (little)
    told.push_back(
        {"cause.open.least", {per_cent("fall", fall_of_rms(least)), per_cent("share", 100.0 * least)}});
  return told;
}

/// Of the verdict "unknown".
Told unknown(const CardFacts& f) {
  const Diagnosis& d = *f.diagnosis;
  if (const BudgetRung* rung = suspected_rung(d)) {
    Told told = {{"cause.suspected",
                  {word("suspect", readable(rung->effect.empty() ? rung->law : rung->effect)),
                   number("before", rung->before, "N m"), number("after", rung->after, "N m")}},
                 {d.better_swapped ? "cause.suspected.swapped" : "cause.suspected.unconfirmed"}};
    if (input_is_made(d)) told.push_back({"cause.suspected.controller"});
    return told;
  }
  Told told = {{"cause.unknown"}};
  const RankedEffect* first = d.ranking.empty() ? nullptr : &d.ranking.front();
  const bool little =
      d.mismatch.floor_from == FloorSource::kEncoder && d.mismatch.remains < std::sqrt(kRule.near_floor);
  if (first != nullptr && first->probability > d.outside_probability)
    told.push_back({"cause.unknown.nearest",
                    {word("nearest", readable(first->effect)),
                     per_cent("share", 100.0 * std::max(first->shrink, 0.0))}});
  else if (little)
    told.push_back({"cause.unknown.little", {encoder_word(d), ratio("times", d.mismatch.remains)}});
  return told;
}

/// The law of the firmware beyond what was declared of it, where the loop as a whole shows it.
Told firmware(const Diagnosis& d) {
  if (!d.loop) return {};
  static const std::pair<const char*, const char*> told_as[] = {
      {"controller.rate", "firmware.rate"},
      {"controller.profile.speed", "firmware.speed"},
      {"controller.profile.acceleration", "firmware.acceleration"},
      {"controller.goal_filter_s", "firmware.filter"},
      {"controller.goal_delay_s", "firmware.goal_late"},
      {"controller.position.delay", "firmware.late"},
      {"controller.position.saturation", "firmware.ends"},
      {"controller.position.falls_at", "firmware.falls"}};
  Told told;
  for (const auto& [key, code] : told_as)
    for (const LoopNumber& n : d.loop->numbers)
      if (n.key == key && contains(d.loop->added, n.key))
        told.push_back({code, {number("value", n.value, n.unit, n.ci95)}});
  return told;
}

/// What the loop's fit has added to the drive, beside what the torque says.
Told drive_in_loop(const CardFacts& f) {
  const Diagnosis& d = *f.diagnosis;
  if (!d.loop) return {};
  std::vector<ToldName> told;
  for (const std::string& name : d.loop->added) {
    if (find_effect(name) == nullptr || std::ranges::count(d.added, name, &AddedEffect::effect) > 0) continue;
    AddedEffect in_loop;
    in_loop.effect = name;
    for (const LoopNumber& n : d.loop->numbers)
      if (n.key.starts_with(name + "."))
        in_loop.parameters.push_back({n.key.substr(name.size() + 1), n.unit, n.value, n.ci95});
    told.push_back(with_amount(in_loop, d, f.coordinates, ""));
  }
  return told.empty() ? Told() : Told{{"cause.loop.drive", {names("effects", std::move(told))}}};
}

/// Whether the cause, where none is established, is more likely outside of the catalogue; probabilities were
/// learned where the candidates' own refits decide, above the encoder's floor.
bool is_likely_outside(const Diagnosis& d) {
  const bool learned = d.mismatch.floor_from != FloorSource::kRepeatability && !d.ranking.empty() &&
                       !d.effects.empty() && d.ranking.front().effect == d.effects.front();
  return learned && d.outside_probability > 0.5;
}

}  // namespace

Told cause_of(const CardFacts& f) {
  if (f.diagnosis == nullptr) return {{"by_diagnose"}};
  const Diagnosis& d = *f.diagnosis;
  Told in_loop = firmware(d);
  for (Statement& s : drive_in_loop(f)) in_loop.push_back(std::move(s));
  Told told;
  if (d.verdict == DiagnosisVerdict::kNone) {
    told = {{changed_numbers(d, f.coordinates).empty() ? "cause.none" : "cause.numbers"}};
  } else {
    const Told causes = established(f);
    Told open = open_causes(f);
    told = causes;
    told.insert(rests_on_open_cause(d) ? told.begin() : told.end(), open.begin(), open.end());
    if (told.empty() && d.stopped)
      told = {{"cause.stopped"}};
    else if (told.empty())
      told = in_loop.empty() ? unknown(f) : Told{{"cause.loop"}};
    if (causes.empty() && in_loop.empty() && !has_code(told, "cause.stopped") && is_likely_outside(d))
      told.push_back({"cause.outside", {per_cent("p", 100.0 * d.outside_probability)}});
    if (ended_early(d)) told.push_back({"cause.exhausted"});
  }
  for (const Told& more : {in_loop, simulator_of(f)}) told.insert(told.end(), more.begin(), more.end());
  return told;
}

}  // namespace gapscope::internal::telling

namespace gapscope {

std::string rival_of_first(const Diagnosis& d) {
  if (d.added.empty() || !d.added.front().established || !d.next_experiment.proposes()) return "";
  const AddedEffect& first = d.added.front();
  for (const Separation& s : d.next_experiment.tried.front().separations)
    if (s.truth == first.effect && !contains(first.group, s.rival)) return readable(s.rival);
  return "";
}

}  // namespace gapscope

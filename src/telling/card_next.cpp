#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "diagnosis/numbers.h"
#include "diagnosis/place.h"
#include "diagnosis/rule.h"
#include "diagnosis/simulator.h"
#include "telling/answer.h"
#include "telling/card_lines.h"
#include "telling/gap_of_effect.h"
#include "telling/names.h"

namespace gapscope::internal::telling {

using diagnosis::kRule;
using diagnosis::kTelling;

bool drifts_farther(const Diagnosis& d) {
  if (d.added.empty() || !d.whole_run || d.closed_loop || !std::isfinite(d.whole_run->before)) return false;
  const WholeRun& w = *d.whole_run;
  return !(w.after < kTelling.clearly_more * w.before || w.after < kRule.far * d.mismatch.floor);
}

namespace {

/// What another recording is to have.
Fact other_motion(const Diagnosis& d) {
  return word("motion", diagnosis::lacking_way(d.where.direction)
                            ? "both directions, other speeds, other loads"
                            : "other speeds, other loads");
}

/// The step that the estimate asks for; what a diagnosis would say is known where there is one.
Told step_of_the_answer(const CardFacts& f) {
  const bool no_gap = f.reference != nullptr && f.reference->find("gap") == nullptr;
  if (f.answer == nullptr || (f.diagnosis != nullptr && no_gap)) return {};
  for (std::size_t i = 0; i < f.answer->next.size(); ++i) {
    const std::vector<std::string>& codes = f.answer->next_codes;
    const std::string code = i < codes.size() ? codes[i] : "next.stored";  // by an earlier version
    if (f.diagnosis == nullptr || code != "next.diagnose.lacks") return {{code, {}, f.answer->next[i]}};
  }
  return {};
}

/// Where the gap that was fitted is not told, though the model lacked what was found: it takes no new
/// recording.
Told step_to_the_gap(const CardFacts& f) {
  const Diagnosis& d = *f.diagnosis;
  const bool fitted = d.model_gap && d.model_gap->origin == GapOrigin::kEstimated && d.model_gap->value > 0.0;
  const bool told = f.answer != nullptr && f.answer->trust != AnswerTrust::kNone;
  if (!fitted || told || d.added.empty()) return {};
  return {{divides_one_body(d) ? "next.model_gap" : "next.read_gap"}};
}

/// From what was found, where the search ended at its limit of work.
Told step_onwards(const Diagnosis& d) {
  if (d.added.empty() || !ended_early(d)) return {};
  return {{"next.go_on",
           {word("first", diagnosis::lacking_way(d.where.direction)
                              ? "Record both directions, too: without them causes stay open."
                              : "")}}};
}

/// What remains once all that was added is in the model, where that is most of it or far above the floor;
/// nothing: it is neither, or the budget has no size of something that was added.
Told unexplained(const CardFacts& f, const Card& card) {
  const Diagnosis& d = *f.diagnosis;
  const ErrorBudget& b = d.budget;
  const double floor = b.exists() ? b.floor() : 0.0, left = card.torque_after;
  const bool sized =
      std::ranges::all_of(d.added, [&](const AddedEffect& a) { return a.after_torque < card.torque; });
  const bool most = left > card.torque - left && left > kRule.floor_ratio * floor;
  if (d.mismatch.remains < kRule.floor_ratio) return {};  // the motion shows none of it
  if (!(b.uncounted.empty() && sized && floor > 0.0 && (most || left > kRule.far * floor))) return {};
  return {{"next.do_not_rely",
           {per_cent("left", card.percent_after), ratio("times", left / floor),
            word("floor", b.records >= floor   ? "that by which the recordings disagree"
                          : is_of_the_drive(b) ? "what the drive itself differs by from period to period"
                                               : "what the encoder's noise alone looks like"),
            other_motion(d), word("swap", d.better_swapped ? "swap `file` and `held_out`" : "")}}};
}

/// What takes the model to other simulators; in brief only where a format carries all of it.
Told export_of(const CardFacts& f) {
  const bool goals = f.diagnosis->closed_loop || input_is_made(*f.diagnosis);
  const Fact what = word("what", goals ? "the drive, without its controller," : "it");
  if (!f.carriers) return {{"next.export.any", {what}}};
  if (!f.carriers->empty()) return {{"next.export", {word("format", f.carriers->front()), what}}};
  std::vector<std::string> lost;
  for (const std::string& effect : f.uncarried) lost.push_back(readable(effect));
  return {{"next.export.loses", {lost.empty() ? word("lost", "it") : names("lost", lost)}}};
}

/// How far the model may be simulated that drifts over a whole recording, though not in the windows that
/// judge it.
Statement simulate(const Diagnosis& d, Coordinates coordinates) {
  const bool open = !std::ranges::all_of(d.added, &AddedEffect::established);
  if (d.whole_run && !d.closed_loop) {
    const WholeRun& w = *d.whole_run;
    if (!std::isfinite(w.after)) return {"next.simulate.runs_away"};
    if (drifts_farther(d))
      return {"next.simulate.drifts", {number("after", w.after, "rad"), number("before", w.before, "rad")}};
    if (w.after > kTelling.whole_run_drift * w.travel)
      return {"next.short_motions", {per_cent("drift", 100.0 * w.after / w.travel)}};
  }
  if (open) return {"next.simulate.open"};
  const std::string what =
      d.added.size() > 1 ? "all of these" : name_of(d.added.front(), d, coordinates).name;
  return {"next.simulate", {word("addition", what)}};
}

/// Where effects were added: to use them, unless too much is left.
Told step_of_the_model(const CardFacts& f, const Card& card) {
  if (Told left = unexplained(f, card); !left.empty()) return left;
  const Diagnosis& d = *f.diagnosis;
  if (d.mismatch.after >= d.mismatch.before)
    return {{"next.no_nearer", {ratio("added", static_cast<double>(d.added.size())), other_motion(d)}}};
  Told told = {simulate(d, f.coordinates)};
  for (Statement& s : export_of(f)) told.push_back(std::move(s));
  if (d.verdict == DiagnosisVerdict::kHelps)
    told.push_back({"next.settle", {other_motion(d)}});
  else if (doubt_of(d) != CauseDoubt::kNone)
    told.push_back({"next.confirm", {other_motion(d)}});
  return told;
}

/// Where the loop was fitted as a whole: that is what fitted.yaml has.
Told step_of_the_loop(const CardFacts& f) {
  Told told = {{"next.loop"}};
  for (Statement& s : export_of(f)) told.push_back(std::move(s));
  return told;
}

/// Where nothing is missing.
Told step_of_numbers(const CardFacts& f) {
  std::vector<std::string> rows;
  if (f.simulated != nullptr)
    for (const SimulatorRow& row : f.simulated->rows)
      if (row.differs) rows.push_back(readable(row.name));
  if (!rows.empty()) return {{"next.mend_simulator", {names("rows", rows)}}};
  if (changed_numbers(*f.diagnosis, f.coordinates).empty()) return {{"next.nothing"}};
  Told told = {{"next.numbers"}};
  for (Statement& s : export_of(f)) told.push_back(std::move(s));
  return told;
}

/// Where the recordings show a mismatch and establish nothing, and the other way round is no better.
Told step_to_establish(const CardFacts& f, const Card& card) {
  Told told;
  if (card.percent < kTelling.little_torque_percent && !f.tolerance.stated())
    told.push_back(
        {"next.little", {per_cent("share", card.percent), word("tolerance", "{torque_percent: 1}")}});
  told.push_back({input_is_made(*f.diagnosis) ? "next.record_input" : "next.record_motion"});
  return told;
}

Told step_without_diagnosis(const CardFacts& f) {
  const bool good = f.answer != nullptr && f.answer->trust == AnswerTrust::kGood;
  if (good) return {{"next.diagnose.gap_known"}, {"next.diagnose.too"}};
  return {{"next.diagnose"}};
}

/// The experiment that would decide, where one separates what these recordings do not, or where its absence
/// is news.
Told experiment(const Diagnosis& d) {
  const NextExperiment& next = d.next_experiment;
  const bool idle = are_one_law(d.group, d) || (d.verdict == DiagnosisVerdict::kUnknown && next.proposes());
  if (next.sentence.empty() || !(next.separates() || !idle)) return {};
  return {{"next.experiment", {}, next.sentence}};
}

}  // namespace

Told next_of(const CardFacts& f, const Card& card) {
  if (card.good_enough && *card.good_enough) return {{"next.within_tolerance"}};
  if (f.diagnosis != nullptr && f.diagnosis->stopped) return {{"next.finish"}};
  if (Told gap = f.diagnosis != nullptr ? step_to_the_gap(f) : Told(); !gap.empty()) return gap;
  if (Told step = step_of_the_answer(f); !step.empty()) {
    if (f.diagnosis == nullptr && step.front().code != "next.diagnose.lacks")
      step.push_back({"next.diagnose.too"});
    return step;
  }
  if (f.diagnosis == nullptr) return step_without_diagnosis(f);
  const Diagnosis& d = *f.diagnosis;
  const bool unknown = d.verdict == DiagnosisVerdict::kUnknown;
  if (!d.held.empty() && (unknown || d.verdict == DiagnosisVerdict::kHelps))
    return {{"next.estimate", {names("held", d.held), estimate_true()}}};
  if (d.loop) return step_of_the_loop(f);
  if (unknown && d.better_swapped) return {{"next.swap"}};  // which takes no new recording
  if (Told onwards = step_onwards(d); !onwards.empty()) return onwards;
  if (Told next = experiment(d); !next.empty()) return next;
  if (!d.added.empty()) return step_of_the_model(f, card);
  return d.verdict == DiagnosisVerdict::kNone ? step_of_numbers(f) : step_to_establish(f, card);
}

}  // namespace gapscope::internal::telling

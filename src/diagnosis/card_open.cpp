#include "diagnosis/card_open.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "diagnosis/card_words.h"
#include "diagnosis/headline.h"
#include "diagnosis/rule.h"
#include "diagnosis/verdict.h"
#include "gapscope/base/text.h"
#include "gapscope/diagnosis/diagnosis.h"
#include "torque_view/options.h"

namespace gapscope::internal::diagnosis {

std::vector<std::string> others_of(const AddedEffect& a, const Diagnosis& d) {
  std::vector<std::string> all;
  for (const std::string& other : a.group)
    if (other != a.effect && !contains(d.effects, other)) all.push_back(readable(other));
  return all;
}

bool is_of_the_drive(const ErrorBudget& b) {
  return b.repeatability >= b.floor() && !(b.repeatability < kRule.floor_ratio * b.encoder);
}

namespace {

constexpr const char* kLowers = "it lowers the error by only ";

/// Of a share of the mean square, the fall of the rms [%].
double fall_of_rms(double share) { return 100.0 * (1.0 - std::sqrt(1.0 - std::clamp(share, 0.0, 1.0))); }

/// "torque ripple", "a free curve over the speed"
std::string rival_words(const std::vector<std::string>& laws) {
  constexpr std::string_view kFree = "free_", kCurve = "_curve";
  if (laws.empty()) return "another torque";
  const std::string& law = laws.front();
  if (!law.starts_with(kFree) || !law.ends_with(kCurve)) return readable(law);
  return "a free curve over the " + law.substr(kFree.size(), law.size() - kFree.size() - kCurve.size());
}

/// Where the torque balance has chosen it: by which of its conditions it is no cause.
std::string doubt_of_balance(const AddedEffect& a, const Diagnosis& d) {
  const torque_view::TorqueViewOptions conditions;
  for (const BudgetRung& r : d.budget.rungs) {
    if (!r.added || r.effect != a.effect) continue;
    if (r.share < conditions.least_share) return fmt::format("{}{:.1f} %", kLowers, fall_of_rms(r.share));
    if (r.share_ci95.low < conditions.least_low)
      return fmt::format("by how much it lowers the error is uncertain, {:.0f} to {:.0f} %",
                         fall_of_rms(r.share_ci95.low), fall_of_rms(r.share_ci95.high));
    return r.last < conditions.least_share
               ? "what was added after it removes most of the same"
               : rival_words(r.rivals) + " would remove nearly as much in its place";
  }
  return "";
}

}  // namespace

std::string why_open(const AddedEffect& a, const Diagnosis& d) {
  if (outlasts_motion(a, d)) return "its period is longer than the held-out motion";
  if (const std::vector<std::string> rivals = others_of(a, d); !rivals.empty())
    return "it may as well be " + enumerated(rivals, "or");
  if (may_be_absent(a, d)) return "these recordings do not determine its amount";
  return doubt_of_balance(a, d);
}

bool are_one_law(const std::vector<std::string>& group, const Diagnosis& d) {
  const bool one_body = d.model_gap && d.model_gap->origin == GapOrigin::kNone;  // with a gap they differ
  return one_body && group.size() == 2 && contains(group, "constant_load_torque") &&
         contains(group, "friction_asymmetry");
}

std::string which_is_open(const std::vector<std::string>& group, const Diagnosis& d) {
  return are_one_law(group, d)
             ? "no recording can tell which: dry friction that differs with the direction is the same as "
               "equal friction and a constant torque"
             : "these recordings cannot tell which";
}

std::string least_of_a_cause(const std::vector<std::string>& why) {
  if (std::ranges::none_of(why, [](const std::string& w) { return w.starts_with(kLowers); })) return "";
  const double share = torque_view::TorqueViewOptions{}.least_share;
  return fmt::format(
      " Only what lowers it by {:.1f} % or more ({:.0f} % of its mean square) is called a cause.",
      fall_of_rms(share), 100.0 * share);
}

const BudgetRung* unestablished_rung(const Diagnosis& d) {
  if (d.verdict != DiagnosisVerdict::kUnknown || d.budget.rungs.empty()) return nullptr;
  const BudgetRung& first = d.budget.rungs.front();
  return first.share > kTelling.rival_share ? &first : nullptr;
}

namespace {

/// What a reader of the table would ask: of the likeliest candidate that was not taken; else of an error that
/// is hardly above what the encoder shows.
std::string how_near(const Diagnosis& d) {
  const RankedEffect* first = d.ranking.empty() ? nullptr : &d.ranking.front();
  if (first != nullptr && first->probability > d.outside_probability)
    return fmt::format(" well enough: {} is the likeliest, but removes {:.0f} % of the error above the floor",
                       readable(first->effect), 100.0 * std::max(first->shrink, 0.0));
  const bool little =
      d.mismatch.floor_from == FloorSource::kEncoder && d.mismatch.remains < std::sqrt(kRule.near_floor);
  if (!little) return "";
  return fmt::format("; it is little, as the error in x1 is {:.2g} times what the encoder can show",
                     d.mismatch.remains);
}

}  // namespace

std::string unknown_words(const CardFacts& f) {
  const Diagnosis& d = *f.diagnosis;
  const BudgetRung* rung = unestablished_rung(d);
  if (rung == nullptr) return "unknown, as no effect of the catalogue explains it" + how_near(d);
  const SharedUnit torque(rung->before, f.coordinates.shown_unit("N m"));
  return fmt::format(
             "unknown, though {} is suspected: as a term of the torque balance it brings the missing {} down "
             "from {} to {}, but {}",
             readable(rung->effect.empty() ? rung->law : rung->effect), f.coordinates.torque_word(),
             torque.number(rung->before), torque(rung->after),
             d.better_swapped ? "the recording that was fitted moves too little to establish a cause"
                              : "no simulation with it follows the recordings well enough to establish it") +
         (input_is_made(d)
              ? std::string(". The ") + f.coordinates.torque_word() +
                    " here was not recorded but computed from the goal by the model's controller, "
                    "which hides a part of what is missing"
              : "");
}

const char* what_disagrees(const Diagnosis& d) {
  const bool parts = !d.traces.empty() &&
                     std::ranges::all_of(d.traces, [](const MismatchTrace& t) { return t.scored_from > 0; });
  return parts ? "the recording's parts" : "the recordings";
}

bool input_is_made(const Diagnosis& d) { return !d.traces.empty() && !d.traces.front().target.empty(); }

const char* what_applies(const Diagnosis& d) {
  return input_is_made(d) ? "model's controller computes from the goal" : "input applies";
}

std::string step_to_estimate(const Diagnosis& d) {
  return fmt::format(
      "Estimate what the configuration holds ({}: {{estimate: true}}), and diagnose again: where "
      "such a number is wrong, effects take its place.",
      fmt::join(d.held, ", "));
}

std::string step_to_establish(const CardFacts& f, const Card& card) {
  const std::string step =
      input_is_made(*f.diagnosis)
          ? "Record the motor's input as well (duty, current or torque), and diagnose from that."
          : "Record the drive in another motion (other speeds, other loads) and diagnose that.";
  if (!(card.percent < kTelling.little_torque_percent) || f.tolerance.stated()) return step;
  return fmt::format(
      "None, if {} of the {} is little enough (`tolerance: {{torque_percent: 1}}` judges it). Else r{}",
      percent_text(card.percent), f.coordinates.torque_word(), step.substr(1));
}

std::string step_to_the_gap(const CardFacts& f) {
  const Diagnosis& d = *f.diagnosis;
  const bool fitted = d.model_gap && d.model_gap->origin == GapOrigin::kEstimated && d.model_gap->value > 0.0;
  const bool told = f.answer != nullptr && f.answer->trust != AnswerTrust::kNone;
  if (!fitted || told || d.added.empty()) return "";
  if (divides_one_body(d))
    return "Begin with a gap in the model: write the configuration again with `gapscope init ... --model gap`"
           " (and the motor's own inertia, `--inertia`, where its sheet has it), and diagnose that.";
  return "Read the gap with what was found in the model: `gapscope run CONFIG --model-from DIR/fitted.yaml "
         "-o DIR_gap`.";
}

std::string exhausted_words(const Diagnosis& d) {
  const bool at_floor = d.mismatch.remains < kRule.floor_ratio;
  if (!d.exhausted || d.stopped || at_floor || d.verdict == DiagnosisVerdict::kNone) return "";
  return " The search ended at its limit of work, so that further causes may have been missed.";
}

std::string step_onwards(const Diagnosis& d) {
  if (exhausted_words(d).empty()) return "";
  return (one_way_words(d.where.direction).empty() ? std::string("Go on from what was found: ")
                                                   : "Record both directions, too: without them causes stay "
                                                     "open. To go on from what was found: ") +
         "`gapscope diagnose CONFIG --model-from DIR/fitted.yaml -o DIR_more`.";
}

bool drifts_farther(const Diagnosis& d) {
  if (d.added.empty() || !d.whole_run || d.closed_loop || !std::isfinite(d.whole_run->before)) return false;
  const WholeRun& w = *d.whole_run;
  const double least = kTelling.clearly_more;
  return !(w.after < least * w.before || w.after < kRule.far * d.mismatch.floor);
}

std::string other_motion(const Diagnosis& d) {
  return !one_way_words(d.where.direction).empty() ? "both directions, other speeds, other loads"
                                                   : "other speeds, other loads";
}

std::string no_nearer(const Diagnosis& d) {
  return fmt::format(
      "Do not rely on `DIR/fitted.yaml` to simulate: the motion comes no nearer with {}. Record another "
      "motion ({}), and diagnose again.",
      d.added.size() > 1 ? "what was added" : "the addition", other_motion(d));
}

std::string unexplained(const CardFacts& f, const Card& card) {
  const ErrorBudget& b = f.diagnosis->budget;
  const double floor = b.exists() ? b.floor() : 0.0;
  const std::vector<AddedEffect>& added = f.diagnosis->added;
  const bool sized = std::all_of(added.begin(), added.end(),
                                 [&](const AddedEffect& a) { return a.after_torque < card.torque; });
  const bool most =
      card.torque_after > card.torque - card.torque_after && card.torque_after > kRule.floor_ratio * floor;
  if (f.diagnosis->mismatch.remains < kRule.floor_ratio) return "";  // the motion shows none of it
  if (!(b.uncounted.empty() && sized && floor > 0.0 && (most || card.torque_after > kRule.far * floor)))
    return "";
  return fmt::format(
      "Do not rely on `DIR/fitted.yaml` yet: {} of the input's {} is unexplained with all that was found "
      "({} times {}). Record another motion ({}){}, and diagnose again.",
      percent_text(card.percent_after), f.coordinates.torque_word(),
      SharedUnit(1.0, "").number(card.torque_after / floor),
      b.records >= floor   ? std::string("that by which ") + what_disagrees(*f.diagnosis) + " disagree"
      : is_of_the_drive(b) ? "what the drive itself differs by from period to period"
                           : "what the encoder's noise alone looks like",
      other_motion(*f.diagnosis), f.diagnosis->better_swapped ? ", or swap `file` and `held_out`" : "");
}

}  // namespace gapscope::internal::diagnosis

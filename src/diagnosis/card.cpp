#include "gapscope/diagnosis/card.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "diagnosis/card_cause.h"
#include "diagnosis/card_helps.h"
#include "diagnosis/card_mismatch.h"
#include "diagnosis/card_numbers.h"
#include "diagnosis/card_open.h"
#include "diagnosis/card_words.h"
#include "diagnosis/headline.h"
#include "diagnosis/rule.h"
#include "diagnosis/words.h"
#include "gapscope/base/text.h"
#include "gapscope/diagnosis/answer.h"
#include "gapscope/diagnosis/diagnosis.h"

namespace gapscope {
namespace {

using internal::diagnosis::also_refitted;
using internal::diagnosis::are_one_law;
using internal::diagnosis::as_sentence;
using internal::diagnosis::brief_cause;
using internal::diagnosis::brief_doubt;
using internal::diagnosis::brief_helps;
using internal::diagnosis::cause_line;
using internal::diagnosis::drifts_farther;
using internal::diagnosis::export_words;
using internal::diagnosis::first_clause;
using internal::diagnosis::gap_not_estimated;
using internal::diagnosis::helps_line;
using internal::diagnosis::kRule;
using internal::diagnosis::kSwapStep;
using internal::diagnosis::kTelling;
using internal::diagnosis::kToldByDiagnose;
using internal::diagnosis::left_open;
using internal::diagnosis::mismatch_size;
using internal::diagnosis::mismatch_words;
using internal::diagnosis::name_of;
using internal::diagnosis::next_of_numbers;
using internal::diagnosis::no_nearer;
using internal::diagnosis::other_motion;
using internal::diagnosis::percent_text;
using internal::diagnosis::SharedUnit;
using internal::diagnosis::step_onwards;
using internal::diagnosis::step_to_establish;
using internal::diagnosis::step_to_estimate;
using internal::diagnosis::step_to_the_gap;
using internal::diagnosis::unexplained;
using internal::diagnosis::where_words;
using internal::diagnosis::without_asides;

bool is_added(const Diagnosis& d) { return !d.added.empty(); }

/// Whether the gap is within its tolerance; nothing where its interval does not decide.
std::optional<bool> gap_good_enough(const CardFacts& f) {
  if (f.answer == nullptr || std::isnan(f.answer->gap)) return {};
  const Interval& ci = f.answer->ci95;
  const double low = std::isfinite(ci.low) ? ci.low : f.answer->gap;
  const double high = std::isfinite(ci.high) ? ci.high : f.answer->gap;
  if (high <= *f.tolerance.gap) return true;
  if (low > *f.tolerance.gap) return false;
  return {};
}

std::optional<bool> torque_good_enough(const CardFacts& f, const Card& card) {
  if (std::isnan(card.percent)) return {};
  return card.percent <= *f.tolerance.torque_percent;
}

/// Of all that is stated: one that is missed decides, one that cannot be told leaves it open.
std::optional<bool> good_enough(const CardFacts& f, const Card& card) {
  std::optional<bool> all;
  bool open = false;
  const auto judge = [&](const std::optional<bool>& one) {
    open = open || !one;
    if (one) all = all.value_or(true) && *one;
  };
  if (f.tolerance.torque_percent) judge(torque_good_enough(f, card));
  if (f.tolerance.gap) judge(gap_good_enough(f));
  return open && all.value_or(true) ? std::nullopt : all;
}

std::string gap_verdict(const CardFacts& f) {
  if (!f.tolerance.gap) return "";
  const std::string limit = f.coordinates.thousandths(*f.tolerance.gap);
  const std::optional<bool> good = gap_good_enough(f);
  if (!good) return " Your tolerance of " + limit + " cannot be judged.";
  return (*good ? " Within your tolerance of " : " Outside your tolerance of ") + limit + ".";
}

bool gap_is_known(const CardFacts& f) { return f.answer->trust != AnswerTrust::kNone; }

std::string gap_trust(const CardFacts& f) {
  const bool known = gap_is_known(f), measured = !known && f.lost_motion;
  if (known && f.answer->sentence.starts_with(internal::diagnosis::kThePlay))  // which bounds the gap
    return std::string(" Trust: good as an upper bound, ") + to_string(f.answer->trust) +
           " as the gap itself.";
  const bool beside = known && f.answer->from == AnswerSource::kModelFree && f.reference != nullptr &&
                      f.reference->rejected();  // whose reason stands between the reading and the trust
  return std::string(measured ? " Trust in a gap: "
                     : beside ? " Trust in that reading: "
                              : " Trust: ") +
         to_string(f.answer->trust) + (measured ? "; the lost motion is measured." : ".");
}

/// Why the trust is limited in a gap that is denied by no model, or in that of a model which leaves
/// something.
/// @param brief  without the sentence that says the latter
std::string why_limited(const CardFacts& f, bool brief) {
  if (f.answer->trust != AnswerTrust::kLimited) return "";
  if (f.answer->sentence.starts_with(internal::diagnosis::kNoBacklash))
    return " (it holds for loads of at least 0.2 of the motor's inertia; a fitted model can confirm it)";
  const auto leaves = [](double floors) {
    return fmt::format(
        " (the model leaves {} times the encoder's noise, and the interval does not hold what it lacks)",
        SharedUnit(1.0, "").number(floors));
  };
  if (f.answer->from == AnswerSource::kDiagnosis && f.diagnosis != nullptr &&
      f.diagnosis->mismatch.remains >= kRule.floor_ratio &&
      f.diagnosis->mismatch.floor_from != FloorSource::kRepeatability)
    return leaves(f.diagnosis->mismatch.remains);
  if (f.answer->from == AnswerSource::kDiagnosis) return left_open(*f.answer);
  const bool fitted = f.answer->from == AnswerSource::kReference && f.reference != nullptr;
  if (!brief || !fitted || f.reference->why.code() != "above_floor") return "";
  return leaves(f.reference->innovation_rmse / f.reference->floor);
}

std::string gap_trust_and_why(const CardFacts& f, bool brief) {
  std::string text = gap_trust(f);
  return text.insert(text.size() - 1, why_limited(f, brief));
}

std::string gap_line(const CardFacts& f) {
  if (f.answer == nullptr) return gap_not_estimated(f.diagnosis, f.coordinates);
  const bool whole = gap_is_known(f) || f.lost_motion;
  return as_sentence(whole ? f.answer->sentence : without_asides(f.answer->sentence)) +
         gap_trust_and_why(f, false) + gap_verdict(f);
}

/// What was measured of a loop, and what it means.
std::string brief_loop(const std::string& sentence) {
  const std::string measured = first_clause(sentence, ".");
  return measured.size() + 1 < sentence.size()
             ? measured + " " + first_clause(sentence.substr(measured.size() + 1), ".")
             : measured;
}

std::string brief_gap(const CardFacts& f) {
  if (f.answer == nullptr) return first_clause(gap_not_estimated(f.diagnosis, f.coordinates));
  const std::string& told = f.answer->sentence;
  if (gap_is_known(f)) return first_clause(told) + gap_trust_and_why(f, true) + gap_verdict(f);
  return (f.lost_motion ? brief_loop(told) : without_asides(first_clause(told))) + gap_verdict(f);
}

std::string torque_verdict(const CardFacts& f, const Card& card) {
  if (!f.tolerance.torque_percent) return "";
  const std::string limit = percent_text(*f.tolerance.torque_percent);
  const std::optional<bool> good = torque_good_enough(f, card);
  if (!good)
    return " Your tolerance of " + limit + " of the " + f.coordinates.torque_word() + " cannot be judged.";
  if (*good) return " Within your tolerance of " + limit + ".";
  const bool then = card.percent_after <= *f.tolerance.torque_percent;
  return fmt::format(" Outside your tolerance of {}{}.", limit, then ? ", within it with what helps" : "");
}

std::string place_line(const CardFacts& f) {
  return f.diagnosis == nullptr ? kToldByDiagnose : where_words(*f.diagnosis, f.coordinates);
}

/// The step that the estimate asks for; what a diagnosis would say is known where there is one.
std::string step_of_the_answer(const CardFacts& f) {
  const bool no_gap = f.reference != nullptr && f.reference->find("gap") == nullptr;
  if (f.answer == nullptr || (f.diagnosis != nullptr && no_gap)) return "";
  for (const std::string& step : f.answer->next)
    if (f.diagnosis == nullptr || step.find("gapscope diagnose") == step.npos) return step;
  return "";
}

/// What a model is good for that drifts over a whole recording, though not in the windows that judge it.
std::string for_short_motions(const Diagnosis& d, Coordinates coordinates) {
  if (!d.whole_run || d.closed_loop) return "";
  const WholeRun& w = *d.whole_run;
  const auto motion = [&](double size) { return SharedUnit(size, coordinates.position_unit())(size); };
  const std::string off = std::isfinite(w.after) ? "drifts up to " + motion(w.after) + " off" : "runs away";
  if (drifts_farther(d))
    return fmt::format(", for short motions alone and never whole recordings (over one it {}, without {} {})",
                       off, d.added.size() > 1 ? "what was added" : "the addition", motion(w.before));
  const double drift = w.after / w.travel;
  if (drift <= kTelling.whole_run_drift) return "";
  return ", for short motions alone (simulated over a whole recording it " +
         (std::isfinite(drift) ? fmt::format("drifts by {:.0f} % of the travel)", 100.0 * drift)
                               : "runs away)");
}

/// Where effects were added: to use them, unless too much is left.
/// @param whole  with what takes them to other simulators, even where it loses a part of them
std::string step_of_the_model(const CardFacts& f, const Card& card, bool whole) {
  if (std::string left = unexplained(f, card); !left.empty()) return left;
  const Diagnosis& d = *f.diagnosis;
  if (d.mismatch.after >= d.mismatch.before) return no_nearer(d);
  const bool open = std::ranges::any_of(d.added, [](const AddedEffect& a) { return !a.established; });
  const std::string short_motions = for_short_motions(d, f.coordinates);
  const bool carried = f.carriers && !f.carriers->empty(), helps = d.verdict == DiagnosisVerdict::kHelps;
  const std::string addition =
      d.added.size() > 1 ? "all of these" : without_asides(name_of(d.added.front(), d, f.coordinates));
  return std::string("Simulate with `DIR/fitted.yaml`") +
         (drifts_farther(d)    ? ""
          : !open              ? (short_motions.empty() ? ", which has " + addition + " in it" : "")
          : d.added.size() > 1 ? ", which predicts best with all of these in it, causes or not"
                               : ", which predicts better with it, a cause or not") +
         short_motions + (whole || carried ? "; " + export_words(f) : ".") +
         (helps || !brief_doubt(d, f.coordinates).empty()
              ? (helps ? " To settle the cause" : " To see whether that holds elsewhere") +
                    (", record another motion (" + other_motion(d) + ") and diagnose again with that.")
              : "");
}

std::string next_line(const CardFacts& f, const Card& card, bool whole) {
  if (card.good_enough && *card.good_enough) return "None: this is within your tolerance.";
  if (f.diagnosis != nullptr && f.diagnosis->stopped) return "Run `gapscope diagnose CONFIG` to its end.";
  if (std::string gap = f.diagnosis != nullptr ? step_to_the_gap(f) : ""; !gap.empty()) return gap;
  if (std::string step = step_of_the_answer(f); !step.empty()) return step;
  if (f.diagnosis == nullptr)
    return f.answer != nullptr && f.answer->trust == AnswerTrust::kGood
               ? "Nothing more for the gap; `gapscope diagnose CONFIG` tells where the model and the drive "
                 "differ, and why."
               : "Run `gapscope diagnose CONFIG`: it tells where the model and the drive differ, and why.";
  const Diagnosis& d = *f.diagnosis;
  const bool unknown = d.verdict == DiagnosisVerdict::kUnknown;
  if (!d.held.empty() && (unknown || d.verdict == DiagnosisVerdict::kHelps)) return step_to_estimate(d);
  if (unknown && d.better_swapped) return kSwapStep;  // which takes no new recording
  if (std::string onwards = is_added(d) ? step_onwards(d) : ""; !onwards.empty()) return onwards;
  const bool separates = d.next_experiment.separates(),
             idle = are_one_law(d.group, d) || (unknown && d.next_experiment.proposes());
  if (const std::string& told = d.next_experiment.sentence; !told.empty() && (separates || !idle))
    return whole || separates ? told : without_asides(told);
  if (is_added(d)) return step_of_the_model(f, card, whole);
  if (d.verdict == DiagnosisVerdict::kNone) return next_of_numbers(f);
  return step_to_establish(f, card);
}

void measure(const CardFacts& f, Card& card) {
  if (f.diagnosis == nullptr) return;
  const MismatchSize& m = f.diagnosis->mismatch;
  if (!is_told_in_torque(*f.diagnosis)) {  // the balance still tells what the model as it is lacks
    const ErrorBudget& b = f.diagnosis->budget;
    if (b.exists()) card.torque = b.nominal, card.percent = 100.0 * b.nominal / b.input;
    return;
  }
  card.torque = m.before_torque, card.torque_after = m.after_torque;
  card.percent = 100.0 * card.torque / m.input_torque;
  card.percent_after = 100.0 * card.torque_after / m.input_torque;
}

}  // namespace

void Tolerance::fields(FieldVisitor& v) {
  v.field({"torque_percent", "%", "rms of the torque that the model misses, of what the input applies", 1e-6,
           1e3},
          torque_percent);
  v.field({"gap", "rad", "largest backlash gap", 1e-12, 10.0}, gap);
}

std::array<CardLine, 6> Card::lines() const {
  return {{{"gap", brief.gap, gap},
           {"model error", brief.mismatch, mismatch},
           {"where", brief.place, place},
           {"cause", brief.cause, cause},
           {"helps", brief.helps, helps},
           {"next", brief.next, next}}};
}

Card card_of(const CardFacts& f) {
  Card card;
  card.diagnosed = f.diagnosis != nullptr;
  measure(f, card);
  card.good_enough = good_enough(f, card);
  card.gap = gap_line(f);
  card.mismatch = mismatch_words(f, card) + torque_verdict(f, card);
  card.place = place_line(f);
  card.cause = cause_line(f);
  card.helps = helps_line(f, card);
  card.next = next_line(f, card, true) + also_refitted(f);
  const std::string size = mismatch_size(f, card);
  card.brief = {brief_gap(f),
                (card.diagnosed ? without_asides(size) : size) + torque_verdict(f, card),
                card.place,
                brief_cause(f),
                brief_helps(f, card),
                f.diagnosis == nullptr
                    ? first_clause(card.next, card.next.starts_with("Nothing") ? ".;" : ".")
                    : next_line(f, card, false)};
  return card;
}

}  // namespace gapscope

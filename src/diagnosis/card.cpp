#include "gapscope/diagnosis/card.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "diagnosis/card_cause.h"
#include "diagnosis/card_numbers.h"
#include "diagnosis/card_open.h"
#include "diagnosis/card_words.h"
#include "diagnosis/rule.h"
#include "diagnosis/words.h"
#include "gapscope/base/text.h"
#include "gapscope/diagnosis/answer.h"
#include "gapscope/diagnosis/diagnosis.h"

namespace gapscope {
namespace {

using internal::diagnosis::also_refitted;
using internal::diagnosis::as_sentence;
using internal::diagnosis::cause_line;
using internal::diagnosis::exhausted_words;
using internal::diagnosis::export_words;
using internal::diagnosis::gap_not_estimated;
using internal::diagnosis::helps_line;
using internal::diagnosis::kRule;
using internal::diagnosis::kSwapStep;
using internal::diagnosis::kToldByDiagnose;
using internal::diagnosis::motion_error;
using internal::diagnosis::next_of_numbers;
using internal::diagnosis::percent_text;
using internal::diagnosis::SharedUnit;
using internal::diagnosis::step_to_establish;
using internal::diagnosis::step_to_estimate;
using internal::diagnosis::unexplained;
using internal::diagnosis::what_applies;
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

std::string gap_line(const CardFacts& f) {
  if (f.answer == nullptr) return gap_not_estimated(f.diagnosis, f.coordinates);
  const bool known = f.answer->trust != AnswerTrust::kNone, measured = !known && f.lost_motion;
  const bool beside = known && f.answer->from == AnswerSource::kModelFree && f.reference != nullptr &&
                      f.reference->rejected();  // whose reason stands between the reading and the trust
  return as_sentence(known || measured ? f.answer->sentence : without_asides(f.answer->sentence)) +
         (measured ? " Trust in a gap: "
          : beside ? " Trust in that reading: "
                   : " Trust: ") +
         to_string(f.answer->trust) + (measured ? "; the lost motion is measured." : ".") + gap_verdict(f);
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

/// What is left of the motion that the fit follows, where nobody has diagnosed it.
std::string fitted_line(const CardFacts& f) {
  if (f.reference == nullptr || std::isnan(f.reference->fit_percent))
    return "Not measured, as no model was fitted.";
  return fmt::format("A free run of the fitted model fits the motion to {:.4g} % (100 % is exact){}.",
                     f.reference->fit_percent, f.reference->rejected() ? "; the model is rejected" : "");
}

/// "The model misses 9.66 N rms of force on held-out data, 17.1 % of the 56.5 N rms that the input applies"
std::string torque_size(const CardFacts& f, const Card& card) {
  const MismatchSize& m = f.diagnosis->mismatch;
  const SharedUnit torque(card.torque, f.coordinates.shown_unit("N m"));
  std::string text = fmt::format("The model misses {} rms of {} on held-out data", torque(card.torque),
                                 f.coordinates.torque_word());
  if (std::isfinite(card.percent))
    text += fmt::format(", {} the {} rms that the {} applies",
                        card.torque < 2.0 * m.input_torque ? percent_text(card.percent) + " of"
                                                           : fmt::format("{:.2g} times", 0.01 * card.percent),
                        SharedUnit(m.input_torque, f.coordinates.shown_unit("N m"))(m.input_torque),
                        what_applies(*f.diagnosis));
  return text;
}

std::string error_size(const CardFacts& f) {
  const MismatchSize& m = f.diagnosis->mismatch;
  if (!std::isfinite(m.before)) return "The model misses the held-out motion altogether";
  return "The model misses " + SharedUnit(m.before, f.coordinates.position_unit())(m.before) +
         " of the held-out motion (" + m.measure + ")";
}

/// "; no model gets below 0.61 N, which is the encoder's noise": in the unit of the size, so that a diagnosis
/// that goes on from another is measured by the same. Empty where no floor in torque is known. Recordings may
/// disagree by more than a model leaves of those held out: that is no bound. What does not come back holds
/// the encoder's noise: it is the drive's where it is clearly more.
std::string torque_floor(const CardFacts& f, const Card& card) {
  const ErrorBudget& b = f.diagnosis->budget;
  const double floor = b.exists() ? b.floor() : kNaN;
  if (f.diagnosis->verdict == DiagnosisVerdict::kNone || !(floor > 0.0 && floor < card.torque)) return "";
  if (card.torque_after < floor && !(b.records >= floor)) return "";  // a model has got below
  if (b.records >= floor && !b.uncounted.empty()) return "";  // what the balance lacks makes them disagree
  const std::string size = SharedUnit(card.torque, f.coordinates.shown_unit("N m"))(floor);
  if (b.records >= floor)
    return "; " + size + " of this differs between the recordings (or parts of one), so no model removes it";
  return "; no model can get below " + size +
         (b.repeatability >= floor && !(b.repeatability < kRule.floor_ratio * b.encoder)
              ? ", by which the drive does not repeat itself"
              : ", the encoder's noise");
}

/// Of a model that nothing is missing of: that what is left is no more than the encoder's noise, or than the
/// drive's own repetition.
std::string floor_words(const CardFacts& f, const Card& card) {
  if (const std::string words = torque_floor(f, card); !words.empty()) return words;
  const MismatchSize& m = f.diagnosis->mismatch;
  if (f.diagnosis->verdict != DiagnosisVerdict::kNone || !(m.before > 0.0 && m.floor > 0.0)) return "";
  return fmt::format("; that is noise: the error of the simulated motion is {} times {}",
                     SharedUnit(1.0, "").number(m.before / m.floor),
                     m.floor_from == FloorSource::kRepeatability ? "that by which the drive repeats itself"
                                                                 : "the encoder's own");
}

std::string additions_below(const CardFacts& f) {
  return f.diagnosis->added.size() > 1 ? "; with the additions below, " : "; with the addition below, ";
}

/// " With its controller in the loop the model is 392 mrad rms off in position; with the additions below, it
/// is 56 mrad off."
std::string closed_loop_words(const CardFacts& f) {
  if (!f.diagnosis->closed_loop) return "";
  const ClosedLoop& c = *f.diagnosis->closed_loop;
  const SharedUnit position(std::isfinite(c.before) ? c.before : c.after, f.coordinates.position_unit());
  const auto is = [&](double error) {
    return std::isfinite(error) ? "is " + position(error) + " rms off in position" : std::string("runs away");
  };
  return fmt::format(" With its controller in the loop the model {}{}.", is(c.before),
                     is_added(*f.diagnosis) ? additions_below(f) + "it " + is(c.after) : "");
}

/// " Simulated freely from the first sample on, the model drifts up to 407 mrad from the held-out motion,
/// whose travel is 876 mrad; with the additions below, up to 41 mrad." Under its controller a drive is judged
/// by that.
std::string whole_run_words(const CardFacts& f) {
  const Diagnosis& d = *f.diagnosis;
  if (!d.whole_run || d.closed_loop) return "";
  const WholeRun& w = *d.whole_run;
  const bool stays = std::isfinite(w.before), stays_after = std::isfinite(w.after);
  const auto position = [&](double size) { return SharedUnit(size, f.coordinates.position_unit())(size); };
  const std::string of = " from the held-out motion, whose travel is " + position(w.travel);
  std::string text = " Simulated freely from the first sample on, the model " +
                     (stays ? "drifts up to " + position(w.before) + of : "runs away");
  if (!is_added(d)) return text + ".";
  text += additions_below(f);
  if (!stays_after) return text + "it runs away.";
  const bool grows = w.after > w.before && d.mismatch.after < d.mismatch.before;
  return text + (stays ? "up to " + position(w.after) : "it drifts up to " + position(w.after) + of) +
         (grows ? ": over so long a run the smallest errors grow." : ".");
}

std::string mismatch_line(const CardFacts& f, const Card& card) {
  if (f.diagnosis == nullptr) return fitted_line(f) + torque_verdict(f, card);
  const bool torque = std::isfinite(card.torque);
  return (torque ? torque_size(f, card) : error_size(f)) + floor_words(f, card) + "." +
         (torque && f.constant_guessed ? " Its unit rests on torque_constant, a guess." : "") +
         whole_run_words(f) + closed_loop_words(f) + torque_verdict(f, card);
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

/// Where effects were added: to use them, unless too much is left.
std::string step_of_the_model(const CardFacts& f, const Card& card) {
  if (std::string left = unexplained(f, card); !left.empty()) return left;
  const Diagnosis& d = *f.diagnosis;
  const bool open = std::ranges::any_of(d.added, [](const AddedEffect& a) { return !a.established; });
  return std::string("Simulate with `DIR/fitted.yaml`") +
         (!open                ? ""
          : d.added.size() > 1 ? ", which predicts best with all of these, established or not"
                               : ", which predicts better with it, established or not") +
         "; " + export_words(f) +
         (d.verdict == DiagnosisVerdict::kHelps
              ? " To settle the cause, record another motion (other speeds, other loads) and hold that out."
              : "");
}

std::string next_line(const CardFacts& f, const Card& card) {
  if (card.good_enough && *card.good_enough) return "None: this is within your tolerance.";
  const std::string step = step_of_the_answer(f);
  if (!step.empty()) return step;
  if (f.diagnosis == nullptr)
    return "Run `gapscope diagnose CONFIG`: it tells where the model and the drive differ, and why.";
  const Diagnosis& d = *f.diagnosis;
  if (d.stopped) return "Run `gapscope diagnose CONFIG` to its end.";
  const bool unknown = d.verdict == DiagnosisVerdict::kUnknown;
  if (!d.held.empty() && (unknown || d.verdict == DiagnosisVerdict::kHelps)) return step_to_estimate(d);
  if (unknown && d.better_swapped) return kSwapStep;  // which takes no new recording
  if (is_added(d) && !exhausted_words(d).empty())
    return "Go on from what was found: `gapscope diagnose CONFIG --model-from DIR/fitted.yaml`.";
  if (!d.next_experiment.sentence.empty()) return d.next_experiment.sentence;
  if (is_added(d)) return step_of_the_model(f, card);
  if (d.verdict == DiagnosisVerdict::kNone) return next_of_numbers(f);
  return step_to_establish(d);
}

void measure(const CardFacts& f, Card& card) {
  if (f.diagnosis == nullptr) return;
  const MismatchSize& m = f.diagnosis->mismatch;
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
  return {{{"gap", gap},
           {"model error", mismatch},
           {"where", place},
           {"cause", cause},
           {"helps", helps},
           {"next", next}}};
}

Card card_of(const CardFacts& f) {
  Card card;
  card.diagnosed = f.diagnosis != nullptr;
  measure(f, card);
  card.good_enough = good_enough(f, card);
  card.gap = gap_line(f);
  card.mismatch = mismatch_line(f, card);
  card.place = place_line(f);
  card.cause = cause_line(f);
  card.helps = helps_line(f, card);
  card.next = next_line(f, card) + also_refitted(f);
  return card;
}

}  // namespace gapscope

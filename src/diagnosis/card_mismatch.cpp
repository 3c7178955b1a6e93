#include "diagnosis/card_mismatch.h"

#include <fmt/format.h>

#include <cmath>

#include "diagnosis/card_numbers.h"
#include "diagnosis/card_open.h"
#include "diagnosis/card_words.h"
#include "diagnosis/rule.h"
#include "gapscope/base/text.h"
#include "gapscope/diagnosis/diagnosis.h"

namespace gapscope::internal::diagnosis {
namespace {

/// What is left of the motion that the fit follows, where nobody has diagnosed it.
std::string fit_of_motion(const CardFacts& f) {
  if (f.reference == nullptr || std::isnan(f.reference->fit_percent))
    return "Not measured, as no model was fitted.";
  const double percent = f.reference->fit_percent;
  const char* const rejected =
      percent > 0.0 ? "; the model is rejected all the same" : "; the model is rejected";
  return fmt::format("A free run of the fitted model {} {:.4g} % (100 % is exact){}.",
                     percent > 0.0 ? "fits the motion to" : "departs from the motion: fit", percent,
                     f.reference->rejected() ? rejected : "");
}

/// "The model", "With nothing added, the refitted model, which has motor Coulomb friction,".
std::string model_words(const Diagnosis& d) {
  const std::string before = d.added.empty() ? "The " : "With nothing added, the ";
  const std::string model = before + (d.refitted.empty() ? "model" : "refitted model");
  std::vector<std::string> names;
  for (const std::string& effect : d.modelled) names.push_back(readable(effect));
  return names.empty() ? model : model + ", which has " + enumerated(names) + ",";
}

/// "The model misses 9.66 N rms of force on held-out data, 17.1 % of the 56.5 N rms that the input applies"
std::string torque_size(const CardFacts& f, const Card& card) {
  const SharedUnit torque(card.torque, f.coordinates.shown_unit("N m"));
  std::string text = fmt::format("{} misses {} rms of {} on held-out data", model_words(*f.diagnosis),
                                 torque(card.torque), f.coordinates.torque_word());
  const double input = 100.0 * card.torque / card.percent;
  if (std::isfinite(card.percent))
    text +=
        fmt::format(", {} the {} rms that the {}",
                    card.percent < 200.0 ? percent_text(card.percent) + " of"
                                         : fmt::format("{:.2g} times", 0.01 * card.percent),
                    SharedUnit(input, f.coordinates.shown_unit("N m"))(input), what_applies(*f.diagnosis));
  return text;
}

std::string error_size(const CardFacts& f) {
  const MismatchSize& m = f.diagnosis->mismatch;
  if (!std::isfinite(m.before)) return model_words(*f.diagnosis) + " misses the held-out motion altogether";
  return model_words(*f.diagnosis) + " misses " +
         SharedUnit(m.before, f.coordinates.position_unit())(m.before) + " of the held-out motion (" +
         m.measure + ")";
}

/// What the encoder's noise alone makes an observer correct [N m]; NaN: not told.
double correction_floor(const Diagnosis& d) {
  const auto row = std::ranges::find_if(
      d.measures, [](const MismatchMeasure& m) { return m.name.starts_with("residual "); });
  return row == d.measures.end() ? kNaN : row->floor;
}

/// "; no model gets below 0.61 N, which is the encoder's noise": in the unit of the size, so that a diagnosis
/// that goes on from another is measured by the same. Empty where no floor in torque is known. Recordings may
/// disagree by more than a model leaves of those held out: that is no bound. What does not come back holds
/// the encoder's noise: it is the drive's where it is clearly more.
std::string torque_floor(const CardFacts& f, const Card& card) {
  const ErrorBudget& b = f.diagnosis->budget;
  const double floor = !b.exists() ? correction_floor(*f.diagnosis) : b.uncounted.empty() ? b.floor() : kNaN;
  if (f.diagnosis->verdict == DiagnosisVerdict::kNone || !(floor > 0.0 && floor < card.torque)) return "";
  if (card.torque_after < floor && !(b.records >= floor)) return "";  // a model has got below
  const std::string size = SharedUnit(card.torque, f.coordinates.shown_unit("N m"))(floor);
  if (b.records >= floor)
    return fmt::format("; {} disagree by {} of this: no one set of numbers removes it",
                       what_disagrees(*f.diagnosis), size);
  if (is_of_the_drive(b))
    return "; no model can get below " + size + ", by which the drive itself differs from period to period";
  return "; the encoder's noise alone looks like " + size + ", below which no model can get";
}

/// Whether nothing is missing, and what is left is noise.
bool is_noise(const Diagnosis& d) {
  return d.verdict == DiagnosisVerdict::kNone && d.mismatch.before > 0.0 && d.mismatch.floor > 0.0;
}

/// Of a model that nothing is missing of: that what is left is no more than the encoder's noise, or than the
/// drive's own repetition.
std::string floor_words(const CardFacts& f, const Card& card) {
  if (const std::string words = torque_floor(f, card); !words.empty()) return words;
  const MismatchSize& m = f.diagnosis->mismatch;
  if (!is_noise(*f.diagnosis)) return "";
  const SharedUnit motion(m.floor, f.coordinates.position_unit());
  return fmt::format(
      "; that is noise: the simulated motion is {} rms off, {} {} (up to {} times as much counts "
      "as noise)",
      motion(m.before),
      m.floor_from == FloorSource::kRepeatability ? "the drive itself differs from period to period by"
                                                  : "the encoder's noise alone makes",
      motion(m.floor), kRule.floor_ratio);
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
  const bool travels =
      std::isfinite(c.before) && f.diagnosis->whole_run && std::isfinite(f.diagnosis->whole_run->travel);
  const double travel = travels ? f.diagnosis->whole_run->travel : kNaN;
  return fmt::format(
      " With its controller in the loop the model {}{}{}.", is(c.before),
      travels ? " (the travel is " + SharedUnit(travel, f.coordinates.position_unit())(travel) + ")" : "",
      !f.diagnosis->added.empty() ? additions_below(f) + "it " + is(c.after) : "");
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
  const double drift = std::isfinite(w.before) ? w.before : w.after;
  const bool alike = drift > kTelling.whole_run_drift * w.travel;  // in one unit
  const std::string of = " from the held-out motion, whose travel is " +
                         SharedUnit(alike ? drift : w.travel, f.coordinates.position_unit())(w.travel);
  std::string text = " Simulated freely from the first sample on, the model " +
                     (stays ? "drifts up to " + position(w.before) + of : "runs away");
  if (d.added.empty()) return text + ".";
  text += additions_below(f);
  if (!stays_after) return text + "it runs away.";
  const bool grows =
      w.after > kRule.floor_ratio * w.before && d.mismatch.after < d.mismatch.before && !drifts_farther(d);
  return text + (stays ? "up to " + position(w.after) : "it drifts up to " + position(w.after) + of) +
         (grows ? ": over so long a run the smallest errors grow." : ".");
}

/// " As configured the simulated motion is 323 mrad off, refitted it is 17 mrad off, with the addition
/// 7.09 mrad (free run restarted every 0.5 s, ...)."
std::string as_configured_words(const CardFacts& f) {
  const Diagnosis& d = *f.diagnosis;
  const MismatchSize& m = d.mismatch;
  if (!d.as_configured || d.refitted.empty() || d.stopped || !std::isfinite(m.before)) return "";
  const double given = d.as_configured->error;
  if (given <= kRule.floor_ratio * m.before) return "";
  const auto position = [&](double size) { return SharedUnit(size, f.coordinates.position_unit())(size); };
  return fmt::format(
      " As configured the {} {}, refitted it is {} off{} ({}).",
      m.measure.starts_with("prediction") ? "predicted motion" : "simulated motion",
      std::isfinite(given) ? "is " + position(given) + " off" : "runs away", position(m.before),
      d.added.empty()
          ? ""
          : fmt::format(", with the addition{} {}", d.added.size() > 1 ? "s" : "", position(m.after)),
      m.measure);
}

std::string size_words(const CardFacts& f, const Card& card, const std::string& floor) {
  const bool torque = std::isfinite(card.torque);
  return (torque ? torque_size(f, card) : error_size(f)) + floor + "." +
         (torque && f.constant_guessed
              ? " All torques here rest on torque_constant, a guess; percentages do not."
              : "") +
         as_configured_words(f);
}

}  // namespace

std::string mismatch_words(const CardFacts& f, const Card& card) {
  return f.diagnosis == nullptr
             ? fit_of_motion(f)
             : size_words(f, card, floor_words(f, card)) + whole_run_words(f) + closed_loop_words(f);
}

std::string mismatch_size(const CardFacts& f, const Card& card) {
  if (f.diagnosis == nullptr) return fit_of_motion(f);
  return size_words(f, card, is_noise(*f.diagnosis) ? ", which is noise" : "");
}

}  // namespace gapscope::internal::diagnosis

#include "gapscope/diagnosis/answer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "diagnosis/card_words.h"
#include "diagnosis/remedies.h"
#include "gapscope/base/decimals.h"

namespace gapscope {
namespace {
using internal::diagnosis::kNoBacklash;
using internal::diagnosis::remedies;
using internal::diagnosis::the_gap_is;

/// The fit ends with the gap closed, and without a model none is seen either.
bool none_by_both(const Findings& f) {
  return f.reference != nullptr && f.reference->closes_gap() && f.model_free != nullptr &&
         f.model_free->verdict == GapVerdict::kNone;
}

/// The gap that the reference tells; nullptr where it tells none, or is rejected.
const FittedParameter* told_gap(const Findings& f) {
  if (f.reference == nullptr || f.reference->rejected()) return nullptr;
  const FittedParameter* gap = f.reference->find("gap");
  const bool told = gap != nullptr && gap->estimated && gap->identifiable && std::isfinite(gap->ci95.low);
  return told ? gap : nullptr;
}

bool is_good(const Findings& f) { return f.reference->trust == FitTrust::kGood; }

double width(const Interval& i) { return i.high - i.low; }

/// "18.96 mrad (95 %: 18.79 to 19.13)": two digits of the half width.
std::string with_interval(double value, const Interval& ci95, Coordinates c) {
  const double half = 1e3 * width(ci95) / 2.0;
  if (!(half > 0.0)) return c.thousandths(value);
  const int d = static_cast<int>(std::clamp(1.0 - std::floor(std::log10(half)), 0.0, 6.0));
  return fmt::format("{} m{} (95 %: {} to {})", with_decimals(1e3 * value, d), c.position_unit(),
                     with_decimals(1e3 * ci95.low, d), with_decimals(1e3 * ci95.high, d));
}

/// Without its full stop.
std::string clause(const Remark& remark) {
  std::string text = remark.text();
  if (text.ends_with(".")) text.pop_back();
  return text;
}

Answer from_model_free(const Findings& f, AnswerTrust trust) {
  const GapEstimate& g = *f.model_free;
  Answer a{g.gap, g.ci95, AnswerSource::kModelFree, trust, "", {}};
  a.sentence = the_gap_is() + with_interval(g.gap, g.ci95, f.coordinates) + ", measured without a model";
  if (g.method == GapMethod::kLiteral)
    a.sentence +=
        fmt::format(", by S1 to S6 of the source paper with L = {:.3g} {}, whose passages scatter by {}",
                    g.bound, f.coordinates.shown_unit("rad/s^2"), f.coordinates.thousandths(g.std));
  if (g.method == GapMethod::kPaper)
    a.sentence += fmt::format(", with the bound that was given (L = {:.3g} {})", g.bound,
                              f.coordinates.shown_unit("rad/s^2"));
  return a;
}

Answer from_reference(const Findings& f, const FittedParameter& gap, AnswerTrust trust) {
  Answer a{gap.value, f.reference->shown_interval(gap), AnswerSource::kReference, trust, "", {}};
  a.sentence = the_gap_is() + with_interval(gap.value, a.ci95, f.coordinates) + " by the fitted model";
  return a;
}

/// Of a reading by itself: what its own recordings bear out.
AnswerTrust trust_in(const GapEstimate& reading) {
  return reading.trust == GapTrust::kGood ? AnswerTrust::kGood : AnswerTrust::kLimited;
}

Answer agreed(const Findings& f, const FittedParameter& gap) {
  const bool sharper = is_good(f) && width(gap.ci95) < width(f.model_free->ci95);
  const AnswerTrust trust = is_good(f) ? AnswerTrust::kGood : trust_in(*f.model_free);
  Answer a = sharper ? from_reference(f, gap, trust) : from_model_free(f, trust);
  a.codes = {sharper ? "gap.reference" : "gap.model_free",
             sharper ? "gap.model_free.agrees" : "gap.reference.agrees"};
  a.sentence += sharper ? ", and the model-free reading agrees." : ", and the fitted model agrees.";
  return a;
}

Answer contradicted(const Findings& f, const FittedParameter& gap) {
  const GapEstimate& g = *f.model_free;
  const bool model = is_good(f);
  Answer a =
      model ? from_reference(f, gap, AnswerTrust::kLimited) : from_model_free(f, AnswerTrust::kLimited);
  a.codes = {model ? "gap.reference" : "gap.model_free",
             model ? "gap.model_free.contradicts" : "gap.reference.contradicts"};
  a.sentence += model ? ", but without a model it reads " + with_interval(g.gap, g.ci95, f.coordinates) + "."
                      : ", but the fitted model says " +
                            with_interval(gap.value, f.reference->shown_interval(gap), f.coordinates) + ".";
  return a;
}

/// Ends a sentence that goes without the reference.
std::string end_without_model(const Findings& f) {
  if (f.reference == nullptr || !f.reference->rejected()) return ".";
  return "; the fitted model is rejected. " + f.reference->why.text();
}

/// The paper's steps claim no interval, so a fit that tells one comes first.
Answer as_printed(const Findings& f, const FittedParameter* gap) {
  Answer reading = from_model_free(f, AnswerTrust::kLimited);
  if (gap == nullptr) {
    reading.sentence += end_without_model(f);
    return reading;
  }
  Answer a = from_reference(f, *gap, is_good(f) ? AnswerTrust::kGood : AnswerTrust::kLimited);
  a.sentence += "; S1 to S6 of the source paper read " + f.coordinates.thousandths(f.model_free->gap) + ".";
  return a;
}

Answer read(const Findings& f) {
  const FittedParameter* gap = told_gap(f);
  if (f.model_free->method == GapMethod::kLiteral) return as_printed(f, gap);
  if (gap != nullptr && f.agree) return *f.agree ? agreed(f, *gap) : contradicted(f, *gap);
  const bool rejected = f.reference != nullptr && f.reference->rejected();
  Answer a = from_model_free(f, rejected ? AnswerTrust::kLimited : trust_in(*f.model_free));
  a.codes = {"gap.model_free", rejected ? "reference.rejected" : "reference.tells_none"};
  a.sentence += end_without_model(f);
  return a;
}

/// "191.1 mrad (11 % of the travel)".
std::string least_denied(const Findings& f) {
  const double limit = f.model_free->none_above();
  const std::string least = f.coordinates.thousandths(limit);
  return f.travel > 0.0 ? fmt::format("{} ({:.2g} % of the travel)", least, 100.0 * limit / f.travel) : least;
}

Answer denied(const Findings& f) {
  const double limit = f.model_free->none_above();
  const std::string least = least_denied(f);
  Answer a{kNaN, {}, AnswerSource::kModelFree, AnswerTrust::kLimited, "", {}};
  const FittedParameter* gap = told_gap(f);
  if (none_by_both(f)) {
    a.sentence = kNoBacklash + least + ", and the fitted model closes the gap: none by both.";
    a.trust = AnswerTrust::kGood;
    a.codes = {"none.model_free", "none.reference.agrees"};
  } else if (gap == nullptr) {
    a.codes = {"none.model_free"};
    a.sentence = kNoBacklash + least + end_without_model(f);
  } else if (gap->ci95.low > limit) {
    a.codes = {"none.model_free", "gap.reference.contradicts"};
    a.sentence = "Without a model there is no backlash above " + least + ", but the fitted model says " +
                 with_interval(gap->value, f.reference->shown_interval(*gap), f.coordinates) + ".";
  } else {
    a = from_reference(f, *gap, is_good(f) ? AnswerTrust::kGood : AnswerTrust::kLimited);
    a.codes = {"gap.reference", "none.model_free.agrees"};
    a.sentence += "; without a model none above " + least + " is seen, which agrees.";
  }
  return a;
}

/// What was measured of the loop, then what it means; empty where no loop is read.
std::string lost_motion(const Findings& f) {
  if (f.model_free == nullptr || !f.model_free->lost_motion.read()) return "";
  const LostMotion& l = f.model_free->lost_motion;
  const Interval range = l.range();
  const bool alike = !(range.high > range.low);
  std::string text = "The lost motion at zero torque is " +
                     (alike ? with_interval(l.value, l.ci95, f.coordinates)
                            : f.coordinates.thousandths(range.low) + " to " +
                                  f.coordinates.thousandths(range.high) + ", by torque level");
  if (std::isfinite(l.gap_limit)) text += "; the gap is at most " + f.coordinates.thousandths(l.gap_limit);
  switch (l.cause) {
    case LostMotionCause::kGap:
      return text + ". The lost motion is mostly a gap.";
    case LostMotionCause::kFriction:
      return text + ". The lost motion is friction and compliance.";
    default:
      return text + ". Whether a gap or friction and compliance make it up cannot be told here.";
  }
}

/// Lost motion is no gap: the reader gets its limit in words.
Answer play(const Findings& f) {
  const std::string value = with_interval(f.model_free->gap, f.model_free->ci95, f.coordinates);
  Answer a{kNaN, {}, AnswerSource::kModelFree, AnswerTrust::kLimited, "", {}};
  a.sentence = std::string(internal::diagnosis::kThePlay) + kWhichGap + " is " + value +
               ", without a model; friction and compliance contribute to it, so the gap is at most that.";
  a.codes = {"play.model_free"};
  const FittedParameter* gap = told_gap(f);
  if (gap == nullptr || gap->value > f.model_free->ci95.high) return a;
  Answer model = from_reference(f, *gap, is_good(f) ? AnswerTrust::kGood : AnswerTrust::kLimited);
  model.sentence += ". " + a.sentence;
  model.codes = {"gap.reference", "play.model_free.agrees"};
  return model;
}

/// Why the reference tells no gap.
std::string no_number(const FitSummary& fit) {
  const FittedParameter* gap = fit.find("gap");
  const std::string why = (fit.rejected() ? "The fitted model is rejected: " : "") + fit.why.text();
  if (gap == nullptr) return "Backlash is not examined, as the model is a single body. " + why;
  if (fit.rejected()) return why;
  return gap->estimated ? why : "The model took the gap as known. " + why;
}

bool rejects(const Findings& f) { return f.reference && f.reference->rejected() && f.reference->find("gap"); }

Answer by_model_alone(const Findings& f) {
  Answer a;
  if (const FittedParameter* gap = told_gap(f)) {
    a = from_reference(f, *gap, is_good(f) ? AnswerTrust::kGood : AnswerTrust::kLimited);
    a.sentence += ". " + f.reference->why.text();
    a.codes = {"gap.reference", "model_free.inconclusive"};
    return a;
  }
  const std::string loop = lost_motion(f);
  if (!loop.empty())
    a.sentence = loop;
  else if (f.model_free != nullptr)
    a.sentence =
        fmt::format("The gap is not known: {}without a model the recording is inconclusive ({}).",
                    rejects(f) ? "the fitted model is rejected, and " : "", clause(f.model_free->reason));
  else if (rejects(f))
    a.sentence = "The gap is not known.";
  if (f.reference != nullptr) a.sentence += (a.sentence.empty() ? "" : " ") + no_number(*f.reference);
  if (a.sentence.empty()) a.sentence = "Nothing was estimated.";
  a.codes = {loop.empty() ? "gap.not_known" : "lost_motion"};
  return a;
}

/// Where the detector reads a gap, or the model is far from the drive, no remedy is a model without one.
bool may_have_gap(const Findings& f) {
  if (f.reference->innovation_rmse > FitOptions{}.rejected_ratio * f.reference->floor) return true;
  return f.model_free != nullptr && f.model_free->verdict == GapVerdict::kBacklash &&
         f.model_free->quantity == GapQuantity::kGap;
}

/// What a reason that says what to change has behind its colon; empty for others.
std::string advice_in(const Remark& reason) {
  const bool bank = reason.codes().find("nothing_reads") != std::string::npos;
  if (reason.code() != "gap_uncertain" && reason.code() != "few_passages" && !bank) return "";
  const std::string text = clause(reason);
  const std::size_t colon = bank ? text.rfind(": ") : text.find(": ");
  return colon == std::string::npos ? "" : "For a reading without a model: " + text.substr(colon + 2) + ".";
}

std::string step_without_model(const GapEstimate& g) {
  const bool open = g.verdict == GapVerdict::kInconclusive, loop = g.lost_motion.read();
  if (open && g.reason.code() == "locked_with_bound")
    return "Set detector: bound to auto: it reads the lost-motion loop, a given bound reads impacts alone.";
  if (g.reason.code() == "passages_as_printed" && open)
    return "Try another bound, a lower one where e_x shows impacts alone, or detector: {bound: auto}.";
  if (g.reason.code() == "encoder_on_load")
    return "For a gap by a model alone: `gapscope init` with --model gap, then `gapscope fit`.";
  const auto says = [&](const char* code) { return g.reason.codes().find(code) != std::string::npos; };
  if (open && (says("bounds_to_try") || says("bound_to_try")))
    return "Set detector: bound as the reason says, or to auto, which reads with a bank of bounds.";
  if (open && says("auto_reads")) return "Set detector: bound to auto, which reads this recording.";
  for (const char* slow : {"too_slow", "only_large_gaps", "no_impact_stands_out"})
    if (open && !loop && g.reason.code() == slow)
      return "For a reading without a model: a faster motion, a finer encoder or faster sampling, the "
             "output free.";
  if (const std::string told = advice_in(g.reason); open && !loop && !told.empty()) return told;
  if (open && !loop)
    return "For a reading without a model, record seven periods or more of a triangle or a sine with a dwell "
           "at the reversals, the output free.";
  const std::size_t levels = g.lost_motion.levels.size();
  if (open && levels > 1)
    return fmt::format(
        "The recording has {} torque levels already, and the smallest bounds the gap: ramps at half of it "
        "would bring that limit down, as wind-up shrinks with the torque.",
        levels);
  if (open ||
      (levels < 2 && g.verdict == GapVerdict::kBacklash && g.quantity == GapQuantity::kPlayAtZeroTorque))
    return "Repeat the ramps at half and at twice the torque: the part of the lost motion that grows with it "
           "is no gap.";
  return "";
}

/// Where the configuration holds a gap that the reading without a model excludes, and no good fit bears out.
std::string step_of_held_gap(const Findings& f) {
  const FittedParameter* gap = f.reference == nullptr ? nullptr : f.reference->find("gap");
  if (gap == nullptr || gap->estimated || f.model_free == nullptr || is_good(f)) return "";
  const GapEstimate& g = *f.model_free;
  if (g.verdict != GapVerdict::kBacklash || g.quantity != GapQuantity::kGap) return "";
  if (std::isnan(g.ci95.low) || (g.ci95.low <= gap->value && gap->value <= g.ci95.high)) return "";
  return fmt::format(
      "Let the fit find the gap (gap: {{estimate: true}}): the configuration holds it at {}, and without a "
      "model it reads {}.",
      f.coordinates.thousandths(gap->value), with_interval(g.gap, g.ci95, f.coordinates));
}

/// Three at most, the most telling first.
std::vector<std::string> steps(const Findings& f) {
  std::vector<std::string> next;
  const auto add = [&](const std::string& step) {
    if (!step.empty()) next.push_back(step);
  };
  add(step_of_held_gap(f));
  if (f.reference != nullptr && f.reference->rejected() &&
      f.reference->innovation_rmse >= f.reference->coasting_rmse)
    add("Check the sign and the unit of u (`gapscope check`): a motor without torque would predict this "
        "motion better.");
  if (f.agree && !*f.agree)
    add("Record once more at another amplitude or frequency: the estimate that stays is the one to believe.");
  if (f.reference != nullptr && !none_by_both(f)) {
    const auto found = remedies().find(f.reference->why.code());
    const bool denies = found != remedies().end() && found->second == remedies().at("gap_at_bound");
    if (found != remedies().end())
      add(denies && may_have_gap(f) ? remedies().at("above_floor") : found->second);
  }
  if (f.model_free != nullptr) add(step_without_model(*f.model_free));
  next.resize(std::min<std::size_t>(next.size(), 3));
  return next;
}

}  // namespace

const char* to_string(AnswerSource source) {
  constexpr const char* kWords[] = {"model_free", "reference", "diagnosis", "none"};
  return kWords[static_cast<int>(source)];
}

const char* to_string(AnswerTrust trust) {
  constexpr const char* kWords[] = {"good", "limited", "none"};
  return kWords[static_cast<int>(trust)];
}

Answer answer_of(const Findings& f) {
  const GapVerdict verdict = f.model_free == nullptr ? GapVerdict::kNotRun : f.model_free->verdict;
  Answer a = verdict == GapVerdict::kNone                               ? denied(f)
             : verdict != GapVerdict::kBacklash                         ? by_model_alone(f)
             : f.model_free->quantity == GapQuantity::kPlayAtZeroTorque ? play(f)
                                                                        : read(f);
  a.next = steps(f);
  if (f.model_free != nullptr) a.gap_at_most = f.model_free->gap_at_most;
  return a;
}

}  // namespace gapscope

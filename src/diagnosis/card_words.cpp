#include "diagnosis/card_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "diagnosis/card_open.h"
#include "diagnosis/rule.h"
#include "gapscope/base/decimals.h"
#include "gapscope/base/text.h"
#include "gapscope/diagnosis/answer.h"

namespace gapscope::internal::diagnosis {

SharedUnit::SharedUnit(double first, const std::string& unit) : unit_(unit.empty() ? "" : " " + unit) {
  static constexpr std::array kPrefixes = {"", "m", "µ", "n"};
  const double size = std::abs(first);
  if (unit.empty() || !(size > 0.0) || !std::isfinite(size) || unit.starts_with("unit"))
    return;  // no "milliunit of u"
  const double thousands = std::clamp(std::ceil(-std::log10(size) / 3.0 - 1e-12), 0.0, 3.0);
  factor_ = std::pow(10.0, 3.0 * thousands);
  unit_ = std::string(" ") + kPrefixes[static_cast<std::size_t>(thousands)] + unit;
}

std::string SharedUnit::number(double value) const {
  const double shown = value * factor_;
  const bool whole = std::abs(shown) >= 999.5;                                  // never "1.2e+03"
  return whole ? with_decimals(shown, 0) : fmt::format("{:.3g}", shown + 0.0);  // no sign of a zero
}

std::string SharedUnit::interval_after(double value, const Interval& ci95, const char* before,
                                       const char* after) const {
  const double half = factor_ * (ci95.high - ci95.low) / 2.0;
  if (!(half > 0.0)) return (*this)(value);
  const int d = static_cast<int>(std::clamp(1.0 - std::floor(std::log10(half)), 0.0, 6.0));
  return fmt::format("{}{}{}95 %: {} to {}{}", with_decimals(factor_ * value, d), unit_, before,
                     with_decimals(factor_ * ci95.low, d), with_decimals(factor_ * ci95.high, d), after);
}

std::string SharedUnit::with_interval(double value, const Interval& ci95) const {
  return interval_after(value, ci95, ", ", "");
}

std::string SharedUnit::with_interval_aside(double value, const Interval& ci95) const {
  return interval_after(value, ci95, " (", ")");
}

bool divides_one_body(const Diagnosis& d) {
  return std::ranges::any_of(d.added, [](const AddedEffect& a) { return a.effect == "backlash"; });
}

std::string the_gap_is() { return std::string("The backlash gap 2β") + kWhichGap + " is "; }

std::string left_open(const Answer& gap) {
  const double share = 0.5 * (gap.ci95.high - gap.ci95.low) / gap.gap;
  return share > kTelling.open_gap
             ? fmt::format(" (these recordings leave it open by {:.0f} %)", 100.0 * share)
             : "";
}

std::string percent_text(double percent) { return fmt::format("{} %", SharedUnit(1.0, "").number(percent)); }

std::string enumerated(const std::vector<std::string>& items, const char* last) {
  std::string text;
  for (std::size_t i = 0; i < items.size(); ++i)
    text += (i == 0 ? "" : i + 1 < items.size() ? ", " : fmt::format(" {} ", last)) + items[i];
  return text;
}

std::string as_sentence(std::string text) {
  if (text.empty()) return text;
  text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
  if (!text.ends_with('.')) text += '.';
  return text;
}

namespace {

/// The words with an aside behind a period that the motion does not go through once.
std::string with_short_travel(std::string what, const Diagnosis& d) {
  constexpr std::string_view kPeriod = "per turn";
  const double turns = d.whole_run ? d.whole_run->travel / (2.0 * kPi) : kNaN;
  const std::size_t at = what.find(kPeriod);
  if (at == what.npos || !(turns * d.where.periods_per_turn < 1.0)) return what;
  return what.insert(at + kPeriod.size(),
                     fmt::format(" (the held-out motion covers {:.2g} turns, less than a period)", turns));
}

/// Who tells the gap without a model. An encoder on the load shows none, so that `detect` would send the
/// reader back.
std::string told_without_model(const Diagnosis& d) {
  const bool on_load = (d.model_gap && d.model_gap->encoder == EncoderSide::kLoad) ||
                       (!d.traces.empty() && d.traces.front().encoder == EncoderSide::kLoad);
  return on_load ? "that takes the motor's position, which is not recorded." : "`gapscope detect CONFIG`.";
}

/// Of a gap that was fitted.
std::string why_not_told(const MismatchSize& m) {
  if (m.remains < kRule.far) return "The recordings do not determine the gap of the fitted model";
  const std::string why =
      std::isfinite(m.remains)
          ? fmt::format(", as it leaves {} times {} (told below {:.3g} times)",
                        SharedUnit(1.0, "").number(m.remains), floor_of_the_motion(m), kRule.far)
          : "";
  return "The fitted model does not follow the recordings well enough to tell the gap" + why;
}

}  // namespace

std::string floor_of_the_motion(const MismatchSize& m) {
  return m.floor_from == FloorSource::kRepeatability ? "what the drive itself varies by from period to period"
                                                     : "the encoder's noise";
}

std::string gap_not_estimated(const Diagnosis* diagnosis, Coordinates coordinates) {
  constexpr const char* kElsewhere = "Not estimated here; told by `gapscope run CONFIG`.";
  if (diagnosis == nullptr || !diagnosis->model_gap) return kElsewhere;
  switch (diagnosis->model_gap->origin) {
    case GapOrigin::kNone:
      if (diagnosis->verdict == DiagnosisVerdict::kNone &&
          diagnosis->model_gap->encoder != EncoderSide::kLoad)
        return "Backlash is not examined, as the model is a single body, which is as good as the recording; "
               "to "
               "check without a model: " +
               told_without_model(*diagnosis);
      if (diagnosis->model_gap->encoder == EncoderSide::kLoad)
        return "Backlash is not examined: with the encoder on the load only a model with a gap can tell it "
               "(`gapscope init` with --model gap).";
      return "Backlash is not examined, as the model is a single body: it is neither shown nor ruled out; to "
             "check the recording for it: " +
             told_without_model(*diagnosis);
    case GapOrigin::kGiven:
      return "The model takes the gap as known, " + coordinates.thousandths(diagnosis->model_gap->value) +
             "; an estimate: " + told_without_model(*diagnosis);
    case GapOrigin::kEstimated:
      return why_not_told(diagnosis->mismatch) + "; without a model: " + told_without_model(*diagnosis);
  }
  return kElsewhere;
}

std::string where_words(const Diagnosis& d, Coordinates coordinates) {
  if (d.verdict == DiagnosisVerdict::kNone) return "Nowhere: what is left has no pattern.";
  const std::string what = with_short_travel(d.where.headline, d);
  const bool has_verb = std::ranges::any_of(std::array{"varies", "changes", "depends", "arises", "reverses"},
                                            [&](const char* verb) { return what.starts_with(verb); });
  return fmt::format("The missing {} {}{}.", coordinates.torque_word(),
                     has_verb                  ? ""
                     : what.starts_with("no ") ? "has "
                                               : "is ",
                     what);
}

std::string export_words(const CardFacts& f) {
  const bool goals = f.diagnosis != nullptr && (f.diagnosis->closed_loop || input_is_made(*f.diagnosis));
  const std::string takes = goals ? " takes the drive, without its controller, to other simulators."
                                  : " takes it to other simulators.";
  if (!f.carriers) return "`gapscope export`" + takes;
  if (!f.carriers->empty())
    return fmt::format("`gapscope export DIR --to {0} -o DIR_{0}`{1}", f.carriers->front(), takes);
  std::vector<std::string> names;
  for (const std::string& effect : f.uncarried) names.push_back(readable(effect));
  return "`gapscope export` loses a part of " + (names.empty() ? "it" : enumerated(names)) +
         " in every format, and says in certificate.md how much.";
}

std::string without_asides(std::string text) {
  for (std::size_t open = text.find(" ("); open != text.npos; open = text.find(" (", open)) {
    std::size_t at = open + 1;
    int depth = 0;
    do depth += text[at] == '(' ? 1 : text[at] == ')' ? -1 : 0;
    while (depth > 0 && ++at < text.size());
    if (at >= text.size()) break;
    text.erase(open, at + 1 - open);
  }
  return text;
}

std::string first_clause(const std::string& text, std::string_view ends) {
  int depth = 0;
  bool code = false;
  for (std::size_t at = 0; at + 1 < text.size(); ++at) {
    const char c = text[at];
    code = code != (c == '`');
    depth += c == '(' ? 1 : c == ')' ? -1 : 0;
    if (!code && depth == 0 && text[at + 1] == ' ' && ends.find(c) != ends.npos)
      return as_sentence(text.substr(0, at));
  }
  return as_sentence(text);
}

}  // namespace gapscope::internal::diagnosis

#include "diagnosis/card_cause.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "diagnosis/card_words.h"
#include "diagnosis/effect_starts.h"
#include "diagnosis/words.h"
#include "gapscope/base/text.h"

namespace gapscope::internal::diagnosis {
namespace {

std::string called(const AddedEffect& a, const CardFacts& f) {
  return name_of(a, *f.diagnosis, f.coordinates);
}

std::vector<std::string> names(const CardFacts& f, bool established) {
  std::vector<std::string> all;
  for (const AddedEffect& a : f.diagnosis->added)
    if (a.established == established) all.push_back(called(a, f));
  return all;
}

/// Rivals of what was added with an open cause.
std::vector<std::string> rivals(const Diagnosis& d) {
  std::vector<std::string> all;
  for (const AddedEffect& a : d.added)
    for (const std::string& rival : a.group)
      if (!a.established && rival != a.effect && !contains(d.effects, rival) &&
          !contains(all, readable(rival)))
        all.push_back(readable(rival));
  return all;
}

std::string open_causes(const CardFacts& f) {
  const std::vector<std::string> open = names(f, false), others = rivals(*f.diagnosis);
  if (open.empty()) return "";
  return enumerated(open) + (open.size() > 1 ? " help too, their cause" : " helps, its cause") + " is open" +
         (others.empty() ? "" : ": it may as well be " + enumerated(others, "or"));
}

/// Whether an amount is the effect's alone: laws that contain a simpler one share its amount with it.
bool has_own_amount(const AddedEffect& a, const std::vector<AddedEffect>& all) {
  const EffectEntry* entry = find_effect(a.effect);
  if (entry == nullptr || contained_effect(*entry) != nullptr) return false;
  return std::none_of(all.begin(), all.end(), [&](const AddedEffect& other) {
    const EffectEntry* o = find_effect(other.effect);
    return o != nullptr && contained_effect(*o) == entry;
  });
}

/// "20.5 N": the amount that the fit gave it; nothing where that has no unit or is not its own.
std::string amount_of(const AddedEffect& a, const CardFacts& f) {
  if (a.parameters.empty() || !has_own_amount(a, f.diagnosis->added)) return "";
  const NamedValue& amount = a.parameters.front();
  const std::string unit = f.coordinates.shown_unit(amount.unit);
  if (unit.empty() || !std::isfinite(amount.value)) return "";
  return SharedUnit(amount.value, unit)(amount.value);
}

/// "friction (20.5 N)"
std::string with_amount(const AddedEffect& a, const CardFacts& f) {
  const std::string amount = amount_of(a, f);
  return called(a, f) + (amount.empty() ? "" : " (" + amount + ")");
}

/// "cogging torque (2 N, 64 %)": with what it takes of the error above the floor. Of a single effect with an
/// amount the fall beside it says that.
std::string with_share(const AddedEffect& a, const CardFacts& f) {
  std::vector<std::string> asides;
  if (const std::string amount = amount_of(a, f); !amount.empty()) asides.push_back(amount);
  if (std::isfinite(a.shrink) && (asides.empty() || f.diagnosis->added.size() > 1))
    asides.push_back(fmt::format("{:.0f} %", 100.0 * a.shrink));
  return called(a, f) + (asides.empty() ? "" : fmt::format(" ({})", fmt::join(asides, ", ")));
}

/// "from 9.66 to 1.22 N (17.1 % to 2.16 %)"
std::string fall(const CardFacts& f, const Card& card) {
  const MismatchSize& m = f.diagnosis->mismatch;
  if (std::isfinite(card.torque) && std::isfinite(card.torque_after)) {
    const SharedUnit torque(card.torque, f.coordinates.shown_unit("N m"));
    return fmt::format("from {} to {} ({} to {})", torque.number(card.torque), torque(card.torque_after),
                       percent_text(card.percent), percent_text(card.percent_after));
  }
  const SharedUnit error(m.before, f.coordinates.position_unit());
  return fmt::format("from {} to {}", error.number(m.before), error(m.after));
}

std::string shares(const CardFacts& f, const Card& card) {
  std::vector<std::string> all;
  for (const AddedEffect& a : f.diagnosis->added) all.push_back(with_share(a, f));
  return enumerated(all) + (all.size() > 1 ? " bring it down " : " brings it down ") + fall(f, card);
}

/// Whether each effect has the torque that it leaves.
bool has_rungs(const Diagnosis& d) {
  return d.added.size() > 1 && std::isfinite(d.mismatch.before_torque) &&
         std::all_of(d.added.begin(), d.added.end(),
                     [](const AddedEffect& a) { return std::isfinite(a.after_torque); });
}

/// "From 9.84 N to 4.19 N with friction, then 2.20 N with cogging torque (17.1 % to 3.8 %)"
std::string rungs(const CardFacts& f, const Card& card) {
  const SharedUnit torque(card.torque, f.coordinates.shown_unit("N m"));
  std::vector<std::string> all;
  for (const AddedEffect& a : f.diagnosis->added)
    all.push_back(torque(a.after_torque) + " with " + with_amount(a, f));
  return fmt::format("from {} to {} ({} to {})", torque(card.torque), fmt::join(all, ", then "),
                     percent_text(card.percent), percent_text(card.percent_after));
}

std::string law_words(const LastResortLaw& law) {
  return fmt::format("a free curve over the {} takes {:.0f} % of {} (compensation_{}.csv)", law.variable,
                     100.0 * law.shrink, law.on_top_of.empty() ? "the error" : "what is left", law.law);
}

}  // namespace

std::string cause_line(const CardFacts& f) {
  if (f.diagnosis == nullptr) return kToldByDiagnose;
  const Diagnosis& d = *f.diagnosis;
  if (d.verdict == DiagnosisVerdict::kNone) return "Nothing is missing that this recording could show.";
  const std::vector<std::string> causes = names(f, true);
  std::string text = causes.empty() ? "" : enumerated(causes) + " (established)";
  const std::string open = open_causes(f);
  if (text.empty() && open.empty() && d.stopped) return "Not told: the search was stopped before its end.";
  text += (text.empty() || open.empty() ? "" : "; ") + open;
  return as_sentence(text.empty() ? "unknown: no effect of the catalogue explains it" : text);
}

std::string helps_line(const CardFacts& f, const Card& card) {
  if (f.diagnosis == nullptr) return kToldByDiagnose;
  const Diagnosis& d = *f.diagnosis;
  if (d.verdict == DiagnosisVerdict::kNone) return "Nothing has to: the model is as good as the recording.";
  std::vector<std::string> parts;
  if (!d.added.empty())
    parts.push_back((has_rungs(d) ? rungs(f, card) : shares(f, card)) + "; `fitted.yaml` has " +
                    (d.added.size() > 1 ? "them" : "it"));
  for (const LastResortLaw& law : d.laws) parts.push_back(law_words(law));
  if (parts.empty() && d.stopped) return "Not told: the search was stopped before its end.";
  if (parts.empty()) return "Nothing of the catalogue does.";
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : " ") + as_sentence(part);
  return text;
}

}  // namespace gapscope::internal::diagnosis

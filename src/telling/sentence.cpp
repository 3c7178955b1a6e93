#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/text.h"
#include "gapscope/diagnosis/diagnosis.h"
#include "gapscope/telling/card.h"
#include "telling/card_lines.h"
#include "telling/headline.h"
#include "telling/names.h"

namespace gapscope {

using namespace internal::telling;

namespace {

/// The causes, and what they take where something was found.
std::string sentence_of(const Diagnosis& d, Coordinates coordinates) {
  CardFacts f;
  f.diagnosis = &d, f.coordinates = coordinates;
  const Card card = card_of(f);
  const bool helps = !d.added.empty() || !d.laws.empty() ||
                     (d.verdict == DiagnosisVerdict::kNone && !changed_numbers(d, coordinates).empty());
  return card.brief.cause + (helps ? " " + card.brief.helps : "");
}

EncoderSide encoder_of(const Diagnosis& d) {
  return d.traces.empty() ? EncoderSide::kMotor : d.traces.front().encoder;
}

/// "6.06 σ if torque ripple is the cause", of every cause that an input can tell.
Told separations_of(const TriedInput& best, Told told) {
  for (const Separation& s : best.separations)
    if (s.contained)
      told.push_back({"next.experiment.contained",
                      {word("truth", readable(s.truth)), word("rival", readable(s.rival))}});
  return told;
}

Told proposal_of(const NextExperiment& next) {
  const TriedInput& best = next.tried.front();
  std::vector<std::string> by;
  for (const Separation& s : best.separations)
    if (!s.contained) by.push_back(fmt::format("{:.3g} σ if {} is the cause", s.excess, readable(s.truth)));
  Told told = {
      {"next.experiment.record",
       {word("input", describe(best.excitation)), ratio("duration", next.duration), names("by", by)}}};
  told = separations_of(best, std::move(told));
  told.push_back({"next.experiment.travel", {number("travel", best.travel, "rad")}});
  return told;
}

}  // namespace

Told experiment_of(const NextExperiment& next, std::span<const Rival> rivals, bool takes_goals) {
  std::vector<std::string> effects;
  for (const Rival& r : rivals) effects.push_back(readable(r.effect));
  const Fact told = names("rivals", effects);
  if (takes_goals) return {{"next.experiment.goals", {told}}};
  if (!next.proposes()) return {{"next.experiment.unplayable"}};
  if (next.separates()) return proposal_of(next);
  Told none = separations_of(next.tried.front(), {{"next.experiment.none", {told}}});
  none.push_back({"next.experiment.limits"});
  return none;
}

void put_into_words(Diagnosis& d, Coordinates coordinates) {
  const EncoderSide encoder = encoder_of(d);
  d.where.headline = headline_of(d.where, coordinates, encoder);
  d.remaining.headline = headline_of(d.remaining, coordinates, encoder);
  for (DiagnosisStep& s : d.steps) s.remaining = s.accepted ? headline_of(s.left, coordinates, encoder) : "";
  d.sentence = sentence_of(d, coordinates);
}

std::string verdict_words(const Diagnosis& d, Coordinates) {
  static constexpr const char* kHow[] = {"established", "likely, not confirmed", "likely, not confirmed",
                                         "established on these recordings"};
  std::string how;
  if (d.verdict == DiagnosisVerdict::kEffect)
    how = std::string("missing in the model: ") + kHow[static_cast<int>(doubt_of(d))];
  if (d.verdict == DiagnosisVerdict::kHelps) how = "the error falls, but no cause is established";
  if (d.verdict == DiagnosisVerdict::kNone) how = "nothing is missing that these recordings show";
  if (d.verdict == DiagnosisVerdict::kUnknown && d.stopped) how = "the search was stopped before its end";
  return to_string(d.verdict) + (how.empty() ? "" : " (" + how + ")");
}

std::string amount_words(const AddedEffect& added, const Diagnosis& d, Coordinates coordinates) {
  const ToldName name = name_of(added, d, coordinates);
  std::vector<std::string> told = amounts_of(added, d, coordinates, false);
  if (!name.aside.empty()) told.insert(told.begin(), "as " + name.name);
  const std::vector<std::string> others = others_of(added, d);
  if (!others.empty()) told.push_back(as_clause({"open.rivals", {names("rivals", others)}}, coordinates));
  return fmt::format("{}", fmt::join(told, "; "));
}

}  // namespace gapscope

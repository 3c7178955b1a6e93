#include "diagnosis/words.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "diagnosis/card_numbers.h"
#include "diagnosis/card_words.h"
#include "diagnosis/effect_starts.h"
#include "diagnosis/last_resort.h"
#include "gapscope/base/decimals.h"
#include "gapscope/base/percents.h"
#include "gapscope/base/text.h"
#include "gapscope/diagnosis/card.h"

namespace gapscope {
namespace internal::diagnosis {
namespace {

/// What an effect is where a parameter of it is negative.
struct Turned {
  const char *effect, *parameter, *words;
};
constexpr Turned kTurned[] = {
    {"stribeck_friction", "stiction_ratio", "inverse Stribeck friction (lower at low speed)"}};

/// Where a recording cannot tell an effect from others.
std::string likeness(std::vector<std::string> group) {
  if (group.size() < 2) return "";
  for (std::string& name : group) name = readable(name);
  return fmt::format(" (this recording cannot tell it from {})",
                     fmt::join(group.begin() + 1, group.end(), " or "));
}

/// The simpler law that an effect brings along, where no earlier effect has named it.
std::string within(const std::string& effect, const std::vector<std::string>& all) {
  const EffectEntry* entry = find_effect(effect);
  const EffectEntry* simpler = entry == nullptr ? nullptr : contained_effect(*entry);
  if (simpler == nullptr || contains(all, simpler->name)) return "";
  return fmt::format(" (which contains {})", readable(simpler->name));
}

/// The effects in their order, each with what it contains and what it cannot be told from.
std::string listed(const Diagnosis& d) {
  std::string text;
  for (const std::string& effect : d.effects) {
    std::vector<std::string> group;
    if (text.empty()) group = d.group;
    for (const DiagnosisStep& s : d.steps)
      if (s.accepted && s.effect == effect) group = s.group;
    text += (text.empty() ? "" : ", then ") + readable(effect) + within(effect, d.effects) + likeness(group);
  }
  return text;
}

std::string ratio(double value, const Diagnosis& d) {
  return std::isfinite(value) ? fmt::format("{} times the {}", SharedUnit(1.0, "").number(value),
                                            floor_name(d.mismatch.floor_from))
                              : "unknown";
}

std::string effect_sentence(const Diagnosis& d) {
  std::string text = fmt::format("The model lacks {}", listed(d));
  if (std::isfinite(d.mismatch.shrink))
    text += fmt::format(": with {} the held-out {} shrinks by {} % of what is above the floor",
                        d.effects.size() > 1 ? "them" : "it", motion_error(d),
                        percent_of_shrink(d.mismatch.shrink));
  return text + fmt::format(", to {}.", ratio(d.mismatch.remains, d));
}

/// "the missing force on held-out data falls from 9.66 N to 1.1 N (17.8 % to 2.0 % of what the input
/// brings)"
std::string torque_fall(const Diagnosis& d, Coordinates coordinates) {
  const MismatchSize& m = d.mismatch;
  const SharedUnit torque(m.before_torque, coordinates.shown_unit("N m"));
  const double both[] = {100.0 * m.before_torque / m.input_torque, 100.0 * m.after_torque / m.input_torque};
  const Percents percent(both);
  return fmt::format(
      "the missing {} on held-out data falls from {} to {} ({} to {} of what the input applies)",
      coordinates.torque_word(), torque(m.before_torque), torque(m.after_torque), percent(both[0]),
      percent(both[1]));
}

/// The same by the measure of a drive whose torque balance depends on its contact.
std::string error_fall(const Diagnosis& d) {
  if (!std::isfinite(d.mismatch.shrink))
    return "the held-out " + std::string(motion_error(d)) + " stays near its floor";
  return fmt::format("the held-out {} shrinks by {} % of what is above the floor, to {}", motion_error(d),
                     percent_of_shrink(d.mismatch.shrink), ratio(d.mismatch.remains, d));
}

constexpr const char* kByBalance = " by the torque balance alone";

/// " (likely, by the torque balance alone; ...)" or " (established; ...)", where the motion does not bear it
/// out.
std::string doubt_aside(const Diagnosis& d) {
  const std::string doubt = doubt_of_motion(d), rival = rival_of_first(d);
  if (doubt.empty() && !rival.empty()) return fmt::format(" (likely; {} explains nearly as much)", rival);
  return doubt.empty() ? "" : (doubt.starts_with(kByBalance) ? " (likely," : " (established") + doubt + ")";
}

/// What is added, in order: causes that are established, then what helps.
std::string ladder_sentence(const Diagnosis& d, Coordinates coordinates) {
  std::vector<std::string> causes, open;
  for (const AddedEffect& a : d.added) {
    const std::string name = name_of(a, d, coordinates);
    (a.established ? causes : open).push_back(name + likeness(a.group));
  }
  const bool counted = d.budget.exists() && d.budget.uncounted.empty();
  const std::string fall = counted ? torque_fall(d, coordinates) : error_fall(d);
  const char* const with = d.added.size() > 1 ? "them" : "it";
  const char* const whether =
      open.size() > 1 ? "but whether they are the cause is open" : "but whether it is the cause is open";
  if (causes.empty())
    return fmt::format("Adding {} helps, {}: with {} {}.", fmt::join(open, ", then "), whether, with, fall);
  if (rests_on_open_cause(d))
    return fmt::format("Adding {} helps, {}; with {} in the model, {} {} established: with all {}.",
                       fmt::join(open, ", then "), whether, open.size() > 1 ? "them" : "it",
                       fmt::join(causes, ", then "), causes.size() > 1 ? "are" : "is", fall);
  std::string text = fmt::format("The model lacks {}{}", fmt::join(causes, ", then "), doubt_aside(d));
  if (!open.empty())
    text += fmt::format("; {} {} as well, {}", fmt::join(open, " and "), open.size() > 1 ? "help" : "helps",
                        whether);
  return text + fmt::format(": with {} {}.", with, fall);
}

/// What the effects leave, where a law of last resort takes much of it.
std::string law_sentence(const Diagnosis& d) {
  std::string text;
  for (const LastResortLaw& law : d.laws) {
    std::vector<std::string> variables;
    for (const std::string& other : law.group) variables.push_back(variable_of(*find_effect(other)));
    text += fmt::format(
        " What {} is a function of {}, whatever its cause: as a free curve it takes {} % (95 %: {} "
        "to {}) of the held-out {} above the floor, to {}.",
        d.effects.empty() ? "is missing" : "remains", fmt::join(variables, " or "),
        with_decimals(100.0 * law.shrink, 0), with_decimals(100.0 * law.shrink_ci95.low, 0),
        with_decimals(100.0 * law.shrink_ci95.high, 0), motion_error(d),
        ratio(law.after / d.mismatch.floor, d));
  }
  return text;
}

std::string stopped_sentence(const Diagnosis& d) {
  return fmt::format("The search was stopped before it named anything: the held-out error is {}, {}.",
                     ratio(d.mismatch.before / d.mismatch.floor, d), d.where.headline);
}

std::string unknown_sentence(const Diagnosis& d) {
  std::string text =
      fmt::format("Something is missing that the catalogue does not explain: the held-out error is {}, {}",
                  ratio(d.mismatch.before / d.mismatch.floor, d), d.where.headline);
  if (d.laws.empty() && !d.ranking.empty() && d.ranking.front().rel > 0.0)
    text +=
        fmt::format("; {} comes nearest, but goes only {:.0f} % of the way to the floor",
                    readable(d.ranking.front().effect), 100.0 * std::clamp(d.ranking.front().rel, 0.0, 1.0));
  return text + ".";
}

std::string none_sentence(const Diagnosis& d, Coordinates coordinates) {
  const std::string error = ratio(d.mismatch.before / d.mismatch.floor, d);
  const std::string numbers = refitted_words(d, coordinates, kToldNumbers);
  if (numbers.empty())
    return fmt::format("Nothing is missing that this recording could show: the held-out error is {}.", error);
  return fmt::format(
      "No effect is missing that this recording could show: with numbers that are fitted the held-out error "
      "is {}. They are other ones than the configuration starts at: {}.",
      error, numbers);
}

std::string verdict_sentence(const Diagnosis& d, Coordinates coordinates) {
  switch (d.verdict) {
    case DiagnosisVerdict::kEffect:
      return d.added.empty() ? effect_sentence(d) : ladder_sentence(d, coordinates);
    case DiagnosisVerdict::kHelps:
      return ladder_sentence(d, coordinates);
    case DiagnosisVerdict::kNone:
      return none_sentence(d, coordinates);
    case DiagnosisVerdict::kUnknown:
      return d.stopped ? stopped_sentence(d) : unknown_sentence(d);
    case DiagnosisVerdict::kNotRun:
      break;
  }
  return d.sentence;
}

}  // namespace

std::string period_words(const AddedEffect& added, Coordinates coordinates) {
  for (const NamedValue& p : added.parameters) {
    if (p.key != "periods_per_turn" || !(p.value > 0.0)) continue;
    if (const std::string cycles = fmt::format("{:.4g}", p.value); coordinates.rotational())
      return cycles == "1" ? " once per turn of x1" : " at " + cycles + " cycles per turn of x1";
    const double period = 2.0 * kPi / p.value;
    return " every " + SharedUnit(period, coordinates.position_unit())(period);
  }
  return "";
}

std::string percent_of_shrink(double shrink) { return with_decimals(100.0 * std::min(shrink, 1.0), 0); }

std::string motion_error(const Diagnosis& d) {
  return d.mismatch.measure.starts_with("prediction") ? "prediction error" : "free-run error";
}

std::string doubt_of_motion(const Diagnosis& d) {
  const MismatchSize& m = d.mismatch;
  if (d.added.empty() || d.is_shown_by_motion()) return "";
  const bool balance = d.added.front().share_of == ShareOf::kTorque;
  const std::string what = m.measure.starts_with("prediction") ? "prediction" : "free run";
  if (!std::isfinite(m.shrink_ci95.low))
    return !balance ? "" : std::string(kByBalance) + "; the " + what + ", near its floor, cannot tell";
  return fmt::format("{} its error shrinks by {} % (95 %: {} to {})",
                     balance ? std::string(kByBalance) + "; the " + what + " cannot tell:"
                             : "; the " + what + " of another recording may not show it:",
                     percent_of_shrink(m.shrink), percent_of_shrink(m.shrink_ci95.low),
                     percent_of_shrink(m.shrink_ci95.high));
}

std::string brief_doubt(const Diagnosis& d, Coordinates coordinates) {
  if (doubt_of_motion(d).empty()) {
    const std::string rival = rival_of_first(d);
    return rival.empty() ? "" : fmt::format("Likely, not confirmed ({} explains nearly as much)", rival);
  }
  const std::string what = d.mismatch.measure.starts_with("prediction") ? "prediction" : "free run";
  return d.added.front().share_of == ShareOf::kTorque
             ? "Likely, not confirmed (by the " + std::string(coordinates.torque_word()) + " balance; the " +
                   what + ", restarted again and again, cannot tell)"
             : "Established on these recordings (the " + what + " of another may not show it)";
}

bool rests_on_open_cause(const Diagnosis& d) {
  return !d.added.empty() && !d.added.front().established &&
         std::any_of(d.added.begin(), d.added.end(), [](const AddedEffect& a) { return a.established; });
}

std::string name_of(const AddedEffect& added, const Diagnosis& d, Coordinates coordinates) {
  for (const Turned& t : kTurned)
    for (const NamedValue& p : added.parameters)
      if (added.effect == t.effect && p.key == t.parameter && p.value < 0.0) return t.words;
  const auto is_same = [&](const AddedEffect& other) { return other.effect == added.effect; };
  const bool again = std::count_if(d.added.begin(), d.added.end(), is_same) > 1;
  return readable(added.effect) + (again ? period_words(added, coordinates) : "");
}

std::string sentence_of(const Diagnosis& d, Coordinates coordinates) {
  return verdict_sentence(d, coordinates) + law_sentence(d);
}

}  // namespace internal::diagnosis

const char* to_string(DiagnosisVerdict verdict) {
  switch (verdict) {
    case DiagnosisVerdict::kEffect:
      return "effect";
    case DiagnosisVerdict::kHelps:
      return "helps";
    case DiagnosisVerdict::kNone:
      return "none";
    case DiagnosisVerdict::kUnknown:
      return "unknown";
    case DiagnosisVerdict::kNotRun:
      return "not run";
  }
  return "";
}

std::string Diagnosis::brief_report() const { return sentence; }

std::string rival_of_first(const Diagnosis& d) {
  if (d.added.empty() || !d.added.front().established || !d.next_experiment.proposes()) return "";
  const AddedEffect& first = d.added.front();
  for (const Separation& s : d.next_experiment.tried.front().separations)
    if (s.truth == first.effect && !contains(first.group, s.rival)) return readable(s.rival);
  return "";
}

}  // namespace gapscope

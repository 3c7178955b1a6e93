#include "report/added_table.h"

#include <fmt/format.h>

#include "base/text.h"
#include "report/wording.h"

namespace gapscope::internal::report {
namespace {

/// "amplitude | 988 mN (95 %: 950 to 1026)"
std::string number_cells(const NamedValue& p, Coordinates coordinates) {
  if (!coordinates.rotational() && p.key == "periods_per_turn") {
    const auto period = [](double cycles) { return 2.0 * kPi / cycles; };
    return "period | " + with_interval(period(p.value), {period(p.ci95.high), period(p.ci95.low)}, "m");
  }
  const Coordinates own =
      p.key == "phase_rad" ? Coordinates() : coordinates;  // an angle on a linear axis, too
  return name_of_key(p.key) + " | " + with_interval(p.value, p.ci95, own.shown_unit(p.unit));
}

/// The later effect that contains this one, and has its numbers.
const AddedEffect* with_these_numbers(const AddedEffect& a, const std::vector<AddedEffect>& added) {
  for (const AddedEffect& other : added) {
    const EffectEntry* entry = find_effect(other.effect);
    const EffectEntry* simpler = entry == nullptr ? nullptr : find_effect(a.effect);
    if (&other != &a && simpler != nullptr && contained_effect(*entry) == simpler) return &other;
  }
  return nullptr;
}

/// " or `load_unbalance`" of what the recordings cannot tell from an effect, but for what was added as well.
std::string alternatives(const AddedEffect& a, const std::vector<std::string>& effects) {
  std::string text;
  for (const std::string& other : a.group)
    if (other != a.effect && !contains(effects, other)) text += " or `" + other + "`";
  return text;
}

/// Which evidence has decided, where the motion does not bear it out; what else nearly explains it.
std::string established_word(const DiagnosisResult& r) {
  const Diagnosis& d = r.diagnosis;
  if (d.added.empty() || d.added.front().share_of == ShareOf::kMotion || d.is_shown_by_motion()) {
    const std::string rival = rival_of_first(d);
    return rival.empty() ? "established" : "likely, " + rival + " explains nearly as much";
  }
  return r.coordinates.rotational() ? "likely, by the torque balance" : "likely, by the force balance";
}

/// Where its numbers are from: they are not those of a ranking by the motion.
std::string origin_words(const DiagnosisResult& r) {
  const Diagnosis& d = r.diagnosis;
  const std::string torque = r.coordinates.torque_word();
  if (d.balanced)
    return ", by the " + torque +
           " balance on the recordings that were fitted: the simulated motion lacks something yet, for which "
           "a refit to it would bend them";
  return std::string(", refitted together to the motion") +
         (d.added.front().share_of == ShareOf::kTorque ? "; the " + torque + " balance has chosen them" : "");
}

}  // namespace

bool is_left_out(const NamedValue& p) {
  return (p.key.find("_harmonic") != std::string::npos && p.value == 0.0) ||
         (p.key == "periods_per_turn" && p.value == 1.0);
}

std::string added_table(const DiagnosisResult& r) {
  std::string text;
  const std::vector<AddedEffect>& added = r.diagnosis.added;
  const std::string established = established_word(r);
  for (const AddedEffect& a : added) {
    const bool on_top = a.established && !added.front().established;
    const std::string others = a.established ? alternatives(a, r.diagnosis.effects) : "";
    std::string effect = fmt::format("`{}`{} ({})", a.effect, others,
                                     !others.empty() ? "not separated"
                                     : on_top        ? "established with `" + added.front().effect + "`"
                                     : a.established ? established
                                                     : "cause open");
    if (const AddedEffect* other = with_these_numbers(a, added)) {
      text += fmt::format("| {} | | within `{}` |\n", effect, other->effect);
      continue;
    }
    for (const NamedValue& p : a.parameters) {
      if (is_left_out(p)) continue;
      text += fmt::format("| {} | {} |\n", effect, number_cells(p, r.coordinates));
      effect = "";
    }
  }
  if (text.empty()) return "";
  return "\n## What was added\n\nThe numbers of the model with all of it" + origin_words(r) +
         ". The intervals hold for that model, as it follows the recordings that were fitted; a number "
         "without one these do not determine by themselves.\n\n"
         "| effect | number | value |\n|---|---|---|\n" +
         text;
}

}  // namespace gapscope::internal::report

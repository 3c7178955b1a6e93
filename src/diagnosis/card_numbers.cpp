#include "diagnosis/card_numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include "diagnosis/card_words.h"
#include "diagnosis/rule.h"
#include "diagnosis/tell_intervals.h"
#include "gapscope/base/text.h"
#include "gapscope/diagnosis/simulator.h"

namespace gapscope::internal::diagnosis {
namespace {

/// Those that contain the simpler effect, each with a level of it as its first number.
std::vector<const AddedEffect*> containers_of(const EffectEntry& simpler,
                                              const std::vector<AddedEffect>& all) {
  std::vector<const AddedEffect*> found;
  for (const AddedEffect& other : all)
    if (const EffectEntry* o = find_effect(other.effect);
        o != nullptr && contained_effect(*o) == &simpler && !other.parameters.empty())
      found.push_back(&other);
  return found;
}

/// The level of a simpler effect in all that contain it; of several, whose parts are not apart, without an
/// interval.
std::optional<NamedValue> shared_level(const std::vector<const AddedEffect*>& containers) {
  if (containers.empty()) return {};
  NamedValue level = containers.front()->parameters.front();
  for (std::size_t i = 1; i < containers.size(); ++i) level.value += containers[i]->parameters.front().value;
  if (containers.size() > 1) level.ci95 = {};
  return level;
}

/// The number that says how much there is of an effect, past those of the simpler one that it contains; of
/// several ratios, as friction that differs with the direction has them, the largest. Nothing: none is known.
std::optional<NamedValue> own_number(const AddedEffect& a, const std::vector<AddedEffect>& all) {
  const EffectEntry* entry = find_effect(a.effect);
  if (entry == nullptr) return {};
  if (const auto containers = containers_of(*entry, all); !containers.empty())
    return shared_level(containers);
  const EffectEntry* simpler = contained_effect(*entry);
  const std::size_t own = simpler == nullptr ? 0 : simpler->parameters.size();
  if (own >= a.parameters.size()) return {};
  const NamedValue* most = &a.parameters[own];
  const auto is_ratio = [](const NamedValue& n) { return n.key.ends_with("ratio"); };
  for (std::size_t i = own + 1; i < a.parameters.size(); ++i)
    if (const NamedValue& n = a.parameters[i];
        is_ratio(*most) && is_ratio(n) && std::abs(n.value) > std::abs(most->value))
      most = &n;
  return *most;
}

/// What a ratio of the level of friction is of the level in all effects that have a part of it.
double part_of_level(const AddedEffect& a, const std::vector<AddedEffect>& all) {
  const EffectEntry* simpler = contained_effect(*find_effect(a.effect));
  if (simpler == nullptr) return 1.0;
  const std::optional<NamedValue> level = shared_level(containers_of(*simpler, all));
  return level && level->value > 0.0 ? a.parameters.front().value / level->value : 1.0;
}

/// "3.12 % of the torque, 95 %: 3.05 to 3.19"; with its sign where it may have either.
std::string share_text(const AddedEffect& a, const NamedValue& n, const std::vector<AddedEffect>& all) {
  double factor = 100.0;
  std::string name = name_of_key(n.key) + " ", unit = "%";
  for (const EffectParameterSpec& p : find_effect(a.effect)->parameters) {
    if (n.key != p.key || *p.of == '\0') continue;
    name = p.low < 0.0 && n.value > 0.0 ? "+" : "";
    unit += std::string(" ") + p.of;
    if (std::string_view(p.of).find("friction") != std::string_view::npos) factor *= part_of_level(a, all);
  }
  return name +
         SharedUnit(1.0, unit).with_interval(factor * n.value, {factor * n.ci95.low, factor * n.ci95.high});
}

constexpr const char* kSteadyTorque = "constant_load_torque";

/// "227.26 mN·m pushing backward, 95 %: 226.44 to 228.07"
std::string pushing(const NamedValue& n, const std::string& unit) {
  const bool back = n.value < 0.0;
  const Interval ci95 = back ? Interval{-n.ci95.high, -n.ci95.low} : n.ci95;
  return SharedUnit(n.value, unit + (back ? " pushing backward" : " pushing forward"))
      .with_interval(std::abs(n.value), ci95);
}

std::string without_interval(const AddedEffect& a, const NamedValue& n) {
  if (std::isfinite(n.ci95.low)) return "";
  if (contains(a.at_bound, n.key)) return ", at the bound of its search";
  return a.established ? "" : ", an amount that the recordings do not determine";
}

std::string name_of_number(const RefittedNumber& n, const Diagnosis& d, Coordinates coordinates) {
  const std::size_t dot = n.key.find('.');
  const bool one_body = d.model_gap && d.model_gap->origin == GapOrigin::kNone;
  if (n.key == "motor_inertia" && one_body)
    return coordinates.rotational() ? "motor inertia (of all that moves)" : "moving mass (motor inertia)";
  if (n.key == "mass_ratio") return "mass ratio (load over motor)";
  if (dot == n.key.npos) return readable(n.key);
  return readable(n.key.substr(0, dot)) + " " + name_of_key(n.key.substr(dot + 1));
}

/// A number that reads differently now.
struct Change {
  std::string name, words;
  double moved = 0.0;   ///< as moved_by()
  bool torque = false;  ///< of an effect
};

/// Those that clearly move, torques of effects before them: what each of these does is seen first in a drive.
/// Then the rest, both as far as they have moved.
void put_in_order(std::vector<Change>& all) {
  const auto place = [](const Change& c) {
    return !(c.moved > kTelling.clear_change) ? 2 : c.torque ? 0 : 1;
  };
  std::ranges::stable_sort(all, [&](const Change& a, const Change& b) {
    return std::pair(place(a), -a.moved) < std::pair(place(b), -b.moved);
  });
}

/// The first `most` and all that clearly move with what changes, the rest by name: "and smaller changes in
/// contact stiffness".
std::string in_part(const std::vector<Change>& changes, std::size_t most) {
  std::vector<std::string> all, rest;
  for (std::size_t i = 0; i < changes.size(); ++i)
    if (i < most || changes[i].moved > kTelling.clear_change)
      all.push_back(changes[i].name + " " + changes[i].words);
    else
      rest.push_back(changes[i].name);
  return rest.empty() ? enumerated(all)
                      : fmt::format("{}, and smaller changes in {}", fmt::join(all, ", "), enumerated(rest));
}

/// "0.1 → 0.0400 N·m s/rad (95 %: 0.0399 to 0.0401)"; empty where both read alike.
std::string change_of(const RefittedNumber& n, const std::string& unit) {
  const std::string from = fmt::format("{:.3g}", n.configured);
  if (from == fmt::format("{:.3g}", n.fitted)) return "";
  return from + " → " + SharedUnit(1.0, unit).with_interval_aside(n.fitted, n.ci95);
}

std::size_t differing_rows(const SimulatorComparison* c) {
  if (c == nullptr) return 0;
  return static_cast<std::size_t>(
      std::count_if(c->rows.begin(), c->rows.end(), [](const SimulatorRow& r) { return r.differs; }));
}

/// " Your simulator's error, 268.8 mrad, falls to 125.7 mrad with motor damping mended and to 0.1149 mrad
/// with all 3 rows that differ."
std::string simulator_helps(const CardFacts& f) {
  const std::size_t differing = differing_rows(f.simulated);
  if (differing == 0) return "";
  const SimulatorErrors& e = f.simulated->errors;
  std::vector<std::string> falls;
  if (f.simulated->shrink > 0.0)
    falls.push_back(fmt::format("to {} with {} mended", f.coordinates.thousandths(e.mended),
                                readable(f.simulated->rows.front().name)));
  if (differing > 1 && e.all_mended < e.stand_in)
    falls.push_back(fmt::format("to {} with all {} rows that differ", f.coordinates.thousandths(e.all_mended),
                                differing));
  if (falls.empty()) return "";
  return fmt::format(" Your simulator's error, {}, falls {}.", f.coordinates.thousandths(e.stand_in),
                     enumerated(falls));
}

/// By how much a number has to be multiplied, with its interval.
Interval factor_of(const RefittedNumber& n) {
  return {n.ci95.low / n.configured, n.ci95.high / n.configured};
}

const RefittedNumber* refitted_number(const Diagnosis& d, const char* key) {
  const auto at = std::find_if(d.refitted.begin(), d.refitted.end(),
                               [&](const RefittedNumber& n) { return n.key == key; });
  return at == d.refitted.end() || !(at->configured > 0.0) ? nullptr : &*at;
}

/// Whether a number changes by far more than its interval is wide.
bool clearly_changes(const Interval& factor) {
  const double half = 0.5 * (factor.high - factor.low), centre = 0.5 * (factor.high + factor.low);
  return half < kTelling.narrow * std::abs(centre - 1.0);
}

/// " Inertia and damping are both 1.136 times those of the configuration, which ... a torque constant ...
/// that is 12 % smaller ...", where both clearly change by one factor, and the torque constant is fixed.
std::string scale_words(const Diagnosis& d) {
  const RefittedNumber* inertia = refitted_number(d, "motor_inertia");
  const RefittedNumber* damping = refitted_number(d, "motor_damping");
  const bool scaled =
      d.fitted.parameters[place::kTorqueConstant].estimate ||
      refitted_number(d, "torque_constant") != nullptr;  // in stored results only that is known
  if (inertia == nullptr || damping == nullptr || scaled) return "";
  const Interval a = factor_of(*inertia), b = factor_of(*damping);
  const bool alike = a.low <= b.high && b.low <= a.high;
  if (!alike || !clearly_changes(a) || !clearly_changes(b)) return "";
  const double factor = inertia->fitted / inertia->configured;
  return fmt::format(
      " Inertia and damping are both {:.4g} times those of the configuration, which the recordings cannot "
      "tell from a torque constant (or gear ratio) that is {} {}: where the inertia is certain, give it as a "
      "bare "
      "number, which is held, and set torque_constant: {{estimate: true}}.",
      factor, percent_text(100.0 * std::abs(1.0 / factor - 1.0)), factor > 1.0 ? "smaller" : "larger");
}

/// All that read differently, in their order.
std::vector<Change> changes_of(const Diagnosis& d, Coordinates coordinates) {
  std::vector<Change> changes;
  for (const RefittedNumber& n : d.refitted) {
    const bool angle = n.key.ends_with("phase_rad");  // along a slide, too
    const std::string change = change_of(n, (angle ? Coordinates() : coordinates).shown_unit(n.unit));
    if (change.empty()) continue;
    const bool of_effect = n.key.find('.') != n.key.npos && n.unit == "N m";
    changes.push_back({name_of_number(n, d, coordinates), change, moved_by(n), of_effect});
  }
  put_in_order(changes);
  return changes;
}

}  // namespace

std::string amount_of(const AddedEffect& a, const std::vector<AddedEffect>& all, Coordinates coordinates) {
  const std::optional<NamedValue> amount = own_number(a, all);
  if (!amount || !std::isfinite(amount->value)) return "";
  const std::string unit = coordinates.shown_unit(amount->unit);
  const bool of_several = containers_of(*find_effect(a.effect), all).size() > 1;
  const std::string open = of_several ? "" : without_interval(a, *amount);
  if (unit.empty()) return share_text(a, *amount, all) + open;
  if (a.effect == kSteadyTorque) return pushing(*amount, unit) + open;
  const std::string name = name_of_key(amount->key);
  const bool said = name == "level" || readable(a.effect).ends_with(name);  // an "input delay" of 3 ms
  return (said ? "" : name + " ") +
         SharedUnit(amount->value, unit).with_interval(amount->value, amount->ci95) + open;
}

std::string refitted_words(const Diagnosis& d, Coordinates coordinates, std::size_t most) {
  return in_part(changes_of(d, coordinates), most);
}

std::string briefly_refitted(const CardFacts& f) {
  if (f.diagnosis == nullptr || f.diagnosis->stopped) return "";
  std::vector<std::string> told;
  const std::vector<Change> changes = changes_of(*f.diagnosis, f.coordinates);
  const std::size_t most = changes.size() > kToldNumbers + 1 ? kToldNumbers : changes.size();
  for (std::size_t i = 0; i < most; ++i)
    told.push_back(without_asides(changes[i].name + " " + changes[i].words));
  if (told.empty()) return "";
  if (changes.size() > most) told.push_back(fmt::format("{} more", changes.size() - most));
  return " Numbers that the fit has changed: " + enumerated(told) + ".";
}

std::string other_numbers_help(const CardFacts& f) {
  const std::string numbers = refitted_words(*f.diagnosis, f.coordinates, kToldNumbers);
  if (numbers.empty() && differing_rows(f.simulated) == 0)
    return "Nothing needed: the model is as good as the recording.";
  if (numbers.empty())
    return "Nothing need be added to the model, which is as good as the recording." + simulator_helps(f);
  return "Other numbers than the configuration starts at, and nothing more: " + numbers +
         "; `fitted.yaml` has them and is as good as the recording." + scale_words(*f.diagnosis) +
         simulator_helps(f);
}

std::string next_of_numbers(const CardFacts& f) {
  const bool numbers = !refitted_words(*f.diagnosis, f.coordinates, kToldNumbers).empty();
  std::vector<std::string> rows;
  if (differing_rows(f.simulated) > 0)
    for (const SimulatorRow& row : f.simulated->rows)
      if (row.differs) rows.push_back(readable(row.name));
  if (!rows.empty())
    return "Mend your simulator: " + enumerated(rows) +
           ", as the table of drive and simulator has it; `fitted.yaml` has the drive's numbers.";
  return numbers ? "Simulate with the numbers of `DIR/fitted.yaml`; " + export_words(f) : "None.";
}

std::string also_refitted(const CardFacts& f) {
  constexpr std::size_t kMost = kToldNumbers - 1;
  if (f.diagnosis == nullptr || f.diagnosis->added.empty() || f.diagnosis->stopped) return "";
  const std::string numbers = refitted_words(*f.diagnosis, f.coordinates, kMost);
  if (numbers.empty()) return "";
  return " Of your own numbers the fit has changed " + numbers + "." + scale_words(*f.diagnosis);
}

}  // namespace gapscope::internal::diagnosis

#include "telling/names.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include "base/shared_unit.h"
#include "base/text.h"
#include "diagnosis/numbers.h"
#include "diagnosis/told_facts.h"

namespace gapscope::internal::telling {
namespace {

using diagnosis::kTelling;

constexpr std::size_t kToldNumbers = 3;  ///< of the user's own in brief; the whole text has all

/// What an effect is where a parameter of it is negative.
struct Turned {
  const char *effect, *parameter;
  ToldName told;
};
const Turned kTurned[] = {
    {"stribeck_friction", "stiction_ratio", {"inverse Stribeck friction", "lower at low speed"}}};

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
    if (p.scale == Scale::kLevel) factor *= part_of_level(a, all);
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
  if (contains(a.at_bound, n.key)) return ", where its search ended, no measured value";
  return a.established ? "" : ", an amount that the recordings do not determine";
}

/// With what the number is of as its aside.
ToldName name_of_number(const RefittedNumber& n, const Diagnosis& d, Coordinates coordinates) {
  const std::size_t dot = n.key.find('.');
  const bool one_body = d.model_gap && d.model_gap->origin == GapOrigin::kNone;
  if (n.key == "motor_inertia" && one_body)
    return coordinates.rotational() ? ToldName{"motor inertia", "of all that moves"}
                                    : ToldName{"moving mass", "motor inertia"};
  if (n.key == "mass_ratio") return {"mass ratio", "load over motor"};
  if (dot == n.key.npos) return {readable(n.key)};
  return {readable(n.key.substr(0, dot)) + " " + name_of_key(n.key.substr(dot + 1))};
}

/// " at 24 cycles per turn of x1", " every 2.5 mm": tells lines of one law apart. Empty for what has no
/// period.
std::string period_of(const AddedEffect& added, Coordinates coordinates) {
  for (const NamedValue& p : added.parameters) {
    if (p.key != "periods_per_turn" || !(p.value > 0.0)) continue;
    if (const std::string cycles = fmt::format("{:.4g}", p.value); coordinates.rotational())
      return cycles == "1" ? "once per turn of x1" : "at " + cycles + " cycles per turn of x1";
    const double period = 2.0 * kPi / p.value;
    return "every " + SharedUnit(period, coordinates.position_unit())(period);
  }
  return "";
}

bool is_added_again(const AddedEffect& added, const Diagnosis& d) {
  return std::ranges::count(d.added, added.effect, &AddedEffect::effect) > 1;
}

/// "20.54 N, 95 %: 20.11 to 20.97": how much there is of an effect, as the fit has it. A law that contains a
/// simpler one shares its level with it and is told by what it adds, "stiction ratio 33.0 %", the simpler one
/// by that level. Nothing where the fit has no numbers of it.
std::string amount_of(const AddedEffect& a, const std::vector<AddedEffect>& all, Coordinates coordinates) {
  const std::optional<NamedValue> amount = own_number(a, all);
  if (!amount || !std::isfinite(amount->value)) return "";
  const std::string unit = coordinates.shown_unit(amount->unit);
  const bool of_several = containers_of(*find_effect(a.effect), all).size() > 1;
  const std::string open = of_several ? "" : without_interval(a, *amount);
  if (unit.empty()) return share_text(a, *amount, all) + open;
  if (a.effect == kSteadyTorque) return pushing(*amount, unit) + open;
  const std::string name = name_of_key(amount->key);
  const bool said = name == "level" || a.effect.ends_with(name);  // an "input delay" of 3 ms
  return (said ? "" : name + " ") +
         SharedUnit(amount->value, unit).with_interval(amount->value, amount->ci95) + open;
}

/// Whether it clearly changes, torques of effects before other numbers: what each of these does is seen first
/// in a drive.
int rank_of(const ChangedNumber& c) { return !(c.moved > kTelling.clear_change) ? 2 : c.torque ? 0 : 1; }

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

}  // namespace

std::string readable_law(const std::string& law) {
  constexpr std::string_view kFree = "free_", kCurve = "_curve";
  if (!law.starts_with(kFree) || !law.ends_with(kCurve)) return readable(law);
  return "a free curve over the " + law.substr(kFree.size(), law.size() - kFree.size() - kCurve.size());
}

ToldName name_of(const AddedEffect& added, const Diagnosis& d, Coordinates coordinates) {
  for (const Turned& t : kTurned)
    for (const NamedValue& p : added.parameters)
      if (added.effect == t.effect && p.key == t.parameter &&
          (std::isnan(p.ci95.high) ? p.value : p.ci95.high) < 0.0)
        return t.told;
  const std::string period = is_added_again(added, d) ? period_of(added, coordinates) : "";
  return {readable(added.effect) + (period.empty() ? "" : " " + period)};
}

std::vector<std::string> amounts_of(const AddedEffect& a, const Diagnosis& d, Coordinates coordinates,
                                    bool period_is_named) {
  std::vector<std::string> all;
  if (const std::string period = period_of(a, coordinates); !period.empty() && !period_is_named)
    all.push_back(period);
  if (const std::string amount = amount_of(a, d.added, coordinates); !amount.empty()) all.push_back(amount);
  return all;
}

ToldName with_amount(const AddedEffect& a, const Diagnosis& d, Coordinates coordinates,
                     const std::string& share) {
  ToldName told = name_of(a, d, coordinates);
  std::vector<std::string> asides = amounts_of(a, d, coordinates, is_added_again(a, d));
  if (!share.empty()) asides.push_back(share);
  told.aside = fmt::format("{}", fmt::join(asides, "; "));
  return told;
}

std::vector<std::string> others_of(const AddedEffect& a, const Diagnosis& d) {
  std::vector<std::string> all;
  for (const std::string& other : a.group)
    if (other != a.effect && !contains(d.effects, other)) all.push_back(readable(other));
  return all;
}

std::vector<ChangedNumber> changed_numbers(const Diagnosis& d, Coordinates coordinates) {
  std::vector<ChangedNumber> all;
  for (const RefittedNumber& n : d.refitted) {
    const std::string from = fmt::format("{:.3g}", n.configured);
    if (from == fmt::format("{:.3g}", n.fitted)) continue;
    const bool angle = n.key.ends_with("phase_rad");  // along a slide, too
    const SharedUnit unit(1.0, (angle ? Coordinates() : coordinates).shown_unit(n.unit));
    const ToldName name = name_of_number(n, d, coordinates);
    const std::string of = name.aside.empty() ? "" : " (" + name.aside + ")";
    const bool of_effect = n.key.find('.') != n.key.npos && n.unit == "N m";
    all.push_back({name.name, name.name + " " + from + " → " + unit(n.fitted),
                   name.name + of + " " + from + " → " + unit.with_interval_aside(n.fitted, n.ci95),
                   diagnosis::moved_by(n), of_effect});
  }
  std::ranges::stable_sort(all, [](const ChangedNumber& a, const ChangedNumber& b) {
    return std::pair(rank_of(a), -a.moved) < std::pair(rank_of(b), -b.moved);
  });
  return all;
}

Fact briefly_changed(const std::vector<ChangedNumber>& all) {
  std::vector<std::string> told;
  const std::size_t most = all.size() > kToldNumbers + 1 ? kToldNumbers : all.size();
  for (std::size_t i = 0; i < most; ++i) told.push_back(all[i].briefly);
  if (all.size() > most) told.push_back(fmt::format("{} more", all.size() - most));
  return names("brief", told);
}

Fact changed_in_full(const std::vector<ChangedNumber>& all, std::size_t most) {
  std::vector<std::string> told, rest;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (i < most || all[i].moved > kTelling.clear_change)
      told.push_back(all[i].in_full);
    else
      rest.push_back(all[i].name);
  if (!rest.empty()) told.push_back(fmt::format("to a smaller part {}", fmt::join(rest, ", ")));
  return names("changes", told);
}

Told scaled_numbers(const Diagnosis& d) {
  const RefittedNumber* inertia = refitted_number(d, "motor_inertia");
  const RefittedNumber* damping = refitted_number(d, "motor_damping");
  const bool scaled =
      d.fitted.parameters[place::kTorqueConstant].estimate ||
      refitted_number(d, "torque_constant") != nullptr;  // in stored results only that is known
  if (inertia == nullptr || damping == nullptr || scaled) return {};
  const Interval a = factor_of(*inertia), b = factor_of(*damping);
  const bool alike = a.low <= b.high && b.low <= a.high;
  if (!alike || !clearly_changes(a) || !clearly_changes(b)) return {};
  const double factor = inertia->fitted / inertia->configured;
  return {{"helps.scale",
           {ratio("factor", factor), per_cent("share", 100.0 * std::abs(1.0 / factor - 1.0)),
            word("way", factor > 1.0 ? "smaller" : "larger"), estimate_true()}}};
}

}  // namespace gapscope::internal::telling

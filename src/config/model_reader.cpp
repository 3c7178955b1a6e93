#include "config/model_reader.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace gapscope::internal::config {
namespace {

/// What each number can be at all.
constexpr auto kPossible = [] {
  std::array<std::pair<double, double>, kDriveParameterCount> possible;
  possible.fill({0.0, 1e9});
  possible[place::kMotorInertia] = possible[place::kTorqueConstant] = {1e-12, 1e9};
  possible[place::kMassRatio].second = 1e6, possible[place::kGap].second = 1e3;
  possible[place::kContactStiffness] = {1e-9, 1e15}, possible[place::kContactDamping].second = 1e12;
  return possible;
}();

/// `prior: {value, std}`; without a value it is around the start.
std::pair<std::optional<double>, double> read_prior(const Value& value, const Range& range) {
  const Section section(value, {"value", "std"});
  std::optional<double> centre;
  if (const auto given = section.find("value")) centre = given->number(range);
  const Value std = section.require("std", "the standard deviation of what is known beforehand");
  const double width = std.number({0.0, kInfinity, range.unit});
  if (width == 0.0) std.fail("is 0, expected more than 0");
  return {centre, width};
}

WrittenParameter read_parameter(const Value& value, int index) {
  WrittenParameter p{{}, {}, {}, {}, value};
  const Range range = possible_parameter(index);
  if (!value.is_map()) {
    p.value = value.number(range);
    p.estimate = false;
    return p;
  }
  const Section section(value, {"value", "estimate", "bounds", "prior", "guess", "given_at"});
  if (const auto given = section.find("guess")) p.guess = given->truth();
  p.given_at = section.find("given_at");
  if (const auto given = section.find("estimate")) p.estimate = given->truth();
  if (const auto given = section.find("bounds")) p.bounds = given->rising_pair(range);
  if (const auto given = section.find("prior")) p.prior = read_prior(*given, range);
  if (const auto given = section.find("value"))
    p.value = given->number(p.bounds ? Range{p.bounds->first, p.bounds->second, range.unit} : range);
  if (p.guess && (!p.value || p.estimate.value_or(false)))
    value.fail("has guess: true, expected a value and no estimate with it: what is estimated is not guessed");
  if (!p.value && p.estimate == false)
    value.fail("has no value and is not estimated, expected a value or estimate: true");
  return p;
}

std::pair<ContactLaw, double> read_contact(const Value& value) {
  if (value.is_text()) {
    value.word({"compliant", "{rigid: {restitution: 0 to 1}}"});
    return {ContactLaw::kCompliant, 1.0};
  }
  const Section section(value, {"rigid"});
  const Section rigid(section.require("rigid", "rigid: {restitution: 0 to 1}"), {"restitution"});
  return {ContactLaw::kRigid, rigid.require("restitution", "a number from 0 to 1").number({0.0, 1.0, "-"})};
}

void read_parameters(const Value& value, WrittenModel& model) {
  std::vector<std::string> keys;
  for (const auto& spec : kDriveParameters) keys.emplace_back(spec.key);
  const Section section(value, keys);
  for (int i = 0; i < kDriveParameterCount; ++i)
    if (const auto given = section.find(keys[i])) model.parameters[i] = read_parameter(*given, i);
}

/// Turns of the motor for one of the axis; 0 where none are told. Whoever reads the recording judges them.
double told_gear(const std::optional<Value>& recording) {
  if (!recording || !recording->is_map()) return 0.0;
  for (const auto& [key, gear] : recording->entries()) {
    if (key != "gear_ratio" || !gear.is_map()) continue;
    for (const auto& [side, ratio] : gear.entries())
      if (side == "position") return std::abs(ratio.number());
  }
  return 0.0;
}

/// Power of the gear's ratio by which a number grows from the motor's shaft to the axis behind the gear.
int power_of_gear(const std::string& unit) {
  if (unit == "kg m^2" || unit == "N m s/rad" || unit == "N m/rad") return 2;
  if (unit == "N m" || unit == "N m per unit of u") return 1;
  return unit == "rad" ? -1 : 0;
}

}  // namespace

void put_behind_gear(WrittenModel& model, const std::optional<Value>& recording, Coordinates coordinates) {
  for (int i = 0; i < kDriveParameterCount; ++i) {
    auto& p = model.parameters[i];
    if (!p || !p->given_at) continue;
    const Value& side = *p->given_at;
    const bool at_motor = side.word({"motor", "load"}) == 0;
    const int power = power_of_gear(kDriveParameters[i].unit);
    const double ratio = told_gear(recording);
    if (power == 0) side.fail("stands beside a ratio, expected a quantity with a unit: a ratio has no side");
    if (!at_motor) continue;  // as all numbers are
    if (!coordinates.rotational()) side.fail("stands on a slide, expected the number as it is for the slide");
    if (ratio == 0.0)
      side.fail(
          "needs the gear, expected recording: gear_ratio: {position: turns of the motor for one of the axis}");
    const double factor = std::pow(ratio, power);
    if (p->value) *p->value *= factor;
    if (p->bounds) p->bounds->first *= factor, p->bounds->second *= factor;
    if (p->prior && p->prior->first) *p->prior->first *= factor;
    if (p->prior) p->prior->second *= factor;
  }
}

Range possible_parameter(int index) {
  const auto& [low, high] = kPossible[index];
  return {low, high, kDriveParameters[index].unit};
}

WrittenModel read_model(const Value& value) {
  WrittenModel model;
  model.given = true;
  model.place = value;
  const Section section(value, {"contact", "load", "parameters", "effects"});
  if (const auto contact = section.find("contact")) model.contact = read_contact(*contact);
  if (const auto load = section.find("load"))
    model.load = load->word({"free", "locked"}) == 0 ? LoadKind::kFree : LoadKind::kLocked;
  if (const auto parameters = section.find("parameters")) read_parameters(*parameters, model);
  if (const auto effects = section.find("effects")) {
    model.effects.emplace();
    for (const Value& item : effects->items()) model.effects->push_back(read_effect(item));
  }
  return model;
}

WrittenModel overlaid(const WrittenModel& base, const WrittenModel& changes) {
  WrittenModel both = base;
  both.given = base.given || changes.given;
  if (changes.place) both.place = changes.place;
  if (changes.contact) both.contact = changes.contact;
  if (changes.load) both.load = changes.load;
  if (changes.effects) both.effects = changes.effects;
  for (int i = 0; i < kDriveParameterCount; ++i) {
    if (!changes.parameters[i]) continue;
    std::optional<double> value = changes.parameters[i]->value;
    if (!value && base.parameters[i]) value = base.parameters[i]->value;
    both.parameters[i] = changes.parameters[i];
    both.parameters[i]->value = value;
  }
  return both;
}

}  // namespace gapscope::internal::config

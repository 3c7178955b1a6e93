#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <numbers>
#include <vector>

#include "gapscope/recording/unit_names.h"

namespace gapscope {
namespace {

struct Unit {
  const char* name;
  UnitScale scale;
};

constexpr double kPi = std::numbers::pi;
constexpr UnitScale kOne, kMilli{1.0, 1e3, 0}, kMicro{1.0, 1e6, 0}, kNano{1.0, 1e9, 0}, kKilo{1e3, 1.0, 0},
    kPercent{1.0, 100.0, 0};

/// The first one is that of SI. Current, voltage and a duty serve both kinds of axes:
/// torque_constant makes them one.
const std::vector<Unit>& units(Quantity quantity) {
  static const std::vector<Unit> time = {{"s", kOne}, {"ms", kMilli}, {"us", kMicro}, {"ns", kNano}};
  static const std::vector<Unit> angle = {{"rad", kOne},
                                          {"mrad", kMilli},
                                          {"deg", {kPi, 180.0, 0}},
                                          {"arcmin", {kPi, 180.0 * 60.0, 0}},
                                          {"rev", {2 * kPi, 1.0, 0}},
                                          {"arcsec", {kPi, 180.0 * 3600.0, 0}}};
  static const std::vector<Unit> length = {{"m", kOne}, {"mm", kMilli}, {"um", kMicro}, {"nm", kNano}};
  static const std::vector<Unit> torque = {{"N m", kOne},  {"mN m", kMilli}, {"kN m", kKilo},
                                           {"A", kOne},    {"mA", kMilli},   {"V", kOne},
                                           {"mV", kMilli}, {"%", kPercent},  {"permille", kMilli}};
  static const std::vector<Unit> force = {{"N", kOne},    {"mN", kMilli},  {"kN", kKilo},
                                          {"A", kOne},    {"mA", kMilli},  {"V", kOne},
                                          {"mV", kMilli}, {"%", kPercent}, {"permille", kMilli}};
  static const std::vector<Unit> voltage = {{"V", kOne}, {"mV", kMilli}};
  switch (quantity) {
    case Quantity::kTime:
      return time;
    case Quantity::kAngle:
      return angle;
    case Quantity::kLength:
      return length;
    case Quantity::kTorque:
      return torque;
    case Quantity::kForce:
      return force;
    case Quantity::kVoltage:
      return voltage;
  }
  return time;
}

/// Of a torque's unit the sign between its two is written in many ways; the table has the blank.
std::string as_in_table(Quantity quantity, std::string_view declared) {
  constexpr std::string_view kForce = "N", kSigns[] = {"", ".", "*", "·", "⋅"};
  const auto force = declared.rfind(kForce);
  if (quantity != Quantity::kTorque || force == declared.npos || !declared.ends_with('m'))
    return std::string(declared);
  const std::string_view before = declared.substr(0, force + kForce.size());
  const std::string_view sign = declared.substr(before.size(), declared.size() - before.size() - 1);
  const bool is_sign = std::find(std::begin(kSigns), std::end(kSigns), sign) != std::end(kSigns);
  return is_sign ? std::string(before) + " m" : std::string(declared);
}

std::optional<UnitScale> from_number(std::string_view text) {
  constexpr double kSmallest = 1e-15, kLargest = 1e15;
  double value = 0.0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (problem != std::errc() || end != text.data() + text.size()) return {};
  if (!(value >= kSmallest && value <= kLargest)) return {};
  return UnitScale{value, 1.0, 0};
}

}  // namespace

double UnitScale::as_signed(double recorded) const {
  return register_bits > 0 && recorded >= std::ldexp(1.0, register_bits - 1)
             ? recorded - std::ldexp(1.0, register_bits)
             : recorded;
}

std::optional<UnitScale> unit_scale(Quantity quantity, std::string_view declared) {
  const std::string name = as_in_table(quantity, declared);
  for (const Unit& unit : units(quantity))
    if (name == unit.name) return unit.scale;
  return from_number(declared);
}

std::string si_unit(Quantity quantity, std::string_view written) {
  const std::vector<Unit>& known = units(quantity);
  const std::string declared = as_in_table(quantity, written);
  const auto named = [&](const Unit& unit) { return declared == unit.name; };
  if (declared == "%" || declared == "permille" || std::none_of(known.begin(), known.end(), named)) return "";
  for (const char* unit : {"N m", "N", "A", "V", "rad", "m", "s"})
    if (declared.ends_with(unit) && unit_scale(quantity, unit)) return unit;
  return "";
}

std::vector<std::string> unit_names(Quantity quantity) {
  std::vector<std::string> names;
  for (const Unit& unit : units(quantity)) names.emplace_back(unit.name);
  return names;
}

std::string known_units(Quantity quantity) {
  std::string names;
  for (const Unit& unit : units(quantity)) names += std::string(unit.name) + ", ";
  return fmt::format("{}or a number ({} per recorded unit)", names, units(quantity).front().name);
}

}  // namespace gapscope

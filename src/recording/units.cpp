#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <numbers>
#include <vector>

#include "recording/unit_names.h"

namespace gapscope {
namespace {

struct Unit {
  const char* name;
  UnitScale scale;
  const char* si;  ///< what a number of it is in then; "" of a share of some full scale
};

constexpr double kPi = std::numbers::pi;
constexpr double kGravity = 9.80665, kPound = 0.45359237, kInch = 0.0254;  ///< [m/s²], [kg], [m]
constexpr UnitScale kOne, kMilli{1.0, 1e3}, kMicro{1.0, 1e6}, kNano{1.0, 1e9}, kKilo{1e3, 1.0},
    kPercent{1.0, 100.0};

/// The first one is that of SI. Current, voltage and a duty serve both kinds of axes:
/// torque_constant makes them one.
const std::vector<Unit>& units(Quantity quantity) {
  static const std::vector<Unit> time = {{"s", kOne, "s"},           {"ms", kMilli, "s"},
                                         {"us", kMicro, "s"},        {"ns", kNano, "s"},
                                         {"100ns", {1.0, 1e7}, "s"}, {"min", {60.0, 1.0}, "s"}};
  static const std::vector<Unit> angle = {
      {"rad", kOne, "rad"},           {"mrad", kMilli, "rad"},
      {"deg", {kPi, 180.0}, "rad"},   {"arcmin", {kPi, 180.0 * 60.0}, "rad"},
      {"rev", {2 * kPi, 1.0}, "rad"}, {"arcsec", {kPi, 180.0 * 3600.0}, "rad"}};
  static const std::vector<Unit> length = {{"m", kOne, "m"},    {"cm", kPercent, "m"},
                                           {"mm", kMilli, "m"}, {"um", kMicro, "m"},
                                           {"nm", kNano, "m"},  {"in", {kInch, 1.0}, "m"}};
  static const std::vector<Unit> torque = {{"N m", kOne, "N m"},
                                           {"mN m", kMilli, "N m"},
                                           {"kN m", kKilo, "N m"},
                                           {"N cm", kPercent, "N m"},
                                           {"N mm", kMilli, "N m"},
                                           {"lbf in", {kPound * kGravity * kInch, 1.0}, "N m"},
                                           {"lbf ft", {kPound * kGravity * 12.0 * kInch, 1.0}, "N m"},
                                           {"ozf in", {kPound * kGravity * kInch, 16.0}, "N m"},
                                           {"kgf cm", {kGravity, 100.0}, "N m"},
                                           {"A", kOne, "A"},
                                           {"mA", kMilli, "A"},
                                           {"V", kOne, "V"},
                                           {"mV", kMilli, "V"},
                                           {"%", kPercent, ""},
                                           {"permille", kMilli, ""}};
  static const std::vector<Unit> force = {{"N", kOne, "N"},
                                          {"mN", kMilli, "N"},
                                          {"kN", kKilo, "N"},
                                          {"lbf", {kPound * kGravity, 1.0}, "N"},
                                          {"kip", {1e3 * kPound * kGravity, 1.0}, "N"},
                                          {"kgf", {kGravity, 1.0}, "N"},
                                          {"A", kOne, "A"},
                                          {"mA", kMilli, "A"},
                                          {"V", kOne, "V"},
                                          {"mV", kMilli, "V"},
                                          {"%", kPercent, ""},
                                          {"permille", kMilli, ""}};
  static const std::vector<Unit> voltage = {{"V", kOne, "V"}, {"mV", kMilli, "V"}};
  static const std::vector<Unit> turning = {{"rad/s", kOne, "rad/s"},
                                            {"deg/s", {kPi, 180.0}, "rad/s"},
                                            {"rpm", {kPi, 30.0}, "rad/s"},
                                            {"rev/s", {2 * kPi, 1.0}, "rad/s"}};
  static const std::vector<Unit> sliding = {{"m/s", kOne, "m/s"},
                                            {"mm/s", kMilli, "m/s"},
                                            {"m/min", {1.0, 60.0}, "m/s"},
                                            {"mm/min", {1.0, 6e4}, "m/s"},
                                            {"in/s", {kInch, 1.0}, "m/s"}};
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
    case Quantity::kTurning:
      return turning;
    case Quantity::kSliding:
      return sliding;
  }
  return time;
}

/// Of a torque's unit the sign between its two is written in many ways; the table has the blank.
std::string as_in_table(Quantity quantity, std::string_view declared) {
  if (quantity == Quantity::kTorque)
    for (const std::string_view arm : {"mm", "cm", "m"})
      for (const std::string_view sign : {"", ".", "*", "·", "⋅", "-"}) {
        const std::string end = fmt::format("N{}{}", sign, arm);
        if (!declared.ends_with(end)) continue;
        return fmt::format("{}N {}", declared.substr(0, declared.size() - end.size()), arm);
      }
  return std::string(declared);
}

std::optional<UnitScale> from_number(std::string_view text) {
  constexpr double kSmallest = 1e-15, kLargest = 1e15;
  double value = 0.0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (problem != std::errc() || end != text.data() + text.size()) return {};
  if (!(value >= kSmallest && value <= kLargest)) return {};
  return UnitScale{value, 1.0};
}

}  // namespace

double RegisterForm::number(double recorded) const {
  if (sign_bit > 0 && recorded >= std::ldexp(1.0, sign_bit)) return std::ldexp(1.0, sign_bit) - recorded;
  if (bits > 0 && recorded >= std::ldexp(1.0, bits - 1)) return recorded - std::ldexp(1.0, bits);
  return recorded - offset;
}

std::optional<UnitScale> unit_scale(Quantity quantity, std::string_view declared) {
  const std::string name = as_in_table(quantity, declared);
  for (const Unit& unit : units(quantity))
    if (name == unit.name) return unit.scale;
  return from_number(declared);
}

std::string si_unit(Quantity quantity, std::string_view written) {
  const std::string declared = as_in_table(quantity, written);
  for (const Unit& unit : units(quantity))
    if (declared == unit.name) return unit.si;
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

#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace gapscope {

/// What one unit of a recorded column is in SI: SI = recorded · factor / divisor. Two numbers, so that 7 ms
/// are 0.007 s to the last bit.
struct UnitScale {
  double factor = 1.0;
  double divisor = 1.0;
  int register_bits =
      0;  ///< of a register that holds a signed number and was read as an unsigned one; 0: none
  double operator()(double recorded) const { return as_signed(recorded) * factor / divisor; }
  double as_signed(double recorded) const;  ///< two's complement: 65535 of 16 bits is -1
};

/// What a column measures. The input of a drive has its own quantities: a torque, a force or what makes one.
enum class Quantity { kTime, kAngle, kLength, kTorque, kForce, kVoltage };

/// The scale of a declared unit: a name ("ms", "deg", "mN m"), or how much SI one recorded unit is, as a
/// number > 0. Nothing for any other text.
std::optional<UnitScale> unit_scale(Quantity quantity, std::string_view declared);

/// The unit of SI in which a declared one is read: "A" of "mA". Empty for a number, and for a share of some
/// full scale (%).
std::string si_unit(Quantity quantity, std::string_view declared);

/// What may be declared, for messages: "s, ms, us, ns, or a number (s per recorded unit)".
std::string known_units(Quantity quantity);

}  // namespace gapscope

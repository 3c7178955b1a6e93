#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace gapscope {

/// How a register of a drive holds a signed number that was read as an unsigned one; all 0: it is the number.
struct RegisterForm {
  int bits = 0;         ///< of two's complement: 65535 of 16 is -1
  int sign_bit = 0;     ///< above the size, counted from 0: 1034 with bit 10 is -10
  double offset = 0.0;  ///< the register where the number is 0

  double number(double recorded) const;
  bool is_one() const { return bits > 0 || sign_bit > 0 || offset != 0.0; }
  bool operator==(const RegisterForm&) const = default;
};

/// What one unit of a recorded column is in SI: SI = recorded · factor / divisor. Two numbers, so that 7 ms
/// are 0.007 s to the last bit.
struct UnitScale {
  double factor = 1.0;
  double divisor = 1.0;
  RegisterForm form = {};  ///< of the register that was recorded
  double operator()(double recorded) const { return form.number(recorded) * factor / divisor; }
};

/// What a column measures. The input of a drive has its own quantities: a torque, a force or what makes one.
/// The last two are speeds.
enum class Quantity { kTime, kAngle, kLength, kTorque, kForce, kVoltage, kTurning, kSliding };

/// The scale of a declared unit: a name ("ms", "deg", "mN m"), or how much SI one recorded unit is, as a
/// number > 0. Nothing for any other text.
std::optional<UnitScale> unit_scale(Quantity quantity, std::string_view declared);

/// The unit of SI in which a declared one is read: "A" of "mA". Empty for a number, and for a share of some
/// full scale (%).
std::string si_unit(Quantity quantity, std::string_view declared);

/// What may be declared, for messages: "s, ms, us, ns, or a number (s per recorded unit)".
std::string known_units(Quantity quantity);

}  // namespace gapscope

#pragma once

#include <functional>
#include <numbers>
#include <optional>
#include <string>

#include "gapscope/base/coordinates.h"
#include "gapscope/base/fields.h"
#include "gapscope/recording/recording_file.h"

namespace gapscope {

/// `encoder: side:` – which bodies have one. With both, that of the motor estimates and that of the load
/// validates.
enum class EncoderSides { kMotor, kLoad, kBoth };

const char* to_string(EncoderSides sides);  ///< "motor", "load", "both"

/// `encoder:` – what its sheet says, on its own side of a gear.
struct EncoderConfig {
  std::optional<int> bits;  ///< counts per revolution = 2^bits
  double quantum = 0.0;     ///< [rad], from either key; 0: not given
  EncoderSides sides = EncoderSides::kMotor;
  int line = 0;  ///< of `side:`

  /// Whose position the estimators read.
  EncoderSide side() const { return sides == EncoderSides::kLoad ? EncoderSide::kLoad : EncoderSide::kMotor; }

  static double quantum_of(int bits) { return 2.0 * std::numbers::pi / static_cast<double>(1ull << bits); }
};

/// `recording: units:` as it is written there; empty: s, rad (m), and u as it was recorded. Each is a name
/// (see known_units()) or a number; the position may be in counts, of which encoder: says how large one is.
struct DeclaredUnits {
  std::string time, input, position, load_position, voltage, speed;
  void fields(FieldVisitor& v);
};

/// `recording: registers:` – how a drive's register holds a signed number that was read as an unsigned one:
/// bits of two's complement (`16`), or `{sign_bit: 10}` or `{offset: 2048}`.
struct RegisterForms {
  RegisterForm input, position, load_position;
};

/// `recording: gear_ratio:` – turns of the axis whose position was recorded for one turn of the axis that the
/// model, the gap and all estimates are of; negative where the two turn against each other.
struct GearRatios {
  double position = 1.0;
  double load_position = 1.0;
  void fields(FieldVisitor& v);
};

/// What units, registers and gears make of the columns. A unit of a speed is that of the column of the
/// position, which then has the speed.
/// @param refuse  is told the key ("position") whose unit is not known, and what was expected; does not
/// return
ColumnScales declared_scales(const DeclaredUnits& units, const RegisterForms& registers,
                             const GearRatios& gear, const EncoderConfig& encoder, Coordinates coordinates,
                             const std::function<void(const char* key, const std::string& expected)>& refuse);

}  // namespace gapscope

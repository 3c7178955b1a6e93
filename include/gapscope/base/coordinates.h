#pragma once

#include <string>

namespace gapscope {

/// Along what a drive moves (`coordinates:` of a configuration). Numbers are computed alike for both; the
/// words and the units in which they are told are those of a rotation or of a translation. All code speaks of
/// a rotation, in SI units; whoever talks to people asks here.
class Coordinates {
 public:
  enum Kind : char { kRotation, kTranslation };

  constexpr Coordinates(Kind kind = kRotation) : kind_(kind) {}

  constexpr bool rotational() const { return kind_ == kRotation; }
  const char* name() const { return rotational() ? "rotation" : "translation"; }

  const char* position_unit() const { return rotational() ? "rad" : "m"; }
  const char* torque_unit() const { return rotational() ? "N m" : "N"; }
  const char* torque_word() const { return rotational() ? "torque" : "force"; }

  /// A unit of a rotational drive ("N m s/rad") as it is here: for a translation in metres ("N s/m").
  std::string unit(const std::string& rotational_unit) const;
  /// The same, typeset: "N·m", "kg m²"; nothing for "-".
  std::string shown_unit(const std::string& rotational_unit) const;
  /// Words whose rotational units stand in brackets, "{:.3g} [rad]", with those of this drive instead.
  /// Brackets around a number are left as they are.
  std::string with_units(const std::string& words) const;
  /// A length of the motion, in thousandths: "18.8 mrad"; "-" for NaN.
  std::string thousandths(double position) const;

  friend constexpr bool operator==(Coordinates a, Coordinates b) { return a.kind_ == b.kind_; }

 private:
  Kind kind_;
};

}  // namespace gapscope

#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "independent_plant/random_drive.h"

namespace gapscope::independent_plant {

enum class Needs {
  kNothing,
  kContact,  ///< a load behind a spring or a gap
  kGap,
  kNoGap,  ///< `backlash`, where the nominal drive has none
};

/// What the sizes of effects are relative to, as the drive moves without them.
struct MotionScale {
  double torque = 0.0;  ///< peak [N·m]
  double input = 0.0;   ///< peak [unit of u]
  double travel = 0.0;  ///< of the motor, peak to peak [rad]
  double speed = 0.0;   ///< of the motor, peak [rad/s]
  double period = 0.0;  ///< of the excitation [s]
  double record = 0.0;  ///< duration [s]
  double quantum = 0.0;
};
/// Of what was driven and recorded; the motion as it truly was.
MotionScale scale_of_motion(const BlindCase& c, const BlindRun& run, double period);

struct EffectScale;  // that, with the severity and what is drawn

/// What else there is to know of an effect.
struct EffectTraits {
  bool of_the_bearing = false;  ///< a law of the one bearing that a drive has: only one of them at a time
  bool another_law = false;     ///< of another functional form than the catalogue's
  double (*cycles_per_turn)(const BlindCase&) = nullptr;  ///< as given, where it is not one
};

/// An effect that a case can be given by name.
struct DrawnEffect {
  std::string_view name;  ///< identifier of the catalogue, or a name of its own
  bool in_catalogue;
  Needs needs;
  void (*give)(BlindCase&, EffectScale&);
  EffectTraits traits = {};
};

/// All effects: the catalogue's in its order, then those outside.
std::span<const DrawnEffect> effect_entries();

/// nullptr if there is none of that name.
const DrawnEffect* find_drawn_effect(std::string_view name);

/// Whether the effect has a place in the drive.
bool can_have(const BlindDrive& drive, const DrawnEffect& entry);

/// Adds one effect to the case. Severity 0 is weak (2–3 % of the torque, a tenth of the gap and the like), 1
/// strong (20–30 %, most of the gap), geometric in between; signs, phases, periods and times are drawn from
/// the seed. Sizes are relative to the case's own peak torque, travel, speed, period and encoder.
/// @throws std::logic_error for an unknown name or an effect that the drive cannot have.
void give_effect(BlindCase& c, std::string_view name, double severity, std::uint64_t seed);

/// The same for a drive that its excitation does not drive.
void give_effect(BlindCase& c, std::string_view name, double severity, std::uint64_t seed,
                 const MotionScale& scale);

}  // namespace gapscope::independent_plant

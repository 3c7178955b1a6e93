#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <string_view>

#include "gapscope/plant/drive.h"

namespace gapscope {

constexpr int kMostEffectParameters = 14;

enum class EffectSide { kMotor, kLoad, kCommand, kContact, kSensor };
const char* to_string(EffectSide side);  ///< "motor", "load", "command", "contact", "sensor"

/// What the bounds of a parameter are measured in: never absolute, always of the drive and the recording.
enum class Scale {
  kOne,              ///< plain numbers and angles
  kLevel,            ///< plain numbers, shares of the effect's first parameter
  kPeakTorque,       ///< Km max|u| [N m]
  kPeakInput,        ///< max|u|
  kPeakSpeed,        ///< largest motor speed of the recording [rad/s]
  kTorquePerSpeed,   ///< peak torque over peak speed
  kTorquePerSpeed2,  ///< peak torque over peak speed squared
  kPeakPower,        ///< peak torque times peak speed [W]
  kTravel,           ///< range of x1 in the recording [rad]
  kQuantum,          ///< of the encoder [rad]
  kGap,              ///< nominal backlash gap [rad]
  kGapPerRecord,     ///< nominal gap over the duration [rad/s]
  kStiffness,        ///< nominal contact stiffness [N m/rad]
  kPenetration,      ///< peak torque over nominal contact stiffness [rad]
  kContactDamping,   ///< nominal contact damping, at least a tenth of √(k m1) [N m s/rad]
  kSample,           ///< sampling interval [s]
  kRecord,           ///< duration [s]
  kPerRecord,        ///< one cycle over the duration [Hz]
  kPerTravel,        ///< one cycle over the travel [1/rev]
};

/// What the scales are measured on.
struct ScaleContext {
  double peak_input = 1.0;
  double peak_speed = 1.0;  ///< [rad/s]
  double travel = 1.0;      ///< [rad]
  double quantum = 1e-6;    ///< [rad]
  double dt = 1e-3;         ///< [s]
  double duration = 1.0;    ///< [s]
  DriveParameters<double> nominal;
};
double scale_value(Scale scale, const ScaleContext& context);

struct EffectParameterSpec {
  const char* key;
  const char* unit;
  double absent;  ///< value at which the effect vanishes, or a neutral one, in units of the scale
  double low;     ///< bounds, in units of the scale
  double high;
  Scale scale;
  bool held = false;    ///< a search leaves it at its neutral value where nothing else is known of it
  const char* of = "";  ///< of a ratio that says how much there is of the effect: "of the load's torque"
};

/// Parameters of an effect in units of their scales; NaN: not known beforehand.
using EffectStart = std::array<double, kMostEffectParameters>;

/// How the search for an effect's parameters begins.
enum class StartSearch {
  kListed,            ///< at its `starts`; without any at a tenth of its upper bounds
  kSine,              ///< there, and at the amplitude and phase that the response to a small one suggests
  kTorqueLines,       ///< at the lines of the residual torque over the motor angle
  kTorqueShareLines,  ///< at those of the residual torque as a share of the drive's torque
};

/// What orders the torque that an effect leaves where it is not modelled.
enum class ResidualPattern { kAngle, kDirection, kSpeed, kInput, kTime, kInputSteps, kCounts, kMode };
/// "angle", "direction", ..., "input_steps", "counts", "mode"
const char* to_string(ResidualPattern pattern);

enum class ContactPhase { kGap, kEngagement, kImpact };
const char* to_string(ContactPhase phase);  ///< "gap", "engagement", "impact"

/// What a drive must have for an effect to have a place in it.
enum class EffectNeeds {
  kNothing,
  kNoGap,     ///< a model without one: no load, or a gap that is fixed at zero
  kContact,   ///< a compliant contact
  kGap,       ///< a load behind a gap
  kFreeLoad,  ///< no output that is held; without a load it acts on the one inertia
};

/// What turns once in the period of an effect for which no other period is given.
enum class Shaft { kNone, kMotor, kLoad };

/// How often the motor and the load turn along 2 pi of x1 and of x2; NaN along a slide, where nothing says
/// how far one turn is.
struct ShaftTurns {
  double motor = 1.0, load = 1.0;

  static constexpr ShaftTurns of_a_slide() {
    return {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};
  }
  double of(Shaft shaft) const;  ///< NaN for none
};

struct EffectLaws;

/// One row of the catalogue: all that is known of an effect but its law, which effect_hooks.h has.
struct EffectEntry {
  const char* name;
  EffectSide side;
  const char* law;
  std::span<const EffectParameterSpec> parameters;
  std::span<const char* const> look_alikes;  ///< that one motor encoder can hardly tell from it
  ResidualPattern follows;
  std::span<const ContactPhase> acts_in;  ///< where it follows the mode: the phases of contact that show it
  EffectNeeds needs;
  int stands_for;        ///< a drive parameter (place::) that says the same where it is fitted; -1: none
  const char* contains;  ///< the simpler effect that is a special case of it; nullptr: none
  StartSearch start_search;
  std::span<const EffectStart> starts;  ///< magnitudes and phases at which its search begins
  const EffectLaws* laws;
  Shaft turns_with = Shaft::kNone;  ///< a period that is not given is one turn of it

  /// The place of `periods_per_turn` among the parameters, which may be written as `period_rad` = 2 pi over
  /// it; -1: it repeats along no angle, or its period is a parameter as it is.
  int period_at() const;
};

/// What a parameter is where nothing is known of it: one turn for a period, else where the effect is absent.
/// NaN where that depends on the recordings, or where nothing turns.
double neutral_value(const EffectEntry& entry, std::size_t parameter, const ShaftTurns& turns);

/// The catalogue, sorted by name.
std::span<const EffectEntry* const> effect_table();

/// The free-form laws of last resort, sorted by name: functions of speed, position or input that stand for no
/// cause. Where a drive lacks something, they are laid over what no effect of the catalogue explains.
std::span<const EffectEntry* const> last_resort_table();

/// Of the catalogue or of the laws of last resort; nullptr if there is none of that name.
const EffectEntry* find_effect(std::string_view name);

/// The simpler effect that this one contains; nullptr if there is none.
const EffectEntry* contained_effect(const EffectEntry& entry);

}  // namespace gapscope

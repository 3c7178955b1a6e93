#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "base/random.h"
#include "gapscope/base/statistics.h"
#include "implant/smoothed_motion.h"

namespace gapscope::internal::implant {

/// The drive that the recordings are of, as far as a law needs it.
struct Receiver {
  double torque_constant = 1.0;  ///< [N m per unit of u]
  double inertia = kNaN;         ///< of the motor [kg m²]
  double damping = 0.0;          ///< viscous, of the motor [N m s]
  bool rotates = true;           ///< positions are angles
  bool one_body = true;          ///< no load behind a contact, and none that is held
};

/// A recording with the motion behind it. The recording must outlive it.
struct Subject {
  const Recording* recording = nullptr;
  SmoothedMotion motion;
};

/// What sizes are relative to, over all recordings of a case.
struct CaseScale {
  double input_rms = 0.0;   ///< [unit of u]
  double peak_input = 0.0;  ///< [unit of u]
  double peak_speed = 0.0;  ///< [rad/s]
  double rms_speed = 0.0;   ///< [rad/s]
  double travel = 0.0;      ///< least of a recording [rad]
  double shortest = 0.0;    ///< duration [s]
  double step = 0.0;        ///< longest mean time step [s]
  double quantum = 0.0;     ///< coarsest of an encoder; 0: not known [rad]
};
CaseScale scale_of(std::span<const Subject> subjects);

constexpr std::size_t kMostValues = 4;
using Values = std::array<double, kMostValues>;  ///< of a law; the first is its size

struct ValueName {
  const char* key;
  const char* unit;
};

/// What a torque law reads.
struct TorquePoint {
  MotionPoint at;
  int direction = 0;    ///< sign of the speed; 0: the drive stands
  double moved = 0.0;   ///< since the point before [rad]
  double lasted = 0.0;  ///< since the point before [s]
};

/// How a law is put into a recording.
enum class Way {
  kTorque,   ///< by u' = u − τ/Km, τ meant over each step of the held input
  kCommand,  ///< by the inverse of its law in u
  kSensor,   ///< in the positions
};

enum class Asks { kNothing, kRotation, kOneBody, kOneRotatingBody, kQuantum };

struct SizeRange {
  double weak = 0.0, strong = 0.0;
};

/// One row of the table of what can be implanted. Of the functions only that of its way is there.
struct ImplantLaw {
  const char* name;  ///< of the catalogue, or a name of its own
  bool in_catalogue;
  Way way;
  Asks asks;
  std::array<ValueName, kMostValues> values;  ///< those without a key are not used
  /// All values but the first.
  void (*draw)(Values& v, const CaseScale& s, const Receiver& drive, std::mt19937_64& g);
  /// Torque on the motor [N m], proportional to the first value. `memory` begins at 0 in every recording.
  double (*torque)(const TorquePoint& p, const Values& v, const Receiver& drive, double& memory);
  /// u', or x1' in u's place. A drawn number that differs between recordings comes from `own`.
  std::vector<double> (*change)(const Subject& s, const Values& v, std::mt19937_64& own);
  /// First values at which it hardly shows and at which it shows most, of those that are not a torque.
  SizeRange (*range)(const CaseScale& s);
  /// The first value of a law that makes no torque that one could measure it by, from a size of 0 to 1.
  double (*by_size)(double size, const CaseScale& s);
};

// The rows by their way, those of the catalogue first.
std::span<const ImplantLaw> torque_laws();
std::span<const ImplantLaw> command_laws();
std::span<const ImplantLaw> sensor_laws();
std::vector<const ImplantLaw*> implant_laws();              ///< all of them, those of the catalogue first
const ImplantLaw* find_implant_law(std::string_view name);  ///< nullptr if there is none

/// Why a drive cannot have it, in words; empty: it can.
std::string why_not(std::string_view effect, const Receiver& drive, double quantum);

}  // namespace gapscope::internal::implant

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "gapscope/reference/fit.h"
#include "independent_plant/drive.h"

namespace gapscope::test {

enum class Driven {
  kLoop,           ///< by a controller that follows a reference
  kConstantSpeed,  ///< the same, at one speed
  kOpen,           ///< by a given command
  kCommanded,      ///< as kLoop, by a servo that tells target, position and volts alone
  kLevels,         ///< by a controller, forth and back at one to three speeds
  kBelt,           ///< as kLoop, with the load on a spring
};

/// A drive of one body on the independent plant, which has an effect that its sheet does not tell of.
struct LoopCase {
  std::uint64_t seed = 0;
  std::string effect;  ///< "none" without
  double missing =
      0.0;  ///< rms of the held-out torque that inertia and viscous damping leave, over the input's
  std::string set_up;  ///< in words
  int redrawn = 0;     ///< drives of this seed that stood still under their effect and are no case
  double periods = kNaN, amplitude = kNaN;  ///< of a line, see level_case()
  double spring_hz = kNaN;                  ///< of a load on a spring, see belt_case()
  independent_plant::BlindDrive drive;
  Recording train, held_out;
  std::optional<DriveController> controller;  ///< that made u of the commands
  ReferenceModel sheet;  ///< inertia and viscous damping to be estimated, off by up to 30 %
};

/// Effects that a drive of one body can have and that such recordings can show.
const std::vector<std::string>& loop_effects(Driven driven);

/// A drive with detents or torque ripple (cogging_torque, torque_ripple), at one to three speeds to either
/// side (3 to 15 rad/s, another one held out): they pass at 0.3 to 3 times the band that the torque balance
/// has without them, and are 5 to 50 % of the input's rms (ripple: 5 to 30 % of the torque); half of the
/// drives have Coulomb friction, too. The rest as in loop_case(), from 14 bit and 500 Hz.
LoopCase level_case(const std::string& effect, std::uint64_t seed);

/// A drive whose load hangs on a spring (a belt, a soft shaft), told as one body: 30 to 75 % of its inertia
/// behind a spring on which the load swings, beside a motor that is held, at 0.3 to 1 times the band that the
/// torque balance has of the rigid drive, damping ratio 0.02 to 0.2; half of the drives have Coulomb friction
/// at the motor, half at the load. One whose controller shakes it, or whose spring leaves less than a tenth
/// of the held-out torque, is drawn anew. The rest as in loop_case().
LoopCase belt_case(std::uint64_t seed);

/// Drawn from the seed: inertia 4e-4 to 4e-3 kg·m², J/d 0.1 to 2 s; an encoder of 12 bit read at 200 Hz, 14
/// at 500, 16 at 1000 or 20 at 2000 Hz; speed loops that cross 1 at 3 to 20 Hz, P or PI, with or without a
/// position loop, with dead time and a limit; references of 2 to 15 rad and 3 to 15 rad/s, another one for
/// what is held out; recordings of 8 s that begin in motion. A servo that tells its target has 12 to 16 bit
/// at 100 to 500 Hz, a P of the position (J/d 0.03 to 0.15 s) or a cascade of two, a delay up to a sample,
/// and a supply that sags by 5 to 25 % at the limit, read in steps of 1 % or as given; all but the effect is
/// known of it. The effect's size is chosen for `missing` to be a log-uniform share from 10 to 60 %, as near
/// as its severity can bring it. A drive that then travels less than a tenth of its way without the effect,
/// in either recording, is drawn anew.
LoopCase loop_case(Driven driven, const std::string& effect, std::uint64_t seed, double volt_step = 0.01);

}  // namespace gapscope::test

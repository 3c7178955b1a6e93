#pragma once

#include <string>
#include <vector>

#include "gapscope/base/coordinates.h"
#include "gapscope/base/statistics.h"

namespace gapscope {

/// How a target says a part of the drive.
enum class Fidelity {
  kExact,
  kApproximate,
  kLeftOut,
};

/// One number or effect of the drive in the target.
struct CarriedPart {
  std::string part;  ///< a key of model: parameters:, or an effect of the catalogue
  Fidelity fidelity = Fidelity::kLeftOut;
  std::string how;  ///< by what it is said there, or why it is not and what would help
};

/// The target under the same input, at one step of its engine, against gapscope's own simulator.
struct TargetError {
  std::string integrator;
  double step = kNaN;  ///< [s]; NaN: the target has none
  double rms = kNaN;   ///< of x1 [rad]; NaN where it diverges
  double max = kNaN;   ///< [rad]
  bool diverges = false;
  /// Bounded, but any small difference grows: the contact chatters, and the error is good for its size only.
  bool unstable = false;
  bool within_encoder = false;  ///< rms within the encoder's floor
};

/// What a target's step may be, of one integrator.
struct StepLimits {
  std::string integrator;
  /// The target is off the model by more at any step: the error meant below is then that to its own motion at
  /// the finest listed step.
  bool against_itself = false;
  double largest = kNaN;  ///< at which the error stays below a tenth of the travel [s]; NaN: not looked for
  /// The largest listed one at which, and below, it is within the encoder's floor [s]; NaN: none.
  double within_encoder = kNaN;
};

/// What became of a drive in a target's format, and how far the target then is from the model.
struct Certificate {
  std::string name, version, format;
  Coordinates coordinates;
  std::vector<std::string> files;   ///< beside the certificate
  std::vector<CarriedPart> parts;   ///< numbers of the drive first, then effects as configured
  std::string input;                ///< under which the errors were found, in words
  double duration = kNaN;           ///< of it [s]
  double travel = kNaN;             ///< of x1 under it, peak to peak [rad]
  double encoder_floor = kNaN;      ///< rounding of the encoder, quantum/√12 [rad]
  std::vector<TargetError> errors;  ///< by integrator and step
  std::vector<StepLimits> limits;   ///< by integrator
  double default_error = kNaN;      ///< rms with what the format takes for granted of friction [rad]
  std::string own_file;             ///< what to change in a model that has the joint already; empty: not told
  std::vector<std::string> warnings;
  std::string configuration;  ///< as resolved
};

/// "exact", "approximate", "left out"
const char* to_string(Fidelity fidelity);

/// The bytes of certificate.json.
std::string certificate_json(const Certificate& certificate);

/// The same for people: what is carried, how far off, which steps; Markdown.
std::string certificate_text(const Certificate& certificate);

}  // namespace gapscope

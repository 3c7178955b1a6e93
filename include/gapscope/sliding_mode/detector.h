#pragma once

#include <span>

#include "gapscope/recording/recording.h"
#include "gapscope/sliding_mode/gap_estimate.h"

namespace gapscope {

enum class DetectorMethod {
  kAuto,        ///< impacts; where they tell no gap, the lost-motion loop
  kImpact,      ///< impacts alone
  kLostMotion,  ///< the lost-motion loop alone
  kPaper,       ///< one e_x with a bound that is given: the source paper's method, improved
  kLiteral,     ///< one e_x with a bound that is given: S1 to S6 as printed, nothing else
};

/// The YAML's words: "auto", "impact", "lost_motion", "paper", "literal"
const char* to_string(DetectorMethod method);

struct DetectorOptions {
  DetectorMethod method = DetectorMethod::kAuto;
  EncoderSide encoder = EncoderSide::kMotor;
  bool locked = false;  ///< the output is declared not to move, so its load cannot rest or coast
  double bound = 0.0;   ///< L [rad/s²] of the one e_x of kPaper and kLiteral; 0: `auto`, a bank of bounds
  /// Lower end of (13) where a model gave one, for the warning only [rad/s²]; 0: unknown.
  double paper_bound = 0.0;
};

/// The model-free estimate of the backlash gap (Sections II-B to III-C, steps S1–S6), from the motor encoder
/// alone; from that of the load it reads nothing and says why. Several recordings are never concatenated: the
/// detector runs on each, their events are combined. Bad data is a verdict with a reason, never an exception.
GapEstimate detect_gap(std::span<const MotorTrace> recordings, const DetectorOptions& options = {});

}  // namespace gapscope

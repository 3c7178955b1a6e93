#pragma once

#include "torque_view/screening.h"

namespace gapscope::internal::torque_view {

/// Recordings as they come, and what the caller knows of them.
struct SplitRecordings {
  std::vector<StampedTrace> fit, judge;
  ShaftTurns turns = {};     ///< along 2π; none of a slide
  bool held_output = false;  ///< the load is locked
  bool new_phase = false;    ///< the encoder counts anew in every recording: a line keeps its amplitude only
  Model known = {};          ///< what the nominal model has beside inertia and viscous damping
  std::vector<std::string> closed = {};   ///< effects of the catalogue that are no candidates
  std::vector<std::string> addable = {};  ///< effects that the caller's model can have
  /// Cycles per 2π of what repeats, as a faster observer sees it: there the band may pass it at times only.
  std::vector<double> lines = {};
  int threads = 1;
};

/// What no model can get below, as rms of a torque [unit of u]; NaN where the recordings do not show it.
struct Floors {
  double encoder = kNaN;        ///< J times the acceleration that the noise of the encoder makes in the band
  double repeatability = kNaN;  ///< what of the residual does not come back after a period of the input
  double joint = kNaN;          ///< left of all recordings by one set of coefficients ...
  double each = kNaN;           ///< ... and by one set for each
  double disagreement() const;  ///< √(joint² − each²)
};
/// J times the acceleration that the encoder's noise makes in the band [unit of u].
double encoder_torque_floor(const SplitRecordings& data, double hz, double inertia);
Floors floors_of(const SplitRecordings& data, Bench& bench, const Model& model,
                 const TorqueViewOptions& options);

}  // namespace gapscope::internal::torque_view

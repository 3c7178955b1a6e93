#pragma once

#include <cstddef>
#include <string>

#include "gapscope/sliding_mode/stream_detector.h"

/// The lines of `detect --stream`, each a JSON object with its newline; units in the keys, as in result.json
/// (on a translational axis rad reads m). A number that could not be had is null.
namespace gapscope {

/// {"kind": "settings", ...}, the first line: the version, and how the columns are read.
/// @param configuration  resolved_reading() of the stream, which is told with its SHA-256
std::string settings_line(const std::string& configuration);

/// {"kind": "learnt", ...}: what the first two periods taught, and is frozen from then on.
std::string learnt_line(const LearntFacts& learnt);

/// {"kind": "event", ...}: one passage, with the keys of an event of result.json.
std::string event_line(const GapEvent& event);

/// How much a stream has been told.
struct StreamProgress {
  double until = kNaN;  ///< time of the last sample [s]
  std::size_t samples = 0;
  std::size_t passages = 0;  ///< since the start; the estimate is of the last ones
};

/// {"kind": "summary", ...}: verdict and estimate, with the keys of model_free of result.json.
std::string summary_line(const GapEstimate& estimate, const StreamProgress& progress);

}  // namespace gapscope

#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "gapscope/recording/recording.h"
#include "gapscope/sliding_mode/stream_detector.h"

namespace gapscope {

/// What a stream of a recording tells.
struct Streamed {
  std::vector<GapEvent> events;
  LearntFacts learnt;
  GapEstimate estimate;
};

/// The samples one by one; what is ready is asked for after every `pause` of them.
inline Streamed as_stream(const MotorTrace& trace, std::size_t pause = 1) {
  StreamDetector detector(trace.start, trace.dt, trace.quantum);
  Streamed s;
  const auto take = [&] {
    for (GapEvent& e : detector.take()) s.events.push_back(std::move(e));
  };
  for (std::size_t i = 0; i < trace.size(); ++i) {
    detector.push(trace.u[i], trace.x1[i]);
    if (i % pause == 0) take();
  }
  detector.finish();
  take();
  s.learnt = detector.learnt();
  s.estimate = detector.estimate();
  return s;
}

}  // namespace gapscope

#include "sliding_mode/published/one_bound.h"

#include <algorithm>
#include <vector>

#include "sliding_mode/marks/marks.h"
#include "sliding_mode/published/literal_method.h"
#include "sliding_mode/published/paper_method.h"
#include "sliding_mode/words.h"

namespace gapscope::internal::sliding_mode {

GapEstimate read_recordings_with_bound(std::span<const MotorTrace> recordings,
                                       std::span<const signals::SignalFacts> facts, double bound) {
  std::vector<PaperReading> readings;
  for (std::size_t i = 0; i < recordings.size(); ++i)
    readings.push_back(read_with_bound(recordings[i], facts[i], bound));
  return decide_with_bound(facts, readings);
}

GapEstimate read_recordings_as_printed(std::span<const MotorTrace> recordings,
                                       std::span<const signals::SignalFacts> facts, double bound) {
  std::vector<std::vector<GapEvent>> passages(recordings.size());
  for (std::size_t i = 0; i < recordings.size(); ++i)
    if (facts[i].defect.empty()) passages[i] = passages_as_printed(recordings[i], facts[i], bound);
  return mean_as_printed(facts, passages, bound);
}

Remark bounds_to_try(std::span<const MotorTrace> recordings, std::span<const signals::SignalFacts> facts) {
  const auto usable =
      std::ranges::find_if(facts, [](const signals::SignalFacts& f) { return f.defect.empty(); });
  if (usable == facts.end()) return {};
  std::vector<double> found;
  for (const double bound : bound_grid(*usable, recordings[usable - facts.begin()].dt))
    if (read_recordings_with_bound(recordings, facts, bound).verdict == GapVerdict::kBacklash)
      found.push_back(bound);
  if (found.empty()) return {};
  return found.size() == 1 ? words::bound_to_try(found.front())
                           : words::bounds_to_try(found.front(), found.back());
}

}  // namespace gapscope::internal::sliding_mode

#include "report/true_passages.h"

namespace gapscope::internal::report {

std::vector<TruePassage> true_passages(const ReportView& view, const Interval& interval) {
  std::vector<TruePassage> found;
  if (view.recording == nullptr || view.source != StateSource::kRecorded) return found;
  const std::vector<Mode>& mode = view.recording->mode;
  int flank = 0;
  std::size_t free_since = 0;
  for (std::size_t i = 0; i < mode.size(); ++i) {
    if (mode[i] == Mode::kOneBody) return found;
    if (mode[i] == Mode::kGap) continue;
    const int side = view.state[i] < 0.0 ? -1 : 1;
    if (flank == -side && view.time[i] >= interval.low && view.time[i] <= interval.high)
      found.push_back(
          {view.time[free_since], view.time[i], view.recording->x1[free_since], view.recording->x1[i]});
    flank = side;
    free_since = i + 1;
  }
  return found;
}

}  // namespace gapscope::internal::report

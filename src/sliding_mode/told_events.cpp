#include "sliding_mode/told_events.h"

namespace gapscope::internal::sliding_mode {

GapEvent event_of(const Transition& t) {
  GapEvent event = t.event;
  event.std = t.half_width;
  if (!t.released()) event.t1 = event.x1_t1 = event.std = kNaN;  // where x1 turned tells no loss of contact
  event.accepted = t.refusal == Refusal::kNone;
  if (!event.accepted) event.remark = refusal_text(t.refusal);
  return event;
}

std::vector<GapEvent> events_of_mean(const signals::FoldedMotion& folded,
                                     std::span<const Transition> passages) {
  const double period = folded.dt * static_cast<double>(folded.mean.size());
  const std::size_t shown = folded.periods / 2;
  const double later = (static_cast<double>(shown) - 1.0) * period + 0.5 * folded.dt;
  std::vector<GapEvent> told;
  for (const Transition& passage : passages) {
    GapEvent event = event_of(passage);
    if (!(event.t2 >= folded.start + period && event.t2 < folded.start + 2.0 * period)) continue;
    for (double* t : {&event.t1, &event.t2}) *t += later;  // the mean has the middle of each bin
    for (double* x1 : {&event.x1_t1, &event.x1_t2}) *x1 += folded.offsets[shown] - folded.drift;
    event.periods = static_cast<int>(folded.periods);
    told.push_back(event);
  }
  return told;
}

}  // namespace gapscope::internal::sliding_mode

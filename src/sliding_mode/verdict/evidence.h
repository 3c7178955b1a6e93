#pragma once

#include <optional>
#include <span>
#include <vector>

#include "gapscope/recording/recording.h"
#include "gapscope/sliding_mode/gap_estimate.h"
#include "signals/signal_facts.h"

namespace gapscope::internal::sliding_mode {

/// Of what the standard deviation of a reading is made [rad].
struct Deviations {
  double random = 0.0;      ///< from passage to passage
  double directions = 0.0;  ///< between rising and falling x1
  double recordings = 0.0;  ///< between recordings
  double systematic = 0.0;  ///< where contact is lost and regained, alike in all passages
  double sampling = 0.0;    ///< from one sample to the next
  double noise = 0.0;       ///< of the encoder
  double together() const;
  double beside_directions() const;  ///< of all others
};

/// What one way of looking at the recordings says of a gap: impacts of single passages, all passages
/// together, the lost-motion loop. Whichever it was, conclude() makes the same of it.
struct GapEvidence {
  GapMethod method = GapMethod::kImpact;
  GapQuantity quantity = GapQuantity::kGap;
  double gap = kNaN;  ///< [rad]; NaN: none is read
  Deviations parts;
  double quantum = 0.0;                ///< of the encoder [rad]
  Remark reading;                      ///< how it was read
  Remark against;                      ///< why it is no reading; empty: nothing speaks against it
  double smallest_visible_gap = kNaN;  ///< that is told with it [rad]
  double whole = kNaN;                 ///< of kFirstGap: all gaps together [rad]
  double at_most = kNaN;               ///< no gap is larger; NaN: no such bound [rad]
  bool denies = false;                 ///< no gap above that, and `reading` is why
  std::vector<GapEvent> events;
  std::vector<Remark> warnings;
  std::vector<ReadingTest> tested;
  std::vector<Remark> presumes;
};

/// Half the 95 % interval over the gap: of what is told at all, and of a gap that is told with good trust.
constexpr double kWidest = 0.25, kNarrow = 0.125;

/// Verdict, interval and reason: `none` of what denies a gap, `backlash` where nothing speaks against one
/// that is known closely enough, else `inconclusive` with the reason. The trust is good where every test was
/// passed.
GapEstimate conclude(GapEvidence evidence);

/// Of what each recording reads by itself the closest known; nothing where two contradict each other.
std::optional<GapEvidence> narrowest(std::span<const MotorTrace> recordings,
                                     std::span<const signals::SignalFacts> facts,
                                     std::optional<GapEvidence> (*read)(const MotorTrace&,
                                                                        const signals::SignalFacts&));

}  // namespace gapscope::internal::sliding_mode

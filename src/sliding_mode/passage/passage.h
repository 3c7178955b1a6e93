#pragma once

#include <span>
#include <vector>

#include "gapscope/base/statistics.h"
#include "gapscope/recording/recording.h"
#include "gapscope/sliding_mode/gap_estimate.h"
#include "signals/signal_facts.h"
#include "sliding_mode/marks/marks.h"
#include "sliding_mode/passage/arrival.h"
#include "sliding_mode/passage/refusal.h"

/// The door of this room: what happened is a passage of the gap, or why it is none.
namespace gapscope::internal::sliding_mode {

/// One candidate passage: an impact, and the release before it.
struct Passage {
  GapEvent event;
  Refusal refusal = Refusal::kNone;
  double seen = kNaN, limit = kNaN;  ///< of the test that refused it (refusal.h), where it has a number
  double contrast = 0.0;             ///< abruptness over what the motion before it needs
  double half_width = 0.0;  ///< systematic, 95 %: where the release and the load's travel may lie [rad]
  double speed = 0.0;  ///< at which the gap closes: of the motor before the impact, less the load's [rad/s]
  double acceleration = 0.0;  ///< of the motor in the gap, just before the impact [rad/s²]
  double stiffness = 0.0;     ///< of the contact, over the motor's inertia; 0: rigid [1/s²]
  double load_travel = 0.0;   ///< assumed between t1 and t2 [rad]
  double most = kNaN;         ///< the gap, of a load that kept its speed from wherever it parted [rad]
  double abruptness = 0.0;    ///< of the impact [rad/s²]
  double later = 0.0;         ///< of the most abrupt mark of its sign before the next passage, over that
  double to_later = kNaN;     ///< what x1 goes from t1 to that mark [rad]
  bool dwell = false;         ///< the motor rested before it entered the gap
  bool untold = false;        ///< … and whether that was at its load is not to be seen
  bool by_law = false;        ///< the load's travel is by the law of the engaged flank
  double t1_first = kNaN, t1_last = kNaN;             ///< between which contact was lost [s]
  double t2_half_width = 0.0;                         ///< of half_width, by t2 alone [s]
  bool released() const { return half_width > 0.0; }  ///< both ends of the flight were found
};

/// @param seen, limit  of the test, where it has a number
void refuse(Passage& passage, Refusal refusal, double seen = kNaN, double limit = kNaN);

/// As it is told: without t1 where the release was not found.
GapEvent event_of(const Passage& passage);

/// What an impact is looked at with.
struct PassageContext {
  const MotorTrace& trace;
  const signals::SignalFacts& facts;
  const BankMarks& run;
};

/// The passage that ends in `impact`, the first main event after a change of sign, tested one by one
/// (PassageTest).
/// @param sliding  L_acc, the smallest bound that slides 80 % of the time [rad/s²]
Passage read_passage(const PassageContext& context, const BankEvent& before, const BankEvent& impact,
                     double sliding);

/// What came behind a passage, before the next one: a mark of the same sign.
void see_later(Passage& passage, const MotorTrace& trace, const BankEvent& later);

/// All passages of a recording, read again together where the load moves (coasting.h) or is driven
/// (pushed_load.h).
std::vector<Passage> read_passages(const PassageContext& context, std::span<const BankEvent> events,
                                   double sliding);

}  // namespace gapscope::internal::sliding_mode

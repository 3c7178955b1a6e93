#pragma once

#include <string>
#include <vector>

#include "gapscope/base/statistics.h"

namespace gapscope {

/// One rung of an error budget: a law that was added, jointly refitted with all before it, and what it takes
/// of the missing torque.
struct BudgetRung {
  std::string law;                       ///< in the words of the budget
  std::string effect;                    ///< of the catalogue; empty: it has none that says this
  bool added = false;                    ///< to the model, as an effect
  double before = kNaN, after = kNaN;    ///< rms of the missing torque [N m]
  double share = kNaN;                   ///< 1 − (mean square after)/(before)
  Interval share_ci95;                   ///< from blocks of held-out time
  double alone = kNaN;                   ///< the share that it takes of the nominal model's residual
  double last = kNaN;                    ///< of the residual of all the others: what none of them can say
  double period = kNaN;                  ///< of a torque that repeats with the motor's position [rad]
  std::vector<std::string> rivals = {};  ///< laws that keep its cause open: they would remove nearly as much
};

/// The missing torque from the nominal model down to what no law explains, all as rms in one band
/// of frequencies [N m; N for a translation]. NaN: the drive has a contact that the torque balance depends
/// on.
struct ErrorBudget {
  double band_hz = kNaN;        ///< top of the band
  double input = kNaN;          ///< torque that the input applies
  double nominal = kNaN;        ///< left by the nominal model
  double with_effects = kNaN;   ///< by that with the effects that were added
  double remains = kNaN;        ///< by that with all laws of the rungs
  double encoder = kNaN;        ///< floor: what the encoder's noise makes of the acceleration
  double repeatability = kNaN;  ///< floor: what does not come back after a period of the input
  double records = kNaN;  ///< floor: by how much one set of numbers misses recordings that each fit alone
  std::vector<BudgetRung> rungs;
  std::vector<std::string> uncounted = {};  ///< effects that were added and that with_effects does not have

  bool exists() const;
  double floor() const;  ///< the largest of the three
};

}  // namespace gapscope

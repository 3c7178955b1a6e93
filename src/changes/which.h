#pragma once

#include "changes/drive_report.h"
#include "results/drive_changes.h"

namespace gapscope::internal::changes {

/// Which numbers of the fit differ between two groups of recordings.
///   must   the interval of a number holds what all others of its fit leave open of it: beyond chance, it
///          differs whatever else does. It is named where a joint fit in which it may differ foretells
///          recordings that are left out better than one without (see two_groups.h)
///   may    where those named do not explain all that differs, what alone explains the rest: `one_of`
///   need not  all others
/// 5 % that anything is told of drives that do not differ, half for the numbers each, half for all together.
/// What acts alike but is in neither fit may be what has changed in place of a number that is named.
WhichDiffers which_differs(const DriveReport& first, const DriveReport& now);

}  // namespace gapscope::internal::changes

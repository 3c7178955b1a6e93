#pragma once

#include <optional>
#include <vector>

#include "diagnosis/study.h"
#include "torque_view/ladder.h"

namespace gapscope::internal::diagnosis {

/// What the steps came to.
struct FirstSearch {
  ScoredModel before;
  double alone =
      kNaN;  ///< held-out size without any held-out recording in the fit, where they are in it [floor]
  std::vector<ScoredModel> candidates;        ///< best first; empty at the floor
  std::vector<ScoredModel> excluded_parents;  ///< of the first candidate
  Decision decision;
  std::optional<torque_view::Budget> budget;  ///< of a drive of one body
};

/// A drive that repeats its own motion far worse than its encoder reads cannot be explained to the encoder's
/// floor by any model: the study goes on with its repeatability as the floor and a faster observer.
///
/// Where the fitted recordings are explained and the others are not, they ask too little: the first half of
/// what is held out is then fitted with them, and only the second half judges.
FirstSearch investigate(Study& study);

}  // namespace gapscope::internal::diagnosis

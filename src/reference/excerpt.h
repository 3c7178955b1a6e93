#pragma once

#include <algorithm>
#include <vector>

#include "reference/fit_problem.h"

namespace gapscope::internal::reference {

/// Of the recordings, one after the other: a search on little of them costs little.
inline constexpr double kGrowingShares[] = {0.125, 0.25, 0.5};

/// The same problem on a part of the recordings.
class Excerpt {
 public:
  /// The first share of each recording: few events lie in it, so that its cost has fewer minima.
  Excerpt(const FitProblem& whole, double share) : share_(share), part_(whole) {
    for (const MotorTrace& trace : whole.recordings) {
      const auto samples = static_cast<std::size_t>(share * static_cast<double>(trace.size()));
      traces_.push_back(part(trace, 0, std::min(std::max(samples, kFewest), trace.size())));
    }
    part_.recordings = traces_;
  }

  /// The samples from `first` to before `last` of recording r alone.
  Excerpt(const FitProblem& whole, std::size_t r, std::size_t first, std::size_t last) : part_(whole) {
    double samples = 0.0;
    for (const MotorTrace& trace : whole.recordings) samples += static_cast<double>(trace.size());
    share_ = static_cast<double>(last - first) / samples;
    traces_.push_back(part(whole.recordings[r], first, last - first));
    part_.floors = {whole.floors[r]};
    part_.recordings = traces_;
  }

  Excerpt(const Excerpt&) = delete;
  Excerpt& operator=(const Excerpt&) = delete;

  const FitProblem& problem() const { return part_; }
  /// Simulations of the part in those of the whole.
  double of_whole(double simulations) const { return share_ * simulations; }

 private:
  static constexpr std::size_t kFewest = 200;  ///< samples

  double share_ = 0.0;
  std::vector<MotorTrace> traces_;
  FitProblem part_;
};

}  // namespace gapscope::internal::reference

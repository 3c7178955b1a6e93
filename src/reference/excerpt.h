#pragma once

#include <algorithm>
#include <vector>

#include "reference/fit_problem.h"

namespace gapscope::internal {

/// The same problem on the first share of each recording. Few events lie in it, so that its cost has fewer
/// minima and costs less to have. What is simulated is counted on the whole problem, in its length.
class Excerpt {
 public:
  Excerpt(const FitProblem& whole, double share) : whole_(whole), share_(share), part_(whole) {
    for (MotorTrace trace : whole.recordings) {
      const auto samples = static_cast<std::size_t>(share * static_cast<double>(trace.size()));
      const std::size_t kept = std::min(std::max(samples, kFewest), trace.size());
      trace.u = trace.u.first(kept);
      trace.x1 = trace.x1.first(kept);
      traces_.push_back(trace);
    }
    part_.recordings = traces_;
    part_.simulations = 0.0;
  }
  ~Excerpt() { whole_.simulations += share_ * part_.simulations; }
  Excerpt(const Excerpt&) = delete;
  Excerpt& operator=(const Excerpt&) = delete;

  const FitProblem& problem() const { return part_; }

 private:
  static constexpr std::size_t kFewest = 200;  ///< samples

  const FitProblem& whole_;
  double share_;
  std::vector<MotorTrace> traces_;
  FitProblem part_;
};

}  // namespace gapscope::internal

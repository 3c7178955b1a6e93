#pragma once

#include <map>
#include <string>
#include <vector>

#include "gapscope/base/statistics.h"
#include "results/run_result.h"

namespace gapscope::test {

/// What one of reading, fit and card says of the gap of one drive.
struct ToldGap {
  AnswerTrust trust = AnswerTrust::kNone;
  double gap = kNaN;    ///< NaN: no number is told [rad]
  Interval ci95;        ///< of a number without one: none [rad]
  double bound = kNaN;  ///< no gap is larger, where none is told [rad]
  std::string why;      ///< code of what the trust rests on, or of why nothing is told
  bool tells() const { return gap == gap; }
  bool bounds() const { return !tells() && bound == bound; }
};

ToldGap told_by(const GapEstimate& reading);
ToldGap told_by(const FitSummary& fit);
ToldGap told_by(const Answer& card);

/// How a number stands to what is true, smallest to largest over a turn.
enum class Verity { kHolds, kMisses, kMissesByFar };

/// By far: more than twice the half width of the interval, and more than 5 % of the gap; of a drive without a
/// gap, more than twice the half width.
Verity verity_of(const ToldGap& told, const Interval& truth);

/// Counts of what one estimator says over many drives.
class TrustCount {
 public:
  void add(const ToldGap& told, const Interval& truth);
  /// A block of lines, each headed by the name: told by trust, held with Wilson's limits, bounds, refusals.
  std::string text(const std::string& name) const;

 private:
  struct Numbers {
    int told = 0, held = 0, missed = 0, by_far = 0;
    std::vector<double> errors;  ///< [%]
  };
  std::map<AnswerTrust, Numbers> numbers_;
  int drives_ = 0, bounds_ = 0, bounds_held_ = 0;
  std::map<std::string, int> refusals_;
};

/// "gap 19.1 [18.9, 19.3] good holds", "bound 3.1 holds", "refused few_passages"; in mrad.
std::string in_words(const ToldGap& told, const Interval& truth);

}  // namespace gapscope::test

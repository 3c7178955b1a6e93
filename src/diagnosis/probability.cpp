#include "diagnosis/probability.h"

#include <algorithm>
#include <cmath>

#include "diagnosis/mismatch_size.h"

namespace gapscope::internal::diagnosis {
namespace {

/// Constant, share of the log distance, log margin, log gain. `learn_probability` learns them again.
using Weights = double[4];
constexpr Weights kFirst = {-1.706, 2.294, 1.026, 0.091};
constexpr Weights kLater = {-0.698, 2.136, 1.382, 0.326};
constexpr double kMarginOffset = 0.05;
constexpr double kTinyGain = 1e-3;
constexpr double kMistakenOrder = 0.04;  ///< of the cases where the group is wrong, at even odds

double probability(const Weights& w, double rel, double margin, double gain) {
  if (!(gain > 0.0)) return 0.0;
  const double z = w[0] + w[1] * rel + w[2] * std::log(std::max(margin, 0.0) + kMarginOffset) +
                   w[3] * std::log(std::max(gain, kTinyGain));
  return 1.0 / (1.0 + std::exp(-z));
}

double odds(double p) { return p / (1.0 - p); }
double from_odds(double o) { return std::isfinite(o) ? o / (1.0 + o) : 1.0; }

}  // namespace

double group_probability(double rel, double margin, double gain) {
  return probability(kFirst, rel, margin, gain);
}

double later_probability(double rel, double margin, double gain) {
  return probability(kLater, rel, margin, gain);
}

Shares probability_shares(const std::vector<ScoredModel>& ranked, const Decision& decision, double outside) {
  Shares shares;
  shares.candidates.assign(ranked.size(), 0.0);
  if (!std::isfinite(decision.probability)) return {std::vector<double>(ranked.size(), kNaN), kNaN};
  const double inside = 1.0 / odds(outside);
  const double group = from_odds(odds(decision.probability) * inside);
  const double mistaken = (1.0 - group) * from_odds(odds(kMistakenOrder) * inside);
  const auto in_group = [&](const ScoredModel& c) {
    return std::find(decision.group.begin(), decision.group.end(), c.entry) != decision.group.end();
  };
  double of_group = 0.0, of_others = 0.0;
  for (const ScoredModel& c : ranked) (in_group(c) ? of_group : of_others) += weight_of(c, ranked.front());
  for (std::size_t i = 0; i < ranked.size(); ++i) {
    const double weight = weight_of(ranked[i], ranked.front());
    const bool grouped = in_group(ranked[i]);
    const double sum = grouped ? of_group : of_others;
    if (sum > 0.0) shares.candidates[i] = (grouped ? group : mistaken) * weight / sum;
    shares.outside -= shares.candidates[i];
  }
  shares.outside = std::max(0.0, shares.outside);
  return shares;
}

}  // namespace gapscope::internal::diagnosis

#include "diagnosis/comparison.h"

#include <algorithm>
#include <cmath>

#include "base/normal.h"

namespace gapscope {

Comparison compare(const GapEstimate& model_free, const FitSummary& reference) {
  Comparison c;
  const FittedParameter* gap = reference.find("gap");
  if (model_free.verdict != GapVerdict::kBacklash || gap == nullptr || reference.rejected()) return c;
  // A gap of another quantity (play at zero torque) is not what the reference fits.
  if (model_free.quantity != GapQuantity::kGap) return c;
  c.difference = model_free.gap - gap->value;
  if (model_free.method == GapMethod::kLiteral) return c;  // a scatter is no error of the mean
  if (!gap->identifiable || !std::isfinite(gap->std) || !std::isfinite(model_free.std)) return c;
  c.joint_std = std::hypot(model_free.std, gap->std);
  c.agree = std::abs(c.difference) <= kNormal95 * c.joint_std;
  return c;
}

void take_for_first_gap(const FitSummary& reference, GapEstimate& g) {
  constexpr double kMore = 0.125;  // of the reading: the widest half interval that is told with good trust
  const FittedParameter* gap = reference.find("gap");
  if (g.verdict != GapVerdict::kBacklash || g.quantity != GapQuantity::kGap || g.by_one_bound()) return;
  if (gap == nullptr || reference.rejected() || !gap->estimated || !gap->identifiable) return;
  if (!(reference.shown_interval(*gap).low > g.ci95.high) || !(gap->value > (1.0 + kMore) * g.gap)) return;
  g.quantity = GapQuantity::kFirstGap;
  g.trust = std::min(g.trust, GapTrust::kLimited);
  std::erase_if(g.presumes, [](const Remark& r) { return r.code() == "one_gap"; });
  g.tested.push_back({{"whole_gap", "it is the whole gap that a fitted model asks for"}, false});
}

double map_width(std::span<const Recording> recordings) {
  std::vector<double> delta;
  for (const Recording& r : recordings)
    for (std::size_t i = 0; i < std::min(r.x1.size(), r.x2.size()); ++i) delta.push_back(r.x1[i] - r.x2[i]);
  if (delta.empty()) return kNaN;
  // Both flanks are visited for long: their densest places, not the extremes, which impacts wind up.
  const double low = quantile(delta, 0.02), high = quantile(delta, 0.98);
  const double middle = 0.5 * (low + high);
  std::vector<double> minus, plus;
  for (const double d : delta) (d < middle ? minus : plus).push_back(d);
  return median(std::move(plus)) - median(std::move(minus));
}

}  // namespace gapscope

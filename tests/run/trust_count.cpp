#include "run/trust_count.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace gapscope::test {
namespace {

constexpr double kFarInHalfWidths = 2.0, kFarShare = 0.05;

AnswerTrust trust_of(FitTrust trust) {
  return trust == FitTrust::kGood      ? AnswerTrust::kGood
         : trust == FitTrust::kLimited ? AnswerTrust::kLimited
                                       : AnswerTrust::kNone;
}

AnswerTrust trust_of(const GapEstimate& reading) {
  return reading.trust == GapTrust::kGood      ? AnswerTrust::kGood
         : reading.trust == GapTrust::kLimited ? AnswerTrust::kLimited
                                               : AnswerTrust::kNone;
}

const char* word(Verity v) {
  return v == Verity::kHolds ? "holds" : (v == Verity::kMisses ? "misses" : "misses by far");
}

std::string share(int count, int of) {
  const Interval w = wilson(count, of);
  return of == 0 ? "0/0" : fmt::format("{}/{} [{:.0f}, {:.0f}] %", count, of, 100.0 * w.low, 100.0 * w.high);
}

double error_of(double gap, const Interval& truth) {
  return std::max({0.0, truth.low - gap, gap - truth.high});
}

}  // namespace

ToldGap told_by(const GapEstimate& reading) {
  ToldGap told;
  told.why = reading.reason.codes();
  if (reading.verdict == GapVerdict::kBacklash) {
    told.trust = trust_of(reading);
    told.gap = reading.gap, told.ci95 = reading.ci95;
    told.why = fmt::format("{} {} {}", to_string(reading.method), to_string(reading.quantity), told.why);
  } else {
    told.bound = reading.gap_at_most;
  }
  return told;
}

ToldGap told_by(const FitSummary& fit) {
  ToldGap told;
  told.trust = trust_of(fit.trust);
  told.why = fit.why.codes();
  const FittedParameter* gap = fit.find("gap");
  if (gap == nullptr || !gap->identifiable || std::isnan(fit.shown_interval(*gap).low)) return told;
  told.gap = gap->value, told.ci95 = fit.shown_interval(*gap);
  return told;
}

ToldGap told_by(const Answer& card) {
  ToldGap told;
  told.trust = card.trust;
  told.gap = card.gap, told.ci95 = card.ci95;
  told.why = to_string(card.from);
  if (!told.tells()) told.bound = card.gap_at_most;
  return told;
}

Verity verity_of(const ToldGap& told, const Interval& truth) {
  if (told.ci95.low <= truth.high && truth.low <= told.ci95.high) return Verity::kHolds;
  const double half = 0.5 * (told.ci95.high - told.ci95.low), error = error_of(told.gap, truth);
  const bool far = !(error <= kFarInHalfWidths * half) && error > kFarShare * truth.low;
  return far ? Verity::kMissesByFar : Verity::kMisses;
}

void TrustCount::add(const ToldGap& told, const Interval& truth) {
  ++drives_;
  if (told.bounds()) ++bounds_, bounds_held_ += told.bound >= truth.low;
  if (!told.tells() && !told.bounds()) ++refusals_[told.why.empty() ? "(no reason)" : told.why];
  if (!told.tells()) return;
  Numbers& n = numbers_[told.trust];
  const Verity v = verity_of(told, truth);
  ++n.told;
  n.held += v == Verity::kHolds, n.missed += v != Verity::kHolds, n.by_far += v == Verity::kMissesByFar;
  if (truth.low > 0.0) n.errors.push_back(100.0 * error_of(told.gap, truth) / truth.low);
}

std::string TrustCount::text(const std::string& name) const {
  std::string text;
  for (const auto& [trust, n] : numbers_) {
    text += fmt::format("{:8s} told {:7s} {}, hold {}, miss {}, by far {}", name, to_string(trust),
                        share(n.told, drives_), share(n.held, n.told), n.missed, n.by_far);
    if (!n.errors.empty())
      text += fmt::format("; off by {:.2f} % in the median, {:.1f} % at most", median(n.errors),
                          quantile(n.errors, 1.0));
    text += "\n";
  }
  text += fmt::format("{:8s} bounds {}, of these bind {}\n", name, share(bounds_, drives_),
                      share(bounds_held_, bounds_));
  for (const auto& [why, count] : refusals_)
    text += fmt::format("{:8s} refused {:3}: {}\n", name, count, why);
  return text;
}

std::string in_words(const ToldGap& told, const Interval& truth) {
  if (told.tells())
    return fmt::format("{:.4g} [{:.4g}, {:.4g}] {} {} ({})", 1e3 * told.gap, 1e3 * told.ci95.low,
                       1e3 * told.ci95.high, to_string(told.trust), word(verity_of(told, truth)), told.why);
  if (told.bounds())
    return fmt::format("at most {:.4g} {}", 1e3 * told.bound,
                       told.bound >= truth.low ? "binds" : "does not bind");
  return fmt::format("refused {}", told.why);
}

}  // namespace gapscope::test

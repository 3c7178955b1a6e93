#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "blind/scored_answer.h"

namespace gapscope::blind {
namespace {

constexpr int kBins = 8;
constexpr int kFewest = 40;  ///< decisions to learn from, with ten of either kind
constexpr int kFewestOfAKind = 10;
constexpr double kRidge = 0.1;  ///< on the weights but the first
constexpr int kNewtonSteps = 50;

Eigen::Vector4d features(const StepOutcome& o) {
  return {1.0, o.rel, std::log(std::max(o.margin, 0.0) + 0.05), std::log(std::max(o.gain, 1e-3))};
}

double logistic(double z) { return 1.0 / (1.0 + std::exp(-z)); }

/// Maximum likelihood with a slight pull to zero, by Newton's method.
std::vector<double> learn_weights(const std::vector<Judgement>& learn) {
  Eigen::Vector4d w = Eigen::Vector4d::Zero();
  const Eigen::Vector4d ridge(1e-6, kRidge, kRidge, kRidge);
  for (int step = 0; step < kNewtonSteps; ++step) {
    Eigen::Vector4d slope = -ridge.cwiseProduct(w);
    Eigen::Matrix4d curvature = ridge.asDiagonal();
    for (const Judgement& j : learn) {
      const Eigen::Vector4d x = features(j.outcome);
      const double p = logistic(w.dot(x));
      slope += ((j.right ? 1.0 : 0.0) - p) * x;
      curvature += p * (1.0 - p) * x * x.transpose();
    }
    w += curvature.ldlt().solve(slope);
  }
  return {w[0], w[1], w[2], w[3]};
}

/// Fills the bins, the calibration error and the Brier score of some probabilities.
void judge(const std::vector<Judgement>& cases, const std::vector<double>& p,
           std::vector<ReliabilityBin>& bins, double& error, double& brier) {
  bins.assign(kBins, {});
  std::vector<double> sums(kBins, 0.0);
  brier = 0.0;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const auto b = static_cast<std::size_t>(std::clamp(static_cast<int>(p[i] * kBins), 0, kBins - 1));
    ++bins[b].cases;
    bins[b].right += cases[i].right ? 1 : 0;
    sums[b] += p[i];
    brier += std::pow(p[i] - (cases[i].right ? 1.0 : 0.0), 2) / static_cast<double>(cases.size());
  }
  error = 0.0;
  for (std::size_t b = 0; b < kBins; ++b) {
    if (bins[b].cases == 0) continue;
    bins[b].predicted = sums[b] / bins[b].cases;
    error += std::abs(sums[b] - bins[b].right) / static_cast<double>(cases.size());
  }
}

}  // namespace

double probability_of(const StepOutcome& o, const BlindCalibration& c) {
  if (o.ranking.empty() || !(o.gain > 0.0)) return 0.0;
  if (c.weights.empty()) return o.probability;
  return logistic(Eigen::Map<const Eigen::Vector4d>(c.weights.data()).dot(features(o)));
}

std::vector<Judgement> judgements(const std::vector<ScoredAnswer>& cases, const std::string& part) {
  std::vector<Judgement> all;
  for (const ScoredAnswer& s : cases) {
    if (s.label->part != part || s.pair() || s.first.ranking.empty()) continue;
    all.push_back({s.first, s.in_group()});
    if (s.known()) all.push_back({decide_again(s.answer->evidence, truth_of(s, true)), false});
  }
  std::erase_if(all, [](const Judgement& j) { return !(j.outcome.gain > 0.0); });
  return all;
}

BlindCalibration calibrate(const std::vector<Judgement>& learn, const std::vector<Judgement>& judged) {
  BlindCalibration c;
  c.learnt_on = static_cast<int>(learn.size()), c.judged_on = static_cast<int>(judged.size());
  const auto right =
      static_cast<int>(std::count_if(learn.begin(), learn.end(), [](const Judgement& j) { return j.right; }));
  const auto probabilities = [&] {
    std::vector<double> p;
    for (const Judgement& j : judged) p.push_back(probability_of(j.outcome, c));
    return p;
  };
  if (judged.empty()) return c;
  judge(judged, probabilities(), c.bins, c.error_before, c.brier_before);
  if (c.learnt_on >= kFewest && right >= kFewestOfAKind && c.learnt_on - right >= kFewestOfAKind)
    c.weights = learn_weights(learn);
  judge(judged, probabilities(), c.bins, c.error, c.brier);
  return c;
}

std::vector<AbstentionPoint> abstention_of(const std::vector<Judgement>& judged, const BlindCalibration& c) {
  std::vector<AbstentionPoint> points;
  for (int percent = 0; percent < 100; percent += 5) {
    AbstentionPoint p{percent / 100.0, 0, 0};
    for (const Judgement& j : judged) {
      if (probability_of(j.outcome, c) < p.threshold) continue;
      ++p.answered;
      p.right += j.right ? 1 : 0;
    }
    points.push_back(p);
  }
  return points;
}

}  // namespace gapscope::blind

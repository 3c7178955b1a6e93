#include <algorithm>
#include <cmath>

#include "base/normal.h"
#include "diagnosis/last_resort.h"
#include "diagnosis/mismatch_size.h"
#include "diagnosis/tell_budget.h"
#include "plant/effects/node_curve.h"
#include "signals/one_body.h"

namespace gapscope::internal::diagnosis {
namespace {

constexpr int kPositionPoints = 24;  ///< of a table over a period or over the travel
constexpr int kPointsInPiece = 4;    ///< of a table by nodes, from one to the next
constexpr int kPictureBins = 40;     ///< of a picture

/// A point of the curve as a sum of the law's parameters: torque = Σ weight · parameter.
struct WeightedPoint {
  double at = 0.0;
  int direction = 0;
  reference::WeightedSum sum;
};

/// Where a curve by nodes is told, in its abscissa: as densely as lines between the points follow it, and
/// beyond the last node up to the largest value.
template <int N, plant::Beyond beyond>
std::vector<double> shares_told(double largest) {
  std::vector<double> shares;
  const int last = kPointsInPiece * N;
  for (int i = 0; i <= last; ++i) shares.push_back(static_cast<double>(i * i) / (last * last));
  const double bends_to =
      beyond == plant::Beyond::kLevel ? 1.0 + plant::NodeWeights<N, beyond>::kLevelledOver : 1.0;
  if (bends_to > 1.0 && largest > bends_to) shares.push_back(bends_to);
  if (largest > bends_to) shares.push_back(largest);
  return shares;
}

/// Both halves of a curve by nodes, from the largest negative value on.
/// @param largest value that is told
/// @param first node that has a parameter
/// @param unit torque on the motor per unit of the parameter, for a positive abscissa
template <int N, plant::Beyond beyond>
std::vector<WeightedPoint> node_points(const ReferenceModel& model, double largest, int first, double unit,
                                       bool friction) {
  const int effect = static_cast<int>(model.effects.size()) - 1;
  const double abscissa = model.effects.back().parameters[0].value;
  const std::vector<double> shares = shares_told<N, beyond>(largest / abscissa);
  std::vector<WeightedPoint> points;
  const auto add = [&](double share, int s) {
    WeightedPoint p{share == 0.0 ? 0.0 : s * abscissa * share, friction ? s : 0, {}};
    const plant::NodeWeights<N, beyond> weights(share);
    for (int k = first; k <= N; ++k) {
      const int place = 1 + k - first;
      p.sum.push_back({{effect, place + N - first}, unit * weights.value(k)});
      if (k < N) p.sum.push_back({{effect, place}, s * unit * weights.value(k)});
    }
    points.push_back(p);
  };
  for (std::size_t i = shares.size() - 1; i > 0; --i) add(shares[i], -1);
  if (friction) add(0.0, -1);
  for (const double share : shares) add(share, 1);
  return points;
}

/// Range of x1 over all that is fitted and held out.
Interval range_of(const Study& study) {
  Interval range{kInfinity, -kInfinity};
  for (const auto* traces : {&study.train, &study.held_out.traces})
    for (const MotorTrace& t : *traces)
      for (const double x : t.x1) range.low = std::min(range.low, x), range.high = std::max(range.high, x);
  return range;
}

std::vector<WeightedPoint> position_points(const Study& study, const ReferenceModel& model) {
  const int effect = static_cast<int>(model.effects.size()) - 1;
  const auto& law = model.effects.back();
  const double period = law.parameters[0].value;
  const Interval travel = range_of(study);
  const bool periodic = law.parameters[0].estimate;
  const double from = periodic ? 0.0 : travel.low, to = periodic ? period : travel.high;
  std::vector<WeightedPoint> points;
  for (int i = 0; i <= kPositionPoints; ++i) {
    WeightedPoint p{from + (to - from) * i / kPositionPoints, 0, {}};
    const double y = 2.0 * kPi * p.at / period;
    for (int k = 1; k < static_cast<int>(law.entry->parameters.size()); k += 2) {
      const int harmonic = (k + 1) / 2;
      p.sum.push_back({{effect, k}, std::cos(harmonic * y)});
      p.sum.push_back({{effect, k + 1}, std::sin(harmonic * y)});
    }
    points.push_back(p);
  }
  return points;
}

std::vector<WeightedPoint> points_of(const Study& study, const ReferenceModel& model) {
  const std::string variable = variable_of(*model.effects.back().entry);
  const signals::OneBody rough = signals::as_one_body(study.train);
  if (variable == "speed")
    return node_points<6, plant::Beyond::kLevel>(model, rough.peak_speed, 0, -1.0, true);
  if (variable == "input")
    return node_points<7, plant::Beyond::kStraight>(model, rough.peak_input, 1,
                                                    model.parameters[place::kTorqueConstant].value, false);
  return position_points(study, model);
}

std::vector<CurvePoint> curve_of(const Study& study, const ScoredModel& after) {
  const ReferenceModel& model = after.fitted.model;
  const reference::ModelFit fit(study.train, model, study.options.fit, study.observer_hz);
  const std::vector<WeightedPoint> points = points_of(study, model);
  std::vector<reference::WeightedSum> sums;
  for (const WeightedPoint& p : points) sums.push_back(p.sum);
  const auto spreads = fit.spreads(fit.point_of(model, after.fitted.starts), sums);
  std::vector<CurvePoint> curve;
  for (std::size_t i = 0; i < points.size(); ++i) {
    CurvePoint c{points[i].at, points[i].direction, 0.0, {}};
    for (const auto& [id, weight] : points[i].sum)
      c.torque += weight * model.effects.back().parameters[id.index].value;
    if (!spreads.empty()) c.ci95 = normal_interval(c.torque, spreads[i]);
    curve.push_back(c);
  }
  return curve;
}

/// The variable at a sample, folded into the first period where the law has one.
double at_sample(const std::string& variable, const MotorTrace& t, const Playback& p, std::size_t i,
                 double period) {
  if (variable == "speed") return p.w1[i];
  if (variable == "input") return t.u[i];
  return std::isnan(period) ? t.x1[i] : t.x1[i] - period * std::floor(t.x1[i] / period);
}

/// Means of the correcting torque over bins of the variable, of each direction.
std::vector<ResidualBin> residual_of(const Study& study, const LawSearch& found, Interval range,
                                     const std::vector<Playback>& before,
                                     const std::vector<Playback>& after) {
  const std::string variable = variable_of(*found.after.entry);
  const ParameterSetting& first = found.after.fitted.model.effects.back().parameters[0];
  const double period = first.estimate ? first.value : kNaN;
  std::vector<ResidualBin> bins;
  for (const int direction : {-1, 1})
    for (int b = 0; b < kPictureBins; ++b)
      bins.push_back(
          {range.low + (range.high - range.low) * (b + 0.5) / kPictureBins, direction, 0, 0.0, 0.0});
  for (std::size_t r = 0; r < before.size(); ++r) {
    const MotorTrace& t = study.held_out.traces[r];
    for (std::size_t i = study.held_out.scored_from[r]; i < before[r].torque.size(); ++i) {
      const double share =
          (at_sample(variable, t, before[r], i, period) - range.low) / (range.high - range.low);
      if (!(share >= 0.0 && share < 1.0) || before[r].w1[i] == 0.0) continue;
      ResidualBin& bin = bins[static_cast<std::size_t>((before[r].w1[i] > 0.0 ? kPictureBins : 0) +
                                                       static_cast<int>(share * kPictureBins))];
      bin.before += before[r].torque[i], bin.after += after[r].torque[i], ++bin.samples;
    }
  }
  std::erase_if(bins, [](const ResidualBin& b) { return b.samples < kTelling.fewest_in_bin; });
  for (ResidualBin& b : bins) b.before /= b.samples, b.after /= b.samples;
  return bins;
}

}  // namespace

LastResortLaw told(const Study& first, const LawSearch& found) {
  const Study& study = found.wider ? *found.wider : first;
  LastResortLaw law;
  law.law = found.after.entry->name;
  law.variable = variable_of(*found.after.entry);
  for (const EffectEntry* entry : found.group) law.group.emplace_back(entry->name);
  for (const ModelEffect& e : found.before.fitted.model.effects) law.on_top_of.emplace_back(e.entry->name);
  law.parameters = effect_values(found.after.fitted.model.effects.back());
  const MismatchSize size = mismatch_size(study, found.before, found.after);
  law.shrink = size.shrink, law.shrink_ci95 = law_shrink_interval(study, found.before, found.after);
  law.before = size.before, law.after = size.after;
  law.curve = curve_of(study, found.after);
  const auto before = play(found.before.fitted.model, study.held_out, study.observer_hz, true);
  const auto after = play(found.after.fitted.model, study.held_out, study.observer_hz, true);
  if (const auto measures = measures_of(study, before, after); !measures.empty())
    law.before_torque = measures.back().before, law.after_torque = measures.back().after;
  if (!before.empty() && !after.empty())
    law.residual = residual_of(study, found, {law.curve.front().at, law.curve.back().at}, before, after);
  law.fitted = found.after.fitted.model;
  return law;
}

}  // namespace gapscope::internal::diagnosis

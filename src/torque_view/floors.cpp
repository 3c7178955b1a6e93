#include "torque_view/floors.h"

#include <algorithm>
#include <cmath>

#include "signals/period.h"

namespace gapscope::internal::torque_view {
namespace {

constexpr double kEven = 0.01;  ///< of a step: stamps that count as uniform

/// The period of the input of evenly stamped samples [s]; 0 if it has none.
double input_period(const StampedTrace& trace) {
  const double dt = trace.step();
  for (std::size_t i = 0; i < trace.t.size(); ++i)
    if (std::abs(trace.t[i] - trace.t.front() - dt * static_cast<double>(i)) >
        kEven * dt * static_cast<double>(i + 1))
      return 0.0;
  const MotorTrace even{trace.file, trace.t.front(), dt, trace.u, trace.x, trace.quantum};
  return dt * signals::input_period(even);
}

/// Σ and count of (r(t + period) − r(t))²/2 over the rows of which both are there; where three periods are,
/// without the first, in which the drive starts.
std::pair<double, double> not_repeated(const BandRecord& record, const double* left, double period) {
  double sum = 0.0, count = 0.0;
  std::size_t later = 0;
  const double first = record.row_time.empty() ? 0.0 : record.row_time.front();
  const bool starts = !record.row_time.empty() && record.row_time.back() - first >= 3.0 * period;
  for (std::size_t i = 0; i < record.row_time.size(); ++i) {
    if (starts && record.row_time[i] < first + period) continue;
    const double at = record.row_time[i] + period;
    while (later + 1 < record.row_time.size() && record.row_time[later + 1] <= at) ++later;
    if (later + 1 >= record.row_time.size()) break;
    if (record.row_number[later + 1] != record.row_number[later] + 1) continue;
    const double share =
        (at - record.row_time[later]) / (record.row_time[later + 1] - record.row_time[later]);
    const double difference = (1.0 - share) * left[later] + share * left[later + 1] - left[i];
    sum += 0.5 * difference * difference, count += 1.0;
  }
  return {sum, count};
}

double repeatability(const SplitRecordings& data, Bench& bench, const Model& model) {
  const Eigen::VectorXd left = bench.left(model);
  double sum = 0.0, count = 0.0;
  for (std::size_t r = 0; r < data.judge.size(); ++r) {
    const double period = input_period(data.judge[r]);
    if (!(period > 0.0)) continue;
    const auto [squares, rows] =
        not_repeated(bench.judge.records()[r], left.data() + bench.judge.first[r], period);
    sum += squares, count += rows;
  }
  return count > 0.0 ? std::sqrt(sum / count) : kNaN;
}

}  // namespace

double Floors::disagreement() const { return std::sqrt(std::max(0.0, joint * joint - each * each)); }

double encoder_torque_floor(const SplitRecordings& data, double hz, double inertia) {
  double noise = 0.0;
  for (const StampedTrace& t : data.judge)
    noise = std::max(noise, noise_acceleration(position_noise(t), t.step(), hz));
  return std::abs(inertia) * noise;
}

Floors floors_of(const SplitRecordings& data, Bench& bench, const Model& model,
                 const TorqueViewOptions& options) {
  Floors floors;
  const double hz = bench.scales.hz;
  floors.encoder = encoder_torque_floor(data, hz, first_coefficient(model, "inertia"));
  floors.repeatability = repeatability(data, bench, model);

  std::vector<StampedTrace> traces = data.fit;
  traces.insert(traces.end(), data.judge.begin(), data.judge.end());
  Rows all = stacked(traces, hz, bench.fit.free_constant, options);
  const Model joint = fitted(all, model);
  floors.joint =
      std::sqrt(residual(all, joint, data.new_phase).squaredNorm() / static_cast<double>(all.size()));
  double each = 0.0;
  for (const StampedTrace& trace : traces) {
    Rows one = stacked({&trace, 1}, hz, bench.fit.free_constant, options);
    const Model own = fitted(one, model);
    each += residual(one, own, false).squaredNorm();
  }
  floors.each = std::sqrt(each / static_cast<double>(all.size()));
  return floors;
}

}  // namespace gapscope::internal::torque_view

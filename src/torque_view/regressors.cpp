#include "torque_view/regressors.h"

#include <algorithm>
#include <cmath>

#include "base/require.h"
#include "gapscope/base/statistics.h"

namespace gapscope::internal::torque_view {
namespace {

constexpr double kShortestKernel = 1.5;  ///< σ over the median step: what it leaves of x is noise

/// How many faults lie before each sample: stretches of lost samples, jumps of x.
std::vector<std::size_t> faults_before(const StampedTrace& trace, const TorqueViewOptions& options) {
  const double step = trace.step();
  std::vector<double> moves;
  for (std::size_t i = 1; i < trace.x.size(); ++i)
    if (trace.x[i] != trace.x[i - 1]) moves.push_back(std::abs(trace.x[i] - trace.x[i - 1]));
  const double jump = moves.empty() ? kInfinity : options.jump * median(moves);
  std::vector<std::size_t> before(trace.t.size() + 1, 0);
  for (std::size_t i = 0; i < trace.t.size(); ++i) {
    const bool fault = i > 0 && (trace.t[i] - trace.t[i - 1] > options.lost_step * step ||
                                 std::abs(trace.x[i] - trace.x[i - 1]) > jump);
    before[i + 1] = before[i] + (fault ? 1 : 0);
  }
  return before;
}

/// 1 at samples that stand still: the motor equation says nothing there.
std::vector<double> stuck_samples(const BandRecord& record, double quantum, double sigma,
                                  const TorqueViewOptions& options) {
  double square = 0.0;
  for (const double w : record.w) square += w * w;
  const double average = mean(record.w), count = static_cast<double>(record.w.size());
  const double slow = options.stuck_speed * std::sqrt(std::max(0.0, square / count - average * average));
  const double unseen = options.stuck_quanta * quantum / (2.0 * options.kernel_reach * sigma);
  std::vector<double> stuck(record.w.size());
  for (std::size_t i = 0; i < stuck.size(); ++i)
    stuck[i] = std::abs(record.w[i]) < std::max(slow, unseen) ? 1.0 : 0.0;
  return stuck;
}

void keep_rows(BandRecord& record, const std::vector<bool>& good) {
  std::vector<double> time;
  std::vector<std::size_t> number;
  for (std::size_t r = 0; r < good.size(); ++r)
    if (good[r]) time.push_back(record.row_time[r]), number.push_back(r);
  record.masked =
      1.0 - static_cast<double>(time.size()) / static_cast<double>(std::max<std::size_t>(1, good.size()));
  record.row_time = std::move(time);
  record.row_number = std::move(number);
  record.rest.keep(good);
  record.whole.keep(good);
}

void mask(BandRecord& record, const StampedTrace& trace, double sigma, const TorqueViewOptions& options) {
  const std::vector<std::size_t> faults = faults_before(trace, options);
  const std::vector<double> stuck = stuck_samples(record, trace.quantum, sigma, options);
  std::vector<double> share(record.row_time.size());
  record.whole.apply(stuck.data(), share.data());
  std::vector<bool> good(share.size());
  for (std::size_t r = 0; r < good.size(); ++r) {
    const std::size_t first = record.whole.first(r), end = record.whole.end(r);
    good[r] = end > first + 3 && faults[std::min(end + 1, trace.t.size())] == faults[first] &&
              share[r] <= options.most_stuck;
  }
  keep_rows(record, good);
}

void read_states(BandRecord& record, std::span<const double> cells, double sigma, double reach) {
  SmoothingKernel kernel(record.t, cells, sigma, reach);
  record.w.resize(record.t.size());
  record.a.resize(record.t.size());
  for (std::size_t i = 0; i < record.t.size(); ++i) {
    const SmoothMotion motion = kernel.motion(record.x, record.t[i]);
    record.w[i] = motion.w, record.a[i] = motion.a;
  }
}

/// What moves more of a load than the others have takes its part of the input.
void take_off(double inertia, BandRecord& record) {
  if (inertia == 0.0) return;
  std::vector<double> accelerated(record.row_time.size());
  record.rest.apply(record.a.data(), accelerated.data());
  for (std::size_t r = 0; r < accelerated.size(); ++r)
    record.u(static_cast<Eigen::Index>(r)) -= inertia * accelerated[r];
}

}  // namespace

double StampedTrace::step() const {
  std::vector<double> steps;
  for (std::size_t i = 1; i < t.size(); ++i) steps.push_back(t[i] - t[i - 1]);
  return median(std::move(steps));
}

StampedTrace stamped(const MotorTrace& trace, bool held_command) {
  StampedTrace s{
      trace.file,    {},          {trace.u.begin(), trace.u.end()}, {trace.x1.begin(), trace.x1.end()},
      trace.quantum, held_command};
  for (std::size_t i = 0; i < trace.size(); ++i) s.t.push_back(trace.time(i));
  return s;
}

BandRecord in_band(const StampedTrace& trace, double hz, const TorqueViewOptions& options) {
  const double sigma = kernel_sigma(hz), inner = options.inner_share * sigma;
  const double outer = std::sqrt(sigma * sigma - inner * inner);
  BandRecord record;
  record.hz = hz;
  record.t = trace.t;
  record.x = trace.x;
  const std::vector<double> cells = cell_lengths(record.t);
  read_states(record, cells, inner, options.kernel_reach);
  const double trim = options.kernel_reach * (inner + outer), every = 1.0 / (options.rows_per_hertz * hz);
  for (double T = record.t.front() + trim; T <= record.t.back() - trim; T += every)
    record.row_time.push_back(T);
  record.rest = RowFilter(record.t, cells, record.row_time, outer, options.kernel_reach);
  record.whole = RowFilter(record.t, cells, record.row_time, sigma, options.kernel_reach);
  mask(record, trace, sigma, options);
  record.u.resize(static_cast<Eigen::Index>(record.row_time.size()));
  const std::vector<double> u = trace.held_command ? hold_corrected(record.t, trace.u) : trace.u;
  record.whole.apply(u.data(), record.u.data());
  take_off(trace.added_inertia, record);
  return record;
}

double position_noise(const StampedTrace& trace) {
  const double sigma = kShortestKernel * trace.step();
  const std::vector<double> cells = cell_lengths(trace.t);
  SmoothingKernel kernel(trace.t, cells, sigma, 3.0);
  std::vector<double> left;
  for (std::size_t i = 8; i + 8 < trace.t.size(); ++i) {
    const SmoothMotion m = kernel.motion(trace.x, trace.t[i]);
    left.push_back(trace.x[i] - (m.x - 0.5 * m.a * sigma * sigma));  // a parabola leaves nothing
  }
  // Of white noise 1 − 2 k(0) + Σk² of the variance is left, with k = (3 − s²)/2 times a Gaussian of
  // 1.5 samples: k(0) = 3/(2 √(2π) 1.5), Σk² = 27/(32 √π 1.5).
  const double centre = 1.5 / (std::sqrt(2.0 * kPi) * kShortestKernel);
  const double passed = 1.0 - 2.0 * centre + 27.0 / (32.0 * std::sqrt(kPi) * kShortestKernel);
  return rms(left) / std::sqrt(passed);
}

double noise_acceleration(double noise, double dt, double hz) {
  const double sigma = kernel_sigma(hz);
  return noise * std::sqrt(3.0 * dt / (8.0 * std::sqrt(kPi) * std::pow(sigma, 5)));
}

}  // namespace gapscope::internal::torque_view

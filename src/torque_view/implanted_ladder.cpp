#include "torque_view/implanted_ladder.h"

#include <algorithm>
#include <cmath>
#include <deque>

#include "base/interrupt.h"
#include "base/parallel.h"

namespace gapscope::internal::torque_view {
namespace {

constexpr int kMostHalvings = 3;  ///< below half of the foretold amount

/// A delay is put in as one, not as its first order: the held input of that much later.
void delay(StampedTrace& trace, double later) {
  const std::vector<double> u = trace.u;
  std::size_t at = 0;
  for (std::size_t i = 0; i < u.size(); ++i) {
    while (at + 1 < u.size() && trace.t[at + 1] <= trace.t[i] + later) ++at;
    trace.u[i] = u[at];
  }
}

void implant_into(std::vector<StampedTrace>& traces, const Budget& budget, const Law& law, const Shape& shape,
                  const Eigen::VectorXd& theta, const TorqueViewOptions& options) {
  if (law.name == std::string_view("input_delay")) {
    for (StampedTrace& trace : traces) delay(trace, theta[0]);
    return;
  }
  Rows rows = stacked(traces, budget.band.hz, budget.band.free_constant, options);
  set_torque(rows, budget.model);
  for (std::size_t r = 0; r < traces.size(); ++r) {
    std::vector<double>& u = traces[r].u;
    Eigen::MatrixXd g = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(u.size()), law.columns);
    law.fill(rows.samples(r), shape, g);
    Eigen::Map<Eigen::VectorXd>(u.data(), g.rows()) += g * theta;
  }
}

/// A multiple of the foretold amount, and whether the ladder adds the law at it.
struct TriedAmount {
  double times = 1.0;
  bool added = false;
};

/// From where on the law is added, with the fewest exceptions on either side: noise makes some.
double threshold(const std::deque<TriedAmount>& tried) {
  double best = tried.back().times;
  long fewest = std::ssize(tried);
  for (std::size_t from = 0; from < tried.size(); ++from) {
    long wrong = 0;
    for (std::size_t i = 0; i < tried.size(); ++i) wrong += tried[i].added != (i >= from) ? 1 : 0;
    if (wrong > fewest) continue;  // of equals the larger amount
    fewest = wrong, best = tried[from].times;
  }
  return best * std::sqrt(0.5);  // between it and the one before
}

void correct(const SplitRecordings& data, const Budget& budget, LeastNamed& least,
             const TorqueViewOptions& options) {
  const auto at = [&](double times) {
    stop_point();
    return TriedAmount{times,
                       ladder_adds(data, budget, *least.law, least.shape, times * least.theta, options)};
  };
  std::deque<TriedAmount> tried = {at(0.5), at(1.0), at(2.0)};
  for (int i = 0; i < kMostHalvings && tried.front().added; ++i)
    tried.push_front(at(0.5 * tried.front().times));
  while (!tried.back().added && tried.back().times * least.torque < budget.input_rms)
    tried.push_back(at(2.0 * tried.back().times));
  if (!tried.back().added) {
    least.theta.resize(0), least.torque = kNaN;
    return;
  }
  const double times = threshold(tried);
  least.theta *= times, least.torque *= times;
}

}  // namespace

bool ladder_adds(SplitRecordings data, const Budget& budget, const Law& law, const Shape& shape,
                 const Eigen::VectorXd& theta, TorqueViewOptions options) {
  implant_into(data.fit, budget, law, shape, theta, options);
  implant_into(data.judge, budget, law, shape, theta, options);
  options.given_hz = budget.band.hz;
  data.threads = 1;
  const Budget with = error_budget(data, options);
  return std::any_of(with.model.begin() + static_cast<std::ptrdiff_t>(with.nominal.size()), with.model.end(),
                     [&](const Term& term) { return is_same_torque(*term.law, law); });
}

void correct_by_implants(const SplitRecordings& data, const Budget& budget, std::vector<LeastNamed>& laws,
                         const TorqueViewOptions& options) {
  parallel_for(laws.size(), data.threads, [&](std::size_t i) {
    if (laws[i].exists()) correct(data, budget, laws[i], options);
  });
}

}  // namespace gapscope::internal::torque_view

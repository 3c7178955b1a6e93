#include "reference/recording_cost.h"

#include <algorithm>
#include <cmath>

#include "base/cut_short.h"

namespace gapscope::internal::reference {
namespace {

/// Cost of a Jet run in plain runs, as measured on one core; constants, so that the count is a function of
/// the work alone.
constexpr double kJet4Cost = 3.0, kJet8Cost = 6.0, kJet12Cost = 9.0;

/// The same of a piece of a step along which smooth effects were followed, in steps without
/// (bench_simulator).
constexpr double kSmoothPieceCost = 5.0;

}  // namespace

RecordingCost::RecordingCost(const FitProblem& problem, std::size_t recording, const RecordingStart& start,
                             double observer_hz)
    : problem_(problem),
      recording_(problem.recordings[recording]),
      place_(recording),
      start_(start),
      states_(problem.free_states(start, observer_hz <= 0.0)),
      shared_(problem.free_count()),
      gains_(observer_hz, problem.recordings[recording]),
      floor_(problem.floors[recording]) {}

/// Hands `keep` the index and the residual of each sample.
template <class T, class Keep>
Evaluation RecordingCost::run(const T* q, const Keep& keep) const {
  const ModelNumbers<T> numbers = problem_.numbers(q);
  std::array<T, kStates> initial;
  for (std::size_t i = 0; i < kStates; ++i) initial[i] = T(start_.q[i]);
  for (std::size_t i = 0; i < states_.size(); ++i)
    initial[static_cast<std::size_t>(states_[i])] = q[shared_ + i];
  const PlantModel<T> model = problem_.plant_model(numbers);
  const DriveState<T> state = problem_.state(start_, T(0.5 * model.drive.gap), initial.data());
  const double scale = 1.0 / floor_;
  long pieces = 0;
  const auto visit = [&](std::size_t i, const DriveStepper<T>& stepper) {
    keep(i, T((recording_.x1[i] - stepper.measured()) * scale));
    pieces = stepper.pieces();
  };
  Evaluation done;
  if (!problem_.controller) {
    done.valid = roll_out(model, state, recording_, gains_, visit);
  } else {
    const std::vector<T> u = problem_.commanded(numbers, place_);
    done.valid = roll_out(model, state, recording_, std::span<const T>(u), gains_, visit);
  }
  done.simulations =
      1.0 + kSmoothPieceCost * static_cast<double>(pieces) / static_cast<double>(recording_.size());
  return done;
}

/// Derivatives by the N numbers from `first` on, or as many as are left.
template <int N>
Evaluation RecordingCost::run_chunk(const double* q, int first, double* residuals,
                                    std::span<const DerivativeColumn> columns) const {
  const auto n = static_cast<std::size_t>(numbers()), begin = static_cast<std::size_t>(first);
  std::vector<Jet<N>> jets(n);
  for (std::size_t i = 0; i < n; ++i) jets[i] = Jet<N>(q[i]);
  const auto part = columns.subspan(begin, std::min<std::size_t>(N, n - begin));
  for (std::size_t i = 0; i < part.size(); ++i) jets[begin + i].v[static_cast<int>(i)] = 1.0;
  bool finite = false;
  Evaluation done = run(jets.data(), [&](std::size_t k, const Jet<N>& r) {
    residuals[k] = r.a;
    for (std::size_t i = 0; i < part.size(); ++i)
      if (part[i].first != nullptr) part[i].first[k * part[i].stride] = r.v[static_cast<int>(i)];
    if (k + 1 == recording_.size()) finite = std::isfinite(r.a) && r.v.allFinite();
  });
  done.valid = done.valid && finite;
  return done;
}

Evaluation RecordingCost::evaluate(const double* q, double* residuals, double* jacobian) const {
  std::vector<DerivativeColumn> columns;
  const auto n = static_cast<std::size_t>(numbers());
  for (std::size_t i = 0; i < n && jacobian != nullptr; ++i) columns.push_back({jacobian + i, n});
  return evaluate(q, residuals, columns);
}

Evaluation RecordingCost::evaluate(const double* q, double* residuals,
                                   std::span<const DerivativeColumn> columns) const {
  Evaluation done;
  if (is_to_end() || problem_.stiffness(problem_.numbers(q)) > problem_.stiffest) return done;
  if (columns.empty()) {
    done = run(q, [&](std::size_t k, double r) { residuals[k] = r; });
    if (!done.valid) return done;
  }
  done.valid = false;
  for (int first = 0; first < std::ssize(columns); first += 12) {
    const auto left = std::ssize(columns) - first;
    const Evaluation part = left <= 4   ? run_chunk<4>(q, first, residuals, columns)
                            : left <= 8 ? run_chunk<8>(q, first, residuals, columns)
                                        : run_chunk<12>(q, first, residuals, columns);
    done.simulations += part.simulations * (left <= 4 ? kJet4Cost : left <= 8 ? kJet8Cost : kJet12Cost);
    if (!part.valid) return done;
  }
  apply_loss(residuals, columns);
  done.valid = true;
  return done;
}

/// Huber: r stays within the width w; beyond it becomes √(2 w |r| − w²), whose square is Huber's loss.
void RecordingCost::apply_loss(double* residuals, std::span<const DerivativeColumn> columns) const {
  const double width = problem_.options.loss_width / floor_;
  if (!(width > 0.0)) return;
  for (std::size_t k = 0; k < recording_.size(); ++k) {
    const double r = residuals[k];
    if (std::abs(r) <= width) continue;
    const double root = std::sqrt(2.0 * width * std::abs(r) - width * width);
    residuals[k] = std::copysign(root, r);
    for (const DerivativeColumn& column : columns)
      if (column.first != nullptr) column.first[k * column.stride] *= width / root;
  }
}

}  // namespace gapscope::internal::reference

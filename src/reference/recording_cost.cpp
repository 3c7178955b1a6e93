#include "reference/recording_cost.h"

#include <algorithm>
#include <cmath>

#include "gapscope/base/interrupt.h"

namespace gapscope::internal::reference {
namespace {

/// Cost of a Jet run in plain runs, as measured on one core; constants, so that the count is a function of
/// the work alone.
constexpr double kJet4Cost = 3.0, kJet8Cost = 6.0, kJet12Cost = 9.0;

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

template <class T>
bool RecordingCost::run(const T* q, T* out) const {
  const ModelNumbers<T> numbers = problem_.numbers(q);
  std::array<T, kStates> initial;
  for (std::size_t i = 0; i < kStates; ++i) initial[i] = T(start_.q[i]);
  for (std::size_t i = 0; i < states_.size(); ++i)
    initial[static_cast<std::size_t>(states_[i])] = q[shared_ + i];
  const PlantModel<T> model = problem_.plant_model(numbers);
  const DriveState<T> state = problem_.state(start_, T(0.5 * model.drive.gap), initial.data());
  const double scale = 1.0 / floor_;
  const auto keep = [&](std::size_t i, const DriveStepper<T>& stepper) {
    out[i] = (recording_.x1[i] - stepper.measured()) * scale;
  };
  if (!problem_.controller) return roll_out(model, state, recording_, gains_, keep);
  const std::vector<T> u = problem_.commanded(numbers, place_);
  return roll_out(model, state, recording_, std::span<const T>(u), gains_, keep);
}

template <int N>
bool RecordingCost::run_chunk(const double* q, int first, int count, double* residuals,
                              double* jacobian) const {
  const auto n = static_cast<std::size_t>(numbers());
  std::vector<Jet<N>> jets(n);
  for (std::size_t i = 0; i < n; ++i) jets[i] = Jet<N>(q[i]);
  for (int i = 0; i < count; ++i) jets[static_cast<std::size_t>(first + i)].v[i] = 1.0;
  std::vector<Jet<N>> out(recording_.size());
  if (!run(jets.data(), out.data())) return false;
  for (std::size_t k = 0; k < out.size(); ++k) {
    residuals[k] = out[k].a;
    for (int i = 0; i < count; ++i) jacobian[k * n + static_cast<std::size_t>(first + i)] = out[k].v[i];
  }
  const std::size_t last = out.size() - 1;
  return std::isfinite(residuals[last]) && out[last].v.allFinite();
}

Evaluation RecordingCost::evaluate(const double* q, double* residuals, double* jacobian) const {
  Evaluation done;
  if (stop_requested() || problem_.stiffness(problem_.numbers(q)) > problem_.stiffest) return done;
  if (jacobian == nullptr) {
    done.simulations += 1.0;
    if (!run(q, residuals)) return done;
  } else {
    for (int first = 0; first < std::max(1, numbers());) {
      const int left = numbers() - first;
      const int count = std::min(left, 12);
      done.simulations += left <= 4 ? kJet4Cost : left <= 8 ? kJet8Cost : kJet12Cost;
      const bool valid = left <= 4   ? run_chunk<4>(q, first, count, residuals, jacobian)
                         : left <= 8 ? run_chunk<8>(q, first, count, residuals, jacobian)
                                     : run_chunk<12>(q, first, count, residuals, jacobian);
      if (!valid) return done;
      first += std::max(1, count);
    }
  }
  apply_loss(residuals, jacobian);
  done.valid = true;
  return done;
}

/// Huber: r stays within the width w; beyond it becomes √(2 w |r| − w²), whose square is Huber's loss.
void RecordingCost::apply_loss(double* residuals, double* jacobian) const {
  const double width = problem_.options.loss_width / floor_;
  if (!(width > 0.0)) return;
  const auto n = static_cast<std::size_t>(numbers());
  for (std::size_t k = 0; k < recording_.size(); ++k) {
    const double r = residuals[k];
    if (std::abs(r) <= width) continue;
    const double root = std::sqrt(2.0 * width * std::abs(r) - width * width);
    residuals[k] = std::copysign(root, r);
    if (jacobian == nullptr) continue;
    for (std::size_t i = 0; i < n; ++i) jacobian[k * n + i] *= width / root;
  }
}

}  // namespace gapscope::internal::reference

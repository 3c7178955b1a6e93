#include "diagnosis/held_out_change.h"

#include <algorithm>
#include <cmath>

namespace gapscope::internal::diagnosis {
namespace {

constexpr double kDifference = 1e-3;  ///< of a number, by which its derivative is taken

Eigen::VectorXd joined(const std::vector<Playback>& played, std::vector<double> Playback::*column) {
  Eigen::Index count = 0;
  for (const Playback& p : played) count += std::ssize(p.*column);
  Eigen::VectorXd all(count);
  Eigen::Index at = 0;
  for (const Playback& p : played)
    for (const double e : p.*column) all[at++] = e;
  return all;
}

std::vector<double> piece(const Eigen::VectorXd& all, Eigen::Index first, std::size_t count) {
  return {all.data() + first, all.data() + first + count};
}

/// The settings of all free numbers.
std::vector<double*> free_values(ReferenceModel& model) {
  std::vector<double*> values;
  const auto take = [&](ParameterSetting& p) {
    if (p.estimate && std::abs(p.value) > 0.0) values.push_back(&p.value);
  };
  for (ParameterSetting& p : model.parameters) take(p);
  for (ModelEffect& e : model.effects)
    for (std::size_t i = 0; i < e.entry->parameters.size(); ++i) take(e.parameters[i]);
  return values;
}

}  // namespace

Eigen::VectorXd least_squares(const Eigen::MatrixXd& columns, const Eigen::VectorXd& of) {
  const Eigen::VectorXd norm = columns.colwise().norm().transpose().cwiseMax(1e-300);
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(columns * norm.cwiseInverse().asDiagonal());
  return qr.solve(of).cwiseQuotient(norm);
}

HeldOutChange::HeldOutChange(const Study& study, const ReferenceModel& model)
    : study_(study), model_(model), starts_(settled_starts(study.held_out.traces, model, study.observer_hz)) {
  errors_ = errors_of(model);
  played_ = play_from(starts_, model, study.held_out, study.observer_hz, true);
  if (played_.empty()) errors_ = {};
  if (usable()) differentiate();
}

HeldOutErrors HeldOutChange::errors_of(const ReferenceModel& model) const {
  const auto played = play_from(starts_, model, study_.held_out, study_.observer_hz, false);
  return {joined(played, &Playback::innovation), joined(played, &Playback::free)};
}

void HeldOutChange::differentiate() {
  ReferenceModel moved = model_;
  const std::vector<double*> values = free_values(moved);
  innovation_by_.resize(errors_.innovation.size(), std::ssize(values));
  free_by_.resize(errors_.free.size(), std::ssize(values));
  innovation_by_.setZero(), free_by_.setZero();
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double value = *values[i];
    *values[i] = value * (1.0 + kDifference);
    const HeldOutErrors change = by(moved);
    *values[i] = value;
    if (!change.exist()) continue;
    innovation_by_.col(static_cast<Eigen::Index>(i)) = change.innovation;
    free_by_.col(static_cast<Eigen::Index>(i)) = change.free;
  }
}

HeldOutErrors HeldOutChange::by(const ReferenceModel& other) const {
  HeldOutErrors change = errors_of(other);
  if (!change.exist()) return {};
  change.innovation -= errors_.innovation, change.free -= errors_.free;
  return change;
}

/// Samples that count: not those before the first window.
Eigen::VectorXd HeldOutChange::judged(const Eigen::VectorXd& samples) const {
  Eigen::VectorXd counted = samples;
  Eigen::Index first = 0;
  for (std::size_t r = 0; r < study_.held_out.traces.size(); ++r) {
    const auto count = static_cast<Eigen::Index>(study_.held_out.traces[r].size());
    const std::size_t before = study_.held_out.scored_from[r] + study_.held_out.restart(r);
    counted.segment(first, std::min(count, static_cast<Eigen::Index>(before))).setZero();
    counted.segment(first, count) /= study_.held_out.innovation_floor(r);
    first += count;
  }
  return counted;
}

HeldOutErrors HeldOutChange::beyond_numbers(const HeldOutErrors& change) const {
  if (innovation_by_.cols() == 0) return change;
  Eigen::MatrixXd columns = innovation_by_;
  for (Eigen::Index c = 0; c < columns.cols(); ++c) columns.col(c) = judged(columns.col(c));
  const Eigen::VectorXd numbers = least_squares(columns, judged(change.innovation));
  return {change.innovation - innovation_by_ * numbers, change.free - free_by_ * numbers};
}

std::vector<std::vector<double>> HeldOutChange::torque_by(const ReferenceModel& other) const {
  const auto changed = play_from(starts_, other, study_.held_out, study_.observer_hz, true);
  std::vector<std::vector<double>> torque;
  for (std::size_t r = 0; r < changed.size(); ++r) {
    torque.push_back(changed[r].torque);
    for (std::size_t i = 0; i < torque[r].size(); ++i) torque[r][i] -= played_[r].torque[i];
  }
  return torque;
}

std::vector<Harmonic> HeldOutChange::lines_with(const std::vector<std::vector<double>>& change, double factor,
                                                double torque_constant) const {
  std::vector<Playback> left(played_.size());
  for (std::size_t r = 0; r < left.size(); ++r) {
    left[r].torque = played_[r].torque;
    for (std::size_t i = 0; i < change[r].size(); ++i) left[r].torque[i] -= factor * change[r][i];
  }
  return strongest_lines(left, study_.held_out.traces, torque_constant, study_.effort.lines);
}

ScoredModel HeldOutChange::scored_with(const EffectEntry* entry, const HeldOutErrors& change) const {
  const Eigen::VectorXd innovation = errors_.innovation + change.innovation,
                        free = errors_.free + change.free;
  std::vector<Playback> played(study_.held_out.traces.size());
  Eigen::Index first = 0;
  for (std::size_t r = 0; r < played.size(); ++r) {
    const std::size_t count = study_.held_out.traces[r].size();
    played[r].innovation = piece(innovation, first, count), played[r].free = piece(free, first, count);
    first += static_cast<Eigen::Index>(count);
  }
  ScoredModel model = scored_by_windows(entry, windows_of(played, study_.held_out));
  model.fitted.mean_cost = mean(model.windows.innovation);  // what was fitted would leave as much
  return model;
}

HeldOutErrors HeldOutChange::nothing() const {
  return {Eigen::VectorXd::Zero(errors_.innovation.size()), Eigen::VectorXd::Zero(errors_.free.size())};
}

}  // namespace gapscope::internal::diagnosis

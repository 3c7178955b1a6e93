#include "torque_view/model.h"

#include <algorithm>
#include <cmath>

#include "base/require.h"

namespace gapscope::internal::torque_view {
namespace {

constexpr int kTorqueRounds = 3;     ///< beyond the first fit
constexpr double kDependent = 1e-9;  ///< of a column that others say as well

bool reads_torque(const Model& model) {
  return std::any_of(model.begin(), model.end(),
                     [](const Term& t) { return t.law->kind == Kind::kOnTorque; });
}

Eigen::VectorXd solved(Eigen::MatrixXd columns, const Eigen::VectorXd& u) {
  const Eigen::VectorXd norm = columns.colwise().norm().transpose().cwiseMax(1e-300);
  columns = columns * norm.cwiseInverse().asDiagonal();
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> qr;
  qr.setThreshold(kDependent);
  qr.compute(columns);
  return qr.solve(u).cwiseQuotient(norm);
}

void take_solution(Rows& rows, Model& model) {
  const Eigen::VectorXd theta = solved(model_and_swing(rows, model), rows.u);
  Eigen::Index first = 0;
  for (Term& term : model) {
    term.theta = theta.segment(first, term.law->columns);
    first += term.law->columns;
  }
}

/// The amplitude of a line as fitted, at the phase that suits these rows.
Eigen::Vector2d turned(const Eigen::MatrixXd& line, const Eigen::VectorXd& left, double amplitude) {
  const Eigen::Vector2d theta = (line.transpose() * line).ldlt().solve(line.transpose() * left);
  return theta.norm() > 0.0 ? Eigen::Vector2d(theta * (amplitude / theta.norm())) : theta;
}

}  // namespace

Model nominal_model() {
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(1);
  return {{&law("inertia"), kNaN, none}, {&law("viscous"), kNaN, none}};
}

Term contact_term(double low, double high) {
  const Law& curve = law("contact_curve");
  return {&curve, (high - low) / (curve.columns - 2), Eigen::VectorXd::Zero(curve.columns)};
}

const Term* find_term(const Model& model, std::string_view name) {
  const auto at =
      std::find_if(model.begin(), model.end(), [&](const Term& t) { return name == t.law->name; });
  return at == model.end() ? nullptr : &*at;
}

double first_coefficient(const Model& model, std::string_view name) {
  const Term* term = find_term(model, name);
  return term == nullptr ? 0.0 : term->theta[0];
}

Samples Rows::samples(std::size_t r) const {
  const BandRecord& record = records()[r];
  return {record.t, record.x, record.w, record.a, tau[r], tau_load[r], inertia, viscous};
}

double Rows::input_square() const {
  double square = u.squaredNorm();
  for (std::size_t r = 0; r < level.size(); ++r)
    square += level[r] * level[r] * static_cast<double>(first[r + 1] - first[r]);
  return square;
}

bool is_constant_speed(const BandRecord& record, const TorqueViewOptions& options) {
  const double average = mean(record.w), square = std::pow(rms(record.w), 2) - average * average;
  return std::sqrt(std::max(0.0, square)) < options.constant_speed * std::abs(average);
}

Rows stacked(std::span<const StampedTrace> traces, double hz, bool free_constant,
             const TorqueViewOptions& options) {
  Rows rows;
  rows.free_constant = free_constant;
  Eigen::Index samples = 0;
  rows.first.push_back(0);
  auto records = std::make_shared<std::vector<BandRecord>>();
  for (const StampedTrace& trace : traces) {
    records->push_back(in_band(trace, hz, options));
    rows.first.push_back(rows.first.back() + records->back().u.size());
    samples = std::max(samples, static_cast<Eigen::Index>(trace.t.size()));
    rows.tau.emplace_back(trace.t.size(), 0.0);
  }
  rows.shared = std::move(records);
  rows.tau_load = rows.tau;
  rows.u.resize(rows.first.back());
  for (std::size_t r = 0; r < rows.records().size(); ++r)
    rows.u.segment(rows.first[r], rows.records()[r].u.size()) = rows.records()[r].u;
  int widest = 0;
  for (const Law& l : laws()) widest = std::max(widest, l.columns);
  rows.at_samples.resize(samples, widest);
  for (const BandRecord& r : rows.records())
    rows.level.push_back(free_constant && r.u.size() > 0 ? r.u.mean() : 0.0);
  centre(rows, rows.u);
  return rows;
}

Scales scales_of(const Rows& rows, const ShaftTurns& turns, bool held_output) {
  Scales s;
  s.turns = turns, s.held_output = held_output, s.one_speed = rows.free_constant;
  s.hz = rows.records().front().hz;
  s.start = kInfinity;
  double low = kInfinity, high = -kInfinity, end = -kInfinity;
  std::vector<double> speeds;
  for (const BandRecord& r : rows.records()) {
    s.start = std::min(s.start, r.t.front()), end = std::max(end, r.t.back());
    const auto [least, most] = std::minmax_element(r.x.begin(), r.x.end());
    low = std::min(low, *least), high = std::max(high, *most);
    speeds.insert(speeds.end(), r.w.begin(), r.w.end());
  }
  s.duration = end - s.start;
  s.travel = high - low;
  s.speed_rms = rms(speeds);
  s.speed_std = std::sqrt(std::max(0.0, s.speed_rms * s.speed_rms - std::pow(mean(speeds), 2)));
  for (double& v : speeds) v = std::abs(v);
  s.top_speed = *std::max_element(speeds.begin(), speeds.end());
  s.torque_rms = std::sqrt(rows.input_square() / static_cast<double>(std::max<Eigen::Index>(1, rows.size())));
  return s;
}

void centre(const Rows& rows, Eigen::Ref<Eigen::MatrixXd> columns) {
  if (!rows.free_constant) return;
  for (std::size_t r = 0; r < rows.records().size(); ++r)
    for (Eigen::Index c = 0; c < columns.cols(); ++c) {
      auto part = columns.col(c).segment(rows.first[r], rows.first[r + 1] - rows.first[r]);
      if (part.size() > 0) part.array() -= part.mean();
    }
}

void filter_columns(Rows& rows, const Law& law, std::size_t r, Eigen::Ref<Eigen::MatrixXd> columns) {
  const BandRecord& record = rows.records()[r];
  const RowFilter& filter = law.follows_states ? record.rest : record.whole;
  for (int c = 0; c < law.columns; ++c)
    filter.apply(rows.at_samples.col(c).data(), columns.col(c).data() + rows.first[r]);
}

void fill_columns(Rows& rows, const Law& law, const Shape& shape, Eigen::Ref<Eigen::MatrixXd> columns) {
  for (std::size_t r = 0; r < rows.records().size(); ++r) {
    const auto count = static_cast<Eigen::Index>(rows.records()[r].t.size());
    law.fill(rows.samples(r), shape, rows.at_samples.topLeftCorner(count, law.columns));
    filter_columns(rows, law, r, columns);
  }
  centre(rows, columns);
}

Eigen::MatrixXd model_columns(Rows& rows, const Model& model) {
  Eigen::Index count = 0;
  for (const Term& term : model) count += term.law->columns;
  Eigen::MatrixXd columns(rows.size(), count);
  Eigen::Index first = 0;
  for (const Term& term : model) {
    fill_columns(rows, *term.law, term.shape, columns.middleCols(first, term.law->columns));
    first += term.law->columns;
  }
  return columns;
}

void set_torque(Rows& rows, const Model& model) {
  rows.inertia = first_coefficient(model, "inertia");
  rows.viscous = first_coefficient(model, "viscous");
  for (std::size_t r = 0; r < rows.records().size(); ++r) {
    const auto count = static_cast<Eigen::Index>(rows.records()[r].t.size());
    Eigen::Map<Eigen::VectorXd> tau(rows.tau[r].data(), count), load(rows.tau_load[r].data(), count);
    tau.setZero(), load.setZero();
    for (const Term& term : model) {
      if (term.law->kind == Kind::kOnTorque) continue;
      auto g = rows.at_samples.topLeftCorner(count, term.law->columns);
      term.law->fill(rows.samples(r), term.shape, g);
      tau.noalias() += g * term.theta;
      if (term.law->kind == Kind::kMotion) load.noalias() += g * term.theta;
    }
    if (rows.free_constant) tau.array() += rows.level[r] - tau.mean();
  }
}

const Term* spring_of(const Model& model) {
  const auto at = std::find_if(model.begin(), model.end(),
                               [](const Term& t) { return t.law->sign == Sign::kShareOfInertia; });
  return at == model.end() ? nullptr : &*at;
}

Eigen::MatrixXd swing_columns(Rows& rows, const Shape& spring) {
  const std::size_t records = rows.records().size();
  Eigen::MatrixXd swing = Eigen::MatrixXd::Zero(rows.size(), static_cast<Eigen::Index>(2 * records));
  for (std::size_t r = 0; r < records; ++r) {
    const BandRecord& record = rows.records()[r];
    starting_swing(rows.samples(r), spring,
                   rows.at_samples.topLeftCorner(static_cast<Eigen::Index>(record.t.size()), 2));
    for (Eigen::Index c = 0; c < 2; ++c)
      record.rest.apply(rows.at_samples.col(c).data(),
                        swing.col(static_cast<Eigen::Index>(2 * r) + c).data() + rows.first[r]);
  }
  centre(rows, swing);
  return swing;
}

Eigen::MatrixXd model_and_swing(Rows& rows, const Model& model) {
  Eigen::MatrixXd columns = model_columns(rows, model);
  const Term* spring = spring_of(model);
  if (spring == nullptr) return columns;
  const Eigen::MatrixXd swing = swing_columns(rows, spring->shape);
  columns.conservativeResize(Eigen::NoChange, columns.cols() + swing.cols());
  columns.rightCols(swing.cols()) = swing;
  return columns;
}

Model fitted(Rows& rows, Model model) {
  const int rounds = reads_torque(model) ? kTorqueRounds : 0;
  take_solution(rows, model);
  Model best = model;
  double least = rounds > 0 ? residual(rows, model, false).squaredNorm() : 0.0;
  for (int round = 0; round < rounds;
       ++round) {  // torque of the model, fit again: mostly, not always, better
    take_solution(rows, model);
    const double square = residual(rows, model, false).squaredNorm();
    if (square < least) least = square, best = model;
  }
  set_torque(rows, best);
  return best;
}

Eigen::VectorXd residual(Rows& rows, const Model& model, bool new_phase) {
  set_torque(rows, model);
  Eigen::VectorXd left = rows.u;
  std::vector<std::pair<Eigen::MatrixXd, double>> lines;
  for (const Term& term : model) {
    Eigen::MatrixXd columns(rows.size(), term.law->columns);
    fill_columns(rows, *term.law, term.shape, columns);
    if (new_phase && term.law->line)
      lines.emplace_back(std::move(columns), term.theta.norm());
    else
      left.noalias() -= columns * term.theta;
  }
  if (const Term* spring = spring_of(model)) {
    const Eigen::MatrixXd swing = swing_columns(rows, spring->shape);
    left -= swing * solved(swing, left);
  }
  for (std::size_t r = 0; r < rows.records().size(); ++r)
    for (const auto& [line, amplitude] : lines) {
      const Eigen::Index first = rows.first[r], count = rows.first[r + 1] - first;
      const auto part = line.middleRows(first, count);
      const Eigen::VectorXd before = left.segment(first, count);
      left.segment(first, count) = before - part * turned(part, before, amplitude);
    }
  return left;
}

}  // namespace gapscope::internal::torque_view

#include "reference/information.h"

#include <algorithm>
#include <cmath>

namespace gapscope::internal::reference {
namespace {

constexpr int kWindows = 24;  ///< the recordings are cut into about so many, for the scatter of scores
constexpr int kPlaces = 55;   ///< of the counts under the motion that are tried, on a lattice with
constexpr int kLattice = 34;  ///< this generator: both are Fibonacci numbers
constexpr int kPieces = 4;    ///< fewest, to leave one out: fewer recordings are cut
constexpr std::size_t kMostLags = 2000;
/// For a derivative: small beside a row, large beside rounding [rows]. Half and double change intervals of
/// `study_rows 3001 3003 FOLDER run`, as recorded and every second row, by less than 1 %.
constexpr double kTriedDelay = 0.1;

/// One recording's part: its residuals and Jacobian, and where its columns go.
struct Part {
  Eigen::VectorXd residuals;
  Cost::Rows jacobian;
  std::vector<Eigen::Index> columns;
};

/// Adds the small symmetric matrix of one recording to the whole one.
void scatter(const Eigen::MatrixXd& part, const std::vector<Eigen::Index>& columns, Eigen::MatrixXd& whole) {
  for (std::size_t i = 0; i < columns.size(); ++i)
    for (std::size_t j = 0; j < columns.size(); ++j)
      whole(columns[i], columns[j]) += part(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
}

Part part_of(const Cost& cost, std::size_t r) {
  Part part;
  for (Eigen::Index i = 0; i < cost.shared(); ++i) part.columns.push_back(i);
  for (Eigen::Index i = 0; i < cost.states(r); ++i) part.columns.push_back(cost.first_state(r) + i);
  part.residuals.resize(cost.samples(r));
  part.jacobian.resize(cost.samples(r), std::ssize(part.columns));
  return part;
}

Eigen::MatrixXd window_scores(const Part& part, Eigen::Index length, int& count) {
  const Eigen::Index n = part.jacobian.cols(), samples = part.residuals.size();
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index first = 0; first < samples; first += length) {
    const Eigen::Index size = std::min(length, samples - first);
    const Eigen::VectorXd score =
        part.jacobian.middleRows(first, size).transpose() * part.residuals.segment(first, size);
    sum += score * score.transpose();
    ++count;
  }
  return sum;
}

/// How the counts lie under a motion, in quanta: where its middle is, and by how much the whole travel is
/// longer. The fitted motion rests and turns at counts, since the fit has drawn it there; the true one need
/// not, and two such places that are off by the same would be no error but in the initial state.
struct CountPlace {
  double phase = 0.0, stretch = 0.0;
};

CountPlace count_place(int j, int of, int generator) {
  return {j / double(of), (generator * j % of) / double(of) - 0.5};
}

/// The error of an encoder on the fitted motion, for counts that lie anywhere, in floors. Noise before the
/// quantiser spreads its error; the first harmonic falls by exp(−2π² (noise/quantum)²).
struct Quantiser {
  double quantum = 0.0, floor = 1.0;
  double size = 0.0;                  ///< of an error of one quantum [floor]; 0: nothing of it is left
  double middle = 0.0, travel = 1.0;  ///< of the motion

  Quantiser(const Eigen::VectorXd& residuals, const MotorTrace& recording, double recording_floor)
      : quantum(recording.quantum), floor(recording_floor) {
    if (!(quantum > 0.0)) return;
    const double square = residuals.squaredNorm() / static_cast<double>(residuals.size()) * floor * floor;
    const double noise = std::sqrt(std::max(0.0, square - quantum * quantum / 12.0)) / quantum;
    size = std::exp(-2.0 * kPi * kPi * noise * noise) * quantum / floor;
    if (size < 1e-3) size = 0.0;
    const auto [least, most] = std::minmax_element(recording.x1.begin(), recording.x1.end());
    middle = 0.5 * (*least + *most), travel = std::max(*most - *least, quantum);
  }

  Eigen::VectorXd error(const Eigen::VectorXd& residuals, const MotorTrace& recording,
                        CountPlace place) const {
    Eigen::VectorXd e(residuals.size());
    for (Eigen::Index i = 0; i < e.size(); ++i) {
      const double x = recording.x1[i] - residuals[i] * floor - middle;
      const double counts = x / quantum + place.phase + place.stretch * x / travel;
      e[i] = (std::nearbyint(counts) - counts) * size;
    }
    return e;
  }
};

Eigen::MatrixXd quantiser_scores(const Part& part, const MotorTrace& recording, double floor) {
  const Eigen::Index n = part.jacobian.cols();
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(n, n);
  const Quantiser quantiser(part.residuals, recording, floor);
  if (quantiser.size == 0.0) return sum;
  for (int j = 0; j < kPlaces; ++j)
    for (const double side : {1.0, -1.0}) {  // as the same drive shows it whose axes point the other way
      CountPlace place = count_place(j, kPlaces, kLattice);
      place.phase *= side;
      const Eigen::VectorXd score =
          part.jacobian.transpose() * quantiser.error(part.residuals, recording, place);
      sum += score * score.transpose() / (2.0 * kPlaces);
    }
  return sum;
}

double autocovariance(const Eigen::VectorXd& r, std::size_t lag) {
  const auto k = static_cast<Eigen::Index>(lag);
  return r.head(r.size() - k).dot(r.tail(r.size() - k));
}

/// 1 + 2 Σ ρ over the initial lags whose pairs stay positive (Geyer's rule).
double inflation_of(const std::vector<Part>& parts) {
  const auto pooled = [&](std::size_t lag) {
    double sum = 0.0;
    for (const Part& p : parts)
      if (lag < static_cast<std::size_t>(p.residuals.size())) sum += autocovariance(p.residuals, lag);
    return sum;
  };
  const double zero = pooled(0);
  if (!(zero > 0.0)) return 1.0;
  const double one = pooled(1);
  double sum = zero + one;
  for (std::size_t lag = 2; lag < kMostLags; lag += 2) {
    const double pair = pooled(lag) + pooled(lag + 1);
    if (!(pair > 0.0)) break;
    sum += pair;
  }
  return std::max(1.0, 2.0 * sum / zero - 1.0);
}

Correlation correlation_of(const FitProblem& problem, const std::vector<Part>& parts) {
  constexpr int kFewPhases = 4;
  double zero = 0.0, one = 0.0, quantised = 0.0;
  for (std::size_t r = 0; r < parts.size(); ++r) {
    const Eigen::VectorXd& residuals = parts[r].residuals;
    zero += residuals.squaredNorm();
    one += autocovariance(residuals, 1);
    const MotorTrace& recording = problem.recordings[r];
    const Quantiser quantiser(residuals, recording, problem.floors[r]);
    if (quantiser.size == 0.0) continue;
    for (int j = 0; j < kFewPhases; ++j)
      quantised +=
          autocovariance(quantiser.error(residuals, recording, {j / double(kFewPhases)}), 1) / kFewPhases;
  }
  if (!(zero > 0.0)) return {0.0, 0.0, 0.0};
  return {one / zero, quantised / zero, 0.0};
}

/// Residuals and derivatives of each recording; empty where the motion diverges.
std::vector<Part> parts_at(const Cost& cost, const Cost::Vector& x, double& simulations) {
  std::vector<Part> parts;
  for (std::size_t r = 0; r < cost.recordings(); ++r) {
    parts.push_back(part_of(cost, r));
    const Evaluation done = cost.evaluate(r, x, parts[r].residuals.data(), parts[r].jacobian.data());
    simulations += done.simulations;
    if (!done.valid) return {};
  }
  return parts;
}

/// Adds the derivative by a delay of the input, in rows, as the last column of each part.
/// @returns false where the delay is a number of the model or of a controller that makes the input, or the
/// motion diverges
bool add_delay(const FitProblem& problem, const FitPoint& at, double observer_hz, std::vector<Part>& parts,
               double& simulations) {
  const auto& effects = problem.effects;
  if (problem.controller || std::find(effects.begin(), effects.end(), &pure_delay()) != effects.end())
    return false;
  std::vector<MotorTrace> later(problem.recordings.begin(), problem.recordings.end());
  for (MotorTrace& r : later) {
    if (!r.sent.empty()) return false;
    r.sent = r.u, r.delay = kTriedDelay * r.dt;
  }
  FitProblem delayed = problem;
  delayed.recordings = later;
  const Cost cost(delayed, at, observer_hz);
  const Cost::Vector x = cost.pack(at);
  std::vector<Eigen::VectorXd> residuals;
  for (std::size_t r = 0; r < parts.size(); ++r) {
    residuals.emplace_back(cost.samples(r));
    const Evaluation done = cost.evaluate(r, x, residuals[r].data(), nullptr);
    simulations += done.simulations;
    if (!done.valid) return false;
  }
  for (std::size_t r = 0; r < parts.size(); ++r) {
    Part& p = parts[r];
    p.jacobian.conservativeResize(Eigen::NoChange, p.jacobian.cols() + 1);
    p.jacobian.rightCols<1>() = (residuals[r] - p.residuals) / kTriedDelay;
    p.columns.push_back(cost.size());
  }
  return true;
}

/// The matrices, and what the residuals alone say.
void add_up(const FitProblem& problem, const std::vector<Part>& parts, Eigen::Index columns,
            Information& sum) {
  double samples = 0.0, squares = 0.0, quantised = 0.0;
  for (std::size_t r = 0; r < parts.size(); ++r) {
    const double size = static_cast<double>(parts[r].residuals.size());
    samples += size;
    squares += parts[r].residuals.squaredNorm();
    quantised += size * std::pow(problem.recordings[r].quantum / problem.floors[r], 2) / 12.0;
  }
  sum.normal = sum.windows = sum.quantiser = Eigen::MatrixXd::Zero(columns, columns);
  const auto length = static_cast<Eigen::Index>(std::ceil(samples / kWindows));
  for (std::size_t r = 0; r < parts.size(); ++r) {
    const Part& p = parts[r];
    scatter(p.jacobian.transpose() * p.jacobian, p.columns, sum.normal);
    scatter(window_scores(p, length, sum.window_count), p.columns, sum.windows);
    scatter(quantiser_scores(p, problem.recordings[r], problem.floors[r]), p.columns, sum.quantiser);
  }
  sum.variance = std::max(squares, quantised) / std::max(1.0, samples - static_cast<double>(columns));
  sum.inflation = inflation_of(parts);
}

/// Takes out of the derivatives by the shared numbers, and of the residuals, what the initial state follows.
void let_state_follow(Eigen::Index shared, Part& part) {
  const Eigen::Index states = part.jacobian.cols() - shared;
  if (states == 0) return;
  const Eigen::MatrixXd by_state = part.jacobian.rightCols(states);
  Eigen::MatrixXd square = by_state.transpose() * by_state;
  square.diagonal().array() += kStateSlope * kStateSlope;
  const Eigen::LDLT<Eigen::MatrixXd> inverse(square);
  const Eigen::MatrixXd follows = inverse.solve(by_state.transpose() * part.jacobian.leftCols(shared));
  part.residuals -= by_state * inverse.solve(by_state.transpose() * part.residuals);
  part.jacobian.leftCols(shared) -= by_state * follows;
}

FitPiece piece_of(const Part& part, Eigen::Index shared, Eigen::Index first, Eigen::Index size) {
  const Eigen::MatrixXd by = part.jacobian.block(first, 0, size, shared);
  const Eigen::VectorXd left = part.residuals.segment(first, size);
  const Eigen::MatrixXd normal = by.transpose() * by;
  const Eigen::VectorXd slope = by.transpose() * left;
  FitPiece piece;
  piece.samples = static_cast<int>(size);
  piece.square = left.squaredNorm();
  piece.slope.assign(slope.begin(), slope.end());
  for (Eigen::Index i = 0; i < shared; ++i)
    for (Eigen::Index j = 0; j <= i; ++j) piece.normal.push_back(normal(i, j));
  return piece;
}

std::vector<FitPiece> pieces_of(const Cost& cost, std::vector<Part> parts) {
  std::vector<FitPiece> pieces;
  const Eigen::Index each = std::max<Eigen::Index>(1, (kPieces + std::ssize(parts) - 1) / std::ssize(parts));
  for (std::size_t r = 0; r < parts.size(); ++r) {
    let_state_follow(cost.shared(), parts[r]);
    const Eigen::Index samples = cost.samples(r);
    for (Eigen::Index k = 0; k < each; ++k) {
      const Eigen::Index first = k * samples / each, end = (k + 1) * samples / each;
      pieces.push_back(piece_of(parts[r], cost.shared(), first, end - first));
      pieces.back().recording = static_cast<int>(r);
    }
  }
  return pieces;
}

/// Half of the slope of the cost along each column.
Eigen::VectorXd score_of(const Cost& cost, const Cost::Vector& x, const std::vector<Part>& parts) {
  Eigen::VectorXd score = Eigen::VectorXd::Zero(cost.size() + 1);
  for (Eigen::Index i = 0; i < cost.size(); ++i)
    score[i] = cost.beside_residual(i, x[i]) * cost.beside_slope(i, x[i]);
  for (const Part& p : parts) {
    const Eigen::VectorXd part = p.jacobian.transpose() * p.residuals;
    for (std::size_t i = 0; i < p.columns.size(); ++i)
      score[p.columns[i]] += part[static_cast<Eigen::Index>(i)];
  }
  return score;
}

/// Takes the delay, the last column, out of the matrices again: what a Gauss–Newton step of all numbers with
/// it makes of it, and how the others follow.
void take_timing(const Eigen::VectorXd& score, Information& i) {
  const Eigen::Index n = score.size() - 1;
  const Eigen::VectorXd scale = i.normal.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd scaled = scale.asDiagonal() * i.normal * scale.asDiagonal();
  const Eigen::VectorXd last =
      Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd>(scaled).solve(Eigen::VectorXd::Unit(n + 1, n));
  const Eigen::VectorXd row = scale[n] * scale.cwiseProduct(last);  // of the inverse
  if (row.allFinite() && row[n] > 0.0) {
    i.timing.early_rows = row.dot(score);
    i.timing.std_rows = std::sqrt(variance_along(i, row, row[n]));
    i.by_timing = -row.head(n) / row[n];
  }
  for (Eigen::MatrixXd* m : {&i.normal, &i.windows, &i.quantiser}) *m = m->topLeftCorner(n, n).eval();
}

}  // namespace

double variance_along(const Information& i, const Eigen::VectorXd& row, double diagonal) {
  const double count = std::max(2, i.window_count);
  return std::max({i.variance * i.inflation * diagonal, count / (count - 1.0) * row.dot(i.windows * row),
                   row.dot(i.quantiser * row)});
}

Correlation correlation_at(const FitProblem& problem, const FitPoint& at, double observer_hz) {
  const Cost cost(problem, at, observer_hz);
  const Cost::Vector x = cost.pack(at);
  std::vector<Part> parts(cost.recordings());
  double simulations = 0.0;
  for (std::size_t r = 0; r < cost.recordings(); ++r) {
    parts[r].residuals.resize(cost.samples(r));
    const Evaluation done = cost.evaluate(r, x, parts[r].residuals.data(), nullptr);
    simulations += done.simulations;
    if (!done.valid) return {kNaN, 0.0, simulations};
  }
  Correlation correlation = correlation_of(problem, parts);
  correlation.simulations = simulations;
  return correlation;
}

Information information_at(const FitProblem& problem, const FitPoint& at, double observer_hz) {
  const Cost cost(problem, at, observer_hz);
  const Cost::Vector x = cost.pack(at);
  Information information;
  std::vector<Part> parts = parts_at(cost, x, information.simulations);
  if (parts.empty()) return information;
  const Eigen::Index n = cost.size();
  information.pieces = pieces_of(cost, parts);
  const bool timed = add_delay(problem, at, observer_hz, parts, information.simulations);
  add_up(problem, parts, timed ? n + 1 : n, information);
  for (Eigen::Index i = 0; i < n; ++i) information.normal(i, i) += cost.beside_curvature(i, x[i]);
  const Eigen::VectorXd score = score_of(cost, x, parts);
  if (timed) take_timing(score, information);
  information.score = score.head(n);
  information.correlation = correlation_of(problem, parts);
  information.valid = information.normal.allFinite();
  return information;
}

}  // namespace gapscope::internal::reference

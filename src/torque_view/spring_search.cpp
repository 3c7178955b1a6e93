#include "torque_view/spring_search.h"

#include <ceres/ceres.h>
#include <ceres/dynamic_numeric_diff_cost_function.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

namespace gapscope::internal::torque_view {
namespace {

constexpr double kLightDamping = 0.03, kHeavyDamping = 0.15;  ///< that a spring is looked for with [-]
constexpr double kWorthRefining = 0.03;  ///< gain on the grid from which it is refined [-]
constexpr double kMuchRub = 0.3;         ///< Coulomb friction of a load to begin with [rms of the input]
constexpr double kLeastDamping = 0.002;  ///< ratio of a spring's: below it a swing outlasts a recording [-]
constexpr double kMostDamping = 0.7;     ///< ratio of a spring's: beyond it nothing swings [-]
constexpr double kShapeStep = 1e-3;      ///< of the derivatives of a spring's shape [-]
constexpr double kLeastScale = 1e-9;     ///< of friction by inertia, in which its steps are measured [SI]
constexpr int kShapeSteps = 25;
constexpr double kShapeTolerance = 1e-5;  ///< of what is left, where they end [-]

/// The law's columns at a shape, with what swings when the recordings begin, where these are few.
Eigen::MatrixXd columns_at(Rows& rows, const Law& law, const Shape& shape) {
  const bool swings = law.columns + 2 * static_cast<int>(rows.records().size()) <= kMostColumns;
  Eigen::MatrixXd columns(rows.size(), law.columns);
  fill_columns(rows, law, shape, columns);
  if (!swings) return columns;
  const Eigen::MatrixXd swing = swing_columns(rows, shape);
  columns.conservativeResize(Eigen::NoChange, columns.cols() + swing.cols());
  columns.rightCols(swing.cols()) = swing;
  return columns;
}

/// One that is absent leads nothing.
bool leads(const BestShape& a, const BestShape& b) {
  return a.gain > b.gain || (std::isnan(b.gain) && !std::isnan(a.gain));
}

/// Looks for the spring at which a load gains most.
class SpringSearch {
 public:
  SpringSearch(Rows& rows, Projection& projection, const Law& law, const std::vector<double>& grid)
      : rows_(rows), projection_(projection), law_(law), grid_(grid) {}

  BestShape at(const Shape& shape) { return gain_of(shape, columns_at(rows_, law_, shape)); }

  /// The best of a grid of frequencies for a load that swings for long and for one that is damped, in steps
  /// as fine as its damping asks for; swings that the recordings begin with are left to the refinement.
  /// @param rubs  whether it has friction of its own
  BestShape on_grid(bool rubs) {
    BestShape best;
    Eigen::MatrixXd column(rows_.size(), law_.columns);
    for (const double damping : {kLightDamping, kHeavyDamping})
      for (std::size_t i = 0; i < grid_.size();
           i += static_cast<std::size_t>(std::lround(damping / kLightDamping))) {
        Shape shape = grid_[i];
        shape.damping = damping;
        if (rubs) shape.drag = drag(), shape.rub = kMuchRub * push();
        fill_columns(rows_, law_, shape, column);
        if (const BestShape there = gain_of(shape, column); leads(there, best)) best = there;
      }
    return best;
  }

  /// By least squares in frequency, damping (both as logarithms), drag and Coulomb friction.
  BestShape refined(const BestShape& from) {
    if (!(from.gain >= kWorthRefining)) return from;
    const double drag = this->drag(), rub = push();
    const auto shape_of = [=](const double* p) {
      Shape shape = std::exp(p[0]);
      shape.damping = std::exp(p[1]), shape.drag = drag * p[2], shape.rub = rub * p[3];
      return shape;
    };
    const auto left = [&](double const* const* p, double* residual) {
      Eigen::Map<Eigen::VectorXd>(residual, rows_.size()) =
          projection_.left_after(columns_at(rows_, law_, shape_of(p[0])));
      return true;
    };
    std::array<double, 4> p = {std::log(std::clamp(from.shape.at, grid_.front(), grid_.back())),
                               std::log(std::clamp(from.shape.damping, kLeastDamping, kMostDamping)),
                               from.shape.drag / drag, from.shape.rub / rub};
    ceres::NumericDiffOptions step;
    step.relative_step_size = kShapeStep;
    auto cost = std::make_unique<ceres::DynamicNumericDiffCostFunction<decltype(left)>>(
        &left, ceres::DO_NOT_TAKE_OWNERSHIP, step);
    cost->AddParameterBlock(4);
    cost->SetNumResiduals(static_cast<int>(rows_.size()));
    ceres::Problem problem;
    problem.AddResidualBlock(cost.release(), nullptr, p.data());
    problem.SetParameterLowerBound(p.data(), 0, std::log(grid_.front()));
    problem.SetParameterUpperBound(p.data(), 0, std::log(grid_.back()));
    problem.SetParameterLowerBound(p.data(), 1, std::log(kLeastDamping));
    problem.SetParameterUpperBound(p.data(), 1, std::log(kMostDamping));
    problem.SetParameterLowerBound(p.data(), 2, 0.0);
    problem.SetParameterLowerBound(p.data(), 3, 0.0);
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_QR;
    options.max_num_iterations = kShapeSteps;
    options.function_tolerance = kShapeTolerance;
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    const BestShape to = at(shape_of(p.data()));
    return to.gain > from.gain ? to : from;
  }

 private:
  /// The drive's friction by its inertia: of the speed, and of what the input makes.
  double drag() const { return std::max(std::abs(rows_.viscous / rows_.inertia), kLeastScale); }
  double push() const {
    const double input = rows_.u.norm() / std::sqrt(static_cast<double>(rows_.size()));
    return std::max(input / std::abs(rows_.inertia), kLeastScale);
  }

  BestShape gain_of(const Shape& shape, const Eigen::MatrixXd& columns) {
    const Projection::Gain gain = projection_.gain(columns);
    return has_its_sign(law_, gain.theta[0], kInfinity) ? BestShape{shape, gain.share} : BestShape{};
  }

  Rows& rows_;
  Projection& projection_;
  const Law& law_;
  const std::vector<double>& grid_;
};

}  // namespace

BestShape best_spring(Rows& rows, Projection& projection, const Law& law, const std::vector<double>& grid) {
  SpringSearch search(rows, projection, law, grid);
  const BestShape smooth = search.refined(search.on_grid(false)), rubs = search.refined(search.on_grid(true));
  return leads(rubs, smooth) ? rubs : smooth;
}

BestShape refined_spring(Rows& rows, Projection& projection, const Law& law, const Scales& scales,
                         const Shape& from) {
  const std::vector<double> grid = law.shapes(scales);
  SpringSearch search(rows, projection, law, grid);
  return grid.empty() ? search.at(from) : search.refined(search.at(from));
}

}  // namespace gapscope::internal::torque_view

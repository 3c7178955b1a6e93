#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "exports/export_source.h"
#include "gapscope/results/certificate.h"

namespace gapscope::internal::exports {

/// Of two motions at the same times; diverges where the target is no number or ends before.
TargetError compared(const std::vector<double>& model, const std::vector<double>& target);

double range_of(const std::vector<double>& x1);

/// The target's x1 at every step, from t = 0 on, under an input held over each; shorter where it diverges.
using TargetMotion = std::function<std::vector<double>(double step, std::span<const double> u)>;

/// The target against the model at many steps. What is compared are the steps that fall
/// on multiples of kJudgedEvery.
class TargetErrors {
 public:
  explicit TargetErrors(const ExportSource& source);

  /// At one step [s]: kCommonTime over a whole number, or a whole multiple of it.
  TargetError at(double step, const TargetMotion& motion) const;
  /// At the listed steps, and between them the largest that the target stands. One that lacks a part of the
  /// drive may be far from the model at any step: the steps are then judged by its own motion at the finest.
  StepLimits scan(const std::string& integrator, const TargetMotion& motion,
                  std::vector<TargetError>& errors) const;

  double travel() const { return travel_; }
  /// Whether one of the listed steps divides the rows of the input. Only those that do, or are a whole
  /// multiple of them, are compared then: under any other a row acts late, which is no error of the target's.
  bool steps_fall_on_rows() const;

 private:
  TargetError against(const std::vector<double>& reference, double step, const TargetMotion& motion) const;
  bool is_steady(const TargetError& error) const { return !error.diverges && !error.unstable; }
  bool stands(const TargetError& error) const { return is_steady(error) && error.max <= 0.1 * travel_; }
  std::vector<double> own_motion(double step, const TargetMotion& motion) const;
  bool grows(double step, std::vector<double> u, const std::vector<double>& x1,
             const TargetMotion& motion) const;
  double between(double good, double bad, const std::vector<double>& reference,
                 const TargetMotion& motion) const;

  const ExportSource& source_;
  std::vector<double> model_;  ///< x1 at multiples of kJudgedEvery
  double travel_ = 0.0;
};

/// What all listed steps divide or are multiples of [s].
inline constexpr double kCommonTime = 4e-3;

/// Of the listed steps the smallest [s].
inline constexpr double kFinestStep = 1e-5;

/// Where the target is compared with the model [s].
inline constexpr double kJudgedEvery = 1e-3;

/// The step at which a part may be called exact, or not [s].
inline constexpr double kCertifiedStep = 1e-4;

}  // namespace gapscope::internal::exports

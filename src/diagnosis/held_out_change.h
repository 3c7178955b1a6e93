#pragma once

#include <Eigen/Dense>

#include "diagnosis/harmonics.h"
#include "diagnosis/study.h"

namespace gapscope::internal::diagnosis {

/// Errors beside what is held out, all recordings one after the other [rad].
struct HeldOutErrors {
  Eigen::VectorXd innovation, free;

  bool exist() const { return innovation.size() > 0; }
};

/// A fitted model beside what is held out, and what its own numbers can say of a change of its errors.
class HeldOutChange {
 public:
  HeldOutChange(const Study& study, const ReferenceModel& model);

  bool usable() const { return errors_.exist(); }
  const ReferenceModel& model() const { return model_; }

  /// What another model changes of the errors, from the same initial states; none where its motion diverges.
  HeldOutErrors by(const ReferenceModel& other) const;
  /// The change without what the model's free numbers would say of it: δ − D (D⁺ δ) of the innovations, D
  /// their differences by the numbers, and the same numbers' part of the free runs.
  HeldOutErrors beyond_numbers(const HeldOutErrors& change) const;
  /// By how much the correcting torque of another model differs, a series for each recording [N m]; empty
  /// where its motion diverges.
  std::vector<std::vector<double>> torque_by(const ReferenceModel& other) const;
  /// The strongest lines of the correcting torque less so much, as the search for periodic effects begins.
  /// @param torque_constant see angle_spectrum()
  std::vector<Harmonic> lines_with(const std::vector<std::vector<double>>& change, double factor,
                                   double torque_constant) const;

  /// Windows of the errors with a change.
  ScoredModel scored_with(const EffectEntry* entry, const HeldOutErrors& change) const;
  HeldOutErrors nothing() const;

 private:
  HeldOutErrors errors_of(const ReferenceModel& model) const;
  void differentiate();
  Eigen::VectorXd judged(const Eigen::VectorXd& samples) const;

  const Study& study_;
  const ReferenceModel& model_;
  std::vector<reference::RecordingStart> starts_;
  HeldOutErrors errors_;
  std::vector<Playback> played_;             ///< with the correcting torque
  Eigen::MatrixXd innovation_by_, free_by_;  // (samples × numbers)
};

/// Coefficients of columns that say most of a signal.
Eigen::VectorXd least_squares(const Eigen::MatrixXd& columns, const Eigen::VectorXd& of);

}  // namespace gapscope::internal::diagnosis

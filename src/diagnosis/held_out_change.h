#pragma once

#include <Eigen/Dense>

#include "diagnosis/study.h"

namespace gapscope::internal::diagnosis {

/// Errors beside what is held out, all recordings one after the other [rad].
struct HeldOutErrors {
  Eigen::VectorXd innovation, free;
  double torque = kNaN;  ///< rms of the residual torque's change [N m]

  bool exist() const { return innovation.size() > 0; }
};

/// A fitted model beside what is held out, and what its own numbers can say of a change of its errors.
class HeldOutChange {
 public:
  HeldOutChange(const Study& study, const ReferenceModel& model);

  bool usable() const { return errors_.exist(); }
  const HeldOutErrors& errors() const { return errors_; }

  /// What another model changes of the errors, from the same initial states; none where its motion diverges.
  HeldOutErrors by(const ReferenceModel& other) const;
  /// The change without what the model's free numbers would say of it: δ − D (D⁺ δ) of the innovations, D
  /// their differences by the numbers, and the same numbers' part of the free runs.
  HeldOutErrors beyond_numbers(const HeldOutErrors& change) const;
  /// rms of the torque by which the residual torques of both models differ [N m].
  double torque_of(const ReferenceModel& other) const;

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
  Eigen::MatrixXd innovation_by_, free_by_;  // (samples × numbers)
};

/// Columns that changes are expressed in.
Eigen::VectorXd least_squares(const Eigen::MatrixXd& columns, const Eigen::VectorXd& of);

}  // namespace gapscope::internal::diagnosis

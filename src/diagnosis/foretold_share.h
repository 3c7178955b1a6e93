#pragma once

#include <memory>
#include <span>

#include "gapscope/diagnosis/diagnosis.h"

namespace gapscope {

/// How much of the held-out residual torque would go to what was changed in recordings, if it were found:
/// with R what the best model of the recordings as they were leaves of their held-out part, and R' what the
/// same terms, fitted again, leave of the changed ones, 1 − R/R'. What the model says in place of the change
/// counts for nothing. No simulation, and no law but those that the recordings as they were ask for.
class ForetoldShares {
 public:
  /// @param train, held_out  must outlive this; held_out may be empty: the last third of each file
  /// @param model  as for diagnose(), which must have run on these recordings: what it fitted
  ForetoldShares(std::span<const MotorTrace> train, std::span<const MotorTrace> held_out,
                 const ReferenceModel& model, const DiagnosisOptions& options);
  ~ForetoldShares();
  ForetoldShares(const ForetoldShares&) = delete;
  ForetoldShares& operator=(const ForetoldShares&) = delete;

  /// @param train, held_out  the changed recordings, in the same order
  /// @param effect  what the change stands for: where the drive has it, too, that is not counted as said
  /// @return 0 to 1; NaN where the torque balance of the drive depends on its contact
  double of(std::span<const MotorTrace> train, std::span<const MotorTrace> held_out,
            const std::string& effect) const;

 private:
  struct Undisturbed;
  std::unique_ptr<Undisturbed> undisturbed_;
};

}  // namespace gapscope

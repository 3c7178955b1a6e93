#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gapscope/base/process_lock.h"

namespace gapscope {

/// A folder that appears complete or not at all. What is to be stored is first written into a temporary
/// folder beside the final one; commit() then moves it over file by file, result.json last. Until then the
/// final folder, and whatever an earlier run left in it, stays as it was; without commit() the temporary
/// folder is removed; one that a killed process left is removed by the next report of the same name.
///
/// A folder holds one report, of an estimate and a diagnosis where both were made: commit() also removes what
/// an earlier report left and the new one does not have (the figures that its report.md shows, report.md,
/// result.json, diagnosis.json, fitted.yaml, next_experiment.*, campaign.json, blind.json, compare.json,
/// resolved.yaml, timing.json and traces/). Any other file in the folder belongs to the user and stays.
class ReportFolder {
 public:
  /// Makes the temporary folder, and the folders above it where they are missing.
  /// @throws std::runtime_error with the path where that cannot be done.
  explicit ReportFolder(const std::string& folder);
  ~ReportFolder();
  ReportFolder(const ReportFolder&) = delete;
  ReportFolder& operator=(const ReportFolder&) = delete;

  /// Where to write; exists and is empty at the start.
  const std::string& path() const { return partial_; }

  /// Takes over what the other kind of command stored here, so that the new report shows it too; nothing
  /// where there is none.
  void keep_estimate();   ///< of run, detect or fit
  void keep_diagnosis();  ///< of diagnose
  void keep_stored();     ///< all that a report is drawn from

  /// @throws std::runtime_error with the path of what could not be moved or removed.
  void commit();

 private:
  void take_over(const std::string& file);
  void keep(const char* result, const std::vector<const char*>& others, bool held_out_traces);

  std::string final_;
  std::string partial_;
  std::unique_ptr<ProcessLock> lock_;  ///< of the temporary folder
};

}  // namespace gapscope

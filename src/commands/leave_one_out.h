#pragma once

#include <string>
#include <vector>

#include "run/run_diagnosis.h"

namespace gapscope {

/// Recordings that are held out together: one, or all with one value of what is known of them.
struct LeftOut {
  std::string told;  ///< "servo_3.csv", "mass 0.535 kg"
  std::vector<RecordedFile> files;
};

/// What a diagnosis of all the others says, judged on these.
struct LeftOutAnswer {
  LeftOut left_out;
  std::string verdict;
  std::string found;     ///< what was added, each with its numbers
  double before = kNaN;  ///< of the mismatch measure, see MismatchSize [rad]
  double after = kNaN;
  double mae = kNaN;        ///< mean over its recordings, of the closed loop where there is one [rad]
  std::string worst = {};   ///< of these recordings
  double worst_mae = kNaN;  ///< [rad]
};

/// The groups of all recordings of a configuration, fitted and held out alike, in the order of the list.
/// @param key  "recording", or mass, arm, gain, voltage
/// @throws ConfigError for another key, and where there are fewer than two groups
std::vector<LeftOut> groups_to_leave_out(const Configuration& configuration, const std::string& key);

/// The configuration that fits all other recordings and holds these out.
Configuration leaving_out(const Configuration& configuration, const LeftOut& left_out);

/// The configuration that fits all recordings; the last third of each judges.
Configuration of_all_recordings(Configuration configuration);

LeftOutAnswer left_out_answer(const LeftOut& left_out, const DiagnosisOutcome& outcome);

/// A table of text: a line for each group that was left out, and what is recommended, with the reason.
std::string left_out_table(const std::vector<LeftOutAnswer>& answers);
std::string csv_of(const std::vector<LeftOutAnswer>& answers);
std::string recommended(const std::vector<LeftOutAnswer>& answers);

}  // namespace gapscope

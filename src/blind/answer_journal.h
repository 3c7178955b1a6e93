#pragma once

#include <fstream>
#include <map>
#include <mutex>
#include <optional>
#include <string>

#include "gapscope/base/process_lock.h"
#include "gapscope/results/blind_records.h"

namespace gapscope::blind {

/// The answers so far, a line each in the order in which they came. A line that a kill has torn is dropped.
class AnswerJournal {
 public:
  /// @param check  names what is answered by whom; @throws ConfigError where the file has another one, or
  /// another process writes it
  AnswerJournal(std::string path, const std::string& check);

  const std::map<std::string, BlindAnswer>& answers() const { return answers_; }
  void add(const BlindAnswer& answer);  ///< from any thread
  void remove();                        ///< no longer needed

 private:
  void require_alone() const;
  void read(const std::string& check);
  std::string path_;
  std::map<std::string, BlindAnswer> answers_;
  std::ofstream out_;
  std::optional<ProcessLock> lock_;
  std::mutex adding_;
};

}  // namespace gapscope::blind

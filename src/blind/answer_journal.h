#pragma once

#include <fstream>
#include <map>
#include <mutex>
#include <optional>
#include <string>

#include "base/process_lock.h"
#include "results/blind_records.h"

namespace gapscope::blind {

/// The answers so far, a line each in the order in which they came, after the SHA-256 of it and of all that
/// stands before it: what was changed since is refused. A line that a kill has torn is dropped.
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
  void take(const std::string& line, int number);
  void write(const BlindAnswer& answer);
  std::string path_, chain_;  ///< chain: of all lines so far
  std::map<std::string, BlindAnswer> answers_;
  std::ofstream out_;
  std::optional<ProcessLock> lock_;
  std::mutex adding_;
};

}  // namespace gapscope::blind

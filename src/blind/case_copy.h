#pragma once

#include <string>

#include "results/blind_records.h"

namespace gapscope::blind {

/// The files of a case, verified and in a place that nobody else knows: whatever happens to the originals
/// meanwhile, what is diagnosed is what was sealed.
class CaseCopy {
 public:
  /// @throws ConfigError for a file that is not the one that was sealed; std::runtime_error where there is no
  /// room for the copies
  CaseCopy(const std::string& folder, const SealedCase& sealed);
  ~CaseCopy();
  CaseCopy(const CaseCopy&) = delete;
  CaseCopy& operator=(const CaseCopy&) = delete;

  const std::string& folder() const { return folder_; }

 private:
  std::string folder_;
};

}  // namespace gapscope::blind

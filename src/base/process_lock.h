#pragma once

#include <string>

namespace gapscope {

/// Tells processes apart that would work on the same file or folder: it is held for as long as this lives.
/// The system releases it when the process ends, in whatever way. Nothing is locked where nothing is there.
class ProcessLock {
 public:
  explicit ProcessLock(const std::string& path);
  ~ProcessLock();
  ProcessLock(const ProcessLock&) = delete;
  ProcessLock& operator=(const ProcessLock&) = delete;

  bool held_by_another() const { return held_by_another_; }
  int handle() const { return handle_; }  ///< of the file that is locked; below 0: there is none

 private:
  int handle_;
  bool held_by_another_ = false;
};

}  // namespace gapscope

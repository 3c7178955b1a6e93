#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace gapscope {

/// Says what goes on where nobody wants to read every step: the last one, each time that so long has passed,
/// and nothing once it is gone.
class NowAndThen {
 public:
  using Tell = std::function<void(const std::string&)>;

  /// @param tell  called from a thread of its own, never twice at once
  NowAndThen(std::chrono::milliseconds every, Tell tell);
  ~NowAndThen();
  NowAndThen(const NowAndThen&) = delete;
  NowAndThen& operator=(const NowAndThen&) = delete;

  void begins(const std::string& what);  ///< from any thread

 private:
  void work(std::chrono::milliseconds every, const Tell& tell);

  std::mutex mutex_;
  std::condition_variable over_;
  bool ends_ = false;
  std::string what_;
  std::thread thread_;
};

}  // namespace gapscope

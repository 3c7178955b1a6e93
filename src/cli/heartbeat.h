#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace gapscope::cli {

/// Says at regular intervals, from a thread of its own, what is being done: for who reads a log and must know
/// that long work goes on. What takes less than one interval leaves no word.
class Heartbeat {
 public:
  using Tell = std::function<void(std::chrono::duration<double> so_far, const std::string& what)>;

  /// @param tell  called by that thread alone; no signal is delivered to it
  Heartbeat(std::chrono::milliseconds every, Tell tell);
  ~Heartbeat();
  Heartbeat(const Heartbeat&) = delete;
  Heartbeat& operator=(const Heartbeat&) = delete;

  void doing(const std::string& what);  ///< from now on; any thread may call it

 private:
  void beat(std::chrono::milliseconds every, const Tell& tell);

  std::mutex mutex_;
  std::condition_variable ended_;
  bool ends_ = false;
  std::string doing_;
  std::thread thread_;
};

}  // namespace gapscope::cli

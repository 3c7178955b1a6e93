#pragma once

#include <functional>
#include <mutex>

namespace gapscope {

/// Removes what is unfinished and ends the process. In another thread than those that work.
[[noreturn]] void end_at_once(int status);

/// Something on the disk that nobody shall find unless it is completed. While one lives, end_at_once() takes
/// it away; otherwise its owner does, within a Moment in which it also gives this up.
class Unfinished {
 public:
  /// @param remove  may be called beside an owner that still writes; returns whether nothing is left
  explicit Unfinished(std::function<bool()> remove);
  ~Unfinished();
  Unfinished(const Unfinished&) = delete;
  Unfinished& operator=(const Unfinished&) = delete;

 private:
  std::function<bool()> remove_;
  friend void end_at_once(int status);
};

/// While it lives the process does not end at once: what is done meanwhile is done whole.
class Moment {
 public:
  Moment();

 private:
  std::unique_lock<std::recursive_mutex> lock_;
};

}  // namespace gapscope

#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <functional>
#include <mutex>
#include <string>
#include <utility>

namespace gapscope::internal::diagnosis {

/// Tells of each of many pieces of work that it begins, and how many have begun of how many; from any thread.
class Counted {
 public:
  Counted(std::function<void(const std::string&)> progress, std::size_t all)
      : progress_(std::move(progress)), all_(all) {}

  void begin(const std::string& what) {
    const std::lock_guard lock(saying_);
    progress_(fmt::format("{}, {} of {}", what, ++begun_, all_));
  }

 private:
  std::function<void(const std::string&)> progress_;
  std::mutex saying_;
  std::size_t begun_ = 0, all_;
};

}  // namespace gapscope::internal::diagnosis

#pragma once

#include <optional>

#include "base/interrupt.h"
#include "gapscope/base/errors.h"

namespace gapscope {

/// While one lives, what runs can be done without: a request to finish stops it at its next stop_point(). Not
/// beside work that is to end its step.
class CutShort {
 public:
  CutShort() noexcept;
  ~CutShort();
  CutShort(const CutShort&) = delete;
  CutShort& operator=(const CutShort&) = delete;
};

/// Whether what runs is to end at its next stop_point().
bool is_to_end() noexcept;

/// What the work returns; nothing where a request to finish came before it began, or while it was under way.
/// @throws Interrupted where it was asked to stop
template <class Work>
auto unless_finishing(const Work& work) -> std::optional<decltype(work())> {
  if (finish_requested()) return {};
  try {
    const CutShort whole;
    return work();
  } catch (const Interrupted&) {
    stop_point();
    return {};
  }
}

}  // namespace gapscope

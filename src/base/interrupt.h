#pragma once

namespace gapscope {

/// Asks all running work to stop at its next convenient point. Safe in a signal handler.
void request_stop() noexcept;
bool stop_requested() noexcept;
void clear_stop_request() noexcept;

/// Asks a search to end with what it has found, once its present step is done. Safe in a signal handler.
void request_finish() noexcept;
bool finish_requested() noexcept;

/// While it lives, a first Ctrl-C asks to finish and only the next one to stop. One at a time; what was asked
/// goes with it.
class FinishFirst {
 public:
  FinishFirst() noexcept;
  ~FinishFirst();
  FinishFirst(const FinishFirst&) = delete;
  FinishFirst& operator=(const FinishFirst&) = delete;
};

/// Whether a Ctrl-C that comes now asks to finish: one of these lives, and nobody has asked yet.
bool may_finish_first() noexcept;

/// @throws Interrupted once request_stop() was called. Long loops call it between pieces of work.
void stop_point();

}  // namespace gapscope

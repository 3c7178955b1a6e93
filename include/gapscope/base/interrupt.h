#pragma once

namespace gapscope {

/// Asks all running work to stop at its next convenient point. Safe in a signal handler.
void request_stop() noexcept;
bool stop_requested() noexcept;
void clear_stop_request() noexcept;

/// @throws Interrupted once request_stop() was called. Long loops call it between pieces of work.
void stop_point();

}  // namespace gapscope

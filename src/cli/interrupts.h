#pragma once

#include "cli/command_line.h"

namespace gapscope::cli {

inline constexpr int kInterrupted = kInterruptedWithReport;

/// From here on SIGINT, SIGTERM and SIGHUP are answered. The first one asks: a diagnosis to come to an end,
/// other work to stop. The second one ends the process, whatever it is doing, and what is unfinished goes.
void answer_interrupts();

/// What asked has been answered: nothing more is said of it.
void interrupt_is_answered();

}  // namespace gapscope::cli

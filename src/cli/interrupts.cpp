#include "cli/interrupts.h"

#include <fcntl.h>
#include <sys/time.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <ctime>
#include <system_error>
#include <thread>

#include "base/at_once.h"
#include "base/interrupt.h"

namespace gapscope::cli {
namespace {

constexpr char kFinishing[] =
    "\ngapscope: ends after the present step and reports what has been found; Ctrl-C again: at once, and "
    "nothing is kept\n";

constexpr char kStopping[] = "\ngapscope: stops after the present piece of work; asked again: at once\n";
constexpr suseconds_t kSilent = 200'000;               ///< microseconds that may pass before that is said
constexpr std::chrono::milliseconds kTimeToStop{200};  ///< by itself, when it is asked again

/// Work that stops sooner has said so itself.
extern "C" void on_still_working(int) {
  [[maybe_unused]] const auto told = write(STDERR_FILENO, kStopping, sizeof kStopping - 1);
}

void tell_after(suseconds_t wait) {
  const itimerval timer{{0, 0}, {0, wait}};  // 0: never
  setitimer(ITIMER_REAL, &timer, nullptr);
}

/// Signals within it [s] are one: `timeout` tells the process and its group.
constexpr double kOneRequest = 0.1;

/// Whether this signal is what the last one was.
bool is_told_twice() {
  static double last = -1.0;
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  const double seconds = static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
  const bool twice = last >= 0.0 && seconds - last < kOneRequest;
  last = seconds;
  return twice;
}

int waker = -1;  ///< of the thread that ends the process: a handler must not wait, nor remove files

void end_soon() {
  static volatile std::sig_atomic_t asked = 0;
  if (asked != 0 || write(waker, "", 1) != 1) _exit(kInterrupted);
  asked = 1;
}

extern "C" void on_interrupt(int signal) {
  if (is_told_twice()) return;
  if (signal != SIGHUP && may_finish_first()) {
    request_finish();
    [[maybe_unused]] const auto told = write(STDERR_FILENO, kFinishing, sizeof kFinishing - 1);
    return;
  }
  const bool again = stop_requested() || finish_requested();
  request_stop();
  if (again)
    end_soon();
  else
    tell_after(kSilent);
}

void end_when_woken(int from) {
  char any = 0;
  while (read(from, &any, 1) < 0) {  // by a signal
  }
  std::this_thread::sleep_for(kTimeToStop);
  end_at_once(kInterrupted);
}

/// Where no thread can be had a second request ends the process as it is.
void start_ending_thread() {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) return;
  try {
    std::thread(end_when_woken, ends[0]).detach();
    waker = ends[1];
  } catch (const std::system_error&) {
    close(ends[0]), close(ends[1]);
  }
}

}  // namespace

void answer_interrupts() {
  start_ending_thread();
  std::signal(SIGINT, on_interrupt);
  std::signal(SIGTERM, on_interrupt);
  if (std::signal(SIGHUP, on_interrupt) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);  // nohup
  std::signal(SIGALRM, on_still_working);
}

void interrupt_is_answered() { tell_after(0); }

}  // namespace gapscope::cli

#include "python/watched_work.h"

#include <chrono>
#include <future>
#include <mutex>

#include "base/interrupt.h"

namespace gapscope::internal::python {
namespace {

namespace py = pybind11;

constexpr std::chrono::milliseconds kLook(50);  // for signals

/// The exception that stands, to be raised where the call returns. Holds the lock.
std::exception_ptr raised() { return std::make_exception_ptr(py::error_already_set()); }

/// What a signal's handler has raised; nothing else than the main thread of the interpreter runs any.
std::exception_ptr signalled() {
  const py::gil_scoped_acquire lock;
  return PyErr_CheckSignals() != 0 ? raised() : nullptr;
}

/// The right to work, until it is destroyed.
std::unique_lock<std::timed_mutex> turn(std::exception_ptr& stopped) {
  static std::timed_mutex one;
  std::unique_lock<std::timed_mutex> mine(one, std::defer_lock);
  while (!stopped && !mine.try_lock_for(kLook)) stopped = signalled();
  return mine;
}

/// A callback as the work calls it, from its own thread and those that it begins.
Progress progress_of(const py::object& callback, std::exception_ptr& stopped) {
  if (callback.is_none()) return [](const std::string&) {};
  return [&callback, &stopped](const std::string& what) {
    const py::gil_scoped_acquire lock;
    try {
      callback(what);
    } catch (py::error_already_set&) {
      if (!stopped) stopped = std::current_exception();
      request_stop();
    }
  };
}

void wait_for(const std::future<void>& done, std::exception_ptr& stopped) {
  while (done.wait_for(kLook) != std::future_status::ready)
    if (const std::exception_ptr now = signalled()) {
      const py::gil_scoped_acquire lock;
      if (!stopped) stopped = now;
      request_stop();
    }
}

}  // namespace

void watch(const py::object& callback, const std::function<void(const Progress&)>& work) {
  std::exception_ptr stopped;  // of Python, so written with the lock
  std::future<void> done;
  {
    const py::gil_scoped_release others_run;
    const std::unique_lock<std::timed_mutex> mine = turn(stopped);
    if (!stopped) {
      const Progress progress = progress_of(callback, stopped);
      done = std::async(std::launch::async, [&] { work(progress); });
      wait_for(done, stopped);
      clear_stop_request();
    }
  }
  if (stopped) std::rethrow_exception(stopped);
  done.get();
}

}  // namespace gapscope::internal::python

#include "gapscope/recording/recording.h"

#include <cmath>

#include "base/require.h"

namespace gapscope {
namespace {

constexpr double kSameRate = 1e-6;  ///< rates that differ by less are one [-]

template <class T>
std::vector<T> part_of(const std::vector<T>& values, std::size_t first, std::size_t count) {
  if (values.empty()) return {};
  const auto begin = values.begin() + static_cast<std::ptrdiff_t>(first);
  return {begin, begin + static_cast<std::ptrdiff_t>(count)};
}

}  // namespace

const char* to_string(Mode mode) {
  switch (mode) {
    case Mode::kGap:
      return "gap";
    case Mode::kEngagementPlus:
      return "engagement+";
    case Mode::kEngagementMinus:
      return "engagement-";
    case Mode::kImpact:
      return "impact";
    case Mode::kOneBody:
      return "one_body";
  }
  return "";
}

bool updates_at_rows(const DriveController& controller, const MotorTrace& recording) {
  if (controller.rate == 0.0) return true;
  return recording.even() && std::abs(controller.rate * recording.dt - 1.0) < kSameRate;
}

void command_by(const DriveController& controller, Recording& recording) {
  const MotorTrace trace = recording.motor_trace();
  GAPSCOPE_REQUIRE(trace.command != nullptr);
  std::vector<double> u = commanded_input(controller, trace), sent;
  const bool acts_later = controller.delay > 0.0 && updates_at_rows(controller, trace);
  if (acts_later) {
    DriveController at_once = controller;
    at_once.delay = 0.0;
    sent = commanded_input(at_once, trace);
  }
  recording.u = std::move(u), recording.sent = std::move(sent);
  recording.delay = acts_later ? controller.delay : 0.0;
}

Recording part(const Recording& recording, std::size_t first, std::size_t count) {
  GAPSCOPE_REQUIRE(first <= recording.size() && count <= recording.size() - first);
  Recording r;
  r.file = recording.file;
  r.start = recording.time(first);
  r.dt = recording.dt;
  r.u = part_of(recording.u, first, count);
  r.x1 = part_of(recording.x1, first, count);
  r.x2 = part_of(recording.x2, first, count);
  r.mode = part_of(recording.mode, first, count);
  r.quantum = recording.quantum;
  r.resampling = recording.resampling;
  r.stamps = part_of(recording.stamps, first, count);
  r.encoder = recording.encoder;
  r.command = recording.command;
  r.command_first = recording.command_first + first;
  r.sent = part_of(recording.sent, first, count);
  r.delay = recording.delay;
  r.assumed = recording.assumed;
  r.load = recording.load;
  return r;
}

MotorTrace part(const MotorTrace& trace, std::size_t first, std::size_t count) {
  GAPSCOPE_REQUIRE(first <= trace.size() && count <= trace.size() - first);
  MotorTrace t = trace;
  t.start = trace.time(first);
  t.command_first = trace.command_first + first;
  t.u = trace.u.subspan(first, count);
  t.x1 = trace.x1.subspan(first, count);
  if (!trace.sent.empty()) t.sent = trace.sent.subspan(first, count);
  if (!trace.even()) t.stamps = trace.stamps.subspan(first, count);
  return t;
}

}  // namespace gapscope

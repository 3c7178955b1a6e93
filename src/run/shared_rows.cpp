#include "run/shared_rows.h"

#include <fmt/format.h>

#include <cstddef>

#include "base/interrupt.h"
#include "gapscope/base/errors.h"

namespace gapscope::internal::run {
namespace {

/// Steps of the position through which two recordings agree that are the same rows [rows]. Two runs of a
/// drive under one input agree at rest, and as long as chance rounds both alike; with nine in ten rows so,
/// through 100 in one of 40,000 cases. Half and double: the same recordings of the tests.
constexpr int kSharedSteps = 100;
constexpr double kSameTime = 0.25;  ///< of a step, to either side: rows are matched with the nearest [-]

/// Whether b, `later` [s] than it says, and a have the same rows from one on through `kSharedSteps`.
bool share_rows(const Recording& a, const Recording& b, double later) {
  const std::vector<double>&x = a.position(), &y = b.position();
  if (a.u.size() != x.size() || b.u.size() != y.size()) return false;
  const double near = kSameTime * std::min(a.dt, b.dt);
  int steps = 0;
  double before = kNaN;
  for (std::size_t i = 0, j = 0; i < x.size() && j < y.size() && steps < kSharedSteps;) {
    const double ahead = a.time(i) - (b.time(j) + later);
    if (ahead > near) {
      ++j;
    } else if (ahead < -near) {
      ++i;
    } else {
      const bool same = x[i] == y[j] && a.u[i] == b.u[j];
      steps = !same ? 0 : steps + (before != x[i] ? 1 : 0);
      before = x[i];
      ++i, ++j;
    }
  }
  return steps >= kSharedSteps;
}

bool share_rows(const Recording& a, const Recording& b) {
  return share_rows(a, b, 0.0) || share_rows(a, b, a.time(0) - b.time(0));
}

}  // namespace

void require_own_rows(const Configuration& configuration, std::span<const Recording> first,
                      std::span<const Recording> others) {
  for (std::size_t i = 0; i < others.size(); ++i)
    for (const auto before : {first, others.first(i)})
      for (const Recording& r : before) {
        stop_point();
        if (share_rows(r, others[i]))
          throw ConfigError(
              configuration.file,
              fmt::format("{} has rows of {} (the same time, input and position): a motion counts "
                          "once, expected recordings, or windows of them, that share no rows",
                          others[i].file, r.file));
      }
}

}  // namespace gapscope::internal::run

#include "diagnosis/motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "gapscope/base/errors.h"
#include "gapscope/base/statistics.h"
#include "signals/encoder.h"

namespace gapscope::internal::diagnosis {
namespace {

/// Whether x1 moves in a window, by its mean square about its mean.
bool moves(double square) { return square > kRule.near_floor; }

}  // namespace

void require_motion(const MotorTrace& t) {
  const auto [low, high] = std::minmax_element(t.x1.begin(), t.x1.end());
  if (*high - *low > kRule.far * signals::encoder_floor(t)) return;
  throw ConfigError(
      t.file,
      fmt::format("x1 does not move ({:.3g} in all), expected the recording of a motion", *high - *low));
}

void require_motion(const HeldOut& held_out) {
  const std::vector<double> still = still_windows(held_out);
  if (std::any_of(still.begin(), still.end(), moves)) return;
  throw ConfigError(held_out.traces.front().file,
                    "x1 does not move where the model is judged, expected the recording of a motion");
}

bool mostly_rests(const HeldOut& held_out) {
  const std::vector<double> still = still_windows(held_out);
  return 2 * std::count_if(still.begin(), still.end(), moves) < std::ssize(still);
}

double unexplained_motion(const HeldOut& held_out, const ScoredModel& model) {
  const std::vector<double> still = still_windows(held_out);
  const std::vector<double>& left = model.windows.free;
  std::vector<double> shares;
  for (std::size_t i = 0; i < std::min(still.size(), left.size()); ++i)
    if (moves(still[i])) shares.push_back(std::sqrt(left[i] / still[i]));
  return median(std::move(shares));
}

std::string motion_left(const HeldOut& held_out, const ScoredModel& model) {
  const double left = unexplained_motion(held_out, model);
  if (!(left > kTelling.most_left)) return "";
  return fmt::format("the simulated motion of the best model is off by {:.0f} % of the motion itself",
                     100.0 * left);
}

}  // namespace gapscope::internal::diagnosis

#include "diagnosis/motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "gapscope/base/errors.h"
#include "gapscope/base/statistics.h"
#include "signals/encoder.h"

namespace gapscope::internal::diagnosis {
namespace {

constexpr double kNoise = 8.0;      ///< way that is surely none of noise [standard deviations]
constexpr double kCounts = 2.0;     ///< the same of counting [quanta]
constexpr double kMoves = 4.0;      ///< mean square about the mean where x1 moves [floor²]
constexpr double kMostLeft = 0.25;  ///< of the motion [-]: 0.02 on drives, 0.5 and more where u moves nothing

}  // namespace

void require_motion(const MotorTrace& t) {
  const auto [low, high] = std::minmax_element(t.x1.begin(), t.x1.end());
  if (*high - *low > kNoise * signals::encoder_floor(t) + kCounts * t.quantum) return;
  throw ConfigError(
      t.file,
      fmt::format("x1 does not move ({:.3g} in all), expected the recording of a motion", *high - *low));
}

void require_motion(const HeldOut& held_out) {
  const std::vector<double> still = still_windows(held_out);
  if (std::any_of(still.begin(), still.end(), [](double square) { return square > kMoves; })) return;
  throw ConfigError(held_out.traces.front().file,
                    "x1 does not move where the model is judged, expected the recording of a motion");
}

double unexplained_motion(const HeldOut& held_out, const ScoredModel& model) {
  const std::vector<double> still = still_windows(held_out);
  const std::vector<double>& left = model.windows.free;
  std::vector<double> shares;
  for (std::size_t i = 0; i < std::min(still.size(), left.size()); ++i)
    if (still[i] > kMoves) shares.push_back(std::sqrt(left[i] / still[i]));
  return median(std::move(shares));
}

std::string motion_left(const HeldOut& held_out, const ScoredModel& model) {
  const double left = unexplained_motion(held_out, model);
  if (!(left > kMostLeft)) return "";
  return fmt::format("the best model leaves {:.0f} % of the motion unexplained", 100.0 * left);
}

}  // namespace gapscope::internal::diagnosis

#include "gapscope/inspection/reach.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "gapscope/base/statistics.h"
#include "signals/local_motion.h"

namespace gapscope {
namespace {

constexpr double kMost = 0.99;  ///< of the samples: a spike is no motion
/// Times as far, as a motion engineer would call another motion. With half and with double the excess 25 and
/// 21 of 30 pairs of real recordings of one drive (a slide, a gear, eight preloads of a rig) have one that
/// goes farther, with this one 25.
constexpr double kClearlyMore = 1.25;

double speed_of(const MotorTrace& r) {
  const std::size_t apart = internal::signals::speed_window(r);
  std::vector<double> speeds;
  for (std::size_t i = apart; i < r.size(); ++i)
    speeds.push_back(std::abs(r.x1[i] - r.x1[i - apart]) / (r.time(i) - r.time(i - apart)));
  return speeds.empty() ? 0.0 : quantile(std::move(speeds), kMost);
}

double input_of(const MotorTrace& r) {
  std::vector<double> sizes;
  for (const double u : r.u) sizes.push_back(std::abs(u));
  return sizes.empty() ? 0.0 : quantile(std::move(sizes), kMost);
}

MotionReach reach_of(const MotorTrace& r) {
  const auto [low, high] = std::minmax_element(r.x1.begin(), r.x1.end());
  return {*high - *low, speed_of(r), input_of(r)};
}

struct Compared {
  const char* words;
  double first, second;
  std::string unit;
  bool farther() const { return first > 0.0 && second > kClearlyMore * first; }
  bool nearer() const { return second > 0.0 && first > kClearlyMore * second; }
};

}  // namespace

MotionReach reach_of(std::span<const MotorTrace> recordings) {
  MotionReach farthest;
  for (const MotorTrace& r : recordings) {
    if (r.size() == 0) continue;
    const MotionReach one = reach_of(r);
    farthest.travel = std::max(farthest.travel, one.travel);
    farthest.speed = std::max(farthest.speed, one.speed);
    farthest.input = std::max(farthest.input, one.input);
  }
  return farthest;
}

std::string goes_farther(const MotionReach& first, const MotionReach& second, Coordinates coordinates) {
  const std::string position = coordinates.position_unit();
  const Compared all[] = {{"speed up to", first.speed, second.speed, position + "/s"},
                          {"travel", first.travel, second.travel, position},
                          {"input up to", first.input, second.input, "units of u"}};
  std::vector<std::string> farther;
  for (const Compared& c : all) {
    if (c.nearer()) return "";
    if (c.farther())
      farther.push_back(fmt::format("{} {:.3g} against {:.3g} {}", c.words, c.second, c.first, c.unit));
  }
  return fmt::format("{}", fmt::join(farther, ", "));
}

}  // namespace gapscope

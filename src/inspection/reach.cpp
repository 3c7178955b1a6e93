#include "inspection/reach.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <vector>

#include "gapscope/base/statistics.h"
#include "gapscope/recording/recording_file.h"
#include "inspection/switched_off.h"
#include "signals/encoder.h"
#include "signals/local_motion.h"
#include "signals/strokes.h"

namespace gapscope {
namespace {

constexpr double kMost = 0.99;  ///< of the samples: a spike is no motion
/// Times as far, as a motion engineer would call another motion. With half and with double the excess 25 and
/// 21 of 30 pairs of real recordings of one drive (a slide, a gear, eight preloads of a rig) have one that
/// goes farther, with this one 25.
constexpr double kClearlyMore = 1.25;
/// A motion, as a share of the speed that few exceed; less is noise or a ripple [-]. With half and with
/// double of it 19 of 20 real recordings each stand still in most of their rows or not, as with this one.
constexpr double kMotion = 0.05;

double speed_of(const MotorTrace& r) {
  const std::size_t apart = internal::signals::speed_window(r);
  std::vector<double> speeds;
  for (std::size_t i = apart; i < r.size(); ++i)
    speeds.push_back(std::abs(r.x1[i] - r.x1[i - apart]) / (r.time(i) - r.time(i - apart)));
  return speeds.empty() ? 0.0 : quantile(std::move(speeds), kMost);
}

/// Share of the samples that are faster than kMotion of the speed that few exceed, and by more than the count
/// that flickers at rest: of a sine 0.97.
double moving_of(const MotorTrace& r, double speed) {
  const std::size_t apart = internal::signals::speed_window(r);
  const double floor = std::max(internal::signals::encoder_floor(r),
                                internal::signals::rounding_noise(internal::signals::encoder_quantum(r)));
  std::size_t moves = 0, all = 0;
  for (std::size_t i = apart; i < r.size(); ++i, ++all) {
    const double way = std::abs(r.x1[i] - r.x1[i - apart]);
    moves += way > kMotion * speed * (r.time(i) - r.time(i - apart)) &&
             internal::signals::exceeds_a_count(way, floor);
  }
  return all == 0 ? 1.0 : static_cast<double>(moves) / static_cast<double>(all);
}

double input_of(const MotorTrace& r) {
  std::vector<double> sizes;
  for (const double u : r.u) sizes.push_back(std::abs(u));
  return sizes.empty() ? 0.0 : quantile(std::move(sizes), kMost);
}

int reversals_of(const MotorTrace& r) {
  return std::max(0, static_cast<int>(internal::signals::strokes(r.x1).size()) - 1);
}

MotionReach reach_of(const MotorTrace& r) {
  const auto [low, high] = std::minmax_element(r.x1.begin(), r.x1.end());
  const double speed = speed_of(r);
  return {*high - *low, speed, input_of(r), reversals_of(r), moving_of(r, speed)};
}

MotorTrace rows_of(const MotorTrace& r, std::size_t from, std::size_t to) {
  MotorTrace part = r;
  part.start = r.time(from);
  part.u = r.u.empty() ? r.u : r.u.subspan(from, to - from);
  part.x1 = r.x1.subspan(from, to - from);
  part.stamps = r.stamps.empty() ? r.stamps : r.stamps.subspan(from, to - from);
  return part;
}

/// Without what it did while the drive was switched off, which nobody asked of it; of that alone nothing
/// would be left.
std::vector<MotorTrace> driven_parts(const MotorTrace& r) {
  if (r.u.empty()) return {r};
  const auto off = internal::inspection::switched_off(r.u, r.x1, internal::signals::encoder_quantum(r));
  if (off.length() == 0) return {r};
  std::vector<MotorTrace> parts;
  if (off.from >= kFewestSamples) parts.push_back(rows_of(r, 0, off.from));
  if (r.size() - off.to >= kFewestSamples) parts.push_back(rows_of(r, off.to, r.size()));
  return parts.empty() ? std::vector{r} : parts;
}

/// In more rows than it moves.
bool stands(const MotionReach& r) { return r.moving < 1.0 - r.moving; }

bool clearly_more(double second, double first) { return first > 0.0 && second > kClearlyMore * first; }

struct Compared {
  const char* words;
  double first, second;
  std::string unit;
  bool farther() const { return clearly_more(second, first); }
  bool nearer() const { return clearly_more(first, second); }
  std::string told() const { return fmt::format("{} {:.3g} against {:.3g} {}", words, second, first, unit); }
};

std::array<Compared, 3> compared(const MotionReach& first, const MotionReach& second,
                                 Coordinates coordinates) {
  const std::string position = coordinates.position_unit();
  return {{{"speed up to", first.speed, second.speed, position + "/s"},
           {"travel", first.travel, second.travel, position},
           {"input up to", first.input, second.input, "units of u"}}};
}

bool has_more_reversals(const MotionReach& second, const MotionReach& first) {
  return second.reversals > kClearlyMore * first.reversals;
}

std::string reversals_told(const MotionReach& second, const MotionReach& first) {
  return fmt::format("{} reversals against {}", second.reversals, first.reversals);
}

std::string one_way(const MotionReach& both_ways) {
  return fmt::format("{} reversals against none", both_ways.reversals);
}

/// Why the first is better fitted; empty where it is not.
std::string reason_to_fit(const MotionReach& first, const MotionReach& second, Coordinates coordinates) {
  const std::string farther = goes_farther(second, first, coordinates);
  if (farther.empty() || !has_more_reversals(first, second)) return farther;
  return farther + ", " + reversals_told(first, second);
}

}  // namespace

MotionReach reach_of(std::span<const MotorTrace> recordings) {
  MotionReach farthest;
  farthest.moving = 0.0;
  std::vector<MotorTrace> parts;
  for (const MotorTrace& r : recordings)
    if (r.size() > 0) std::ranges::copy(driven_parts(r), std::back_inserter(parts));
  for (const MotorTrace& r : parts) {
    const MotionReach one = reach_of(r);
    farthest.travel = std::max(farthest.travel, one.travel);
    farthest.speed = std::max(farthest.speed, one.speed);
    farthest.input = std::max(farthest.input, one.input);
    farthest.reversals += one.reversals;
    farthest.moving = std::max(farthest.moving, one.moving);
  }
  return farthest;
}

std::string goes_farther(const MotionReach& first, const MotionReach& second, Coordinates coordinates) {
  if (first.reversals > 0 && second.reversals == 0) return "";
  std::vector<std::string> farther;
  for (const Compared& c : compared(first, second, coordinates)) {
    if (c.nearer()) return "";
    if (c.farther()) farther.push_back(c.told());
  }
  return fmt::format("{}", fmt::join(farther, ", "));
}

std::string judges_little(const MotionReach& fitted, const MotionReach& held_out) {
  if (fitted.reversals > 0 && held_out.reversals == 0)
    return "moves in one direction only: nothing that depends on the other one can be judged by it; hold out "
           "another recording, which goes both ways";
  if (!stands(fitted) && stands(held_out))
    return fmt::format(
        "rests in {:.0f} % of its rows: little of what depends on the motion can be judged by it; hold out "
        "another recording, which moves",
        100.0 * (1.0 - held_out.moving));
  return "";
}

FittingOrder fitting_order(const MotionReach& first, const MotionReach& second, Coordinates coordinates) {
  using Fit = FittingOrder::Fit;
  // No model that is fitted to one direction alone is known in the other.
  if (first.reversals > 0 && second.reversals == 0) return {Fit::kFirst, one_way(first)};
  if (second.reversals > 0 && first.reversals == 0) return {Fit::kSecond, one_way(second)};
  if (const auto why = reason_to_fit(first, second, coordinates); !why.empty()) return {Fit::kFirst, why};
  if (const auto why = reason_to_fit(second, first, coordinates); !why.empty()) return {Fit::kSecond, why};
  std::vector<std::string> apart;
  for (const Compared& c : compared(second, first, coordinates))
    if (c.farther() || c.nearer()) apart.push_back(c.told());
  if (!apart.empty())
    return {Fit::kEither, fmt::format("neither covers the other: {}", fmt::join(apart, ", "))};
  if (has_more_reversals(first, second)) return {Fit::kFirst, reversals_told(first, second)};
  if (has_more_reversals(second, first)) return {Fit::kSecond, reversals_told(second, first)};
  return {Fit::kEither, "both go as far: speed, travel, input and reversals within a quarter"};
}

}  // namespace gapscope

#include "drives/reference_motion.h"

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "base/require.h"
#include "gapscope/base/statistics.h"

namespace gapscope::independent_plant {
namespace {

constexpr double kRamp = 0.25;     ///< of a trapezoid's time
constexpr double kSpread = 1.75;   ///< between the frequencies of two sines, irrational enough
constexpr double kShortest = 0.1;  ///< of the travel, between two places
constexpr double kSlowest = 0.5;   ///< level of speed, of the peak
constexpr int kSamplesOfLines = 20000;
constexpr double kPeriodsOfLines = 40.0;  ///< of the slowest sine, over which their peaks are looked for

/// Way and speed of a move of length and duration 1.
Target unit_move(Course course, double p) {
  if (course == Course::kTriangle || course == Course::kConstantSpeed) return {p, 1.0};
  if (course != Course::kTrapezoid && course != Course::kLevels)
    return {p - std::sin(2.0 * kPi * p) / (2.0 * kPi), 1.0 - std::cos(2.0 * kPi * p)};
  const double top = 1.0 / (1.0 - kRamp);
  if (p < kRamp) return {0.5 * top * p * p / kRamp, top * p / kRamp};
  if (p <= 1.0 - kRamp) return {top * (p - 0.5 * kRamp), top};
  return {1.0 - 0.5 * top * (1.0 - p) * (1.0 - p) / kRamp, top * (1.0 - p) / kRamp};
}

double next_place(const ReferenceMotion& m, double from, std::mt19937_64& g) {
  if (m.course != Course::kPickAndPlace) return from > 0.0 ? -0.5 * m.travel : 0.5 * m.travel;
  double to = from;
  while (std::abs(to - from) < kShortest * m.travel) to = uniform(g, -0.5 * m.travel, 0.5 * m.travel);
  return to;
}

/// Of a move, of the peak.
double speed_share(const ReferenceMotion& m, std::size_t move) {
  if (m.course != Course::kLevels || m.levels < 2) return 1.0;
  const auto level = static_cast<double>((move / 2) % static_cast<std::size_t>(m.levels));
  return 1.0 - (1.0 - kSlowest) * level / (m.levels - 1.0);
}

}  // namespace

Reference::Reference(const ReferenceMotion& motion, double duration, std::uint64_t seed) : motion_(motion) {
  GAPSCOPE_REQUIRE(duration > 0.0 && motion.speed != 0.0 && motion.dwell_s >= 0.0);
  if (motion.course == Course::kConstantSpeed)
    moves_.push_back({0.0, duration, 0.0, motion.speed * duration});
  else if (motion.course == Course::kSines)
    add_lines(seed);
  else
    add_moves(duration, seed);
}

void Reference::add_moves(double duration, std::uint64_t seed) {
  GAPSCOPE_REQUIRE(motion_.travel > 0.0 && motion_.speed > 0.0);
  std::mt19937_64 places = random_stream(seed, "blind places");
  const double top = unit_move(motion_.course, 0.5).w;
  double at = 0.0;
  for (double t = 0.0; t < duration;) {
    const double to = next_place(motion_, at, places);
    const double takes = top * std::abs(to - at) / (motion_.speed * speed_share(motion_, moves_.size()));
    moves_.push_back({t, takes, at, to});
    t += takes + motion_.dwell_s;
    at = to;
  }
}

Target Reference::sum_of_lines(double t) const {
  Target sum;
  for (const Line& l : lines_) {
    sum.x += l.amplitude * std::sin(l.omega * t + l.phase);
    sum.w += l.amplitude * l.omega * std::cos(l.omega * t + l.phase);
  }
  return sum;
}

/// Amplitudes fall with the frequency, so that each brings the same speed; then size and time are scaled.
void Reference::add_lines(std::uint64_t seed) {
  GAPSCOPE_REQUIRE(motion_.lines > 0 && motion_.travel > 0.0 && motion_.speed > 0.0);
  std::mt19937_64 phases = random_stream(seed, "blind reference");
  for (int i = 0; i < motion_.lines; ++i) {
    const double omega = std::pow(kSpread, i);
    lines_.push_back({1.0 / omega, omega, uniform(phases, 0.0, 2.0 * kPi)});
  }
  double low = kInfinity, high = -kInfinity, fastest = 0.0;
  for (int i = 0; i < kSamplesOfLines; ++i) {
    const Target at = sum_of_lines(2.0 * kPi * kPeriodsOfLines * i / kSamplesOfLines);
    low = std::min(low, at.x), high = std::max(high, at.x), fastest = std::max(fastest, std::abs(at.w));
  }
  const double size = motion_.travel / (high - low), pace = motion_.speed / (size * fastest);
  for (Line& l : lines_) l.amplitude *= size, l.omega *= pace;
}

Target Reference::at(double t) const {
  if (!lines_.empty()) return sum_of_lines(t);
  auto move = std::upper_bound(moves_.begin(), moves_.end(), t,
                               [](double time, const Move& m) { return time < m.start; });
  if (move == moves_.begin()) return {};
  --move;
  const double p = (t - move->start) / move->duration, length = move->to - move->from;
  if (motion_.course != Course::kConstantSpeed && p > 1.0) return {move->to, 0.0};
  const Target unit = unit_move(motion_.course, p);
  return {move->from + length * unit.x, length / move->duration * unit.w};
}

}  // namespace gapscope::independent_plant

#include "sliding_mode/verdict/shelf.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/normal.h"
#include "gapscope/base/statistics.h"
#include "signals/encoder.h"
#include "signals/strokes.h"
#include "sliding_mode/free_body.h"
#include "sliding_mode/verdict/pool.h"
#include "sliding_mode/words.h"

namespace gapscope::internal::sliding_mode {
namespace {

constexpr double kNextWindow = 1.15;  ///< over the one before
/// Of a window: at its begin, where the motor starts. Half tells one more of them, double one that
/// accelerates.
constexpr double kStarting = 0.15;
constexpr double kFirstStep = 0.3, kLastStep = 0.8;  ///< of a window: where the torque may rise
constexpr std::size_t kPlaces = 50;                  ///< tried between them
constexpr double kBesideStep = 0.05;                 ///< of the way to it: not asked for its slope
constexpr std::size_t kMostRowsOfStroke = 400;       ///< of a stroke; of longer ones every n-th
constexpr std::size_t kFewestOfLevel = 6;            ///< of a level
constexpr std::size_t kFewestEachWay = 2;            ///< strokes that show it

/// Of the torque's squares: what two levels explain at least. Of 50 drives in position loops 27 are told by
/// it and 26 hold, by half of it 32 and 31, by 0.85 13 and 12.
constexpr double kTwoLevels = 0.7;
/// Of the step: what the torque changes along a level. Of drives without a gap, and of such that accelerate
/// all the time, what two levels explain best changes by 0.3 to 1.5. Half tells 26 of the same
/// drives, and they hold, double 30, of which two miss.
constexpr double kFlat = 0.25;
constexpr double kLow = 0.2, kHigh = 0.8;  ///< of the step: between which its width is read
constexpr double kHalf = 0.5;
constexpr double kWidestRise = 0.3, kFinestRise = 0.004, kNextRise = 1.25;  ///< of the way: tried
constexpr double kOffMiddle = 0.1;  ///< … from the middle of each stroke's own
constexpr int kMiddles = 10;
constexpr double kToHalfRise = 1.5;  ///< widths of the rise, from the gap's to the middle of it

/// From one turn to the next.
struct Stroke {
  int direction = 0;
  std::size_t before = 0, turn = 0, end = 0;  ///< the turn before it, its own and the next [samples]
  double place = 0.0;                         ///< of x1 at the turn [rad]
};

/// The torque along the motion, over the way since the turn.
struct TorqueRows {
  std::vector<double> way, torque;
};

struct TwoLevels {
  double low = 0.0, high = 0.0;  ///< [unit of u]
  double step() const { return high - low; }
  double share(double torque) const { return (torque - low) / step(); }
};

/// What one window shows, the levels of rising and falling x1 apart.
struct Shelf {
  double window = 0.0, way = 0.0;  ///< [rad]
  double explains = 0.0;           ///< of the torque's squares
  std::array<TwoLevels, 2> levels;
};

std::size_t side(int direction) { return direction > 0 ? 0 : 1; }

/// x1 where it stays at its turn: noise takes the farthest sample farther.
double place_of_turn(const MotorTrace& trace, const signals::SignalFacts& facts, std::size_t turn) {
  const double tolerance = facts.quantum + 2.0 * facts.noise;
  const auto alike = [&](std::size_t i) { return std::abs(trace.x1[i] - trace.x1[turn]) <= tolerance; };
  std::size_t first = turn, last = turn;
  while (first > 0 && alike(first - 1)) --first;
  while (last + 1 < trace.size() && alike(last + 1)) ++last;
  return median(std::vector<double>(trace.x1.begin() + first, trace.x1.begin() + last + 1));
}

std::vector<Stroke> strokes_of(const MotorTrace& trace, const signals::SignalFacts& facts) {
  const std::vector<signals::StrokeTurn> turns = signals::turns(trace.x1);
  std::vector<Stroke> strokes;
  for (std::size_t k = 0; k + 1 < turns.size(); ++k)
    strokes.push_back({turns[k].direction, k > 0 ? turns[k - 1].sample : 0, turns[k].sample,
                       turns[k + 1].sample, place_of_turn(trace, facts, turns[k].sample)});
  return spread(std::span<const Stroke>(strokes));
}

double way_at(const MotorTrace& trace, const Stroke& s, std::size_t i) {
  return s.direction * (trace.x1[i] - s.place);
}

/// Samples of a stroke until it leaves the window.
std::size_t end_of_window(const MotorTrace& trace, const Stroke& s, double window) {
  std::size_t i = s.turn;
  while (i < s.end && way_at(trace, s, i) < window) ++i;
  return i;
}

void add_rows(const MotorTrace& trace, const Stroke& s, double window, TorqueRows& rows) {
  const std::size_t end = end_of_window(trace, s, window), stride = (end - s.turn) / kMostRowsOfStroke + 1;
  for (std::size_t i = s.turn; i < end; i += stride) {
    const double way = way_at(trace, s, i);
    if (way <= kStarting * window) continue;
    rows.way.push_back(way), rows.torque.push_back(s.direction * trace.u[i]);
  }
}

/// Sums of the torque below a way, and above it.
struct LevelSums {
  double n = 0.0, sum = 0.0, squares = 0.0;
  void add(double torque) { ++n, sum += torque, squares += torque * torque; }
  double level() const { return sum / n; }
  double left() const { return squares - sum * sum / n; }
};

std::array<LevelSums, 2> halves_of(const TorqueRows& rows, double way) {
  std::array<LevelSums, 2> h;
  for (std::size_t i = 0; i < rows.way.size(); ++i) h[rows.way[i] < way ? 0 : 1].add(rows.torque[i]);
  return h;
}

/// What the torque changes along the rows between two ways [unit of u].
double change_along(const TorqueRows& rows, double from, double to) {
  double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, low = kInfinity, high = -kInfinity;
  for (std::size_t i = 0; i < rows.way.size(); ++i) {
    const double way = rows.way[i];
    if (way < from || way > to) continue;
    ++n, x += way, y += rows.torque[i], xx += way * way, xy += way * rows.torque[i];
    low = std::min(low, way), high = std::max(high, way);
  }
  const double spread = xx - x * x / n;
  return n >= static_cast<double>(kFewestOfLevel) && spread > 0.0 ? (xy - x * y / n) / spread * (high - low)
                                                                  : kInfinity;
}

bool flat(const TorqueRows& rows, const Shelf& s, const TwoLevels& levels) {
  const double most = kFlat * levels.step(), beside = kBesideStep * s.way;
  return std::abs(change_along(rows, 0.0, s.way - beside)) <= most &&
         std::abs(change_along(rows, s.way + beside, s.window)) <= most;
}

std::optional<Shelf> shelf_in(const MotorTrace& trace, std::span<const Stroke> strokes, double window) {
  std::array<TorqueRows, 2> rows;
  for (const Stroke& s : strokes) add_rows(trace, s, window, rows[side(s.direction)]);
  Shelf best;
  best.window = window;
  double least = kInfinity, all = 0.0;
  for (const TorqueRows& r : rows) {
    if (r.way.size() < 2 * kFewestOfLevel) return {};
    all += halves_of(r, kInfinity)[0].left();
  }
  for (std::size_t k = 0; k <= kPlaces; ++k) {
    const double share = kFirstStep + (kLastStep - kFirstStep) * static_cast<double>(k) / kPlaces;
    double left = 0.0;
    std::array<TwoLevels, 2> levels;
    for (std::size_t d = 0; d < 2; ++d) {
      const auto [low, high] = halves_of(rows[d], share * window);
      if (std::min(low.n, high.n) < static_cast<double>(kFewestOfLevel)) left = kInfinity;
      left += low.left() + high.left(), levels[d] = {low.level(), high.level()};
    }
    if (left < least) least = left, best.way = share * window, best.levels = levels;
  }
  if (!(least < kInfinity) || !(all > 0.0)) return {};
  best.explains = 1.0 - least / all;
  if (best.explains < kTwoLevels) return {};
  for (std::size_t d = 0; d < 2; ++d)
    if (!(best.levels[d].step() > 0.0) || !flat(rows[d], best, best.levels[d])) return {};
  return best;
}

/// Of the windows that show one the clearest; nothing where another tells another way.
std::optional<Shelf> agreed_shelf(const MotorTrace& trace, const signals::SignalFacts& facts,
                                  std::span<const Stroke> strokes) {
  std::vector<Shelf> all;
  const double first = std::max(signals::kFewestToldQuanta * facts.quantum, facts.least_way());
  for (double window = first; window < facts.travel; window *= kNextWindow)
    if (const auto s = shelf_in(trace, strokes, window)) all.push_back(*s);
  if (all.empty()) return {};
  const Shelf best = *std::ranges::max_element(all, {}, &Shelf::explains);
  const auto other = [&](const Shelf& s) { return std::abs(s.way - best.way) > kSameShelf * best.way; };
  if (std::ranges::any_of(all, other)) return {};
  return best;
}

/// Where the torque of one stroke rises.
struct Rise {
  std::size_t sample = 0;  ///< the first beyond the middle of it
  double way = kNaN;       ///< to its middle [rad]
  double width = 0.0;      ///< [rad]
  double step = 0.0;       ///< that x1 goes from a sample to the next on the shelf [rad]
  double unseen = 0.0;     ///< what x1 went before the turn since the load was seen pushed [rad]
};

/// Width of the rise about sample `i`, by the way between kLow and kHigh of the step [rad].
double width_at(const MotorTrace& trace, const Stroke& s, const TwoLevels& levels, std::size_t i,
                std::size_t end) {
  const auto share = [&](std::size_t k) { return levels.share(s.direction * trace.u[k]); };
  std::size_t low = i, high = i;
  while (low > s.turn && share(low) >= kLow) --low;
  while (high + 1 < end && share(high) <= kHigh) ++high;
  return (way_at(trace, s, high) - way_at(trace, s, low)) / (kHigh - kLow);
}

/// Where the torque that moved the drive to the turn was last beyond the middle of its step.
std::size_t last_pushed(const MotorTrace& trace, const Stroke& s, const TwoLevels& before) {
  std::size_t i = s.turn;
  while (i > s.before && before.share(-s.direction * trace.u[i]) < kHalf) --i;
  return i;
}

std::optional<Rise> rise_of(const MotorTrace& trace, const Stroke& s, const Shelf& shelf) {
  const TwoLevels& levels = shelf.levels[side(s.direction)];
  const std::size_t end = end_of_window(trace, s, shelf.window);
  std::size_t begin = s.turn;
  while (begin < end && way_at(trace, s, begin) <= kStarting * shelf.window) ++begin;
  // The sample from which on the upper level fits better: the least sum of what the shares are beyond one
  // half.
  double sum = 0.0, least = 0.0;
  std::size_t at = begin;
  for (std::size_t i = begin; i < end; ++i) {
    sum += levels.share(s.direction * trace.u[i]) - kHalf;
    if (sum < least) least = sum, at = i + 1;
  }
  if (at <= begin || at >= end) return {};
  Rise r;
  r.sample = at;
  const double before = levels.share(s.direction * trace.u[at - 1]),
               behind = levels.share(s.direction * trace.u[at]);
  const double part = behind > before ? std::clamp((kHalf - before) / (behind - before), 0.0, 1.0) : kHalf;
  r.way = (1.0 - part) * way_at(trace, s, at - 1) + part * way_at(trace, s, at);
  r.step = (way_at(trace, s, at) - way_at(trace, s, begin)) / static_cast<double>(at - begin);
  r.width = width_at(trace, s, levels, at, end);
  const std::size_t pushed = last_pushed(trace, s, shelf.levels[side(-s.direction)]);
  r.unseen = std::max(way_at(trace, s, pushed), 0.0);
  return r;
}

struct Rises {
  std::vector<Rise> rises;
  std::vector<Stroke> strokes;  ///< as many

  std::vector<double> of(double Rise::*member, int direction = 0) const {
    std::vector<double> values;
    for (std::size_t k = 0; k < rises.size(); ++k)
      if (direction == 0 || strokes[k].direction == direction) values.push_back(rises[k].*member);
    return values;
  }
};

/// @param rise  way to the middle of the rise, of all [rad]
void keep_reversals(const MotorTrace& trace, const Rises& reading, double rise, GapEvidence& e) {
  for (std::size_t k = 0; k < reading.rises.size(); ++k) {
    const Stroke& s = reading.strokes[k];
    const Rise& r = reading.rises[k];
    GapEvent event;
    event.file = trace.file;
    event.direction = s.direction;
    event.t1 = trace.time(s.turn), event.t2 = trace.time(r.sample);
    event.x1_t1 = s.place, event.x1_t2 = s.place + s.direction * r.way;
    event.gap_uncorrected = r.way;
    event.gap = r.way + e.gap - rise;
    event.std = e.parts.together();
    event.remark = "by the torque behind the reversal";
    e.events.push_back(event);
  }
}

/// Width of the rise that all strokes together show, each about its own middle: with the noise of the torque
/// and what the loop does there, so no rise is wider [rad].
double widest_rise(const MotorTrace& trace, const Rises& reading, const Shelf& shelf) {
  TorqueRows rows;
  for (std::size_t k = 0; k < reading.rises.size(); ++k) {
    const Stroke& s = reading.strokes[k];
    TorqueRows own;
    add_rows(trace, s, shelf.window, own);
    for (std::size_t i = 0; i < own.way.size(); ++i) {
      rows.way.push_back(own.way[i] - reading.rises[k].way);
      rows.torque.push_back(shelf.levels[side(s.direction)].share(own.torque[i]));
    }
  }
  double widest = 0.0, least = kInfinity;
  const auto try_ramp = [&](double width, double middle) {
    double left = 0.0;
    for (std::size_t i = 0; i < rows.way.size(); ++i) {
      const double off = rows.way[i] - middle;
      const double ramp = width > 0.0 ? std::clamp(off / width + kHalf, 0.0, 1.0) : (off < 0.0 ? 0.0 : 1.0);
      left += (rows.torque[i] - ramp) * (rows.torque[i] - ramp);
    }
    if (left < least) least = left, widest = width;
  };
  for (double width = kWidestRise * shelf.way; width > kFinestRise * shelf.way; width /= kNextRise)
    for (int k = -kMiddles; k <= kMiddles; ++k) try_ramp(width, kOffMiddle * shelf.way * k / kMiddles);
  try_ramp(0.0, 0.0);
  return widest;
}

std::optional<GapEvidence> shelf_of(const MotorTrace& trace, const signals::SignalFacts& facts) {
  if (!facts.defect.empty() || !(facts.quantum > 0.0) || trace.u.size() != trace.x1.size()) return {};
  const std::vector<Stroke> strokes = strokes_of(trace, facts);
  const auto shelf = agreed_shelf(trace, facts, strokes);
  if (!shelf) return {};
  Rises reading;
  for (const Stroke& s : strokes)
    if (const auto rise = rise_of(trace, s, *shelf))
      reading.rises.push_back(*rise), reading.strokes.push_back(s);
  const auto up = reading.of(&Rise::way, 1), down = reading.of(&Rise::way, -1);
  if (std::min(up.size(), down.size()) < kFewestEachWay) return {};
  const double n = static_cast<double>(reading.rises.size());
  const double width = std::max(median(reading.of(&Rise::width)), 0.0),
               unseen = median(reading.of(&Rise::unseen));
  const double rise = 0.5 * (median(up) + median(down));
  GapEvidence e;
  e.method = GapMethod::kReversal;
  e.quantum = facts.quantum;
  e.gap = rise - kToHalfRise * width + 0.5 * unseen;
  const double spring = kToHalfRise * std::max(width, widest_rise(trace, reading, *shelf));
  e.parts.systematic = (spring + 0.5 * unseen) / kNormal95;
  e.parts.random = std::max(robust_std(up), robust_std(down)) / std::sqrt(0.5 * n);
  e.parts.directions = 0.5 * std::abs(median(up) - median(down));
  e.parts.sampling = 0.25 * median(reading.of(&Rise::step));
  e.parts.noise = facts.noise;
  if (!(e.gap > signals::kFewestToldQuanta * facts.quantum)) return {};
  keep_reversals(trace, reading, rise, e);
  const bool both = e.parts.directions <= kNormal95 * e.parts.beside_directions();
  e.tested = {{words::both_directions(), both}, {words::impacts_too(), false}};
  e.presumes = {words::one_gap(), words::load_rests(), words::own_encoder()};
  e.reading = words::shelf_read(std::ssize(reading.rises), rise);
  return e;
}

}  // namespace

std::optional<GapEvidence> read_shelf(std::span<const MotorTrace> recordings,
                                      std::span<const signals::SignalFacts> facts) {
  return narrowest(recordings, facts, shelf_of);
}

}  // namespace gapscope::internal::sliding_mode

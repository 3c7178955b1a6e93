// What the samples of x1 say about the encoder and the unit they are given in.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "inspection/rules.h"
#include "signals/encoder.h"
#include "signals/fresh_rows.h"

namespace gapscope::internal::inspection {
namespace {

using Samples = std::span<const double>;

constexpr double kFastestRotation = 3000.0;  ///< no motor turns faster [rad/s]
constexpr double kFastestSlide = 50.0;       ///< no axis moves faster [m/s]
constexpr double kJump = 10.0;               ///< step over those around it
constexpr double kSmallestJump = 20.0;       ///< … and over the noise of one position

/// Counts per turn that encoders are made with, beside the powers of two.
constexpr std::array kDecimalCounts = {1000.0, 2000.0,  2500.0,  4000.0,  5000.0,
                                       8000.0, 10000.0, 20000.0, 40000.0, 50000.0};

bool near(double value, double usual) { return std::abs(value - usual) < 1e-4 * usual; }

bool is_power_of_two(double counts) {
  return counts > 50.0 && near(counts, std::exp2(std::round(std::log2(counts))));
}

constexpr double kMostCounts = 1 << 30;    ///< a turn
constexpr double kFinestSlide = 0.99e-10;  ///< [m]

/// 0.001, 5e-8, ...: what rounding to so many decimals leaves, or the step of a linear scale.
bool is_round(double step) {
  const auto is_power_of_ten = [](double x) {
    return std::abs(std::log10(x) - std::round(std::log10(x))) < 1e-6;
  };
  return is_power_of_ten(step) || is_power_of_ten(2.0 * step) || is_power_of_ten(5.0 * step);
}

double fastest(const Material& m) {
  const Samples x = m.recording.x1;
  const std::size_t reach = std::max<std::size_t>(1, x.size() / 1000);
  double most = 0.0;
  for (std::size_t i = reach; i < x.size(); ++i) most = std::max(most, std::abs(x[i] - x[i - reach]));
  return most / (m.recording.dt * static_cast<double>(reach));
}

Finding wrong_unit(const std::string& found, const std::string& advice) {
  return {kPositionUnitRule, Severity::kSpoils, found, advice};
}

/// @param counts  steps per turn, which no encoder has
std::optional<Finding> unit_declared_for_another(double counts) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  struct Mistaken {
    double times;  ///< of what is read, in the unit that it is
    const char *is, *declared, *unit;
  };
  constexpr Mistaken kMistaken[] = {{360.0 / kTurn, "radians", "degrees", "rad"},
                                    {1.0 / 360.0, "degrees", "turns", "deg"},
                                    {1.0 / kTurn, "radians", "turns", "rad"},
                                    {1e-3, "milliradians", "radians", "mrad"},
                                    {kTurn / 21600.0, "arc minutes", "radians", "arcmin"}};
  for (const Mistaken& k : kMistaken)
    if (is_power_of_two(counts / k.times))
      return wrong_unit(fmt::format("x1 steps by 1/{:.4g} of a turn, and by 1/{:.0f} were it {:.3g} times as "
                                    "much: {}, declared as {}?",
                                    counts, counts / k.times, k.times, k.is, k.declared),
                        fmt::format("declare it, recording: units: {{position: {}}}", k.unit));
  return {};
}

/// "nd" of 2, "rd" of 43, "th" of 11 and of what is no whole number.
const char* ordinal(double n) {
  const long whole = std::lround(n), last = whole % 10;
  if (std::abs(n - static_cast<double>(whole)) > 1e-6 || whole / 10 % 10 == 1) return "th";
  return last == 1 ? "st" : last == 2 ? "nd" : last == 3 ? "rd" : "th";
}

double median_of_four(std::array<double, 4> v) {
  std::sort(v.begin(), v.end());
  return 0.5 * (v[1] + v[2]);
}

/// Steps that stand alone among their neighbours: a body with inertia makes none.
std::vector<std::size_t> jumps(const Material& m) {
  const Samples x = m.rows.x1;
  const auto step = [&](std::size_t i) { return std::abs(x[i] - x[i - 1]); };
  const double least = kSmallestJump * std::max(m.signal.noise, m.recording.quantum);
  std::vector<std::size_t> found;
  for (std::size_t i = 3; i + 2 < x.size(); ++i) {
    const double around = median_of_four({step(i - 2), step(i - 1), step(i + 1), step(i + 2)});
    if (step(i) > kJump * around + least) found.push_back(i);
  }
  return found;
}

/// Wraps and rows that jump and come back, which were mended as the file was read.
Finding mended_jumps(const Material& m) {
  std::vector<std::string> mended;
  for (const Remark& r : m.rows.assumed)
    if (r.code() == "position.unwrapped" || r.code() == "rows.jumping")
      mended.push_back(r.text(m.coordinates));
  if (mended.empty()) return {"jumps", Severity::kFine, "x1 has none", ""};
  return {
      "jumps", Severity::kNote, fmt::format("{}", fmt::join(mended, "; ")),
      "where it did turn so far, recording: unwrap: false; a reading that fails so often is worth a look at the "
      "encoder's line"};
}

}  // namespace

bool is_usual(double counts) {
  return is_power_of_two(counts) || std::any_of(kDecimalCounts.begin(), kDecimalCounts.end(),
                                                [&](double usual) { return near(counts, usual); });
}

Finding check_position_unit(const Material& m, RecordingFacts&) {
  const double q = m.recording.quantum, turn = 2.0 * std::numbers::pi;
  const double speed = fastest(m), limit = m.coordinates.rotational() ? kFastestRotation : kFastestSlide;
  if (m.moves() && whole_numbers(m.rows.x1))
    return wrong_unit("all positions are whole numbers: counts?",
                      m.coordinates.rotational()
                          ? "declare it, units: {position: counts} beside encoder: {bits: ...}"
                          : "declare it, units: {position: counts} beside encoder: {quantum: ...}");
  if (m.coordinates.rotational() && q > 0.0 && !is_usual(turn / q) && is_usual(360.0 / q))
    return wrong_unit(fmt::format("x1 steps by 360/{:.0f}: degrees?", 360.0 / q),
                      "declare it, recording: units: {position: deg}");
  if (m.coordinates.rotational() && q > 0.0 && !is_usual(turn / q) && is_power_of_two(1.0 / q))
    return wrong_unit(fmt::format("x1 steps by 1/{:.0f}: turns?", 1.0 / q),
                      "declare it, recording: units: {position: rev}");
  // Steps of a position in another unit may be those of a speed: an encoder's by the time between two rows.
  const bool differenced = q > 0.0 && is_power_of_two(turn / q / m.recording.dt);
  if (m.coordinates.rotational() && q > 0.0 && !differenced && !is_usual(turn / q))
    if (auto other = unit_declared_for_another(turn / q)) return *std::move(other);
  if (auto speed_in_its_place = seeming_position(m)) return *std::move(speed_in_its_place);
  if (m.coordinates.rotational() && differenced && !is_usual(turn / q))
    if (auto other = unit_declared_for_another(turn / q)) return *std::move(other);
  const std::string speeds = "up to " + m.length(speed) + "/s";
  if (speed > limit)
    return wrong_unit(speeds + fmt::format(", more than {:.0f}", limit),
                      fmt::format("give x1 in {} and t in s", m.unit()));
  return {kPositionUnitRule, Severity::kFine, speeds + fmt::format(", as a motor in {} may move", m.unit()),
          ""};
}

Finding check_encoder(const Material& m, RecordingFacts& facts) {
  const double q = m.recording.quantum, noise = m.signal.noise;
  facts.noise = noise;
  if (!(q > 0.0))
    return {"encoder", Severity::kNote,
            "no smallest step is seen; noise " + m.length(noise) + " per position",
            "if x1 was filtered, interpolated or computed, record the raw counts: filters blur the impacts"};
  facts.quantum = q;
  if (m.coordinates.rotational() && is_round(q))
    return {"encoder", Severity::kNote,
            fmt::format(
                "x1 steps by {:.4g} rad, a round number: so many decimals, not the counts, or no angle", q),
            "write x1 with more digits, and give the real step as encoder: {bits: ...}; a linear axis in m: "
            "--translation"};
  const double per_turn = 2.0 * std::numbers::pi / q;
  if (m.coordinates.rotational() ? per_turn > kMostCounts : q < kFinestSlide)
    return {"encoder", Severity::kNote,
            fmt::format("x1 steps by {:.4g} {}, finer than any encoder: another unit?", q, m.unit()),
            "declare it, recording: units: {position: ...}"};
  return {
      "encoder", Severity::kFine,
      fmt::format(
          "x1 steps by {}{}, noise {:.2g} steps; no gap below {:.0f} steps, {}, is found, and few below {:.0f}, {}",
          m.length(q), m.coordinates.rotational() ? fmt::format(" ({:.0f} per turn)", per_turn) : "",
          noise / q, signals::kFewestToldQuanta, m.length(signals::kFewestToldQuanta * q),
          signals::kFewestGapQuanta, m.length(signals::kFewestGapQuanta * q)),
      ""};
}

Finding check_jumps(const Material& m, RecordingFacts&) {
  const std::vector<std::size_t> found = jumps(m);
  if (found.empty()) return mended_jumps(m);
  const std::size_t i = found.front();
  const double size = std::abs(m.rows.x1[i] - m.rows.x1[i - 1]), turns = size / (2.0 * std::numbers::pi);
  const bool wraps =
      m.coordinates.rotational() && turns > 0.9 && std::abs(turns - std::round(turns)) < 0.05 * turns;
  return {"jumps", Severity::kSpoils,
          fmt::format("x1 jumps {} times, first by {} in {}", found.size(), m.length(size),
                      m.rows.place(m.rows.line[i])),
          wraps ? "a whole turn: count x1 on over the turns (unwrap it)"
                : "lost counts, a wrapped counter or a spike: mend the cause, or leave that part out with "
                  "recording: window"};
}

Finding check_hold(const Material& m, RecordingFacts&) {
  constexpr const char* kRule = "fresh samples";
  const signals::FreshRows rows = signals::fresh_rows(m.rows.x1, m.recording.quantum);
  if (rows.filling == signals::Filling::kNone)
    return {kRule, Severity::kFine, "no rows of x1 are held, or on a line between readings", ""};
  if (!rows.are_filled())
    return {
        kRule, Severity::kNote,
        m.recording.quantum > 0.0
            ? "whether x1 is read again for every row cannot be seen: from row to row its speed changes by "
              "less than its counts show"
            : "whether x1 is read again for every row cannot be seen: it is in no whole counts",
        "record the raw counts, at the rate at which they are read, in a faster or longer motion"};
  const double rate = 1.0 / (recording::mean_step(m.rows) * rows.every);
  const bool held = rows.filling == signals::Filling::kHeld;
  const std::string found =
      held ? fmt::format("x1 changes in every {}{} row only: read at some {:.4g} Hz and held",
                         figure(rows.every, 2), ordinal(rows.every), rate)
           : fmt::format(
                 "x1 changes its speed in every {}{} row only: read at some {:.4g} Hz and interpolated",
                 figure(rows.every, 2), ordinal(rows.every), rate);
  if (m.resampled && m.recording.dt * rate > 0.99)
    return {kRule, Severity::kNote, found, "resampled so slowly that each row is a reading"};
  return {
      kRule, Severity::kSpoils, found,
      fmt::format(
          "record at the rate of the encoder, or take each reading once, recording: resample: {{rate: {:.4g}}}",
          rate)};
}

}  // namespace gapscope::internal::inspection

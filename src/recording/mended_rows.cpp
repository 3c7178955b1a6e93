// What is mended in the rows of a file before anybody looks at them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "gapscope/base/errors.h"
#include "gapscope/base/statistics.h"
#include "recording/recorded_rows.h"

namespace gapscope::internal::recording {
namespace {

constexpr double kNearTurn = 0.25;      ///< of a turn: a step that far from a whole one wraps
constexpr double kWithinTurn = 1.02;    ///< turns that a position which wraps may span
constexpr double kMoreThanAround = 10;  ///< a row that jumps, over the steps around it
constexpr double kLeastJump = 0.05;     ///< … and of all that the position spans
constexpr double kMoreThanUsual = 4;    ///< … and over the step that one in twenty exceeds
constexpr double kMostJumping = 0.02;   ///< share of the rows: with more of them it is no reading
constexpr std::size_t kJumping = 2;     ///< rows that jump together

/// From the lowest to the highest, but for a hundredth at either end.
double span_of(Numbers values) {
  if (values.size() < 2) return 0.0;
  const auto cut = static_cast<std::ptrdiff_t>(values.size() / 100);
  std::nth_element(values.begin(), values.begin() + cut, values.end());
  const double low = values[static_cast<std::size_t>(cut)];
  std::nth_element(values.begin(), values.end() - 1 - cut, values.end());
  return *(values.end() - 1 - cut) - low;
}

/// The step from row to row that only one in twenty exceeds.
double large_step(const Numbers& x) {
  Numbers steps;
  for (std::size_t i = 1; i < x.size(); ++i) steps.push_back(std::abs(x[i] - x[i - 1]));
  const auto at = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() * 19 / 20);
  std::nth_element(steps.begin(), at, steps.end());
  return *at;
}

/// How many turns a step goes too far.
double turns_of(double step, double turn, Unwrap how) {
  const double turns = std::round(step / turn);
  if (how == Unwrap::kAlways) return turns;
  return std::abs(turns) == 1.0 && std::abs(step - turns * turn) < kNearTurn * turn ? turns : 0.0;
}

bool steps_beyond(const Numbers& x, double size) {
  return std::adjacent_find(x.begin(), x.end(), [=](double a, double b) { return std::abs(b - a) > size; }) !=
         x.end();
}

/// @returns how often the position began anew
std::size_t unwrap(double turn, Unwrap how, Numbers& x) {
  if (how == Unwrap::kNever || !(turn > 0.0) || !steps_beyond(x, 0.5 * turn)) return 0;
  if (how == Unwrap::kAuto && span_of(x) > kWithinTurn * turn) return 0;
  std::size_t wraps = 0;
  double whole = 0.0, before = x.front();
  for (std::size_t i = 1; i < x.size(); ++i) {
    const double turns = turns_of(x[i] - before, turn, how);
    before = x[i];
    wraps += turns != 0.0;
    whole -= turns * turn;
    x[i] += whole;
  }
  return wraps;
}

/// Rows from `at` on that jump away from those around and come back; 0: none do.
std::size_t jumping_rows(const Numbers& x, std::size_t at, double least) {
  for (std::size_t count = 1; count <= kJumping && at + count + 1 < x.size(); ++count) {
    const std::size_t before = at - 1, after = at + count;
    const double away = x[at] - x[before], back = x[after] - x[after - 1];
    const double around = std::max(
        {std::abs(x[before] - x[before - 1]), std::abs(x[after + 1] - x[after]), least / kMoreThanAround});
    const bool jumps =
        std::min(std::abs(away), std::abs(back)) > kMoreThanAround * around && away * back < 0.0;
    if (jumps && std::abs(x[after] - x[before]) <= 3.0 * static_cast<double>(count + 1) * around)
      return count;
  }
  return 0;
}

struct Jumps {
  std::size_t rows = 0, first = 0;
};

/// Draws single rows that jump and come back, as no body with inertia does, on a line between their
/// neighbours.
Jumps take_out_jumps(const Numbers& t, Numbers& x) {
  Jumps jumps;
  if (x.size() < kFewestSamples) return jumps;
  const double usual = kMoreThanUsual * large_step(x);
  if (!steps_beyond(x, usual)) return jumps;
  const double least = std::max({usual, kLeastJump * span_of(x), 20.0 * seen_quantum(x)});
  if (!(least > 0.0)) return jumps;
  Numbers mended = x;
  for (std::size_t i = 2; i + 2 < x.size(); ++i) {
    const std::size_t count = jumping_rows(mended, i, least);
    if (count == 0) continue;
    if (jumps.rows == 0) jumps.first = i;
    jumps.rows += count;
    const double slope = (mended[i + count] - mended[i - 1]) / (t[i + count] - t[i - 1]);
    for (std::size_t j = i; j < i + count; ++j) mended[j] = mended[i - 1] + slope * (t[j] - t[i - 1]);
  }
  if (static_cast<double>(jumps.rows) > kMostJumping * static_cast<double>(x.size())) return {};
  x = std::move(mended);
  return jumps;
}

void mend_position(const ReadOptions& options, RecordedRows& table) {
  const double turn = options.columns.scales.turn;
  const std::size_t wraps = unwrap(turn, options.unwrap, table.x1);
  unwrap(turn, options.unwrap, table.x2);
  unwrap(turn, options.unwrap, table.target);
  if (wraps > 0)
    table.assumed.emplace_back("position.unwrapped",
                               "x1 starts again {} times, after a turn of {:.4g} [rad]: counted on",
                               std::vector<Remark::Value>{static_cast<long>(wraps), turn});
  const Jumps jumps = take_out_jumps(table.t, table.x1);
  if (jumps.rows > 0)
    table.assumed.emplace_back(
        "rows.jumping", "rows in which x1 jumps away and back drawn over: {}, the first in {}",
        std::vector<Remark::Value>{static_cast<long>(jumps.rows), table.place(table.line[jumps.first])});
}

/// x1 as the integral of the speed that was read in its place, from 0 on.
void integrate(RecordedRows& table) {
  double speed = table.x1.front(), x = 0.0;
  table.x1.front() = 0.0;
  for (std::size_t i = 1; i < table.size(); ++i) {
    x += 0.5 * (speed + table.x1[i]) * (table.t[i] - table.t[i - 1]);
    speed = std::exchange(table.x1[i], x);
  }
  table.integrated = true;
  table.assumed.emplace_back("position.integrated", "x1 is the integral of the speed");
}

void move_input(int rows, RecordedRows& table) {
  const auto moved = static_cast<std::size_t>(std::abs(rows));
  if (moved + kFewestSamples > table.size())
    throw ConfigError(table.path,
                      fmt::format("has {} rows of which the input is moved by {}, expected at least {} more",
                                  table.size(), rows, kFewestSamples));
  const std::size_t left = table.size() - moved;
  Numbers u(table.u);
  if (rows < 0)
    std::copy(u.begin() + rows * -1, u.end(), table.u.begin());
  else
    std::copy(u.begin(), u.end() - rows, table.u.begin() + rows);
  table.keep(rows < 0 ? 0 : moved, left);
  table.assumed.emplace_back("input.moved", "u moved by {} rows",
                             std::vector<Remark::Value>{static_cast<long>(rows)});
}

/// Takes x2 away where it is x1 again: two encoders never read the same to the last digit, from any zero.
void drop_copied_load(RecordedRows& table) {
  if (table.x2.size() != table.x1.size() || table.x2.empty()) return;
  constexpr double kRounding =
      1e-9;  ///< of the travel: of other units and written digits; encoders leave 1e-6
  const auto [low, high] = std::ranges::minmax(table.x1);
  const double zero = table.x2.front() - table.x1.front();
  for (std::size_t i = 0; i < table.size(); ++i)
    if (!(std::abs(table.x2[i] - table.x1[i] - zero) < kRounding * (high - low))) return;
  table.x2.clear();
  table.assumed.emplace_back("load_position.copy", "x2 is x1 again, no second encoder: left out",
                             std::vector<Remark::Value>{});
}

}  // namespace

void mend_rows(const ReadOptions& options, RecordedRows& table) {
  if (options.columns.position_is_speed)
    integrate(table);
  else
    mend_position(options, table);
  drop_copied_load(table);
  if (options.input_rows != 0 && table.has_input && options.columns.reads_input())
    move_input(options.input_rows, table);
}

}  // namespace gapscope::internal::recording

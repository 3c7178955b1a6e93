// An input that looks like one and is another: a magnitude, a row too late, beside a speed in place of x1.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "inspection/balance.h"
#include "inspection/rules.h"
#include "signals/torque_cycles.h"

namespace gapscope::internal::inspection {
namespace {

// Counted by study_inputs on drives 25 to 104, developed on. As they are 77 of 80 step by counts of a usual
// encoder, which are of an angle; without that 6 would be told a speed, and none with it. With a speed in the
// place of x1 34 of 80 spoil where it was differenced, 40 where it was true; with half of kLeftOfSpeed 29 and
// 32 (1 as they are, without the counts), with double 56 and 51 (17). A moved row is seen in one of five at
// most: smooth motions hide it.
/// What is left as it stands, over what is left when it is moved: worth a note.
constexpr double kGainOfRows = 1.4;
constexpr double kSurelyMoved = 2.0;   ///< … and that it spoils
constexpr double kLeftOfSpeed = 0.5;   ///< of what the law of a position leaves: it spoils
constexpr double kPerhapsSpeed = 0.8;  ///< … and is worth a note
constexpr double kExplained = 0.3;     ///< … and of u
constexpr double kWindsUp = 2.0;       ///< [rad] further than that no locked output lets x1 go
constexpr double kGainOfSigns = 2.0;   ///< as kGainOfRows, with signs
constexpr double kToAndFro = 0.3;      ///< the shorter way of x1 to one side, over that to the other
constexpr double kFarFromZero = 0.5;   ///< mean of u, over what u swings about it
constexpr double kFollowsLoop = 0.9;   ///< of a locked output, beside which nothing moves

double ways_to_either_side(std::span<const double> x) {
  double there = 0.0, back = 0.0;
  for (std::size_t i = 1; i < x.size(); ++i) (x[i] > x[i - 1] ? there : back) += std::abs(x[i] - x[i - 1]);
  return std::min(there, back) / std::max({there, back, 1e-300});
}

/// The mean time from one crossing of its mean to the next [s].
double half_period_of(std::span<const double> u, double dt) {
  const double level = mean(u);
  std::size_t crossings = 1;
  for (std::size_t i = 1; i < u.size(); ++i) crossings += (u[i] > level) != (u[i - 1] > level);
  return dt * static_cast<double>(u.size()) / static_cast<double>(crossings);
}

bool has_one_sign(std::span<const double> u) {
  const auto [low, high] = std::minmax_element(u.begin(), u.end());
  return *low >= 0.0 || *high <= 0.0;
}

}  // namespace

std::optional<Finding> seeming_input(const Material& m, const std::string& found) {
  const MotorTrace trace = m.recording.motor_trace();
  if (m.commanded || !m.moves() || !has_one_sign(m.recording.u)) return {};
  if (ways_to_either_side(m.recording.x1) < kToAndFro) return {};
  const double gain = gain_of_signs(trace, m.signal.half_period);
  if (!(gain > kGainOfSigns)) return {};
  return Finding{
      kInputRule, Severity::kSpoils,
      found +
          fmt::format(": never of the other sign while x1 goes to and fro, and with its sign turned where "
                      "it touches 0 a body leaves {} times less of it: a magnitude",
                      figure(gain, 2)),
      "record it with its sign (of a servo the goal and --controller-gain estimate show as much: --target "
      "in place of --input)"};
}

std::optional<Finding> constant_input(const Material& m, const std::string& found) {
  const std::vector<double>& u = m.recording.u;
  if (m.commanded || !(m.signal.leaning > kFarFromZero)) return {};
  return Finding{
      kInputRule, Severity::kNote,
      found +
          fmt::format(
              ", {} in the mean, which is {:.0f} % of its swing: a constant load, as gravity or a preload{}",
              figure(mean(u)), 100.0 * m.signal.leaning,
              has_one_sign(u) ? "; it never changes its sign" : ""),
      "give the model constant_load_torque, or load_unbalance where an arm turns, estimated; a contact that such a load "
      "holds closed does not open, and no gap shows then: unload it, or swing u about 0",
      true};
}

std::optional<Finding> seeming_rows(const Material& m, bool uniform, const std::string& found) {
  const MotorTrace trace = m.recording.motor_trace();
  if (!uniform || m.commanded || !m.moves()) return {};
  const InputRows rows = best_input_rows(trace, m.signal.half_period);
  if (rows.best == 0 || !(rows.gain > kGainOfRows)) return {};
  if (signals::torque_cycles(trace).following > kFollowsLoop) return {};
  const bool late = rows.best < 0;
  return Finding{"scale of u", late && rows.gain > kSurelyMoved ? Severity::kSpoils : Severity::kNote,
                 found + fmt::format("; moved by {} row{} a body leaves {} times less of u: {}", rows.best,
                                     std::abs(rows.best) == 1 ? "" : "s", figure(rows.gain, 2),
                                     late ? "each row has what acted before it, as in the reply of a drive"
                                          : "it acts later than it stands, or the drive is late itself"),
                 fmt::format("recording: input_rows: {0} (--input-rows {0}){1}", rows.best,
                             late ? "" : "; or leave it to the model: input_delay"),
                 true};
}

std::optional<Finding> seeming_position(const Material& m) {
  const MotorTrace trace = m.recording.motor_trace();
  if (m.commanded || !m.moves() || m.rows.integrated) return {};
  const double of_input = half_period_of(m.recording.u, m.recording.dt);
  if (m.signal.half_periods < signals::kFewestHalfPeriods &&
      m.recording.duration() < static_cast<double>(signals::kFewestHalfPeriods) * of_input)
    return {};
  const auto [low, high] = std::minmax_element(m.recording.u.begin(), m.recording.u.end());
  if (*low == *high) return {};
  // Counts of a usual encoder are of an angle: a damped drive follows u as a speed does.
  if (m.coordinates.rotational() && m.recording.quantum > 0.0 &&
      is_usual(2.0 * std::numbers::pi / m.recording.quantum))
    return {};
  double best = kInfinity;
  // Turns of a speed that was differenced are of its noise: those of u count as well.
  for (const std::size_t window : balance_windows(trace, std::max(m.signal.half_period, of_input))) {
    const Balance balance(trace, window);
    const double left = balance.left_of_speed(m.recording.u);
    if (left < kExplained) best = std::min(best, left / balance.left(m.recording.u));
  }
  if (!(best < kPerhapsSpeed)) return {};
  // What a locked output lets x1 go follows u as well.
  const bool held = m.signal.travel < kWindsUp && signals::torque_cycles(trace).following > kFollowsLoop;
  return Finding{
      kPositionUnitRule, best < kLeftOfSpeed && !held ? Severity::kSpoils : Severity::kNote,
      fmt::format(
          "u goes with the first difference of x1, not with the second: as a speed x1 leaves {} times less of it",
          figure(1.0 / best, 2)),
      "name it as what it is, recording: columns: speed (--speed in place of --position)"};
}

}  // namespace gapscope::internal::inspection

// An input whose numbers cannot be those of what drives the motor.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "inspection/rules.h"

namespace gapscope::internal::inspection {
namespace {

/// A servo's goal runs with its position; a torque that does so with one number per unit of position is that
/// of a spring, and of one stiffness among all.
constexpr double kRunsWith = 0.98;
constexpr double kLeastSlope = 0.8, kMostSlope = 1.25;  ///< of a goal over the position, in one unit
constexpr double kLargestDuty = 1.5;  ///< a share of the supply is 1 at most; half as much to spare
/// What a controller may ask for before its limit: a stiff servo whose goal jumps by a turn asks for some.
constexpr double kLargestAskedFor = 20.0;
constexpr double kLargestCurrent = 300.0;  ///< of a motor that one encoder is on [A]

/// A straight line through one signal over another.
struct Line {
  double correlation = 0.0, slope = 0.0;
};

Line line_of(std::span<const double> y, std::span<const double> x) {
  const double y0 = mean(y), x0 = mean(x);
  double xx = 0.0, yy = 0.0, xy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - x0) * (x[i] - x0), yy += (y[i] - y0) * (y[i] - y0);
    xy += (x[i] - x0) * (y[i] - y0);
  }
  if (!(xx > 0.0) || !(yy > 0.0)) return {};
  return {xy / std::sqrt(xx * yy), xy / xx};
}

bool is_near_one(double slope) { return slope > kLeastSlope && slope < kMostSlope; }

double peak_of(std::span<const double> u) {
  double peak = 0.0;
  for (const double v : u) peak = std::max(peak, std::abs(v));
  return peak;
}

std::optional<Finding> commanded_position(const Material& m, const std::string& found) {
  const std::vector<double>& u = m.register_input;  // as it stands: a declared unit says nothing of a goal
  if (m.commanded || !m.moves() || u.size() != m.rows.x1.size()) return {};
  Line line = line_of(u, m.rows.x1);
  if (!(line.correlation > kRunsWith)) return {};
  // Its numbers are those of the position's own column, or of the position in rad beside it.
  if (!is_near_one(line.slope)) line.slope *= std::abs(m.position_unit);
  if (!is_near_one(line.slope)) return {};
  return Finding{
      kInputRule, Severity::kSpoils,
      found + fmt::format(": its numbers run with those of x1 (correlation {:.3f}, {:.2f} per unit of "
                          "position): a commanded position, no torque, current or duty?",
                          line.correlation, line.slope),
      "such a column belongs under --target (recording: columns: target), beside "
      "--controller-gain estimate; --input names what drives the motor"};
}

std::optional<Finding> large_duty(const Material& m, const std::string& found) {
  const double peak = peak_of(m.duty);
  if (!(peak > (m.commanded ? kLargestAskedFor : kLargestDuty))) return {};
  const std::string size = fmt::format(": the duty that the voltage multiplies is up to {}", figure(peak));
  if (m.commanded)
    return Finding{kInputRule, Severity::kNote, found + size + ", of the controller's gain, where 1 is all",
                   "is the gain in units of the firmware? It has to be duty per rad (--controller-gain, or "
                   "estimate); a limit of the duty is --set controller.position.saturation=1",
                   true};
  return Finding{
      kInputRule, Severity::kNote, found + size + ", where 1 is all of the supply",
      fmt::format("give the size of one unit of its column: --input-unit 0.01 where it is in percent, "
                  "1/{} or more where that is full",
                  figure(peak)),
      true};
}

}  // namespace

std::optional<Finding> impossible_input(const Material& m, const std::string& found) {
  if (auto goal = commanded_position(m, found)) return goal;
  return large_duty(m, found);
}

}  // namespace gapscope::internal::inspection

namespace gapscope {

void judge_for_unit(const std::string& unit, Inspection& inspection) {
  using internal::inspection::kLargestCurrent;
  if (unit != "A" || !(inspection.facts.input_peak > kLargestCurrent)) return;
  for (Finding& f : inspection.findings) {
    if (f.rule != kInputRule || f.severity == Severity::kSpoils) continue;
    f.severity = Severity::kNote, f.warned = true;
    f.found +=
        fmt::format(": {} A are a great deal", internal::inspection::figure(inspection.facts.input_peak));
    f.advice = "is the column in mA? Declare it, recording: units: {input: mA} (--input-unit mA)";
  }
}

}  // namespace gapscope

#include "reference/controller_numbers.h"

#include <algorithm>
#include <cmath>

#include "base/require.h"
#include "base/text.h"
#include "recording/supply.h"
#include "reference/torque_scale.h"

namespace gapscope::internal::reference {
namespace {

constexpr double kLongestDelay = 50.0;     ///< derived bound [samples]
constexpr double kShortestDelay = 1e-3;    ///< the same: at 0 itself a change of it has one side [samples]
constexpr double kFirstDelay = 0.1;        ///< where a search begins at least [samples]
constexpr double kControllerSpan = 100.0;  ///< derived bounds of the other numbers over their starts

/// The recordings under a controller.
void set_inputs(FitProblem& problem, const DriveController& controller) {
  auto made = std::make_shared<StartInputs>();
  made->recordings.assign(problem.recordings.begin(), problem.recordings.end());
  for (MotorTrace& trace : made->recordings) {
    GAPSCOPE_REQUIRE(trace.command != nullptr);
    made->u.push_back(commanded_input(controller, trace));
    trace.u = made->u.back();
    trace.sent = {}, trace.delay = 0.0;
  }
  problem.inputs = made;
  problem.recordings = made->recordings;
  problem.controller = controller;
}

/// Whether its updates are those of the rows, of every recording.
bool all_at_rows(const FitProblem& problem, const DriveController& controller) {
  return std::all_of(problem.recordings.begin(), problem.recordings.end(),
                     [&](const MotorTrace& t) { return updates_at_rows(controller, t); });
}

/// Of a controller whose leading number is 1 so far.
double suggested_leading(const FitProblem& problem, const ReferenceModel& model) {
  const TorqueScale scale = torque_scale(problem.recordings, model);
  const double km = model.parameters[place::kTorqueConstant].value;
  if (const double by_torque = scale.constant / (km > 0.0 ? km : 1.0); by_torque > 0.0) return by_torque;
  return scale.body.peak_input > 0.0 ? 1.0 / scale.body.peak_input : 1.0;
}

void bound_delay(Parameter& p, double dt) {
  p.typical = dt;
  p.start = std::max(p.start, kFirstDelay * dt);
  if (std::isnan(p.low)) p.low = kShortestDelay * dt;
  if (std::isnan(p.high)) p.high = std::max(kLongestDelay * dt, 3.0 * p.start);
  p.low = std::max(p.low, kShortestDelay * dt);
  p.high = std::max(p.high, p.low);
}

void bound_gain(Parameter& p, double size, bool leading) {
  p.typical = std::max(std::abs(p.start), size);
  const double least = leading ? p.typical / kControllerSpan : 0.0, most = kControllerSpan * p.typical;
  const double sign = p.start < 0.0 ? -1.0 : 1.0;
  if (std::isnan(p.low)) p.low = sign > 0.0 ? least : -most;
  if (std::isnan(p.high)) p.high = sign > 0.0 ? most : -least;
}

/// Whether a supply multiplies what the controller asks for, which is then a duty.
bool has_supply(const FitProblem& problem) {
  return std::any_of(problem.recordings.begin(), problem.recordings.end(),
                     [](const MotorTrace& r) { return is_supplied(*r.command); });
}

/// What one unit of the controller's output is; where the torque constant is 1, the gain has its size.
std::string output_unit(const FitProblem& problem) {
  if (!has_supply(problem)) return "unit of u";
  const auto is_one = [](const Parameter& p) {
    return p.id == drive_number(place::kTorqueConstant) && !p.estimated && p.start == 1.0;
  };
  return std::any_of(problem.parameters.begin(), problem.parameters.end(), is_one) ? "N m/V" : "duty";
}

Parameter parameter_of_controller(int index, const ParameterSetting& setting, const DriveController& start,
                                  double dt, const std::string& output) {
  const ControllerNumberSpec& spec = kControllerNumbers[index];
  DriveController c = start;
  Parameter p;
  p.id = number_of_controller(index);
  p.key = spec.key, p.unit = replaced(spec.unit, "unit of u", output);
  if (index == controller_place::kGain && c.kind == ControllerKind::kCascade) p.unit = "1/s";
  p.estimated = setting.estimate;
  p.given = std::isfinite(setting.value);
  p.start = gapscope::controller_number(c, index);
  p.prior = setting.prior;
  if (!p.estimated) return p;
  p.low = setting.low, p.high = setting.high;
  const double leading = std::abs(gapscope::controller_number(c, leading_number(c.kind)));
  if (index == controller_place::kDelay)
    bound_delay(p, dt);
  else
    bound_gain(p, spec.typical * leading, index == leading_number(c.kind));
  p.start = std::clamp(p.start, p.low, p.high);
  p.coordinate = p.low >= 0.0 ? Coordinate::logarithmic(p.typical) : Coordinate::linear(p.start, p.typical);
  return p;
}

}  // namespace

void command_inputs(FitProblem& problem, const ReferenceModel& model) {
  const ControllerModel& given = *model.controller;
  DriveController controller = given.at_start();
  set_inputs(problem, controller);
  const bool delays = controller.delay > 0.0 || given.numbers[controller_place::kDelay].estimate;
  problem.delays = delays && all_at_rows(problem, controller);
  const int leading = leading_number(controller.kind);
  if (std::isfinite(given.numbers[static_cast<std::size_t>(leading)].value)) return;
  gapscope::controller_number(controller, leading) = suggested_leading(problem, model);
  set_inputs(problem, controller);
}

void add_controller(FitProblem& problem, const ControllerModel& model) {
  const double dt = problem.recordings.front().dt;
  const std::string output = output_unit(problem);
  for (int i = 0; i < kControllerNumberCount; ++i) {
    const ParameterSetting& setting = model.numbers[i];
    if (!setting.estimate && !(std::abs(setting.value) > 0.0)) continue;
    problem.parameters.push_back(parameter_of_controller(i, setting, *problem.controller, dt, output));
  }
}

}  // namespace gapscope::internal::reference

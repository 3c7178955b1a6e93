#include "diagnosis/loop_additions.h"

#include <algorithm>
#include <cmath>

namespace gapscope::internal::diagnosis {
namespace {

/// Of the torque that the drive usually brings, with which friction begins.
constexpr double kFirstShare = 0.2;
constexpr double kSpeedOver = 0.03;  ///< time over which a speed is read [s]
constexpr double kFast = 0.99;       ///< quantile of the speeds, with which a profile begins
constexpr double kRise = 0.1;        ///< time in which it comes to that speed at first [s]

/// Of the speed at which its whole output is lost in damping, which is a few times the one that it goes with.
constexpr double kMostDamped = 0.3;
constexpr double kInertia = 1.5;  ///< that of what hangs there, with which a drive begins

bool has(const ReferenceModel& model, const char* name) {
  return std::ranges::any_of(model.effects,
                             [&](const ModelEffect& e) { return e.entry == find_effect(name); });
}

/// Its first number, 0 where the loop has none of it.
double level_of(const Loop& loop, const char* name) {
  for (const ModelEffect& e : loop.model.effects)
    if (e.entry == find_effect(name)) return e.parameters[0].value;
  return 0.0;
}

ModelEffect effect_with(const char* name, std::initializer_list<ParameterSetting> settings) {
  ModelEffect effect;
  effect.entry = find_effect(name);
  std::copy(settings.begin(), settings.end(), effect.parameters.begin());
  return effect;
}

/// Largest output that the loop asks for at the recorded errors [unit of u].
double largest_output(const Loop& loop, std::span<const MotorTrace> recordings) {
  double most = 0.0;
  for (const MotorTrace& t : recordings)
    for (const double u : commanded_input(loop.controller, t)) most = std::max(most, std::abs(u));
  return most;
}

/// The torque that the drive usually brings: that of what hangs on it, else the median of what the loop asks
/// for [N m].
double usual_torque(const Loop& loop, std::span<const MotorTrace> recordings) {
  for (const ModelEffect& e : loop.model.effects)
    if (e.entry == find_effect("load_unbalance") && e.parameters[0].value > 0.0) return e.parameters[0].value;
  std::vector<double> sizes;
  for (const MotorTrace& t : recordings)
    for (const double u : commanded_input(loop.controller, t)) sizes.push_back(std::abs(u));
  return loop.model.parameters[place::kTorqueConstant].value * median(std::move(sizes));
}

double largest_supply(std::span<const MotorTrace> recordings) {
  double most = 0.0;
  for (const MotorTrace& t : recordings)
    most = std::max(most, *std::max_element(t.command->supply.begin(), t.command->supply.end()));
  return most;
}

/// Of goal and position [rad].
std::vector<double> errors_of(std::span<const MotorTrace> recordings) {
  std::vector<double> sizes;
  for (const MotorTrace& t : recordings)
    for (std::size_t i = 0; i < t.size(); ++i)
      sizes.push_back(std::abs(t.command->target[t.command_first + i] - t.x1[i]));
  return sizes;
}

/// With which the drive goes where it goes fast [rad/s].
double usual_top_speed(std::span<const MotorTrace> recordings) {
  std::vector<double> speeds;
  for (const MotorTrace& t : recordings) {
    const auto rows = static_cast<std::size_t>(std::ceil(kSpeedOver / t.dt));
    for (std::size_t i = rows; i < t.size(); i += rows)
      speeds.push_back(std::abs(t.x1[i] - t.x1[i - rows]) / (t.elapsed(i) - t.elapsed(i - rows)));
  }
  return speeds.empty() ? 0.0 : quantile(std::move(speeds), kFast);
}

/// So many times the torque per unit of the input, with the same limit of torque.
void more_torque(double times, Loop& loop) {
  ParameterSetting& constant = loop.model.parameters[place::kTorqueConstant];
  if (!constant.estimate) return;
  constant.value *= times;
  if (std::isfinite(loop.controller.saturation)) loop.controller.saturation /= times;
}

/// Of an error, where the gain falls.
double share_left(const DriveController& c, double error) {
  return std::pow(1.0 + std::pow(error / c.falls_at, c.falls_sharpness), -1.0 / c.falls_sharpness);
}

LoopAddition of_law(const std::vector<const LawNumber*>& numbers, std::vector<double> starts,
                    std::function<void(Loop&, double)> put) {
  LoopAddition a{std::move(starts), std::move(put), {}};
  for (const LawNumber* n : numbers)
    a.parts.push_back({n->key, [n](Loop& l) { l.controller.*n->member = n->absent; }, true});
  return a;
}

LoopAddition of_law(const LawNumber& number, std::vector<double> starts) {
  return of_law({&number}, std::move(starts),
                [&number](Loop& l, double start) { l.controller.*number.member = start; });
}

void erase(Loop& loop, const char* effect) {
  std::erase_if(loop.model.effects, [&](const ModelEffect& e) { return e.entry == find_effect(effect); });
}

LoopAddition of_drive(const char* effect, std::vector<double> starts,
                      std::function<void(Loop&, double)> put) {
  return {std::move(starts), std::move(put), {{effect, [effect](Loop& l) { erase(l, effect); }}}};
}

/// Of the law that the loop's firmware has none of yet.
void add_laws(const Loop& loop, std::span<const MotorTrace> recordings,
              std::vector<LoopAddition>& additions) {
  std::vector<double> errors = errors_of(recordings);
  const double error = *std::ranges::max_element(errors), usual = median(std::move(errors));
  const double output = largest_output(loop, recordings) / largest_supply(recordings);
  const double speed = usual_top_speed(recordings), dt = recordings.front().dt;
  const double damping = loop.model.parameters[place::kMotorDamping].value;
  const auto lacks = [&](const LawNumber& n) { return !n.is_in(loop.controller); };
  const auto is_off = [](const MotorTrace& t) { return t.command->off_from < kInfinity; };
  if (lacks(LawNumbers::off_damping) && std::ranges::any_of(recordings, is_off)) {
    additions.push_back(of_law(LawNumbers::off_damping, {0.02 * damping, 0.3 * damping}));
    additions.back().parts.front().of_law = false;
  }
  if (lacks(LawNumbers::saturation))
    additions.push_back(of_law(LawNumbers::saturation, {0.3 * output, 0.7 * output}));
  if (lacks(LawNumbers::goal_delay))
    additions.push_back(of_law(LawNumbers::goal_delay, {0.5 * dt, 3.0 * dt}));
  if (lacks(LawNumbers::delay)) additions.push_back(of_law(LawNumbers::delay, {0.3 * dt, 2.0 * dt}));
  if (lacks(LawNumbers::goal_filter))
    additions.push_back(of_law(LawNumbers::goal_filter, {2.0 * dt, 8.0 * dt}));
  const std::vector<double> speeds = {0.7 * speed, 0.9 * speed, 1.1 * speed};
  if (speed > 0.0 && lacks(LawNumbers::profile_speed))
    additions.push_back(of_law(LawNumbers::profile_speed, speeds));
  if (speed > 0.0 && lacks(LawNumbers::profile_acceleration))
    additions.push_back(of_law(LawNumbers::profile_acceleration, {speed / kRise, 3.0 * speed / kRise}));
  if (speed > 0.0 && lacks(LawNumbers::profile_speed) && lacks(LawNumbers::profile_acceleration))
    additions.push_back(of_law(
        {&LawNumbers::profile_speed, &LawNumbers::profile_acceleration}, speeds, [](Loop& l, double start) {
          l.controller.profile_speed = start, l.controller.profile_acceleration = start / kRise;
        }));
  // What it does to errors of the usual size stays, at first.
  const auto falling = [&](std::vector<const LawNumber*> numbers, std::vector<double> starts,
                           const std::function<void(DriveController&, double)>& change) {
    additions.push_back(of_law(numbers, std::move(starts), [=](Loop& l, double start) {
      const double before = share_left(l.controller, usual);
      change(l.controller, start);
      more_torque(before / share_left(l.controller, usual), l);
    }));
  };
  const std::vector<double> ends = {0.1 * error, 0.3 * error, error};
  if (lacks(LawNumbers::falls_at))
    falling({&LawNumbers::falls_at}, ends, [](DriveController& c, double at) { c.falls_at = at; });
  if (lacks(LawNumbers::falls_at) && lacks(LawNumbers::falls_sharpness))
    falling({&LawNumbers::falls_at, &LawNumbers::falls_sharpness}, ends,
            [](DriveController& c, double at) { c.falls_at = at, c.falls_sharpness = 1.0; });
  if (!lacks(LawNumbers::falls_at) && lacks(LawNumbers::falls_sharpness))
    falling({&LawNumbers::falls_sharpness}, {1.0, 4.0},
            [](DriveController& c, double n) { c.falls_sharpness = n; });
}

/// Of the drive.
void add_effects(const Loop& loop, std::span<const MotorTrace> recordings,
                 std::vector<LoopAddition>& additions) {
  const double torque = usual_torque(loop, recordings);
  if (!has(loop.model, "motor_coulomb_friction") && !has(loop.model, "stribeck_friction") &&
      !has(loop.model, "load_dependent_friction"))
    additions.push_back(of_drive("motor_coulomb_friction", {0.2 * kFirstShare * torque, kFirstShare * torque},
                                 [](Loop& l, double start) {
                                   l.model.effects.push_back(effect_with("motor_coulomb_friction",
                                                                         {ParameterSetting::sought(start)}));
                                 }));
  if (!has(loop.model, "load_dependent_friction"))
    additions.push_back(of_drive("load_dependent_friction", {0.1, 0.3}, [](Loop& l, double start) {
      l.model.effects.push_back(effect_with("load_dependent_friction",
                                            {ParameterSetting::known(0.0), ParameterSetting::sought(start)}));
    }));
  if (!has(loop.model, "stribeck_friction")) {
    additions.push_back(of_drive("stribeck_friction", {0.3}, [](Loop& l, double start) {
      const double level = level_of(l, "motor_coulomb_friction");
      if (!(level > 0.0)) return;
      erase(l, "motor_coulomb_friction");
      l.model.effects.push_back(
          effect_with("stribeck_friction", {ParameterSetting::sought(level), ParameterSetting::sought(start),
                                            ParameterSetting::sought(0.2), ParameterSetting::known(1.0)}));
    }));
    additions.back().parts.front().take_out = [](Loop& l) {
      const double level = level_of(l, "stribeck_friction");
      erase(l, "stribeck_friction");
      l.model.effects.push_back(effect_with("motor_coulomb_friction", {ParameterSetting::sought(level)}));
    };
  }
  const bool loads = std::ranges::any_of(recordings, [](const MotorTrace& t) { return !t.load.is_none(); });
  if (loads && has(loop.model, "load_unbalance")) {
    additions.push_back(of_drive("load_unbalance", {0.1}, [](Loop& l, double start) {
      const auto first = std::ranges::find_if(
          l.model.effects, [](const ModelEffect& e) { return e.entry == find_effect("load_unbalance"); });
      const auto at = [&](std::size_t i) { return ParameterSetting::known(first->parameters[i].value); };
      l.model.effects.push_back(effect_with(
          "load_unbalance", {ParameterSetting::sought(start * first->parameters[0].value), at(1), at(2)}));
    }));
    additions.back().parts.front().take_out =
        [](Loop& l) {  // the second one: the first hangs there as declared
          const auto last =
              std::find_if(l.model.effects.rbegin(), l.model.effects.rend(),
                           [](const ModelEffect& e) { return e.entry == find_effect("load_unbalance"); });
          l.model.effects.erase(std::next(last).base());
        };
  }
}

/// Torque with which what hangs on the drive is held at x1 [N m].
double weight_at(const ReferenceModel& model, const MotorTrace& trace, double x1) {
  double torque = 0.0, more = trace.load.gravity;
  for (const ModelEffect& e : model.effects)
    if (e.entry == find_effect("load_unbalance")) {
      torque += (e.parameters[0].value + more) * std::sin(e.parameters[2].value * x1 + e.parameters[1].value);
      more = 0.0;
    }
  return torque;
}

}  // namespace

std::optional<Loop> held_at_rest(const Loop& loop, std::span<const MotorTrace> recordings) {
  std::vector<double> constants;  // of which a goal that is not taken up yet spoils some
  for (const MotorTrace& t : recordings) {
    const std::vector<double> u = commanded_input(loop.controller, t);
    const auto rows = static_cast<std::size_t>(std::ceil(kRise / t.dt));
    for (std::size_t i = rows; i < t.size(); ++i) {
      const bool rests = std::abs(t.x1[i] - t.x1[i - rows]) <= t.quantum;
      if (rests && u[i] != 0.0) constants.push_back(weight_at(loop.model, t, t.x1[i]) / u[i]);
    }
  }
  Loop held = loop;
  ParameterSetting &constant = held.model.parameters[place::kTorqueConstant],
                   &damping = held.model.parameters[place::kMotorDamping],
                   &inertia = held.model.parameters[place::kMotorInertia];
  const double speed = usual_top_speed(recordings);
  if (!constant.estimate || !(speed > 0.0)) return {};
  constant.value = median(std::move(constants));
  if (!(constant.value > 0.0)) return {};
  if (damping.estimate)
    damping.value = kMostDamped * constant.value * largest_output(loop, recordings) / speed;
  if (inertia.estimate && inertia.low > 0.0) inertia.value = kInertia * inertia.low;
  return held;
}

std::vector<LoopAddition> additions_to(const Loop& loop, std::span<const MotorTrace> recordings) {
  std::vector<LoopAddition> additions;
  add_laws(loop, recordings, additions);
  add_effects(loop, recordings, additions);
  return additions;
}

}  // namespace gapscope::internal::diagnosis

#include "gapscope/simulation/closed_loop.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <stdexcept>

#include "base/interrupt.h"
#include "base/random.h"
#include "base/require.h"
#include "gapscope/plant/effect_hooks.h"
#include "gapscope/simulation/stepper.h"

namespace gapscope {
namespace {

constexpr double kOneInstant = 1e-9;  ///< times that differ by less are one [s]

/// The drive while it is switched off: its load drives the gears, which rub under the mean of the torques on
/// both of their sides, of which the motor's is none.
/// @param damping  of the motor's side then; NaN: as ever [N m s/rad]
PlantModel<double> let_go(PlantModel<double> model, double damping) {
  if (!std::isnan(damping)) model.drive.motor_damping = damping;
  if (!model.gears_rub || model.structure.has_load) return model;
  model.gear_friction *= 0.5;
  const EffectEntry &hangs = *find_effect("load_unbalance"), &driving = *find_effect("cogging_torque");
  std::vector<std::array<double, 3>> weights;  // amplitude, phase, periods per turn
  std::erase_if(model.effects, [&](const ActiveEffect<double>& e) {
    const bool weighs = e.hooks == &hooks_of<double>(hangs);
    if (weighs) weights.push_back({e.parameters[0], e.parameters[1], e.parameters[2]});
    return weighs;
  });
  for (const auto& [amplitude, phase, periods] : weights) {
    std::vector<double> values(driving.parameters.size(), 0.0);
    values[0] = amplitude, values[1] = periods, values[2] = phase;
    add_effect<double>(model, driving, values);
  }
  return model;
}

/// A drive and its controller, from one event to the next.
class DriveInLoop {
 public:
  /// @param phase  of a turn, at which the first update comes
  DriveInLoop(const PlantModel<double>& model, const DriveController& controller,
              const SimulationOptions& options, double phase = 0.0)
      : model_(model),
        dt_(1.0 / options.rate),
        controller_(controller),
        phase_(phase),
        law_(controller_),
        stepper_(model, dt_, kOneInstant),
        encoder_(options.encoder),
        noise_(random_stream(options.seed, "encoder noise")) {
    stepper_.reset(options.initial);
  }

  /// What acts until the first output of the controller does.
  void begin_with(double u) { u_ = u; }

  const DriveStepper<double>& drive() const { return stepper_; }

  double read() {
    double x = stepper_.measured();
    if (encoder_.noise > 0.0) x += encoder_.noise * normal(noise_);
    if (encoder_.quantum > 0.0) x = encoder_.quantum * std::nearbyint(x / encoder_.quantum);
    return x;
  }

  /// At a row of which the reading is x: one of its own, where an update falls on it.
  void row(double target, double x, double supply = 1.0) {
    if (goals_.empty() && now_ == 0.0) target_ = target;
    goals_.push_back({now_ + controller_.goal_delay, target});
    supply_ = supply, impulse_ = 0.0, row_began_ = now_;
    if (controller_.rate == 0.0 || next_update() < now_ + kOneInstant) update(x);
    act();
  }

  /// At a row while the drive is switched off, or no longer.
  void switch_off(bool off) {
    if (off) coming_.clear(), u_ = 0.0;
    if (off == off_) return;
    off_ = off;
    const DriveState<double> state = stepper_.state();
    stepper_ = DriveStepper<double>(off ? let_go(model_, controller_.off_damping) : model_, dt_, kOneInstant);
    stepper_.reset(state);
  }

  /// @returns the mean of the input since the row
  double until(double end) {
    for (double next = next_event(); next < end - kOneInstant; next = next_event()) {
      advance(next);
      if (controller_.rate > 0.0 && next_update() < now_ + kOneInstant) update(read());
      act();
    }
    advance(end);
    return impulse_ / (now_ - row_began_);
  }

 private:
  /// Of the controller, or of the host, and when it arrives.
  struct Command {
    double from, u;
  };

  double next_update() const { return (static_cast<double>(updates_) + phase_) / controller_.rate; }
  double next_event() const {
    const double change = coming_.empty() ? kInfinity : coming_.front().from;
    return controller_.rate > 0.0 ? std::min(change, next_update()) : change;
  }
  void update(double x) {
    for (; !goals_.empty() && goals_.front().from < now_ + kOneInstant; goals_.pop_front())
      target_ = goals_.front().u;
    if (off_) {
      ++updates_;
      return;
    }
    coming_.push_back({now_ + controller_.delay, law_.update(now_, target_, x)});
    ++updates_;
  }
  void act() {
    for (; !coming_.empty() && coming_.front().from < now_ + kOneInstant; coming_.pop_front())
      u_ = coming_.front().u;
  }
  void advance(double to) {
    stepper_.step(u_ * supply_, to - now_);
    impulse_ += u_ * supply_ * (to - now_);
    now_ = to;
    if (!stepper_.healthy())
      throw std::runtime_error("the simulated motion diverges: expected a stable drive and controller");
  }

  PlantModel<double> model_;
  double dt_;
  bool off_ = false;
  DriveController controller_;
  double phase_;
  ControllerLaw<double> law_;
  DriveStepper<double> stepper_;
  Encoder encoder_;
  std::mt19937_64 noise_;
  std::deque<Command> coming_, goals_;
  double now_ = 0.0, u_ = 0.0, supply_ = 1.0, target_ = 0.0, impulse_ = 0.0, row_began_ = 0.0;
  long updates_ = 0;
};

}  // namespace

Recording simulate_under_controller(const PlantModel<double>& model, const DriveController& controller,
                                    std::span<const double> target, const SimulationOptions& options,
                                    std::span<const double> supply) {
  GAPSCOPE_REQUIRE(options.rate > 0.0 && controller.delay >= 0.0);
  GAPSCOPE_REQUIRE(supply.empty() || supply.size() == target.size());
  Recording r;
  r.dt = 1.0 / options.rate;
  r.quantum = options.encoder.quantum;
  const bool load = model.structure.reads_load();
  r.encoder = load ? EncoderSide::kLoad : EncoderSide::kMotor;
  DriveInLoop loop(model, controller, options);
  auto rows = std::make_shared<CommandRows>();
  for (std::size_t i = 0; i < target.size(); ++i) {
    stop_point();
    const double position = loop.read();
    const DriveState<double>& state = loop.drive().state();
    r.x1.push_back(load ? state.x1 : position);
    if (model.structure.has_load) r.x2.push_back(load ? position : state.x2);
    r.mode.push_back(mode_of(loop.drive()));
    rows->t.push_back(r.time(i)), rows->position.push_back(position);
    rows->supply.push_back(supply.empty() ? 1.0 : supply[i]);
    loop.row(target[i], position, rows->supply.back());
    r.u.push_back(loop.until(r.time(i + 1)));
  }
  rows->target.assign(target.begin(), target.end());
  r.command = rows;
  return r;
}

std::vector<double> positions_under_controller(const PlantModel<double>& model,
                                               const DriveController& declared, const MotorTrace& recording,
                                               const DriveState<double>& start, double phase) try {
  GAPSCOPE_REQUIRE(recording.command != nullptr);
  const CommandRows& rows = *recording.command;
  const DriveController controller = controller_during(rows, declared);
  SimulationOptions options;
  options.rate = 1.0 / recording.dt, options.initial = start, options.encoder = {};
  PlantModel<double> then = model;
  add_load(then, recording.load.inertia, recording.load.gravity);
  DriveInLoop loop(then, controller, options, phase);
  const std::size_t first = recording.command_first;
  loop.begin_with(commanded_input(declared, rows, first, 1).front() / rows.supply[first]);
  std::vector<double> positions;
  for (std::size_t i = 0; i < recording.size(); ++i) {
    positions.push_back(loop.read());
    loop.switch_off(rows.is_off(rows.t[first + i]));
    loop.row(rows.target[first + i], positions.back(), rows.supply[first + i]);
    if (i + 1 < recording.size()) loop.until(recording.elapsed(i + 1));
  }
  return positions;
} catch (const std::runtime_error&) {
  return {};
}

}  // namespace gapscope

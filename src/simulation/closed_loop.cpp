#include "gapscope/simulation/closed_loop.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <stdexcept>

#include "gapscope/base/interrupt.h"
#include "gapscope/base/random.h"
#include "gapscope/base/require.h"
#include "gapscope/simulation/stepper.h"

namespace gapscope {
namespace {

constexpr double kOneInstant = 1e-9;  ///< times that differ by less are one [s]

/// A drive and its controller, from one event to the next.
class DriveInLoop {
 public:
  DriveInLoop(const PlantModel<double>& model, const DriveController& controller,
              const SimulationOptions& options)
      : controller_(controller),
        law_(controller_),
        stepper_(model, 1.0 / options.rate, kOneInstant),
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
    target_ = target, supply_ = supply, impulse_ = 0.0, row_began_ = now_;
    if (controller_.rate == 0.0 || next_update() < now_ + kOneInstant) update(x);
    act();
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
  struct Command {
    double from, u;
  };

  double next_update() const { return static_cast<double>(updates_) / controller_.rate; }
  double next_event() const {
    const double change = coming_.empty() ? kInfinity : coming_.front().from;
    return controller_.rate > 0.0 ? std::min(change, next_update()) : change;
  }
  void update(double x) {
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

  DriveController controller_;
  ControllerLaw<double> law_;
  DriveStepper<double> stepper_;
  Encoder encoder_;
  std::mt19937_64 noise_;
  std::deque<Command> coming_;
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
                                               const DriveState<double>& start) try {
  GAPSCOPE_REQUIRE(recording.command != nullptr);
  const CommandRows& rows = *recording.command;
  const DriveController controller = controller_during(rows, declared);
  SimulationOptions options;
  options.rate = 1.0 / recording.dt, options.initial = start, options.encoder = {};
  DriveInLoop loop(model, controller, options);
  const std::size_t first = recording.command_first;
  loop.begin_with(commanded_input(declared, rows, first, 1).front() / rows.supply[first]);
  std::vector<double> positions;
  for (std::size_t i = 0; i < recording.size(); ++i) {
    positions.push_back(loop.read());
    loop.row(rows.target[first + i], positions.back(), rows.supply[first + i]);
    if (i + 1 < recording.size()) loop.until(recording.elapsed(i + 1));
  }
  return positions;
} catch (const std::runtime_error&) {
  return {};
}

}  // namespace gapscope

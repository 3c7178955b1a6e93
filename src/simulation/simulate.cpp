#include "gapscope/simulation/simulate.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/interrupt.h"
#include "base/random.h"
#include "base/require.h"
#include "gapscope/simulation/stepper.h"

namespace gapscope {
namespace {

/// The coarser of the sheet's quantum and one that an effect gives.
double real_quantum(const PlantModel<double>& model, double quantum) {
  for (const ActiveEffect<double>& e : model.effects)
    if (e.hooks->quantum != nullptr) quantum = std::max(quantum, e.hooks->quantum(e.parameters));
  return quantum;
}

}  // namespace

std::vector<double> encoder_reads(std::span<const double> position, const Encoder& encoder,
                                  std::uint64_t seed) {
  auto noise = random_stream(seed, "second encoder noise");
  std::vector<double> read(position.begin(), position.end());
  for (double& x : read) {
    if (encoder.noise > 0.0) x += encoder.noise * normal(noise);
    if (encoder.quantum > 0.0) x = encoder.quantum * std::nearbyint(x / encoder.quantum);
  }
  return read;
}

Recording simulate(const PlantModel<double>& model, std::span<const double> u,
                   const SimulationOptions& options) {
  GAPSCOPE_REQUIRE(options.rate > 0.0);
  Recording r;
  r.dt = 1.0 / options.rate;
  r.quantum = options.encoder.quantum;
  r.u.assign(u.begin(), u.end());
  r.x1.reserve(u.size());
  r.mode.reserve(u.size());
  const bool load = model.structure.reads_load();
  r.encoder = load ? EncoderSide::kLoad : EncoderSide::kMotor;
  auto noise = random_stream(options.seed, "encoder noise");
  const double quantum = real_quantum(model, options.encoder.quantum);
  DriveStepper<double> stepper(model, r.dt);
  stepper.reset(options.initial);
  for (const double input : u) {
    stop_point();  // a stiff drive takes its time for a single sample
    double position = stepper.measured();
    if (options.encoder.noise > 0.0) position += options.encoder.noise * normal(noise);
    if (quantum > 0.0) position = quantum * std::nearbyint(position / quantum);
    r.x1.push_back(load ? stepper.state().x1 : position);
    if (model.structure.has_load) r.x2.push_back(load ? position : stepper.state().x2);
    r.mode.push_back(mode_of(stepper));
    stepper.step(input);
    if (!stepper.healthy())
      throw std::runtime_error("the simulated motion diverges: expected a stable drive and a bounded input");
  }
  return r;
}

PlantModel<double> plant_model(const DriveParameters<double>& drive, const DriveStructure& structure) {
  PlantModel<double> model;
  model.drive = drive;
  model.structure = structure;
  model.load_sticks = drive.load_coulomb_friction > 0.0;
  return model;
}

}  // namespace gapscope

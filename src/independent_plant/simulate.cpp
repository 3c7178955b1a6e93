#include "independent_plant/simulate.h"

#include "base/require.h"
#include "independent_plant/run_recorder.h"

namespace gapscope::independent_plant {
BlindRun simulate_blind(const BlindDrive& drive, const BlindExcitation& excitation, const BlindSensor& sensor,
                        const BlindOptions& options) {
  return simulate_blind_command(drive, command(excitation, options.rate, options.duration, options.seed),
                                sensor, options);
}

BlindRun simulate_blind_command(const BlindDrive& drive, const std::vector<double>& u,
                                const BlindSensor& sensor, const BlindOptions& options) {
  const double dt = 1.0 / options.rate;
  GAPSCOPE_REQUIRE(drive.effects.command.jitter_s < dt);
  Rig rig(drive, sensor, options.duration, options.tolerance, options.seed);
  RunRecorder recorder(sensor, 0.0, dt);
  for (std::size_t k = 0; k < u.size(); ++k) {
    const double t = dt * static_cast<double>(k);
    rig.advance(t);
    recorder.note(rig, u[k], rig.read());
    rig.send(t, u[k]);
  }
  return recorder.finished(rig);
}

}  // namespace gapscope::independent_plant

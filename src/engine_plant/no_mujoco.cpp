// Where MuJoCo was not there at build time.
#include "engine_plant/mujoco_plant.h"
#include "gapscope/base/errors.h"

namespace gapscope::engine_plant {

void require_mujoco() {
  throw ConfigError(
      "gapscope: plant: mujoco needs MuJoCo, which was not there when gapscope was built, expected "
      "libmujoco-dev (apt install libmujoco-dev; or plant: independent), then cmake and the build anew");
}

Recording mujoco_recording(const independent_plant::BlindCase&) {
  require_mujoco();
  return {};
}

}  // namespace gapscope::engine_plant

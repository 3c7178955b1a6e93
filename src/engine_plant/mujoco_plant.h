#pragma once

#include <span>
#include <string_view>

#include "gapscope/recording/recording.h"
#include "independent_plant/random_drive.h"

/// Drives whose physics no line of gapscope has: MuJoCo's own engine moves what an XML says of them.
namespace gapscope::engine_plant {

/// The effects of the catalogue that MJCF of MuJoCo 2.2 says as they are, or that the loop around an engine
/// has of itself (a delay of the input).
std::span<const std::string_view> mujoco_effects();

/// @throws ConfigError where gapscope was built without MuJoCo, with what to install
void require_mujoco();

/// A case as MuJoCo moves it: Runge–Kutta at about 0.0125 ms, the input held over each sample, x1 read by the
/// case's encoder with its noise. Deterministic; calls may come from several threads.
/// @throws ConfigError as require_mujoco(); std::logic_error for an effect that is not among mujoco_effects()
/// or a motion that diverges
Recording mujoco_recording(const independent_plant::BlindCase& drawn);

}  // namespace gapscope::engine_plant

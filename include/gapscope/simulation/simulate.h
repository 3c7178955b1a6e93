#pragma once

#include <cstdint>
#include <span>

#include "gapscope/plant/plant_model.h"
#include "gapscope/recording/recording.h"

namespace gapscope {

/// The encoder that estimators read: noise first, then the nearest count.
struct Encoder {
  double quantum = 0.0;  ///< [rad]; 0: continuous
  double noise = 0.0;    ///< rms, before quantisation [rad]
};

struct SimulationOptions {
  double rate = 1000.0;        ///< [Hz]
  std::uint64_t seed = 1;      ///< of the encoder's noise
  DriveState<double> initial;  ///< at the first sample
  Encoder encoder;
};

/// Plays the input u (held from sample to sample) on a drive and records it like a real one: x1 through the
/// encoder, x2 exactly (the other way round where the encoder is on the load), and the mode of each sample
/// (impact: a contact closed in the interval that ends there).
/// @throws std::runtime_error when the motion diverges.
Recording simulate(const PlantModel<double>& model, std::span<const double> u,
                   const SimulationOptions& options);

/// What another encoder on the drive reads of an exact position [rad], with a noise of its own.
std::vector<double> encoder_reads(std::span<const double> position, const Encoder& encoder,
                                  std::uint64_t seed);

/// The model of a drive without effects.
PlantModel<double> plant_model(const DriveParameters<double>& drive, const DriveStructure& structure);

}  // namespace gapscope

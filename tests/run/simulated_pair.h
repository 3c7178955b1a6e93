#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "gapscope/recording/recording.h"
#include "gapscope/reference/fit.h"

namespace gapscope::test {

/// A number that drive and simulator have, each its own.
struct Knob {
  std::string name;  ///< of the row that tells it
  double drive = 0.0, simulator = 0.0;

  bool differs() const { return drive != simulator; }
};

/// A drive by the independent plant, a simulator of it by MuJoCo's engine, both under the same inputs.
struct SimulatedPair {
  bool has_load = false;
  double step = 1e-3;        ///< of the engine [s]
  bool runge_kutta = false;  ///< else MuJoCo's semi-implicit Euler
  double detents_per_turn = 0.0;
  double input_late = 0.0;  ///< of the simulator, in whole steps [s]
  std::vector<Knob> knobs;  ///< withheld from the decision
  Recording train, held_out, simulated_train, simulated_held_out;
  ReferenceModel sheet;  ///< up to 20 % off the drive

  const Knob* find(const std::string& name) const;
  /// What an effect has beside its amount, alike in both.
  double shape_of(const std::string& effect, const EffectParameterSpec& parameter) const;
};

/// @param same  drive and simulator have the same physics: only step and solver differ
SimulatedPair draw_pair(std::uint64_t seed, bool same);

}  // namespace gapscope::test

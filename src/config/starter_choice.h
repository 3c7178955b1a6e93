#pragma once

#include <span>
#include <string>

#include "config/starter.h"

namespace gapscope::internal::config {

/// The structure of a first model, and why it is that one.
struct StarterChoice {
  StarterModel structure = StarterModel::kGap;
  std::string why;
  bool seen = true;  ///< or asked for: no guess
};

/// As asked for; where nobody asks, as the detector sees it.
StarterChoice chosen_structure(StarterModel model, std::span<const MotorTrace> traces, EncoderSide encoder,
                               Coordinates coordinates);

/// That of a simulator's model, unless it knows of no gap and the detector does.
StarterChoice as_modelled(const JointNumbers& numbers, std::span<const MotorTrace> traces,
                          EncoderSide encoder, Coordinates coordinates);

}  // namespace gapscope::internal::config

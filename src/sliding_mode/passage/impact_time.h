#pragma once

#include "sliding_mode/passage/passage.h"
#include "sliding_mode/passage/release.h"

namespace gapscope::internal::sliding_mode {

/// The instant of an impact, by local fits.
struct ImpactTime {
  bool found = false;
  bool freed = false;         ///< the kink is along the passage: what pulled at the motor let go
  std::size_t core = 0;       ///< last sample that is safely before it
  double time = 0.0;          ///< [samples]
  double half_width = 0.0;    ///< of the instants that fit almost as well [s]
  double stiffness = 0.0;     ///< of the contact, over the motor's inertia; 0: rigid [1/s²]
  double position = 0.0;      ///< x1 [rad]
  double speed = 0.0;         ///< of the motor just before [rad/s]
  double acceleration = 0.0;  ///< of the motor just before [rad/s²]
  double drive = 0.0;         ///< acceleration that the input gives the motor along the passage [rad/s²]
};

/// Where x1 leaves the law of the free motor behind (contact_onset.h), in as few samples as show it.
ImpactTime refine_impact(const PassageContext& context, const BankEvent& impact, const Reversal& reversal,
                         const FlightLaw& law);

}  // namespace gapscope::internal::sliding_mode

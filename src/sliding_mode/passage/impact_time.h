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
  double half_width = 0.0;    ///< over the kinks that fit almost as well, and what is hidden [s]
  double contact = 0.0;       ///< ω of the stroke that fits best; 0: rigid, or bounces [rad/s]
  double hidden = 0.0;        ///< how long the contact acts before it shows in the noise [s]
  double position = 0.0;      ///< x1 [rad]
  double speed = 0.0;         ///< of the motor just before [rad/s]
  double acceleration = 0.0;  ///< of the motor just before [rad/s²]
  double drive = 0.0;         ///< acceleration that the input gives the motor along the passage [rad/s²]
};

/// Where x1 leaves the law of the free motor behind: kinks (t − t2)₊^p, p = 1 (rigid), or the stroke of an
/// elastic contact, in what the law of the flight leaves over. The window after the impact is tied to the
/// excursion, because a light load rings within a millisecond.
ImpactTime refine_impact(const PassageContext& context, const BankEvent& impact, const Reversal& reversal,
                         const FlightLaw& law);

}  // namespace gapscope::internal::sliding_mode

#pragma once

#include <cstdint>
#include <optional>

#include "implant/implant_law.h"

namespace gapscope::internal::implant {

/// A law with all its values.
struct Implant {
  const ImplantLaw* law = nullptr;
  Values values{};
  std::uint64_t seed = 0;  ///< of what differs between recordings
};

/// All values but the first, drawn.
Implant drawn_shape(const ImplantLaw& law, std::span<const Subject> subjects, const Receiver& drive,
                    std::uint64_t seed);

/// The same with the first value at which it has that size, see drawn_implant().
std::optional<Implant> sized_implant(Implant implant, std::span<const Subject> subjects,
                                     const Receiver& drive, double size);

/// A law of drawn shape whose torque, or the torque that would have the same effect on the readings, has that
/// rms over all recordings, relative to that of the torque that the input brings; one set of values for all.
/// Nothing where no value comes to it.
std::optional<Implant> drawn_implant(const ImplantLaw& law, std::span<const Subject> subjects,
                                     const Receiver& drive, double size, std::uint64_t seed);

/// The recording of a drive that has the effect as well. A recorded drive obeyed m a = Km u + rest; with
/// u' = u − τ/Km the same motion is that of a drive that has the torque τ, too.
/// @param number of the recording in its case
Recording implanted(const Subject& subject, std::size_t number, const Implant& implant,
                    const Receiver& drive);

/// rms of what it changes over that of the input, see drawn_implant().
double implant_size(std::span<const Subject> subjects, const Implant& implant, const Receiver& drive);

}  // namespace gapscope::internal::implant

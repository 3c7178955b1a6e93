#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "gapscope/diagnosis/next_experiment.h"
#include "independent_plant/random_drive.h"

namespace gapscope::test {

/// A drive of the independent plant with an effect, recorded under a slow sine that shows little of it, and
/// two models fitted to that: with the true effect, and with one that is easily mistaken for it.
struct LookAlikes {
  independent_plant::BlindCase drive;
  Recording recording;
  std::vector<Rival> rivals;  ///< the truth first
};

LookAlikes look_alikes(const std::string& truth, const std::string& other, std::uint64_t seed);

/// What the other model leaves of a recording of the drive that the truth does not, both refitted [σ].
double seen_excess(const LookAlikes& pair, const Recording& recorded);

/// The drive under the proposed input.
Recording played(const LookAlikes& pair, const NextExperiment& proposal);

/// Truths with what each is taken for.
const std::vector<std::pair<std::string, std::string>>& look_alike_pairs();

}  // namespace gapscope::test

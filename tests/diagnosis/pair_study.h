#pragma once

#include <string>
#include <vector>

#include "blind/blind_pair.h"
#include "diagnosis/study_row.h"

namespace gapscope::test {

/// Two effects that one drive may have at once, joined by '+': of different families, neither a look-alike of
/// the other, both seen by a fit (so no coarser encoder).
std::vector<std::string> effect_pairs();

/// The names between '+'.
std::vector<std::string> split_effects(const std::string& joined);

/// The whole stepwise search on a drive with the effects joined by '+'.
///   first     what was found, joined by '+'           group   how many of the true ones are among it
///   in_group  all of them are                         before  what is left with the best but one of them
///   [floor] shrink    of all steps                            probability  processor time over that of the
///   first step
StudyRow examine_steps(const blind::BlindPair& pair, std::uint64_t seed);

/// The proposed experiment for a pair of look-alikes, "truth/rival", played on the independent plant.
///   first  the shape of the input     before, shrink  predicted and seen excess [σ]
///   in_group  at least one σ seen     group  1 where no direction can be told
StudyRow examine_question(const std::string& pair, std::uint64_t seed);

}  // namespace gapscope::test

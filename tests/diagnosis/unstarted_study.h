#pragma once

#include "blind/blind_pair.h"
#include "diagnosis/study_row.h"

namespace gapscope::test {

/// The whole diagnosis of a drive with a gap of which the sheet says motor inertia and torque constant alone:
/// no other number has a value to begin with.
///   before    of the nominal model [floor]        place     the gap is told: "yes", else "-"
///   covered   its interval holds the drive's: "yes", "no"; "-": no gap or no interval is told
StudyRow examine_unstarted(const blind::BlindPair& pair, std::uint64_t seed);

void print_unstarted(const std::vector<StudyRow>& rows);

}  // namespace gapscope::test

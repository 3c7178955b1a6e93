#pragma once

#include "blind/blind_pair.h"
#include "diagnosis/study_row.h"
#include "gapscope/diagnosis/diagnosis.h"

namespace gapscope::test {

/// What one says, and the columns that do not hang on the kind of study: `before` and `group` as below.
struct WholeDiagnosis {
  Diagnosis diagnosis;
  StudyRow row;
};
WholeDiagnosis diagnosed(const blind::BlindPair& pair, const ReferenceModel& sheet, std::uint64_t seed);

/// The whole diagnosis of a drive that lacks nothing or something outside the catalogue, laws of last resort
/// included.
///   first     the law that was told, else "-"        in_group  it is of the true variable
///   group     number of effects that were added      before    of the nominal model [floor]
///   shrink    that the law takes                      covered   whether it takes as much of the next
///   recording; "-beyond" where more than a tenth of that lies beyond the law's table
StudyRow examine_laws(const blind::BlindPair& pair, std::uint64_t seed);

/// Of what is a function of speed, position or input: how often its law was told, and how much it takes.
void print_laws(const std::vector<StudyRow>& rows);

}  // namespace gapscope::test

#pragma once

#include <string>
#include <vector>

#include "report/figure_data.h"
#include "results/diagnosis_result.h"
#include "results/run_result.h"

namespace gapscope::internal::report {

/// The figures in order, each with its reading; what there is none of, with the reason.
std::string figure_section(const std::vector<FigureData>& figures);

/// A heading and a list; nothing for no lines.
std::string bullet_section(const char* title, const std::vector<std::string>& lines);

/// Those of a rejected reference that a diagnosis has replaced are told where its parameters are.
/// @param diagnosis  in the same folder; nullptr: none
std::vector<std::string> warnings_of(const RunResult& run, const DiagnosisResult* diagnosis = nullptr);
std::vector<std::string> notes_of(const RunResult& run);  ///< on the data, and what was done to them

/// What a report tells of an estimate: the estimators in sentences and as a table, parameters, advice.
/// @param diagnosis  in the same folder; nullptr: none
std::string estimate_text(const RunResult& run, const Timing& timing,
                          const DiagnosisResult* diagnosis = nullptr);

}  // namespace gapscope::internal::report

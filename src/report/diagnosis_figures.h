#pragma once

#include <string>
#include <vector>

#include "report/figure_data.h"
#include "results/diagnosis_result.h"

namespace gapscope::internal::report {

/// The figures of a diagnosis, the overview sheet first.
std::vector<FigureData> diagnosis_figures(const DiagnosisResult& result);

/// Error and correcting torque, before and after.
FigureData diagnosis_traces(const DiagnosisResult& result);
FigureData diagnosis_ranking(const DiagnosisResult& result);  ///< held-out score of every candidate
FigureData diagnosis_where(const DiagnosisResult& result);    ///< the seven maps
/// Correcting torque over speed, angle and input.
FigureData diagnosis_torque_map(const DiagnosisResult& result);

/// What a report tells of a diagnosis: its sentence and its tables.
std::string diagnosis_text(const DiagnosisResult& result);

}  // namespace gapscope::internal::report

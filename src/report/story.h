#pragma once

#include <string>
#include <vector>

#include "report/figure_data.h"
#include "report/html_page.h"
#include "results/diagnosis_result.h"
#include "results/run_result.h"

namespace gapscope::internal::report {

/// What the report of a drive tells: an estimate, a diagnosis, or both as one story.
struct DriveStory {
  const RunResult* run = nullptr;              ///< nullptr: not there
  const DiagnosisResult* diagnosis = nullptr;  ///< nullptr: not there
  Timing timing;
  std::string note;                 ///< below the title; empty: none
  std::vector<FigureData> figures;  ///< of both
};

/// The six lines that everybody wants to know, briefly and then in full.
std::string card_text(const Card& card);

/// What its page begins with: what it is of, how far the answers go, and the picture that carries them.
PageHead head_of(const DriveStory& story);

/// The text of report.md: the title, the card, then the detail, and what its words mean.
std::string story_text(const DriveStory& story);

}  // namespace gapscope::internal::report

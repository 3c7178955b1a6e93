#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gapscope/base/coordinates.h"
#include "gapscope/base/doubt.h"
#include "gapscope/reference/fit_summary.h"
#include "gapscope/sliding_mode/gap_estimate.h"
#include "gapscope/telling/card.h"
#include "gapscope/telling/statement.h"

namespace gapscope {

struct Diagnosis;

/// kDiagnosis: the model with all that a diagnosis has added.
enum class AnswerSource { kModelFree, kReference, kDiagnosis, kNone };
enum class AnswerTrust { kGood, kLimited, kNone };

const char* to_string(AnswerSource source);  ///< "model_free", "reference", "diagnosis", "none"
const char* to_string(AnswerTrust trust);    ///< "good", "limited", "none"

/// What is the gap, can it be believed, and what should be done next.
struct Answer {
  double gap = kNaN;  ///< 2β [rad]; NaN where none is read, or none is there
  Interval ci95;      ///< [rad]
  AnswerSource from = AnswerSource::kNone;
  AnswerTrust trust = AnswerTrust::kNone;
  std::string sentence;
  std::vector<std::string> next;             ///< at most three steps
  std::vector<std::string> next_codes = {};  ///< theirs
  std::string in_brief = "";                 ///< the sentence, as a card begins with it
  Tolerance tolerance = {};                  ///< that was stated
  double gap_at_most = kNaN;  ///< no gap is larger, by the reading without a model [rad]; NaN: no such bound
  std::vector<std::string> codes = {};  ///< what is told, by names that do not change with its wording
  Card card = {};                       ///< the same and the mismatch, in six lines

  bool says(const std::string& code) const;
};

/// What was found. A part that was not asked for is null.
struct Findings {
  const GapEstimate* model_free = nullptr;
  const FitSummary* reference = nullptr;
  std::optional<bool> agree;  ///< of the comparison
  Coordinates coordinates;
  double travel = kNaN;  ///< of x1, peak to peak, the largest of the recordings [rad]; NaN: not told
};

/// Which of both numbers to believe. A reading that its own recordings do not bear out in all is good only
/// where a good reference agrees, and none is beside a reference that is rejected. A rejected reference has
/// no say; one that is good goes before a reading that contradicts it, and before one that agrees and is less
/// sharp; one that is limited behind any reading. Where they contradict each other the trust is limited, and
/// that in a gap denied without a model alone: a load far lighter than the motor leaves a weaker impact, and
/// such a reading does not know the load.
Answer answer_of(const Findings& findings);

/// An answer that rests on doubtful recordings: its trust is limited at most, and the first doubt is seen to
/// before anything else.
void put_in_doubt(Answer& answer, const std::vector<Doubt>& doubts);

/// Goes on with these statements, in both lengths and by their codes.
void go_on(Answer& answer, const Told& told, Coordinates coordinates);

/// The gap of the model that a diagnosis has fitted, where that follows the held-out recordings and the
/// fitted ones determine it: good at the floor, limited up to ten of it, nothing beyond.
std::optional<Answer> answer_of_diagnosis(const Diagnosis& diagnosis, Coordinates coordinates);

/// The same beside an estimate that leaves the gap to it: that tells none, reads one without a model while
/// its own fit is rejected, or denies one that the diagnosis has fitted. Where the diagnosis follows the
/// recordings its gap is the answer, with limited trust where the reading is another one; where it does not,
/// and its gap contradicts the denial, the two stand side by side with limited trust. Nothing: the estimate
/// stands.
std::optional<Answer> answer_of_diagnosis(const Diagnosis& diagnosis, const Answer& estimate,
                                          const Findings& beside);

}  // namespace gapscope

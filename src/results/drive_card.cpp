#include "gapscope/results/drive_card.h"

#include <cmath>
#include <filesystem>
#include <optional>

namespace gapscope {
namespace {

/// The gap that the diagnosis tells, where the estimate beside it tells none.
std::optional<Answer> better_than(const Answer* estimate, const DiagnosisResult& diagnosis) {
  if (estimate != nullptr && (estimate->trust != AnswerTrust::kNone || !std::isnan(estimate->gap))) return {};
  return answer_of_diagnosis(diagnosis.diagnosis, diagnosis.coordinates);
}

}  // namespace

Card drive_card(const RunResult* run, const DiagnosisResult* diagnosis) {
  CardFacts facts;
  if (run != nullptr) {
    facts.answer = run->answer ? &*run->answer : nullptr;
    facts.reference = run->reference ? &*run->reference : nullptr;
    facts.coordinates = run->coordinates;
    if (run->answer) facts.tolerance = run->answer->tolerance;
    facts.constant_guessed = run->input && run->input->constant_guessed;
  }
  std::optional<Answer> better;
  if (diagnosis != nullptr) {
    better = better_than(facts.answer, *diagnosis);
    if (better) facts.answer = &*better;
    facts.simulated = diagnosis->simulated ? &*diagnosis->simulated : nullptr;
    facts.diagnosis = &diagnosis->diagnosis;
    facts.coordinates = diagnosis->coordinates;
    facts.constant_guessed = diagnosis->input && diagnosis->input->constant_guessed;
    if (run == nullptr && diagnosis->answer) facts.tolerance = diagnosis->answer->tolerance;
  }
  return card_of(facts);
}

void add_card(const std::string& folder, RunResult& run) {
  if (!run.answer) return;
  std::optional<DiagnosisResult> beside;
  if (std::filesystem::exists(folder + "/diagnosis.json")) beside = read_diagnosis_result(folder);
  run.answer->card = drive_card(&run, beside ? &*beside : nullptr);
}

void add_card(const std::string& folder, DiagnosisResult& diagnosis) {
  std::optional<RunResult> beside;
  if (std::filesystem::exists(folder + "/result.json")) beside = read_run_result(folder);
  Answer answer;
  answer.sentence = "The gap was not estimated.";
  if (beside && beside->answer) answer = *beside->answer;
  if (std::optional<Answer> better = better_than(beside && beside->answer ? &answer : nullptr, diagnosis))
    answer = *better;
  if (diagnosis.answer) answer.tolerance = diagnosis.answer->tolerance;
  diagnosis.answer = answer;
  if (beside && beside->answer) beside->answer->tolerance = answer.tolerance;
  diagnosis.answer->card = drive_card(beside ? &*beside : nullptr, &diagnosis);
}

}  // namespace gapscope

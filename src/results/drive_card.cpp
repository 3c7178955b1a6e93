#include "results/drive_card.h"

#include <filesystem>
#include <optional>

#include "results/carriage.h"

namespace gapscope {
namespace {

/// The gap that the diagnosis tells, where the estimate beside it, if there is one, leaves it to that.
std::optional<Answer> better_than(const RunResult* run, const DiagnosisResult& diagnosis) {
  if (run == nullptr || !run->answer) return answer_of_diagnosis(diagnosis.diagnosis, diagnosis.coordinates);
  Findings found;
  found.model_free = run->model_free ? &*run->model_free : nullptr;
  found.reference = run->reference ? &*run->reference : nullptr;
  found.coordinates = diagnosis.coordinates;
  return answer_of_diagnosis(diagnosis.diagnosis, *run->answer, found);
}

}  // namespace

Card drive_card(const RunResult* run, const DiagnosisResult* diagnosis) {
  CardFacts facts;
  std::optional<InputFacts> input;
  if (run != nullptr) {
    facts.answer = run->answer ? &*run->answer : nullptr;
    facts.reference = run->reference ? &*run->reference : nullptr;
    facts.coordinates = run->coordinates;
    facts.lost_motion = run->model_free && run->model_free->lost_motion.read();
    if (run->answer) facts.tolerance = run->answer->tolerance;
    input = run->input;
  }
  std::optional<Answer> better;
  if (diagnosis != nullptr) {
    better = better_than(run, *diagnosis);
    if (better) facts.answer = &*better;
    facts.simulated = diagnosis->simulated ? &*diagnosis->simulated : nullptr;
    facts.diagnosis = &diagnosis->diagnosis;
    facts.coordinates = diagnosis->coordinates;
    const std::optional<ModelGap>& gap = diagnosis->diagnosis.model_gap;
    facts.carriers = carriers_of(diagnosis->diagnosis.added, gap && gap->origin != GapOrigin::kNone);
    facts.uncarried = carried_by_none(diagnosis->diagnosis.added);
    input = diagnosis->input;
    if (run == nullptr && diagnosis->answer) facts.tolerance = diagnosis->answer->tolerance;
  }
  facts.constant_guessed = input && input->constant_guessed;
  Card card = card_of(facts);
  for (CardText* c : {static_cast<CardText*>(&card), &card.brief})
    for (std::string* line : {&c->gap, &c->mismatch, &c->place, &c->cause, &c->helps, &c->next})
      *line = with_input_unit(*line, input.value_or(InputFacts{}));
  return card;
}

namespace {

void put_card(RunResult& run, const DiagnosisResult* beside) {
  if (run.answer) run.answer->card = drive_card(&run, beside);
}

void put_answer(DiagnosisResult& diagnosis, RunResult* beside) {
  Answer answer;
  go_on(answer, {{"gap.not_estimated.here"}}, {});
  if (beside != nullptr && beside->answer) answer = *beside->answer;
  if (std::optional<Answer> better = better_than(beside, diagnosis)) answer = *better;
  if (diagnosis.answer) answer.tolerance = diagnosis.answer->tolerance;
  diagnosis.answer = answer;
  if (beside != nullptr && beside->answer) beside->answer->tolerance = answer.tolerance;
  diagnosis.answer->card = drive_card(beside, &diagnosis);
}

}  // namespace

void add_card(RunResult& run) { put_card(run, nullptr); }
void add_card(DiagnosisResult& diagnosis) { put_answer(diagnosis, nullptr); }

void add_card(const std::string& folder, RunResult& run) {
  std::optional<DiagnosisResult> beside;
  if (run.answer && std::filesystem::exists(folder + "/diagnosis.json"))
    beside = read_diagnosis_result(folder);
  put_card(run, beside ? &*beside : nullptr);
}

void add_card(const std::string& folder, DiagnosisResult& diagnosis) {
  std::optional<RunResult> beside;
  if (std::filesystem::exists(folder + "/result.json")) beside = read_run_result(folder);
  put_answer(diagnosis, beside ? &*beside : nullptr);
}

}  // namespace gapscope

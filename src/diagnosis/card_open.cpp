#include "diagnosis/card_open.h"

#include <fmt/format.h>

#include "diagnosis/card_words.h"
#include "diagnosis/rule.h"
#include "diagnosis/verdict.h"
#include "gapscope/base/text.h"
#include "gapscope/diagnosis/diagnosis.h"

namespace gapscope::internal::diagnosis {

std::string undetermined_words(const Diagnosis& d) {
  std::vector<std::string> names;
  std::size_t open = 0;
  for (const AddedEffect& a : d.added) {
    if (a.established) continue;
    ++open;
    if (may_be_absent(a, d)) names.push_back(readable(a.effect));
  }
  if (names.empty()) return "";
  const std::string what = names.size() < open ? enumerated(names) + " there is"
                                               : std::string("there is of ") + (open > 1 ? "them" : "it");
  return "these recordings do not determine how much " + what;
}

const BudgetRung* unestablished_rung(const Diagnosis& d) {
  if (d.verdict != DiagnosisVerdict::kUnknown || d.budget.rungs.empty()) return nullptr;
  const BudgetRung& first = d.budget.rungs.front();
  return first.share > kTelling.rival_share ? &first : nullptr;
}

std::string unknown_words(const CardFacts& f) {
  const Diagnosis& d = *f.diagnosis;
  const BudgetRung* rung = unestablished_rung(d);
  if (rung == nullptr) return "unknown: no effect of the catalogue explains it";
  const SharedUnit torque(rung->before, f.coordinates.shown_unit("N m"));
  return fmt::format("unknown: in the error budget {} brings the missing {} down from {} to {}, but {}",
                     readable(rung->effect.empty() ? rung->law : rung->effect), f.coordinates.torque_word(),
                     torque.number(rung->before), torque(rung->after),
                     d.better_swapped
                         ? "the recording that was fitted moves too little to establish a cause"
                         : "no model with it follows the recordings well enough to establish it") +
         (input_is_made(d) ? std::string("; the ") + f.coordinates.torque_word() +
                                 " here is what the model's controller makes of the goal: with the recorded "
                                 "input the same effect may be established"
                           : "");
}

bool input_is_made(const Diagnosis& d) { return !d.traces.empty() && !d.traces.front().target.empty(); }

std::string step_to_establish(const Diagnosis& d) {
  return input_is_made(d)
             ? "Record the motor's input as well (duty, current or torque) and diagnose by that: made of the "
               "goal "
               "by a controller's numbers, it takes up a part of what the model lacks."
             : "Record the drive in another motion (other speeds, other loads) and diagnose that.";
}

std::string exhausted_words(const Diagnosis& d) {
  const bool at_floor = d.mismatch.remains < kRule.floor_ratio;
  if (!d.exhausted || d.stopped || at_floor || d.verdict == DiagnosisVerdict::kNone) return "";
  return std::string(" The search ended at its limit of work, so that further causes may have been missed") +
         (d.added.empty() ? "."
                          : "; a diagnosis goes on from here with the `model:` of `fitted.yaml` in the place "
                            "of the configuration's (and its `anchor:`).");
}

}  // namespace gapscope::internal::diagnosis

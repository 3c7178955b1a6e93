#pragma once

#include <string>
#include <vector>

#include "gapscope/diagnosis/card.h"
#include "gapscope/diagnosis/error_budget.h"

/// What a card says of causes that are not told.
namespace gapscope::internal::diagnosis {

/// Why the cause of what was added is open: "it may as well be actuator lag"; empty: no condition of its own
/// says it.
std::string why_open(const AddedEffect& added, const Diagnosis& diagnosis);

/// "these recordings cannot tell which" of a group is the cause, or that none could.
std::string which_is_open(const std::vector<std::string>& group, const Diagnosis& diagnosis);

/// " A cause has to remove at least 20 %.", where one of these is that an effect removes less; else empty.
std::string least_of_a_cause(const std::vector<std::string>& why);

/// Of the verdict "unknown": "unknown, as no effect of the catalogue explains it", or that one takes much of
/// it in the error budget and is not established.
std::string unknown_words(const CardFacts& facts);

/// The first law of the error budget, where that alone takes most of a mismatch of which nothing is
/// established; nullptr: there is none.
const BudgetRung* unestablished_rung(const Diagnosis& diagnosis);

/// "the recordings", or "the recording's parts" where what is held out is the end of what was fitted: what
/// one set of numbers leaves that one for each would not.
const char* what_disagrees(const Diagnosis& diagnosis);

/// Whether the input was not recorded: the model's controller makes it of the goal.
bool input_is_made(const Diagnosis& diagnosis);

/// "input", or "model's controller": what applies the torque that sizes are a share of.
const char* what_applies(const Diagnosis& diagnosis);

/// The step where dampings or frictions are held at what nobody has measured: it takes no new recording.
std::string step_to_estimate(const Diagnosis& diagnosis);

/// The step where the recordings show a mismatch and establish nothing, and the other way round is no better.
std::string step_to_establish(const CardFacts& facts, const Card& card);

/// The step where the gap that was fitted is not told, though the model lacked what was found: it takes no
/// new recording. Empty: there is no such gap.
std::string step_to_the_gap(const CardFacts& facts);

/// " The search ended at its limit of work: ..." where that may have left something unfound; else empty.
std::string exhausted_words(const Diagnosis& diagnosis);

/// Whether these are two names of one law in a single body: a constant torque, and dry friction that differs
/// with the direction.
bool are_one_law(const std::vector<std::string>& group, const Diagnosis& diagnosis);

/// The step from what was found where the search ended at its limit of work; empty: it did not.
std::string step_onwards(const Diagnosis& diagnosis);

/// What remains once all that was added is in the model, where that is most of it or far above the floor;
/// empty: it is neither, or the budget has no size of something that was added.
std::string unexplained(const CardFacts& facts, const Card& card);

/// Whether the model drifts about three times as far with what was added, from a recording simulated as a
/// whole: small errors of the right numbers add up to less.
bool drifts_farther(const Diagnosis& diagnosis);

/// What the recordings cannot tell from an effect, but for what was added as well, in words.
std::vector<std::string> others_of(const AddedEffect& added, const Diagnosis& diagnosis);

/// Whether the floor of a budget is that the drive does not repeat, clearly more than the encoder's noise.
bool is_of_the_drive(const ErrorBudget& budget);

/// What another recording is to have: "both directions, other speeds, other loads", where one way was
/// recorded.
std::string other_motion(const Diagnosis& diagnosis);

/// The step where what was added takes torque and brings the simulated motion no nearer.
std::string no_nearer(const Diagnosis& diagnosis);

/// The step to the same recordings the other way round.
inline constexpr const char* kSwapStep =
    "Swap `file` and `held_out` and diagnose again: the recording that is held out now moves more, and tells "
    "more where it is fitted.";

}  // namespace gapscope::internal::diagnosis

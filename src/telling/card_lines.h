#pragma once

#include <optional>
#include <string>

#include "gapscope/diagnosis/diagnosis.h"
#include "gapscope/telling/card.h"
#include "gapscope/telling/statement.h"

/// The lines of a card that a diagnosis fills, and what they share.
namespace gapscope::internal::telling {

/// How sure established causes are.
enum class CauseDoubt {
  kNone,
  kRival,       ///< something else explains the recordings nearly as well
  kByBalance,   ///< the torque balance alone tells it, the motion cannot
  kRecordings,  ///< the motion of another recording may not show it
};
CauseDoubt doubt_of(const Diagnosis& diagnosis);

/// Whether the first cause is open and a later one established: that one holds with the first in the model.
bool rests_on_open_cause(const Diagnosis& diagnosis);

/// The first law of the error budget, where that alone takes most of a mismatch of which nothing is
/// established; nullptr: there is none.
const BudgetRung* suspected_rung(const Diagnosis& diagnosis);

/// Whether these are two names of one law in a single body: a constant torque, and dry friction that differs
/// with the direction.
bool are_one_law(const std::vector<std::string>& group, const Diagnosis& diagnosis);

/// Whether the search ended at its limit of work and may have left something unfound.
bool ended_early(const Diagnosis& diagnosis);

/// What the card says of the user's simulator; empty where there is none.
Told simulator_of(const CardFacts& facts);
std::size_t differing_rows(const SimulatorComparison* comparison);

/// Whether the input was not recorded: the model's controller makes it of the goal.
bool input_is_made(const Diagnosis& diagnosis);
Fact source_word(const Diagnosis& diagnosis);  ///< "input applies": what the torque is a share of
Fact judged_word(const Diagnosis& diagnosis);  ///< "free run" or "prediction"
Fact error_word(const Diagnosis& diagnosis);   ///< "free-run error" or "prediction error"
Fact added_names(const Diagnosis& diagnosis);  ///< names of what was added
/// What one set of numbers leaves that one for each would not.
Fact parts_word(const Diagnosis& diagnosis);
Fact encoder_word(const Diagnosis& diagnosis);       ///< "x1" or "x2"
Fact floor_of_the_motion(const MismatchSize& size);  ///< "the encoder's noise"

Told cause_of(const CardFacts& facts);
Told error_of(const CardFacts& facts, const Card& card);
Told helps_of(const CardFacts& facts, const Card& card);
Told next_of(const CardFacts& facts, const Card& card);

/// Whether the model drifts about three times as far with what was added, from a recording simulated as a
/// whole: small errors of the right numbers add up to less.
bool drifts_farther(const Diagnosis& diagnosis);

/// Whether the floor of a budget is that the drive does not repeat, clearly more than the encoder's noise.
bool is_of_the_drive(const ErrorBudget& budget);
/// Whether the size in torque tells what is left: of windows that rest in their median it is none.
bool tells_torque(const Card& card);

}  // namespace gapscope::internal::telling

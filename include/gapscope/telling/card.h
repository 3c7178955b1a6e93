#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "gapscope/base/coordinates.h"
#include "gapscope/base/fields.h"
#include "gapscope/base/statistics.h"
#include "gapscope/telling/statement.h"

namespace gapscope {

struct AddedEffect;
struct Answer;
struct Diagnosis;
struct FitSummary;
struct NextExperiment;
struct Rival;
struct SimulatorComparison;

/// `tolerance:` – what the user calls good enough. What is absent is not judged.
struct Tolerance {
  std::optional<double> torque_percent;  ///< rms of the missing torque [% of what the input applies]
  std::optional<double> gap;             ///< backlash gap 2β [rad]

  bool stated() const { return torque_percent || gap; }
  void fields(FieldVisitor& visitor);
};

/// One line of the card: "model error", what is to be said of it, and the same with numbers and reasons.
struct CardLine {
  const char* name;
  const std::string& brief;
  const std::string& text;
};

struct CardText {
  std::string gap;       ///< the gap, and whether to believe it
  std::string mismatch;  ///< between model and drive, in torque and per cent of the input's
  std::string place;     ///< where it is
  std::string cause;     ///< what it comes from, and how sure that is
  std::string helps;     ///< what takes how much of it
  std::string next;      ///< the next step
};

/// The codes of what each line says: these do not change with its wording.
struct CardCodes {
  std::vector<std::string> gap, mismatch, place, cause, helps, next;
};

/// What everybody wants to know of a drive, in six lines: brief, as terminal and report begin with it, and
/// with numbers, reasons and limits. A default-built one has nothing to say.
struct Card : CardText {
  CardText brief;
  CardCodes codes;
  /// Rms of the missing torque of the model as it is, held-out [N m]; of the balance alone where the motion
  /// tells what helps
  double torque = kNaN;
  double percent = kNaN;            ///< the same, of what the input applies [%]
  double torque_after = kNaN;       ///< with all that helps [N m]
  double percent_after = kNaN;      ///< the same [%]
  std::optional<bool> good_enough;  ///< by the tolerance; nothing: none is stated, or it cannot be told
  bool diagnosed = false;  ///< place, cause and what helps are known; else all three say alike who tells them

  std::array<CardLine, 6> lines() const;
  bool asks(const std::string& code) const;  ///< for this next step
};

/// What a card is made of. What was not asked for is null, and the card says how to get it.
struct CardFacts {
  const Answer* answer = nullptr;
  const FitSummary* reference = nullptr;
  const Diagnosis* diagnosis = nullptr;
  const SimulatorComparison* simulated = nullptr;  ///< the user's simulator, where its answer was given
  Coordinates coordinates;
  Tolerance tolerance;
  /// Formats of `export` that have the drive and all that was added exactly; nothing: not known
  std::optional<std::vector<std::string>> carriers;
  std::vector<std::string> uncarried;  ///< what was added and no format has exactly
  bool lost_motion = false;            ///< that of the loop is read: measured, whatever it means
  bool constant_guessed = false;       ///< torque_constant is a guess, and the torques rest on it
};

Card card_of(const CardFacts& facts);

/// How much there is of an effect that a diagnosis has added: "every 2.5 mm; amplitude 988 mN, 95 %: 507 to
/// 1468". Empty where it has no numbers.
std::string amount_words(const AddedEffect& added, const Diagnosis& diagnosis, Coordinates coordinates);

/// The verdict, and how far it goes: "effect (missing in the model: likely, not confirmed)".
std::string verdict_words(const Diagnosis& diagnosis, Coordinates coordinates);

/// What explains the recordings nearly as well as an established first cause: the next experiment is to tell
/// the two apart. Empty where nothing does.
std::string rival_of_first(const Diagnosis& diagnosis);

/// What to record next, where the recordings do not decide between rivals.
/// @param takes_goals  the drive's controller makes the input: other goals are all that one can ask for
Told experiment_of(const NextExperiment& next, std::span<const Rival> rivals, bool takes_goals);

/// Puts a diagnosis into words: its sentence, and where the mismatch is.
void put_into_words(Diagnosis& diagnosis, Coordinates coordinates);
/// The same of a comparison with a simulator, and of its rows.
void put_into_words(SimulatorComparison& comparison, Coordinates coordinates);

}  // namespace gapscope

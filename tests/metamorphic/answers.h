#pragma once

#include <map>
#include <string>

#include "gapscope/inspection/inspection.h"
#include "metamorphic/told_drive.h"
#include "telling/answer.h"

namespace gapscope::metamorphic {

enum class Command { kDetect, kRun, kDiagnose };

const char* to_string(Command command);  ///< "detect", "run", "diagnose"

/// A number of an answer in units of the base, with its interval where it has one.
struct Number {
  double value = kNaN;
  Interval ci95;
};

/// What a command says of a drive.
struct Answers {
  std::string refusal;                       ///< why the drive was not taken; empty: it was
  std::map<std::string, Severity> findings;  ///< of `check`, by rule
  std::map<std::string, std::string> words;  ///< verdicts and trusts, by what they are of
  std::map<std::string, Number> numbers;
  double time_scale = 1.0;  ///< of the drive
  AnswerTrust trust = AnswerTrust::kNone;
  Number gap;  ///< of the answer
};

/// Writes the drive into a folder of its own, reads it as the command does and asks the command.
Answers ask(Command command, const ToldDrive& drive);

}  // namespace gapscope::metamorphic

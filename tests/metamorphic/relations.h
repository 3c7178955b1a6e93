#pragma once

#include <span>
#include <string>

#include "metamorphic/answers.h"
#include "metamorphic/bases.h"

namespace gapscope::metamorphic {

/// What must hold of an answer, beside that of the base.
enum class Holds {
  kEqual,    ///< the same words and findings, the same numbers
  kWithin,   ///< the same verdict, and the gap within what both intervals allow
  kTold,     ///< a gap of good trust is the drive's own: its interval holds the truth
  kRefused,  ///< no answer
};

struct Expected {
  Holds holds = Holds::kEqual;
  double tolerance = 0.0;  ///< of numbers that are equal, relative
  double width = 0.0;      ///< of their intervals, in half widths
  bool same_first = true;  ///< `check`, which looks at the first recording, looks at the same one
};

constexpr Expected equal(double tolerance = 1e-8, double width = 1e-3) {
  return {Holds::kEqual, tolerance, width};
}
/// The same of recordings in another order.
constexpr Expected equal_but_first(double tolerance = 1e-8) {
  return {Holds::kEqual, tolerance, 1e-3, false};
}
constexpr Expected kWithin{Holds::kWithin}, kTold{Holds::kTold}, kRefused{Holds::kRefused};

using Change = void (*)(ToldDrive& drive);

/// Of whom a command is asked, and what must then hold.
struct Asked {
  const char* bases = "";  ///< by their letters
  Expected expected = {};
};

/// One way to tell the same drive otherwise, and what each command must then say.
struct Relation {
  const char* name;
  Change change;
  Asked detect, run, diagnose = {};
  bool not_fresh = false;   ///< `check` must say that positions are not read anew for every row
  Change before = nullptr;  ///< to be compared with; null: with the base as it is

  const Asked& asked(Command command) const {
    return command == Command::kDetect ? detect : command == Command::kRun ? run : diagnose;
  }
};

std::span<const Relation> relations();

}  // namespace gapscope::metamorphic

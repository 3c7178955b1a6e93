#pragma once

#include <string>
#include <vector>

#include "gapscope/base/statistics.h"

namespace gapscope::test {

/// What came of one case: one line of a study, written and read by columns.
struct StudyRow {
  unsigned long seed = 0;
  std::string rig, effect, excitations;
  double severity = 0.0;
  std::string verdict;        ///< none, effect, helps or unknown
  std::string first = "-";    ///< of the ranking
  bool in_group = false;      ///< the truth is the first or in its group
  int group = 0;              ///< its size
  double before = kNaN;       ///< larger median of the nominal model fitted to its recordings alone [floor]
  double shrink = kNaN;       ///< of the first candidate
  std::string removed = "-";  ///< verdict without the truth and its look-alikes
  std::string place = "-";    ///< yes, no: the headline names the place; -: nothing was named
  std::string blind_place = "-";  ///< the same of a headline that is not told the effect
  std::string covered = "-";      ///< yes, no: the next recording's shrink is in the interval; -: it has none
  double probability = kNaN;
  double seconds = kNaN;  ///< of processor time
  std::string details;    ///< for the reader

  bool named() const { return verdict == "effect" && in_group; }
  bool wrong() const { return verdict == "effect" && !in_group; }
  bool relevant() const { return before > 2.0; }
};

std::string line_of(const StudyRow& row);

/// Rows of a stored study, in the order of their seeds; lines that are no rows are skipped.
std::vector<StudyRow> read_rows(const std::string& file);

/// Counts with Wilson limits.
void print_known(const std::vector<StudyRow>& rows);
void print_none(const std::vector<StudyRow>& rows);
void print_outside(const std::vector<StudyRow>& rows);
void print_steps(const std::vector<StudyRow>& rows);      ///< columns: see examine_steps()
void print_questions(const std::vector<StudyRow>& rows);  ///< columns: see examine_question()

}  // namespace gapscope::test

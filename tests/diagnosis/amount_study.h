#pragma once

#include "blind/blind_pair.h"
#include "diagnosis/study_row.h"
#include "gapscope/diagnosis/diagnosis.h"

namespace gapscope::test {

/// A number of an effect that was drawn and is named: what the drive has, and what the diagnosis tells.
struct ToldNumber {
  std::string key;
  double drawn = kNaN;
  double told = kNaN;
  Interval ci95;  ///< NaN where none is told

  bool has_interval() const;
  /// A phase also where it is turned by whole turns.
  bool holds() const;
  /// Error over the standard error that the interval stands for [-]; NaN without one.
  double deviation() const;
};

/// Of the drawn effects that the diagnosis has established, their numbers in order: "{KEY DRAWN TOLD LOW
/// HIGH}"; none of a law of another form.
std::string told_numbers_in_words(const std::vector<blind::DrawnLaw>& drawn, const Diagnosis& d);

/// Read back from the details of a row; the amount first.
std::vector<ToldNumber> told_numbers(const StudyRow& row);

/// How often the 95 % interval of an amount, the first number of an effect, holds what was drawn.
struct AmountCount {
  int held = 0, all = 0;
  double squares = 0.0;  ///< of the deviations
  void add(const ToldNumber& n);
};

/// The model with the effect that the drive has, fitted to what a diagnosis fits from the numbers that were
/// drawn, and the intervals that a diagnosis tells of it: what comes once the right effect is named, without
/// the search.
///   verdict  "effect" where that explains the recording, else "unknown"    before  rms that is left [floor]
///   covered  "beside" where a fit from the numbers of the drive leaves less, else "best"
StudyRow examine_amount(const blind::BlindPair& pair, std::uint64_t seed);

/// Drive by drive what was drawn and what is told; then how many intervals hold, by effect and for all, with
/// Wilson limits. Effects whose law has another form by construction are named and left out: their amount is
/// another quantity.
void print_amounts(const std::vector<StudyRow>& rows);

}  // namespace gapscope::test

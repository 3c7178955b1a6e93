#pragma once

#include "diagnosis/study.h"

namespace gapscope::internal::diagnosis {

/// An effect at usual numbers, of which only the size varies: at its first start, a line at the middle of its
/// periods, a phase of zero. One that contains an effect of the model takes that one's level over.
class ExemplaryEffect {
 public:
  /// @param like recordings that its scales are taken from
  ExemplaryEffect(const Study& study, const ReferenceModel& model, const EffectEntry& entry);

  const EffectEntry& entry() const { return entry_; }
  std::size_t size_at() const { return inherits_ ? 1 : 0; }  ///< place of the parameter that is its size

  /// @param size in what it begins with; 0: the effect is absent
  std::vector<double> values(double size) const;
  /// The model with it.  @param quarter of the phase, for one that has such
  ReferenceModel in_model(double size, bool quarter = false) const;
  bool has_phase() const;
  /// Whether it is a ratio of a simpler effect that the model does not have.
  bool lacks_its_level() const;
  /// Whether so much is within the bounds of the catalogue.
  bool is_possible(double size) const;

 private:
  std::vector<double> written(double size) const;

  const ReferenceModel& model_;
  const EffectEntry& entry_;
  ShaftTurns turns_;
  bool inherits_ = false;
  std::vector<double> start_, absent_;
  std::vector<Interval> bounds_;
};

}  // namespace gapscope::internal::diagnosis

#pragma once

#include <span>
#include <vector>

#include "diagnosis/effect_starts.h"
#include "diagnosis/fitted_model.h"
#include "diagnosis/numbers.h"

namespace gapscope::internal::diagnosis {

/// Where an effect that was added to a fitted model begins: from every base and every start of the effect the
/// numbers are adjusted with the base's derivatives, by plain runs alone, and the best go on to be refined.
class Race {
 public:
  /// @param fit of the fitted model with the effect as its last
  /// @param nominal the fitted model without it
  Race(const reference::ModelFit& fit, const FittedModel& nominal,
       std::span<const reference::FitLinearisation> bases, const SearchEffort& effort);

  /// A start from every base.
  void enter(const EffectStart& start);
  /// The sine that each base's residuals ask for.
  void enter_sines(const EffectStart& typical);
  /// A start on the drive of a fitted model whose last effect this one contains, and a weaker one, which is
  /// nearly that model itself.
  void enter_on(const FittedModel& parent, const EffectStart& start);
  /// A weaker start from the first base where the last one entered leaves more than the model without the
  /// effect: one far smaller than the start only hurts there.
  /// @param i the parameter that is made weaker
  void weaken(const EffectStart& start, std::size_t i);

  /// What the best leaves after the race alone [floor²]; infinite without anything that has entered.
  double least() const { return best().residual_mean_square; }
  /// The best as it stands; infinite without anything that has entered.
  reference::RefinedFit leader() const;
  /// The best refined, the more the more it promises, and the best from another base where that does not
  /// explain all. Infinite without anything that has entered.
  /// @param thorough false: only as far as tells whether it is worth a whole refinement
  reference::RefinedFit refined(bool thorough) const;

 private:
  const EffectEntry& entry() const { return *fit_.model().effects.back().entry; }
  Interval bounds(std::size_t i) const;
  std::vector<double> physical(const EffectStart& start) const;
  double weaker(std::size_t i, double value) const;
  /// @param origin the base that it set out from; their number: none
  void take(reference::AdjustedFit entrant, std::size_t origin);
  const reference::AdjustedFit& best() const;
  reference::RefinedFit follow(const reference::AdjustedFit& from, bool thorough) const;
  void run_from(const std::vector<double>& effect, const reference::FitLinearisation& base);
  void run_on(const FittedModel& parent, std::vector<double> effect);

  const reference::ModelFit& fit_;
  const FittedModel& nominal_;
  std::span<const reference::FitLinearisation> bases_;
  const SearchEffort& effort_;
  std::vector<reference::AdjustedFit> best_;  ///< from each base, and from elsewhere
  reference::AdjustedFit last_;
};

}  // namespace gapscope::internal::diagnosis

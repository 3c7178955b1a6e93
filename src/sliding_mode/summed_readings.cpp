#include "sliding_mode/summed_readings.h"

#include <algorithm>
#include <utility>

#include "sliding_mode/verdict.h"
#include "sliding_mode/words.h"

namespace gapscope::internal::sliding_mode {
namespace {

struct SummedReading {
  std::vector<ImpactAnalysis> analyses;
  std::vector<double> intervals;  ///< [s]
  GapEstimate estimate;           ///< not run where no recording could be summed

  void add(ImpactAnalysis analysis, double interval) {
    analyses.push_back(std::move(analysis));
    intervals.push_back(interval);
  }
  void decide(const Remark& said) {
    if (analyses.empty()) return;
    estimate = decide_gap(analyses, intervals);
    estimate.reason += said;
  }
};

SummedReading of_mean_periods(std::span<const MotorTrace> recordings) {
  SummedReading reading;
  for (const MotorTrace& recording : recordings) {
    const signals::FoldedMotion folded = signals::fold(recording);
    if (folded.periods != 0) reading.add(analyse_mean(folded, recording), folded.dt);
  }
  reading.decide(words::mean_of_periods());
  return reading;
}

SummedReading of_block_means(std::span<const MotorTrace> recordings,
                             std::span<const signals::SignalFacts> facts,
                             std::span<const signals::BlockMeans> means) {
  SummedReading reading;
  for (std::size_t i = 0; i < means.size(); ++i)
    if (means[i].width != 0)
      reading.add(analyse_means(means[i], recordings[i], facts[i].quantum), means[i].dt);
  if (!means.empty()) reading.decide(words::means_of_samples(static_cast<long>(means.front().width)));
  return reading;
}

/// The mean period again, of means of samples.
SummedReading of_both(std::span<const MotorTrace> recordings, std::span<const signals::SignalFacts> facts,
                      std::span<const signals::BlockMeans> means) {
  SummedReading reading;
  for (std::size_t i = 0; i < means.size(); ++i) {
    if (means[i].width == 0) continue;
    signals::FoldedMotion folded = signals::fold(means[i].trace(recordings[i].file));
    if (folded.periods == 0) continue;
    folded.quantum = facts[i].quantum;
    folded.rounding = std::max(folded.rounding, means[i].rounding);
    reading.add(analyse_mean(folded, recordings[i]), folded.dt);
  }
  if (!means.empty())
    reading.decide(words::means_of_samples(static_cast<long>(means.front().width)) +
                   words::mean_of_periods());
  return reading;
}

}  // namespace

void read_sums(std::span<const MotorTrace> recordings, std::span<const signals::SignalFacts> facts,
               std::vector<ImpactAnalysis>& analyses, GapEstimate& estimate) {
  const auto take = [&](SummedReading reading, bool with_none) {
    const GapVerdict verdict = reading.estimate.verdict;
    const bool none = with_none && verdict == GapVerdict::kNone && estimate.verdict != GapVerdict::kNone;
    if (verdict != GapVerdict::kBacklash && !none) return false;
    estimate = std::move(reading.estimate);
    analyses = std::move(reading.analyses);
    return verdict == GapVerdict::kBacklash;
  };
  if (take(of_mean_periods(recordings), true)) return;
  std::vector<signals::BlockMeans> means;
  for (std::size_t i = 0; i < recordings.size(); ++i)
    means.push_back(signals::block_means(recordings[i], facts[i]));
  if (take(of_block_means(recordings, facts, means), false)) return;
  take(of_both(recordings, facts, means), false);
}

}  // namespace gapscope::internal::sliding_mode

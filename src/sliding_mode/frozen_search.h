#pragma once

#include <cstddef>
#include <deque>
#include <string>
#include <vector>

#include "sliding_mode/bound_bank.h"
#include "sliding_mode/impact_search.h"

namespace gapscope::internal::sliding_mode {

/// Counts turns of a motion that may wander: y has come back from its last extreme by more than a threshold.
class TurnCounter {
 public:
  explicit TurnCounter(double threshold = kInfinity) : threshold_(threshold) {}
  void step(double y) noexcept;
  std::size_t count() const { return count_; }

 private:
  double threshold_, low_ = kInfinity, high_ = -kInfinity;
  int side_ = 0;
  std::size_t count_ = 0;
};

/// What the first two periods taught. Nothing of it changes afterwards.
struct FrozenFacts {
  signals::SignalFacts facts;
  std::vector<double> bounds, floor, quiet;
  std::vector<double> visible;  ///< smallest gap that would show above each bound, one beyond the last [rad]
  double one_body = kInfinity;  ///< smallest gap that cannot hide in what one body leaves [rad]
  std::size_t sliding = 0;      ///< index of L_acc
  double least = 0.0;           ///< bound that a main event reaches [rad/s²]
  std::size_t samples = 0;      ///< that it was learnt from
};

/// The impact method (S1–S6, impact_search.h) on samples as they come, in memory that does not grow. Facts,
/// bounds, floors and thresholds are learnt from the first kFewestHalfPeriods half periods; the bank then
/// runs on, and every quarter of a half period the passages whose impact lies in it are read from a window
/// around it: two half periods before, half a one after. A passage is thus complete at most three quarters of
/// a half period after its impact. What comes out does not depend on the pieces in which samples go in.
class FrozenSearch {
 public:
  /// @param most_kept  passages that summary() judges: the last so many
  FrozenSearch(std::string file, double start, double dt, double quantum, std::size_t most_kept);

  void push(double u, double x1);
  void finish();  ///< reads what is left, with what there is after it

  bool has_learnt() const { return frozen_.samples > 0; }
  const FrozenFacts& frozen() const { return frozen_; }
  /// Why nothing can be learnt from what came so far; empty once something was.
  const Remark& defect() const { return frozen_.facts.defect; }
  std::size_t samples() const { return offset_ + x1_.size(); }
  std::size_t passages() const { return passages_; }
  std::size_t held() const { return x1_.size(); }  ///< samples in the window

  /// Passages read since the last call.
  std::vector<Passage> take();

  /// As analyse() would tell it, of the passages that are kept.
  ImpactAnalysis summary() const;

 private:
  struct KeptPassage {
    Passage passage;
    std::size_t half_periods, marks;  ///< before it
  };

  bool try_to_learn();
  void learn(const signals::SignalFacts& facts, const MotorTrace& trace);
  void go_on(double u, double x1);
  void read_core(std::size_t end);
  void keep(Passage passage, std::size_t mark);
  MotorTrace window() const;
  std::size_t half_periods() const { return turns_.count() > 0 ? turns_.count() - 1 : 0; }

  std::string file_;
  double start_, dt_, quantum_;
  std::size_t most_kept_;
  FrozenFacts frozen_;
  std::vector<BoundBank> bank_;  ///< one, once there are bounds
  TurnCounter turns_;

  std::vector<double> u_, x1_;                    ///< the window; all samples until something was learnt
  BankErrors run_;                                ///< the same of its errors
  std::size_t offset_ = 0;                        ///< of its first sample in the recording
  std::size_t core_ = 0;                          ///< first sample whose impacts were not read yet
  std::size_t hop_ = 0, before_ = 0, after_ = 0;  ///< [samples]
  std::size_t next_try_ = 0;
  bool gave_up_ = false;

  std::size_t last_impact_ = 0, marks_ = 0, passages_ = 0;
  std::size_t half_periods_gone_ = 0, marks_gone_ = 0;  ///< before the first passage that is kept
  std::vector<std::size_t> tops_;                       ///< of the main events, by bound
  std::deque<KeptPassage> kept_;
  std::vector<Passage> fresh_;
};

}  // namespace gapscope::internal::sliding_mode

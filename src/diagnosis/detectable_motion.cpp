#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "diagnosis/detectable.h"
#include "diagnosis/exemplary_effect.h"
#include "diagnosis/held_out_change.h"
#include "gapscope/base/parallel.h"
#include "gapscope/base/text.h"

namespace gapscope::internal::diagnosis {
namespace {

constexpr double kCoarse = 4.0;  ///< between sizes that are tried first
constexpr int kCoarseTrials = 4, kFineTrials = 2;

/// A candidate as a direction in which it changes the errors, beyond the model's numbers.
struct Probe {
  const EffectEntry* entry = nullptr;
  std::vector<HeldOutErrors> changes;  ///< one, or two quarters of a phase
};

struct Verdict {
  bool named = false;
  const EffectEntry* hidden_by = nullptr;
  bool said_by_model = false;
};

class Contestants {
 public:
  Contestants(const Study& study, const ReferenceModel& model, const std::vector<const EffectEntry*>& asked)
      : study_(study), beside_(study, model) {
    if (!beside_.usable()) return;
    for (const EffectEntry* entry : asked)
      if (!reads_counts(*entry)) effects_.emplace_back(study, model, *entry);
    probes_.resize(effects_.size());
    parallel_for(effects_.size(), study.options.threads,
                 [&](std::size_t i) { probes_[i] = probe(effects_[i]); });
  }

  const std::vector<ExemplaryEffect>& effects() const { return effects_; }
  DetectableEffect told(const ExemplaryEffect& effect) const;

 private:
  Probe probe(const ExemplaryEffect& effect) const {
    Probe p{&effect.entry(), {}};
    for (const bool quarter : {false, true}) {
      if (quarter && !effect.has_phase()) break;
      const HeldOutErrors change = beside_.by(effect.in_model(kProbed, quarter));
      if (change.exist()) p.changes.push_back(beside_.beyond_numbers(change));
    }
    return p;
  }

  /// What is left of a change where a rival takes its best part.
  HeldOutErrors without(const HeldOutErrors& change, const Probe& rival) const {
    Eigen::MatrixXd columns(change.innovation.size(), std::ssize(rival.changes));
    for (Eigen::Index c = 0; c < columns.cols(); ++c)
      columns.col(c) = rival.changes[static_cast<std::size_t>(c)].innovation;
    const Eigen::VectorXd size = least_squares(columns, change.innovation);
    HeldOutErrors left = change;
    for (Eigen::Index c = 0; c < columns.cols(); ++c) {
      if (columns.cols() == 1 && size[c] < 0.0 && rival.entry->parameters.front().low >= 0.0) continue;
      left.innovation -= size[c] * rival.changes[static_cast<std::size_t>(c)].innovation;
      left.free -= size[c] * rival.changes[static_cast<std::size_t>(c)].free;
    }
    return left;
  }

  Verdict verdict(const ExemplaryEffect& effect, double size) const;
  Verdict least(const ExemplaryEffect& effect, double& size) const;

  static constexpr double kProbed = 0.1;  ///< size of a probe: small, as it stands for all smaller ones
  const Study& study_;
  HeldOutChange beside_;
  std::vector<ExemplaryEffect> effects_;
  std::vector<Probe> probes_;
};

/// The recordings as so much of the effect would have changed them: the model errs by as much more, but for
/// what its own numbers say of that.
Verdict Contestants::verdict(const ExemplaryEffect& effect, double size) const {
  const HeldOutErrors change = beside_.by(effect.in_model(size));
  if (!change.exist()) return {};
  HeldOutErrors left = beside_.beyond_numbers(change);
  const double absorbed = 1.0 - left.innovation.squaredNorm() / change.innovation.squaredNorm();
  left.innovation = -left.innovation, left.free = -left.free;
  const ScoredModel before = beside_.scored_with(nullptr, left);
  const bool model_says = absorbed > torque_view::TorqueViewOptions{}.most_absorbed;
  if (!study_.repeats_badly() && at_floor(before)) return {false, nullptr, model_says};
  std::vector<ScoredModel> ranked{beside_.scored_with(&effect.entry(), beside_.nothing())};
  for (const Probe& rival : probes_)
    if (rival.entry != &effect.entry() && !rival.changes.empty())
      ranked.push_back(beside_.scored_with(rival.entry, without(left, rival)));
  rank(ranked);
  const Decision decision = decide_alone(ranked, before, study_.reach(), {});
  if (ranked.front().entry != &effect.entry()) return {false, ranked.front().entry, model_says};
  return {decision.accepted, decision.accepted || ranked.size() < 2 ? nullptr : ranked[1].entry, model_says};
}

/// By factors first, then between the last two.
Verdict Contestants::least(const ExemplaryEffect& effect, double& size) const {
  Verdict at = verdict(effect, size = 1.0), next;
  const bool smaller = at.named;
  int trials = 1;
  for (; trials < kCoarseTrials + 1; ++trials) {
    const double other = smaller ? size / kCoarse : size * kCoarse;
    if (!effect.is_possible(other)) break;
    next = verdict(effect, other);
    if (smaller && !next.named) break;
    size = other, at = next;
    if (!smaller && next.named) break;
  }
  if (!at.named) return at;
  double below = size / kCoarse;
  for (int i = 0; i < kFineTrials; ++i) {
    const double between = std::sqrt(below * size);
    (verdict(effect, between).named ? size : below) = between;
  }
  return at;
}

DetectableEffect Contestants::told(const ExemplaryEffect& effect) const {
  const EffectEntry& entry = effect.entry();
  double size = kNaN;
  const Verdict at = least(effect, size);
  if (at.named)
    return detectable_from(entry, effect.values(size), effect.size_at(),
                           beside_.torque_of(effect.in_model(size)));
  if (at.said_by_model) return not_detectable(entry, "model", "the model's own numbers take it up");
  if (at.hidden_by != nullptr)
    return not_detectable(entry, at.hidden_by->name,
                          fmt::format("{} says it as well", readable(at.hidden_by->name)));
  return not_detectable(entry, "", "as much as was tried leaves the model as near the floor");
}

DetectableEffect coarser_count(const Study& study, const EffectEntry& entry) {
  double quantum = 0.0;
  for (const MotorTrace& t : study.held_out.traces) quantum = std::max(quantum, t.quantum);
  if (!(quantum > 0.0)) return not_detectable(entry, "", "the sheet tells no quantum to compare with");
  return detectable_from(entry, {kTelling.coarser * quantum}, 0, kNaN);
}

}  // namespace

std::vector<DetectableEffect> detectable_in_motion(const Study& study, const ReferenceModel& model,
                                                   const std::vector<const EffectEntry*>& asked) {
  const Contestants contestants(study, model, asked);
  const std::vector<ExemplaryEffect>& effects = contestants.effects();
  std::vector<DetectableEffect> detectable(effects.size());
  parallel_for(effects.size(), study.options.threads,
               [&](std::size_t i) { detectable[i] = contestants.told(effects[i]); });
  for (const EffectEntry* entry : asked)
    if (reads_counts(*entry)) detectable.push_back(coarser_count(study, *entry));
  std::stable_sort(detectable.begin(), detectable.end(),
                   [](const DetectableEffect& a, const DetectableEffect& b) { return a.effect < b.effect; });
  return detectable;
}

}  // namespace gapscope::internal::diagnosis

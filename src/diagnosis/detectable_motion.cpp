#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "base/text.h"
#include "diagnosis/detectable.h"
#include "diagnosis/exemplary_effect.h"
#include "diagnosis/held_out_change.h"

namespace gapscope::internal::diagnosis {
namespace {

/// Of a start: a change that stays is none.
constexpr double kNothing = std::numeric_limits<double>::epsilon();

/// What a weak start of a candidate changes of the errors, beyond the model's numbers; less does in
/// proportion.
struct Probe {
  const EffectEntry* entry = nullptr;
  double absorbed = kNaN;              ///< share of the change that the numbers say
  std::vector<HeldOutErrors> changes;  ///< one, or two quarters of a phase
};

struct Verdict {
  bool named = false;
  const EffectEntry* hidden_by = nullptr;  ///< what is named in its place, or nearly
};

/// Over all recordings; NaN without any.
double rms_of(const std::vector<std::vector<double>>& torque) {
  double square = 0.0, count = 0.0;
  for (const std::vector<double>& t : torque)
    for (const double value : t) square += value * value, count += 1.0;
  return std::sqrt(square / count);
}

HeldOutErrors times(double factor, HeldOutErrors errors) {
  errors.innovation *= factor, errors.free *= factor;
  return errors;
}

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

  std::size_t count() const { return effects_.size(); }
  DetectableEffect told(std::size_t i) const;

 private:
  Probe probe(const ExemplaryEffect& effect) const {
    Probe p{&effect.entry(), kNaN, {}};
    for (const bool quarter : {false, true}) {
      if (quarter && !effect.has_phase()) break;
      const HeldOutErrors change = beside_.by(effect.in_model(study_.effort.weaker, quarter));
      if (!change.exist()) continue;
      p.changes.push_back(beside_.beyond_numbers(change));
      if (!quarter)
        p.absorbed = 1.0 - p.changes.front().innovation.squaredNorm() / change.innovation.squaredNorm();
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

  Verdict verdict(const EffectEntry& entry, const HeldOutErrors& change) const;
  Verdict played(const ExemplaryEffect& effect, double size) const;
  double in_proportion(const Probe& probe) const;
  double least(const ExemplaryEffect& effect, double foretold, Verdict& last) const;
  double found_from(const ExemplaryEffect& effect, double size) const;

  const Study& study_;
  HeldOutChange beside_;
  std::vector<ExemplaryEffect> effects_;
  std::vector<Probe> probes_;
};

/// The recordings as the effect would have changed them: the model errs by as much more.
/// @param change that the effect makes of the model's errors, beyond what its numbers say
Verdict Contestants::verdict(const EffectEntry& entry, const HeldOutErrors& change) const {
  const HeldOutErrors missing = times(-1.0, change);
  const ScoredModel before = beside_.scored_with(nullptr, missing);
  if (!study_.repeats_badly() && at_floor(before)) return {};
  std::vector<ScoredModel> ranked{beside_.scored_with(&entry, beside_.nothing())};
  for (const Probe& rival : probes_)
    if (rival.entry != &entry && !rival.changes.empty())
      ranked.push_back(beside_.scored_with(rival.entry, without(missing, rival)));
  rank(ranked);
  const Decision decision = decide_alone(ranked, before, study_.reach(), {});
  const bool first = ranked.front().entry == &entry;
  if (first && decision.accepted) return {true, nullptr};
  return {false, !first ? ranked.front().entry : ranked.size() > 1 ? ranked[1].entry : nullptr};
}

Verdict Contestants::played(const ExemplaryEffect& effect, double size) const {
  if (!effect.is_possible(size)) return {};
  const HeldOutErrors change = beside_.by(effect.in_model(size));
  return change.exist() ? verdict(effect.entry(), beside_.beyond_numbers(change)) : Verdict{};
}

/// The least size, by halves, that would be named if the errors grew in proportion to it; the first start
/// where that would not be.
double Contestants::in_proportion(const Probe& probe) const {
  const auto named = [&](double size) {
    return verdict(*probe.entry, times(size / study_.effort.weaker, probe.changes.front())).named;
  };
  double size = 1.0;
  if (!named(size)) return size;
  while (size > kNothing && named(0.5 * size)) size *= 0.5;
  return size;
}

/// The same by plays: from there by factors of two, and once between the last two.
double Contestants::least(const ExemplaryEffect& effect, double foretold, Verdict& last) const {
  double size = foretold;
  last = played(effect, size);
  if (last.named)
    while (size > kNothing && played(effect, 0.5 * size).named) size *= 0.5;
  while (!last.named && effect.is_possible(2.0 * size)) last = played(effect, size *= 2.0);
  if (!last.named) return kNaN;
  const double between = std::sqrt(0.5) * size;
  return played(effect, between).named ? between : size;
}

/// The size from which the search finds the period of a line, which it does not know; the size itself for
/// other effects. NaN if not even the first start shows it.
double Contestants::found_from(const ExemplaryEffect& effect, double size) const {
  const bool of_share = effect.entry().start_search == StartSearch::kTorqueShareLines;
  if (!of_share && effect.entry().start_search != StartSearch::kTorqueLines) return size;
  const auto change = beside_.torque_by(effect.in_model(study_.effort.weaker));
  if (change.empty()) return kNaN;
  const double km = of_share ? beside_.model().parameters[place::kTorqueConstant].value : 0.0;
  const double periods = effect.values(size)[1], width = one_cycle(study_.held_out.traces);
  for (; size <= 1.0; size *= std::sqrt(2.0))
    for (const Harmonic& line : beside_.lines_with(change, size / study_.effort.weaker, km))
      if (std::abs(line.periods - periods) < width) return size;
  return kNaN;
}

DetectableEffect Contestants::told(std::size_t i) const {
  const ExemplaryEffect& effect = effects_[i];
  const EffectEntry& entry = effect.entry();
  if (effect.lacks_its_level())
    return not_detectable(
        entry, contained_effect(entry)->name,
        fmt::format("the model has no {} that it would change", readable(contained_effect(entry)->name)));
  if (probes_[i].changes.empty()) return not_detectable(entry, "", "with it the model's motion diverges");
  if (probes_[i].absorbed > torque_view::TorqueViewOptions{}.most_absorbed)
    return not_detectable(entry, "model", "the model's own numbers absorb it");
  Verdict last;
  double size = least(effect, in_proportion(probes_[i]), last);
  if (std::isfinite(size)) {
    size = found_from(effect, size);
    if (!std::isfinite(size)) return not_detectable(entry, "", "its period would not be found");
    return detectable_from(entry, effect.values(size), effect.size_at(),
                           rms_of(beside_.torque_by(effect.in_model(size))));
  }
  if (last.hidden_by == nullptr)
    return not_detectable(entry, "", "as much as was tried leaves the model near the floor");
  return not_detectable(entry, last.hidden_by->name,
                        fmt::format("{} says it as well", readable(last.hidden_by->name)));
}

DetectableEffect coarser_count(const Study& study, const EffectEntry& entry) {
  double quantum = 0.0;
  for (const MotorTrace& t : study.held_out.traces) quantum = std::max(quantum, t.quantum);
  if (!(quantum > 0.0))
    return not_detectable(entry, "", "the encoder's quantum is not known to compare with");
  return detectable_from(entry, {kTelling.coarser * quantum}, 0, kNaN);
}

}  // namespace

std::vector<DetectableEffect> detectable_in_motion(const Study& study, const ReferenceModel& model,
                                                   const std::vector<const EffectEntry*>& asked) {
  const Contestants contestants(study, model, asked);
  std::vector<DetectableEffect> detectable(contestants.count());
  parallel_for(contestants.count(), study.options.threads,
               [&](std::size_t i) { detectable[i] = contestants.told(i); });
  for (const EffectEntry* entry : asked)
    if (reads_counts(*entry)) detectable.push_back(coarser_count(study, *entry));
  std::stable_sort(detectable.begin(), detectable.end(),
                   [](const DetectableEffect& a, const DetectableEffect& b) { return a.effect < b.effect; });
  return detectable;
}

}  // namespace gapscope::internal::diagnosis

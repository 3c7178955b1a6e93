#include "changes/observations.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/normal.h"

namespace gapscope::internal::changes {
namespace {

using Reports = std::span<const DriveReport>;
using Look = std::function<Observation(const DriveReport&)>;

constexpr double kSameLevel = 1.2;    ///< largest |u| of ramps that are of one level
constexpr double kLoadedFlank = 4.0;  ///< largest |u| over the friction, from which a flank is loaded

Observation untold(std::string why) {
  Observation o;
  o.remark = std::move(why);
  return o;
}

Observation at_most(double limit, std::string why) {
  Observation o = untold(std::move(why));
  o.at_most = std::isfinite(limit) ? std::max(limit, 0.0) : kNaN;
  return o;
}

/// The interval may be wider than the standard error, never narrower.
Observation told(double value, double std, const Interval& ci95) {
  Observation o;
  o.value = value, o.ci95 = ci95;
  o.std = std::fmax(std, (ci95.high - ci95.low) / (2.0 * kNormal95));
  return o;
}

Observation told(const LoopMean& mean) {
  if (!std::isfinite(mean.value)) return untold("too few ramps");
  return told(mean.value, kNaN, {mean.value - mean.half_width, mean.value + mean.half_width});
}

Observation answered(const DriveReport& r) {
  if (!r.answer) return untold("no answer");
  const Answer& a = *r.answer;
  Observation o = std::isfinite(a.gap) ? told(a.gap, kNaN, a.ci95) : at_most(a.gap_at_most, "not known");
  o.trust = to_string(a.trust);
  return o;
}

Observation read_as(const GapEstimate& g) {
  const bool scatter = g.method == GapMethod::kLiteral;  // which is no error of the mean
  Observation o = told(g.gap, scatter ? kNaN : g.std, g.ci95);
  o.trust = to_string(g.trust);
  return o;
}

/// Of several gaps in series.
Observation first_gap(const DriveReport& r) {
  if (!r.model_free) return untold("not asked for");
  const GapEstimate& g = *r.model_free;
  const bool read = g.verdict == GapVerdict::kBacklash && g.quantity == GapQuantity::kFirstGap;
  return read ? read_as(g) : untold("no signs of several gaps");
}

/// Where the first of several was read, the whole is no smaller.
Observation read_gap(const DriveReport& r) {
  if (!r.model_free) return untold("not asked for");
  const GapEstimate& g = *r.model_free;
  if (g.verdict == GapVerdict::kNone) return at_most(g.none_above(), "none is seen");
  if (g.verdict == GapVerdict::kBacklash && g.quantity == GapQuantity::kFirstGap) {
    Observation o = at_most(g.gap_at_most, "the first of several was read");
    o.at_least = g.ci95.low;
    return o;
  }
  if (g.verdict != GapVerdict::kBacklash || g.quantity != GapQuantity::kGap)
    return at_most(g.gap_at_most, g.verdict == GapVerdict::kBacklash ? "the play was read" : "inconclusive");
  return read_as(g);
}

Observation lost_at(const DriveReport& r, double level) {
  if (!r.model_free || !r.model_free->lost_motion.read()) return untold("no loop was read");
  for (const LostMotionLevel& l : r.model_free->lost_motion.levels)
    if (same_level(l.amplitude, level)) return told(l.lost_motion, kNaN, l.ci95);
  return untold("not ramped to this torque");
}

const LoopFacts* loop_at(const DriveReport& r, double level) {
  for (const LoopFacts& l : r.loops)
    if (same_level(l.amplitude, level)) return &l;
  return nullptr;
}

/// Below its breakaway a drive shows no more than a part of its friction.
Observation loop_friction(const DriveReport& r, double level) {
  const LoopFacts* loop = loop_at(r, level);
  if (loop == nullptr) return untold("not ramped to this torque");
  Observation o = told(loop->friction);
  if (loop->runs_free || !o.has_value()) return o;
  Observation least = untold("x1 does not run free: a part of the friction");
  least.at_least = std::max(o.ci95.low, 0.0);
  return least;
}

/// Torques that hardly exceed the friction bend what rubs, not the flank.
Observation flank_stiffness(const DriveReport& r, double level) {
  const LoopFacts* loop = loop_at(r, level);
  if (loop == nullptr) return untold("not ramped to this torque");
  const bool loaded = loop->amplitude > kLoadedFlank * loop->friction.value;
  return loaded ? told(loop->stiffness) : untold("the ramps hardly exceed the friction");
}

Observation fitted(const DriveReport& r, const std::string& key) {
  if (!r.reference) return untold("not asked for");
  const FittedParameter* p = r.reference->find(key);
  if (p == nullptr) return untold("not in the model");
  if (!p->estimated) return untold(fmt::format("given, {:.4g}", p->value));
  if (r.reference->rejected()) return untold("left out, the model is rejected");
  if (!r.reference->converged()) return untold("the fit did not converge");
  if (p->at_bound) return untold("at a bound");
  if (!p->identifiable) return untold("not identifiable");
  Observation o = told(p->value, p->std, p->ci95);
  o.trust = to_string(r.reference->trust);
  return o;
}

/// Known up to what no model gets below.
Observation missing_torque(const DriveReport& r) {
  if (!r.diagnosis) return untold("not diagnosed");
  const MismatchSize& gap = r.diagnosis->mismatch;
  if (!std::isfinite(gap.before_torque)) return untold("not known as a torque");
  const double square = gap.before_torque * gap.before_torque, floor = gap.floor_torque * gap.floor_torque;
  if (!std::isfinite(floor)) return told(gap.before_torque, kNaN, {});
  return told(gap.before_torque, kNaN, {std::sqrt(std::max(square - floor, 0.0)), std::sqrt(square + floor)});
}

/// An effect that was added, or is fitted in the model; else the smallest amount that would have been named.
Observation amount(const DriveReport& r, const std::string& effect, const std::string& key) {
  if (!r.diagnosis) {
    Observation o = fitted(r, effect + "." + key);
    return o.has_value() ? o : untold("not diagnosed");
  }
  for (const AddedEffect& added : r.diagnosis->added)
    for (const NamedValue& v : added.parameters)
      if (added.effect == effect && v.key == key) return told(v.value, kNaN, v.ci95);
  if (Observation o = fitted(r, effect + "." + key); o.has_value()) return o;
  for (const DetectableEffect& d : r.diagnosis->detectable)
    if (d.effect == effect && d.smallest.key == key && d.can_be_shown())
      return at_most(d.smallest.value, "not found, less than would have been");
  return untold("not found");
}

void add(Reports reports, DriveQuantity q, const Look& look, std::vector<DriveQuantity>& all) {
  for (const DriveReport& r : reports) q.observed.push_back(look(r));
  if (std::ranges::any_of(q.observed, [](const Observation& o) { return o.has_value() || o.has_bound(); }))
    all.push_back(std::move(q));
}

DriveQuantity named(std::string key, std::string from, std::string unit, double level = kNaN) {
  DriveQuantity q;
  q.key = std::move(key), q.from = std::move(from), q.unit = std::move(unit), q.level = level;
  return q;
}

/// Of the ramps of all reports, by rising torque.
std::vector<double> levels_of(Reports reports) {
  std::vector<double> levels;
  for (const DriveReport& r : reports)
    if (r.model_free)
      for (const LostMotionLevel& l : r.model_free->lost_motion.levels)
        if (std::ranges::none_of(levels, [&](double at) { return same_level(at, l.amplitude); }))
          levels.push_back(l.amplitude);
  std::ranges::sort(levels);
  return levels;
}

/// Of u where it was declared, else "u".
std::string unit_of_u(Reports reports) {
  for (const DriveReport& r : reports)
    if (r.input && !r.input->unit.empty()) return r.input->unit;
  return "u";
}

void add_loops(Reports reports, std::vector<DriveQuantity>& all) {
  const std::vector<double> levels = levels_of(reports);
  const std::string unit = unit_of_u(reports);
  for (const double level : levels)
    add(
        reports, named("lost_motion", "model_free", "rad", level),
        [&](const DriveReport& r) { return lost_at(r, level); }, all);
  for (const double level : levels)
    add(
        reports, named("loop_friction", "model_free", unit, level),
        [&](const DriveReport& r) { return loop_friction(r, level); }, all);
  for (const double level : levels)
    add(
        reports, named("flank_stiffness", "model_free", unit + "/rad", level),
        [&](const DriveReport& r) { return flank_stiffness(r, level); }, all);
}

/// The numbers of all fits, the gap first.
std::vector<DriveQuantity> fitted_numbers(Reports reports) {
  std::vector<DriveQuantity> numbers = {named("gap", "reference", "rad")};
  for (const DriveReport& r : reports)
    if (r.reference)
      for (const FittedParameter& p : r.reference->parameters)
        if (std::ranges::none_of(numbers, [&](const DriveQuantity& q) { return q.key == p.key; }))
          numbers.push_back(named(p.key, "reference", p.unit));
  return numbers;
}

std::vector<DriveQuantity> added_numbers(Reports reports) {
  std::vector<DriveQuantity> numbers;
  for (const DriveReport& r : reports)
    if (r.diagnosis)
      for (const AddedEffect& added : r.diagnosis->added)
        for (const NamedValue& v : added.parameters) {
          const std::string key = added.effect + "." + v.key;
          if (std::ranges::none_of(numbers, [&](const DriveQuantity& q) { return q.key == key; }))
            numbers.push_back(named(key, "diagnosis", v.unit));
        }
  return numbers;
}

}  // namespace

bool same_level(double a, double b) { return std::max(a, b) <= kSameLevel * std::min(a, b); }

std::vector<DriveQuantity> observed_quantities(Reports reports) {
  std::vector<DriveQuantity> all;
  add(reports, named("gap", "answer", "rad"), answered, all);
  add(reports, named("gap", "model_free", "rad"), read_gap, all);
  add(reports, named("first_gap", "model_free", "rad"), first_gap, all);
  add_loops(reports, all);
  for (DriveQuantity& q : fitted_numbers(reports)) {
    const std::string key = q.key;
    add(
        reports, std::move(q), [&](const DriveReport& r) { return fitted(r, key); }, all);
  }
  add(reports, named("missing_torque", "diagnosis", "N m"), missing_torque, all);
  for (DriveQuantity& q : added_numbers(reports)) {
    const std::size_t dot = q.key.find('.');
    const std::string effect = q.key.substr(0, dot), key = q.key.substr(dot + 1);
    add(
        reports, std::move(q), [&](const DriveReport& r) { return amount(r, effect, key); }, all);
  }
  return all;
}

}  // namespace gapscope::internal::changes

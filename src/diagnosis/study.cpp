#include "diagnosis/study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/interrupt.h"
#include "base/require.h"
#include "diagnosis/few_recordings.h"
#include "gapscope/base/errors.h"
#include "signals/encoder.h"
#include "signals/period.h"

namespace gapscope {

void DiagnosisKnowledge::fields(FieldVisitor& v) {
  v.field({"periods_per_turn", "1/rev", "of a torque: pole pairs, slots, teeth", 1e-3, 1e7},
          periods_per_turn);
  v.field({"periods", "rad", "the same as a length, such as a screw's pitch", 1e-9, 1e4}, periods);
  v.field({"outside_catalogue", "", "how likely the catalogue lacks what is missing", 0.01, 0.99},
          outside_catalogue);
  v.field({"detectable", "", "find the smallest amount of each effect that would have been named"},
          detectable);
}

namespace internal::diagnosis {
namespace {

std::size_t rows_of_first_part(const MotorTrace& file) {
  return static_cast<std::size_t>(kMeasure.train_share * static_cast<double>(file.size()));
}

/// Whether what is left of a file beside its first part could be fitted as a recording of its own.
bool can_judge(const MotorTrace& file) { return file.size() - rows_of_first_part(file) >= kFewestFitted; }

/// What is fitted of files whose last third is held out; those that are too short for that are fitted whole
/// and stand first.
std::vector<MotorTrace> first_parts(std::span<const MotorTrace> files) {
  std::vector<MotorTrace> parts;
  std::ranges::copy_if(files, std::back_inserter(parts), std::not_fn(can_judge));
  for (const MotorTrace& file : files)
    if (can_judge(file)) parts.push_back(part(file, 0, rows_of_first_part(file)));
  return parts;
}

void hold_out_the_last_third(std::span<const MotorTrace> files, Study& study) {
  study.train = first_parts(files);
  for (const MotorTrace& file : files) {
    if (!can_judge(file)) {
      study.judge_nothing.push_back(file.file);
      continue;
    }
    study.held_out.traces.push_back(file);
    study.held_out.scored_from.push_back(rows_of_first_part(file));
  }
  if (study.held_out.traces.empty())
    throw ConfigError(files.front().file,
                      fmt::format("has {} samples, too few to hold out its last third: expected {} or more, "
                                  "or another recording (held_out)",
                                  files.front().size(), 3 * kFewestFitted));
}

/// Where a recording is cut in two: in the middle, or, where the drive rests through one of these halves (it
/// has less than half of its share of the way), at half of the way, but in the middle half of the time.
std::size_t half_of(const MotorTrace& t) {
  std::vector<double> way(t.size(), 0.0);
  for (std::size_t i = 1; i < way.size(); ++i) way[i] = way[i - 1] + std::abs(t.x1[i] - t.x1[i - 1]);
  const std::size_t middle = t.size() / 2;
  if (4.0 * std::min(way[middle], way.back() - way[middle]) >= way.back()) return middle;
  const auto at = std::lower_bound(way.begin(), way.end(), 0.5 * way.back());
  const std::size_t least = std::max(t.size() / 4, kFewestFitted);
  return std::clamp(static_cast<std::size_t>(at - way.begin()), least, t.size() - least);
}

/// Whether nearly all positions are whole numbers of quanta apart: a steady speed repeats its step, too.
bool counts_in(std::span<const double> x1, double quantum) {
  double beside = 0.0;
  for (const double x : x1) {
    const double counts = (x - x1.front()) / quantum;
    beside += std::abs(counts - std::round(counts));
  }
  return beside < kTelling.on_grid * static_cast<double>(x1.size());
}

/// Least quantum that the samples of all recordings show; 0 unless each of them is coarser than its sheet.
double coarser_quantum(const std::vector<MotorTrace>& traces) {
  double least = kInfinity;
  for (const MotorTrace& t : traces) {
    const double seen = t.quantum > 0.0 ? seen_quantum(t.x1) : 0.0;
    if (seen < kTelling.coarser * t.quantum || seen == 0.0 || !counts_in(t.x1, seen)) return 0.0;
    least = std::min(least, seen);
  }
  return least;
}

/// Of a recording whose counts are coarser than the sheet's the floor is the sheet's: they are what is
/// missing.
double floor_of(const MotorTrace& t, bool coarser) {
  return coarser ? signals::rounding_noise(t.quantum) : signals::encoder_floor(t);
}

}  // namespace

Study make_study(std::span<const MotorTrace> train, std::span<const MotorTrace> held_out,
                 const ReferenceModel& model, const DiagnosisOptions& options) {
  Study study{{}, {}, model, {}, kMeasure.slow_hz, 0.0, {}, options};
  study.turns = options.coordinates.rotational() ? options.turns : ShaftTurns::of_a_slide();
  const std::vector<MotorTrace> few = few_of(train);
  const bool are_all = std::ranges::equal(few, train, {}, &MotorTrace::size, &MotorTrace::size);
  if (held_out.empty()) {
    hold_out_the_last_third(few, study);
    if (!are_all) study.all = first_parts(train);
  } else {
    study.train = few;
    if (!are_all) study.all.assign(train.begin(), train.end());
    study.held_out.traces.assign(held_out.begin(), held_out.end());
    study.held_out.scored_from.assign(held_out.size(), 0);
  }
  study.seen_quantum = coarser_quantum(study.held_out.traces);
  for (const MotorTrace& t : study.held_out.traces)
    study.held_out.floors.push_back(floor_of(t, study.seen_quantum > 0.0));
  for (const MotorTrace& t : study.held_out.traces)
    study.held_out.periods.push_back(signals::input_period(t));
  for (const std::string& name : options.excluded) GAPSCOPE_REQUIRE(find_effect(name) != nullptr);
  for (const EffectEntry* entry : effect_table())
    if (study.can_turn(*entry) && !study.is_excluded(*entry)) study.catalogue.push_back(entry);
  return study;
}

bool Study::can_turn(const EffectEntry& entry) const {
  return entry.turns_with == Shaft::kNone || std::isfinite(turns.of(entry.turns_with));
}

bool Study::is_excluded(const EffectEntry& entry) const {
  return std::find(options.excluded.begin(), options.excluded.end(), entry.name) != options.excluded.end();
}

bool Study::is_exhausted() const { return finish_requested() || has_done_its_work(); }

bool Study::has_done_its_work() const {
  const auto done = static_cast<double>(*options.fit.work - work_before);
  return step_work > 0.0 && done > effort.most_steps_of_work * step_work;
}

void count_first_step(Study& study, std::size_t candidates) {
  if (candidates == 0) return;
  const double whole = static_cast<double>(study.catalogue.size()) / static_cast<double>(candidates);
  study.step_work = whole * static_cast<double>(*study.options.fit.work - study.work_before);
}

bool may_fit_half_of_the_held_out(const Study& study) {
  return !study.repeats_badly() && !(study.held_out.scored_from.front() > 0);
}

void fit_half_of_the_held_out(Study& study) {
  study.all.clear();
  HeldOut& held = study.held_out;
  for (std::size_t r = 0; r < held.traces.size(); ++r) {
    const std::size_t half = half_of(held.traces[r]);
    study.train.push_back(part(held.traces[r], 0, half));
    held.scored_from[r] = half;
  }
}

Study of_all(const Study& study) {
  Study whole = study;
  if (!study.all.empty()) whole.train = study.all;
  return whole;
}

ScoredModel on_all(const Study& whole, const ScoredModel& model) {
  if (whole.all.empty() || !std::isfinite(model.fitted.mean_cost)) return model;
  whole.options.progress("fitting all recordings");
  FittedModel fitted = fit_near(whole.train, model.fitted.model, whole.options.fit, whole.observer_hz);
  return fitted.mean_cost < kInfinity
             ? judge(model.entry, std::move(fitted), whole.held_out, whole.observer_hz)
             : model;
}

std::vector<MotorTrace> everything(const Study& study) {
  const std::vector<MotorTrace>& held = study.held_out.traces;
  const bool parts_are_fitted = study.held_out.scored_from.front() > 0;  // these stand last
  std::vector<MotorTrace> all(study.train.begin(),
                              study.train.end() - (parts_are_fitted ? std::ssize(held) : 0));
  all.insert(all.end(), held.begin(), held.end());
  return all;
}

std::vector<reference::RecordingStart> starts_on(const Study& study, const FittedModel& fitted) {
  if (fitted.starts.size() == study.train.size()) return fitted.starts;
  return settled_starts(study.train, fitted.model, study.observer_hz);
}

HeldOut fitted_as_held_out(const Study& study) {
  HeldOut all;
  all.traces = study.train;
  all.scored_from.assign(all.traces.size(), 0);
  for (const MotorTrace& t : all.traces) {
    all.floors.push_back(floor_of(t, study.seen_quantum > 0.0));
    all.periods.push_back(signals::input_period(t));
  }
  return all;
}

}  // namespace internal::diagnosis
}  // namespace gapscope

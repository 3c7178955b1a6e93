#include "diagnosis/simulator.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/interrupt.h"
#include "base/parallel.h"
#include "base/require.h"
#include "base/shared_unit.h"
#include "diagnosis/rule.h"
#include "diagnosis/simulator_rows.h"
#include "diagnosis/stand_in.h"

namespace gapscope {
namespace internal::diagnosis {
namespace {

class Comparer {
 public:
  Comparer(const SimulatorQuestion& question, const DiagnosisOptions& options)
      : question_(question),
        options_(options),
        drive_(side_of(question.train, question.held_out, question.drive.observer_hz, options)),
        simulator_(side_of(question.simulated_train, question.simulated_held_out, question.drive.observer_hz,
                           options)),
        floor_(std::max(question.drive.mismatch.floor, question.simulator.mismatch.floor)) {}

  SimulatorComparison answer();

 private:
  JointFit joint_fit(std::vector<JointEffect> effects) const;
  JointFit best_joint_fit() const;
  std::vector<Stretch> stretches(bool judged) const;
  void warn(const JointFit& fit, std::vector<std::string>& warnings) const;
  void order(const JointFit& fit, std::vector<PlannedRow>& rows) const;
  void mend(const JointFit& fit, const std::vector<PlannedRow>& rows, SimulatorComparison& c) const;
  std::vector<SimulatorTrace> traces(const JointFit& fit, const StandIn& stand_in,
                                     const ReferenceModel* mended) const;

  const SimulatorQuestion& question_;
  const DiagnosisOptions& options_;
  Side drive_, simulator_;
  double floor_;
};

ReferenceModel with_effects(const Diagnosis& of, const std::vector<JointEffect>& effects,
                            ModelEffect JointEffect::*side) {
  ReferenceModel model = of.fitted;
  model.effects.clear();
  for (const JointEffect& e : effects) model.effects.push_back(e.*side);
  return model;
}

JointFit Comparer::joint_fit(std::vector<JointEffect> effects) const {
  JointFit fit{std::move(effects), {}, {}};
  parallel_for(2, options_.threads, [&](std::size_t i) {
    if (i == 0)
      fit.drive = fit_side(drive_, with_effects(question_.drive, fit.effects, &JointEffect::drive));
    else
      fit.simulator =
          fit_side(simulator_, with_effects(question_.simulator, fit.effects, &JointEffect::simulator));
  });
  return fit;
}

JointFit Comparer::best_joint_fit() const {
  JointFit best;
  for (std::vector<JointEffect>& effects : joint_effects(question_.drive, question_.simulator)) {
    stop_point();
    JointFit fit = joint_fit(std::move(effects));
    if (fit.usable() && (!best.usable() || fit.log_error(floor_) < best.log_error(floor_)))
      best = std::move(fit);
  }
  return best;
}

/// What judges, or what was fitted.
std::vector<Stretch> Comparer::stretches(bool judged) const {
  std::vector<Stretch> all;
  const HeldOut &drive = drive_.judged, &simulator = simulator_.judged;
  if (judged) {
    for (std::size_t r = 0; r < drive.traces.size(); ++r)
      all.push_back({drive.traces[r], simulator.traces[r], drive.scored_from[r], drive.traces[r].size()});
  } else {
    for (std::size_t r = 0; r < drive_.train.size(); ++r)
      all.push_back({drive_.train[r], simulator_.train[r], 0, drive_.train[r].size()});
  }
  return all;
}

double share_mended(double before, double after) { return 1.0 - after / before; }

/// Those that differ first, by what mending each takes of the error on what was fitted.
void Comparer::order(const JointFit& fit, std::vector<PlannedRow>& rows) const {
  const StandIn fitted(fit.simulator.model, stretches(false));
  const double before = fitted.error_of(fit.simulator.model);
  for (PlannedRow& planned : rows)
    planned.row.shrink_fitted = share_mended(
        before, fitted.error_of(with_numbers(fit.simulator.model, fit.drive.model, planned.ids)));
  std::stable_sort(rows.begin(), rows.end(), [](const PlannedRow& a, const PlannedRow& b) {
    if (a.row.differs != b.row.differs) return a.row.differs;
    return a.row.differs && a.row.shrink_fitted > b.row.shrink_fitted;
  });
}

std::vector<SimulatorTrace> Comparer::traces(const JointFit& fit, const StandIn& stand_in,
                                             const ReferenceModel* mended) const {
  const std::vector<MotorTrace>& recorded = drive_.judged.traces;
  const FreeRuns drive = free_runs(fit.drive.model, recorded, settled_starts(recorded, fit.drive.model, 0.0));
  const FreeRuns standing = stand_in.runs_of(stand_in.model());
  const FreeRuns better = mended == nullptr ? FreeRuns(recorded.size()) : stand_in.runs_of(*mended);
  std::vector<SimulatorTrace> all;
  for (std::size_t r = 0; r < recorded.size(); ++r) {
    const MotorTrace &t = recorded[r], &s = simulator_.judged.traces[r];
    all.push_back({t.file,
                   s.file,
                   t.start,
                   t.dt,
                   drive_.judged.scored_from[r],
                   {t.u.begin(), t.u.end()},
                   {t.x1.begin(), t.x1.end()},
                   {s.x1.begin(), s.x1.end()},
                   drive[r],
                   standing[r],
                   better[r],
                   {t.stamps.begin(), t.stamps.end()}});
  }
  return all;
}

void Comparer::mend(const JointFit& fit, const std::vector<PlannedRow>& rows, SimulatorComparison& c) const {
  const StandIn judged(fit.simulator.model, stretches(true));
  c.errors.simulator = judged.simulator_error();
  c.errors.stand_in = judged.error_of(judged.model());
  c.errors.stand_in_miss = judged.miss();
  ReferenceModel all = judged.model(), first = judged.model();
  for (const PlannedRow& planned : rows) {
    SimulatorRow row = planned.row;
    const ReferenceModel mended = with_numbers(judged.model(), fit.drive.model, planned.ids);
    const double error = judged.error_of(mended);
    row.shrink = share_mended(c.errors.stand_in, error);
    if (row.differs && c.rows.empty()) first = mended, c.errors.mended = error, c.shrink = row.shrink;
    if (row.differs) all = with_numbers(all, fit.drive.model, planned.ids);
    c.rows.push_back(std::move(row));
  }
  const bool differs = !rows.empty() && rows.front().row.differs;
  if (differs) {
    c.errors.all_mended = judged.error_of(all);
    c.shrink_all = share_mended(c.errors.stand_in, c.errors.all_mended);
  }
  c.traces = traces(fit, judged, differs ? &first : nullptr);
}

/// Where a model is off the floor, its numbers hold part of what it lacks.
void Comparer::warn(const JointFit& fit, std::vector<std::string>& warnings) const {
  for (const auto& [side, name] : {std::pair(&fit.drive, "drive"), std::pair(&fit.simulator, "simulator")})
    if (side->error > kRule.floor_ratio * floor_)
      warnings.push_back(fmt::format(
          "the model leaves {} floors on the {}: a row may hold part of what it does not explain there",
          SharedUnit(1.0, "").number(side->error / floor_), name));
}

/// Where the model is farther from the simulator than the simulator from the drive, no number of it says
/// anything of what is between the two.
void take_back_rows(SimulatorComparison& c) {
  for (SimulatorRow& row : c.rows) row.differs = false;
  c.shrink = c.shrink_all = c.errors.mended = c.errors.all_mended = kNaN;
  for (SimulatorTrace& t : c.traces) t.mended.clear();
  c.state = ComparisonState::kNotFollowed;
}

SimulatorComparison Comparer::answer() {
  SimulatorComparison c;
  c.verdict = question_.simulator.verdict;
  c.effects = question_.simulator.effects;
  c.floor = floor_;
  const JointFit fit = best_joint_fit();
  if (!fit.usable()) {
    return c;
  }
  std::vector<PlannedRow> rows = planned_rows(fit);
  parallel_for(rows.size(), options_.threads, [&](std::size_t i) {
    stop_point();
    measure({drive_, simulator_, floor_}, fit, rows[i]);
  });
  c.dt = drive_.train.front().dt;
  c.drive_floors = fit.drive.error / floor_, c.simulator_floors = fit.simulator.error / floor_;
  warn(fit, c.warnings);
  order(fit, rows);
  mend(fit, rows, c);
  if (c.errors.stand_in_miss > std::max(c.errors.simulator, kLeastRow * floor_)) {
    take_back_rows(c);
    return c;
  }
  c.state = ComparisonState::kRead;
  return c;
}

}  // namespace
}  // namespace internal::diagnosis

SimulatorComparison compare_with_simulator(const SimulatorQuestion& question,
                                           const DiagnosisOptions& options) {
  GAPSCOPE_REQUIRE(question.train.size() == question.simulated_train.size());
  GAPSCOPE_REQUIRE(question.held_out.size() == question.simulated_held_out.size());
  for (std::size_t r = 0; r < question.train.size(); ++r)
    GAPSCOPE_REQUIRE(question.train[r].size() == question.simulated_train[r].size());
  for (std::size_t r = 0; r < question.held_out.size(); ++r)
    GAPSCOPE_REQUIRE(question.held_out[r].size() == question.simulated_held_out[r].size());
  options.progress("laying drive and simulator side by side");
  return internal::diagnosis::Comparer(question, options).answer();
}

}  // namespace gapscope

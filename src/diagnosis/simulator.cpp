#include "gapscope/diagnosis/simulator.h"

#include <algorithm>
#include <cmath>

#include "diagnosis/simulator_words.h"
#include "diagnosis/stand_in.h"
#include "gapscope/base/interrupt.h"
#include "gapscope/base/parallel.h"
#include "gapscope/base/require.h"

namespace gapscope {
namespace internal::diagnosis {
namespace {

using reference::ParameterId;

/// When a row is one. Set before any pair was looked at: two floors are what the contract asks for, the rest
/// is the usual 95 %.
struct RowRule {
  double floors = 2.0;       ///< least size of a row [floor]
  double deviations = 1.96;  ///< least distance of both numbers [joint standard deviations]
};
constexpr RowRule kRowRule;

/// Drive and simulator with one set of joint effects.
struct JointFit {
  std::vector<JointEffect> effects;
  SideFit drive, simulator;

  bool usable() const { return std::isfinite(drive.error) && std::isfinite(simulator.error); }
  double log_error(double floor) const {
    return std::log(std::hypot(drive.error, floor)) + std::log(std::hypot(simulator.error, floor));
  }
};

/// A row, and the numbers of the model that it stands for.
struct PlannedRow {
  SimulatorRow row;
  std::vector<ParameterId> ids;
  int effect = ParameterId::kDrive;
};

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
  std::vector<PlannedRow> planned(const JointFit& fit) const;
  PlannedRow effect_row(const JointFit& fit, std::size_t effect) const;
  void fill_numbers(const JointFit& fit, PlannedRow& row) const;
  void measure(const JointFit& fit, PlannedRow& row) const;
  bool is_there(const Side& side, const SideFit& fit, const PlannedRow& row, bool in_diagnosis) const;
  /// An excess in floors, or in what the model leaves anyway where that is more.
  double in_floors(double excess, const SideFit& fit) const {
    return excess / std::max(floor_, std::isfinite(fit.error) ? fit.error : 0.0);
  }
  std::vector<Stretch> stretches(bool judged) const;
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

bool is_free(const ReferenceModel& model, ParameterId id) {
  ReferenceModel copy = model;
  return setting_of(copy, id).estimate;
}

PlannedRow Comparer::effect_row(const JointFit& fit, std::size_t effect) const {
  const JointEffect& e = fit.effects[effect];
  PlannedRow planned;
  planned.effect = static_cast<int>(effect);
  planned.row.name = e.drive.entry->name;
  planned.row.is_effect = true;
  planned.row.group = e.group;
  for (int i = 0; i < std::ssize(e.drive.entry->parameters); ++i)
    if (const ParameterId id{planned.effect, i};
        is_free(fit.drive.model, id) || is_free(fit.simulator.model, id))
      planned.ids.push_back(id);
  return planned;
}

std::vector<PlannedRow> Comparer::planned(const JointFit& fit) const {
  std::vector<PlannedRow> rows;
  for (std::size_t e = 0; e < fit.effects.size(); ++e) rows.push_back(effect_row(fit, e));
  for (int i = 0; i < kDriveParameterCount; ++i) {
    if (!fit.drive.model.parameters[static_cast<std::size_t>(i)].estimate ||
        !has_parameter(fit.drive.model.structure, i))
      continue;
    PlannedRow& planned = rows.emplace_back();
    planned.row.name = kDriveParameters[i].key;
    planned.ids = {reference::drive_number(i)};
  }
  std::erase_if(rows, [](const PlannedRow& planned) { return planned.ids.empty(); });
  return rows;
}

Interval around(double value, double std) {
  if (std::isnan(std)) return {};
  return {value - kRowRule.deviations * std, value + kRowRule.deviations * std};
}

void Comparer::fill_numbers(const JointFit& fit, PlannedRow& planned) const {
  const std::vector<double> drive = spreads_of(drive_, fit.drive, planned.ids);
  const std::vector<double> simulator = spreads_of(simulator_, fit.simulator, planned.ids);
  ReferenceModel of_drive = fit.drive.model, of_simulator = fit.simulator.model;
  for (std::size_t i = 0; i < planned.ids.size(); ++i) {
    const ParameterId id = planned.ids[i];
    ComparedNumber n;
    if (planned.row.is_effect) {
      const EffectParameterSpec& spec = fit.effects[static_cast<std::size_t>(id.effect)]
                                            .drive.entry->parameters[static_cast<std::size_t>(id.index)];
      n.key = spec.key, n.unit = spec.unit;
    } else {
      n.key = kDriveParameters[id.index].key, n.unit = kDriveParameters[id.index].unit;
    }
    n.drive = setting_of(of_drive, id).value, n.simulator = setting_of(of_simulator, id).value;
    n.drive_ci95 = around(n.drive, drive[i]), n.simulator_ci95 = around(n.simulator, simulator[i]);
    planned.row.numbers.push_back(std::move(n));
  }
}

/// Whether the intervals of any number are apart; where there are none, nothing speaks against it.
bool intervals_apart(const SimulatorRow& row) {
  bool asked = false;
  for (const ComparedNumber& n : row.numbers) {
    const double d = (n.drive_ci95.high - n.drive_ci95.low) / 2.0;
    const double s = (n.simulator_ci95.high - n.simulator_ci95.low) / 2.0;
    if (std::isnan(d) || std::isnan(s)) continue;
    asked = true;
    if (std::abs(n.drive - n.simulator) > std::hypot(d, s)) return true;
  }
  return !asked;
}

/// Named by the diagnosis of that side, or a model without it, refitted, leaves two floors more.
bool Comparer::is_there(const Side& side, const SideFit& fit, const PlannedRow& planned,
                        bool in_diagnosis) const {
  if (in_diagnosis) return true;
  ReferenceModel without = fit.model;
  without.effects.erase(without.effects.begin() + planned.effect);
  return in_floors(excess(fit_side(side, without), fit), fit) > kRowRule.floors;
}

void Comparer::measure(const JointFit& fit, PlannedRow& planned) const {
  stop_point();
  SimulatorRow& row = planned.row;
  fill_numbers(fit, planned);
  const SideFit drive = fit_side(drive_, pinned(fit.drive.model, fit.simulator.model, planned.ids));
  const SideFit simulator = fit_side(simulator_, pinned(fit.simulator.model, fit.drive.model, planned.ids));
  const double of_drive = excess(drive, fit.drive), of_simulator = excess(simulator, fit.simulator);
  row.size = std::min(of_drive, of_simulator);
  row.floors = std::min(in_floors(of_drive, fit.drive), in_floors(of_simulator, fit.simulator));
  row.differs = row.floors > kRowRule.floors && intervals_apart(row);
  if (!row.is_effect) return;
  const JointEffect& e = fit.effects[static_cast<std::size_t>(planned.effect)];
  const bool in_drive = is_there(drive_, fit.drive, planned, e.in_drive);
  const bool in_simulator = is_there(simulator_, fit.simulator, planned, e.in_simulator);
  row.found_in = in_drive ? (in_simulator ? FoundIn::kBoth : FoundIn::kDrive)
                          : (in_simulator ? FoundIn::kSimulator : FoundIn::kNeither);
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
    planned.row.shrink_fitted =
        share_mended(before, fitted.error_of(replaced(fit.simulator.model, fit.drive.model, planned.ids)));
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
    const ReferenceModel mended = replaced(judged.model(), fit.drive.model, planned.ids);
    const double error = judged.error_of(mended);
    row.shrink = share_mended(c.errors.stand_in, error);
    if (row.differs && c.rows.empty()) first = mended, c.errors.mended = error, c.shrink = row.shrink;
    if (row.differs) all = replaced(all, fit.drive.model, planned.ids);
    c.rows.push_back(std::move(row));
  }
  const bool differs = !rows.empty() && rows.front().row.differs;
  if (differs) {
    c.errors.all_mended = judged.error_of(all);
    c.shrink_all = share_mended(c.errors.stand_in, c.errors.all_mended);
  }
  c.traces = traces(fit, judged, differs ? &first : nullptr);
}

SimulatorComparison Comparer::answer() {
  SimulatorComparison c;
  c.verdict = question_.simulator.verdict;
  c.effects = question_.simulator.effects;
  c.floor = floor_;
  const JointFit fit = best_joint_fit();
  if (!fit.usable()) {
    c.sentence = "The model that has all effects of both could not be fitted to drive and simulator alike.";
    return c;
  }
  std::vector<PlannedRow> rows = planned(fit);
  parallel_for(rows.size(), options_.threads, [&](std::size_t i) { measure(fit, rows[i]); });
  order(fit, rows);
  mend(fit, rows, c);
  const double dt = drive_.train.front().dt;
  for (SimulatorRow& row : c.rows)
    if (row.differs) row.sentence = row_sentence(row, dt, options_.coordinates);
  c.sentence = comparison_sentence(c, options_.coordinates);
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

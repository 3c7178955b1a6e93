#include "diagnosis/simulator_rows.h"

#include "gapscope/base/normal.h"

namespace gapscope::internal::diagnosis {
namespace {

using reference::ParameterId;

bool is_free(const ReferenceModel& model, ParameterId id) {
  ReferenceModel copy = model;
  return setting_of(copy, id).estimate;
}

PlannedRow effect_row(const JointFit& fit, std::size_t effect) {
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

}  // namespace

std::vector<PlannedRow> planned_rows(const JointFit& fit) {
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

namespace {

/// Of an effect that is not there nothing has a spread: a lag of no time has no slope that would tell how
/// well its time is known.
bool is_absent(const SideFit& fit, const PlannedRow& planned) {
  if (!planned.row.is_effect) return false;
  const ModelEffect& e = fit.model.effects[static_cast<std::size_t>(planned.effect)];
  return e.parameters[0].value == e.entry->parameters[0].absent;
}

std::vector<double> spreads_on(const Side& side, const SideFit& fit, const PlannedRow& planned) {
  if (is_absent(fit, planned)) return std::vector<double>(planned.ids.size(), kNaN);
  return spreads_of(side, fit, planned.ids);
}

void fill_numbers(const RowInstrument& of, const JointFit& fit, PlannedRow& planned) {
  const std::vector<double> drive = spreads_on(of.drive, fit.drive, planned);
  const std::vector<double> simulator = spreads_on(of.simulator, fit.simulator, planned);
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
    n.drive_ci95 = normal_interval(n.drive, drive[i]),
    n.simulator_ci95 = normal_interval(n.simulator, simulator[i]);
    planned.row.numbers.push_back(std::move(n));
  }
}

/// Where a side's interval ends, from its number on; the amount of an effect that is not there is exactly
/// that.
double reach(double number, const Interval& ci95, const SimulatorRow& row, bool is_amount) {
  if (row.is_effect && is_amount && number == find_effect(row.name)->parameters[0].absent) return 0.0;
  return (ci95.high - ci95.low) / 2.0;
}

/// Whether the intervals of any number are apart; where there are none, nothing speaks against it.
bool intervals_apart(const SimulatorRow& row) {
  bool asked = false;
  for (const ComparedNumber& n : row.numbers) {
    const bool is_amount = &n == &row.numbers.front();
    const double d = reach(n.drive, n.drive_ci95, row, is_amount);
    const double s = reach(n.simulator, n.simulator_ci95, row, is_amount);
    if (std::isnan(d) || std::isnan(s)) continue;
    asked = true;
    if (std::abs(n.drive - n.simulator) > std::hypot(d, s)) return true;
  }
  return !asked;
}

/// An excess in floors, or in what the model leaves anyway where that is more.
double in_floors(double excess, const SideFit& fit, double floor) {
  return excess / std::max(floor, std::isfinite(fit.error) ? fit.error : 0.0);
}

/// Named by the diagnosis of that side, or a model without it, refitted, leaves two floors more; not where
/// its amount has gone to nothing.
bool is_there(const Side& side, const SideFit& fit, const PlannedRow& planned, bool in_diagnosis,
              double floor) {
  if (is_absent(fit, planned)) return false;
  if (in_diagnosis) return true;
  ReferenceModel without = fit.model;
  without.effects.erase(without.effects.begin() + planned.effect);
  return in_floors(excess(fit_side(side, without), fit), fit, floor) > kLeastRow;
}

FoundIn found_in(const RowInstrument& of, const JointFit& fit, const PlannedRow& planned) {
  const JointEffect& e = fit.effects[static_cast<std::size_t>(planned.effect)];
  const bool in_drive = is_there(of.drive, fit.drive, planned, e.in_drive, of.floor);
  const bool in_simulator = is_there(of.simulator, fit.simulator, planned, e.in_simulator, of.floor);
  if (in_drive) return in_simulator ? FoundIn::kBoth : FoundIn::kDrive;
  return in_simulator ? FoundIn::kSimulator : FoundIn::kNeither;
}

}  // namespace

void measure(const RowInstrument& of, const JointFit& fit, PlannedRow& planned) {
  SimulatorRow& row = planned.row;
  fill_numbers(of, fit, planned);
  const SideFit drive = fit_side(of.drive, pinned(fit.drive.model, fit.simulator.model, planned.ids));
  const SideFit simulator = fit_side(of.simulator, pinned(fit.simulator.model, fit.drive.model, planned.ids));
  const double of_drive = excess(drive, fit.drive), of_simulator = excess(simulator, fit.simulator);
  row.size = std::min(of_drive, of_simulator);
  row.floors =
      std::min(in_floors(of_drive, fit.drive, of.floor), in_floors(of_simulator, fit.simulator, of.floor));
  row.differs = row.floors > kLeastRow && intervals_apart(row);
  if (row.is_effect) row.found_in = found_in(of, fit, planned);
}

}  // namespace gapscope::internal::diagnosis

#include "diagnosis/simulator_rows.h"

#include "base/normal.h"

namespace gapscope {
namespace {

/// Of what says how much there is of the row's effect; nullptr: it says something else.
const EffectParameterSpec* spec_of_amount(const SimulatorRow& row, const std::string& key) {
  const EffectEntry* entry = row.is_effect ? find_effect(row.name) : nullptr;
  if (entry == nullptr) return nullptr;
  for (const std::size_t i : internal::diagnosis::sizes_of(*entry))
    if (key == entry->parameters[i].key) return &entry->parameters[i];
  return nullptr;
}

}  // namespace

bool says_how_much(const SimulatorRow& row, const ComparedNumber& number) {
  return spec_of_amount(row, number.key) != nullptr;
}

bool says_none(const SimulatorRow& row, const ComparedNumber& number, double value) {
  const EffectParameterSpec* amount = spec_of_amount(row, number.key);
  return amount != nullptr && value == amount->absent;
}

namespace internal::diagnosis {
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
    if (!fit.drive.model.parameters[i].estimate || !has_parameter(fit.drive.model.structure, i)) continue;
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
bool lacks_row(const SideFit& fit, const PlannedRow& planned) {
  return planned.row.is_effect && is_absent(fit.model.effects[planned.effect]);
}

std::vector<double> spreads_on(const Side& side, const SideFit& fit, const PlannedRow& planned) {
  if (lacks_row(fit, planned)) return std::vector<double>(planned.ids.size(), kNaN);
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
      const EffectParameterSpec& spec = fit.effects[id.effect].drive.entry->parameters[id.index];
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

/// Where a side's interval ends, from its number on; an amount of an effect that is not there is exactly
/// that.
double reach(const SimulatorRow& row, const ComparedNumber& n, double number, const Interval& ci95) {
  return says_none(row, n, number) ? 0.0 : (ci95.high - ci95.low) / 2.0;
}

/// Whether the intervals of any number are apart; where there are none, nothing speaks against it.
bool intervals_apart(const SimulatorRow& row) {
  bool asked = false;
  for (const ComparedNumber& n : row.numbers) {
    const double d = reach(row, n, n.drive, n.drive_ci95);
    const double s = reach(row, n, n.simulator, n.simulator_ci95);
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
  if (lacks_row(fit, planned)) return false;
  if (in_diagnosis) return true;
  ReferenceModel without = fit.model;
  without.effects.erase(without.effects.begin() + planned.effect);
  return in_floors(excess(fit_side(side, without), fit), fit, floor) > kLeastRow;
}

FoundIn found_in(const RowInstrument& of, const JointFit& fit, const PlannedRow& planned) {
  const JointEffect& e = fit.effects[planned.effect];
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

}  // namespace internal::diagnosis
}  // namespace gapscope

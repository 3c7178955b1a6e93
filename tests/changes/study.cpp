// What changed between two groups of recordings, in a series of ten and among ten units, on drives that the
// plant makes which shares no code with the fit.
// study_changes pairs FIRST COUNT     groups of 2 or 3 recordings, one number changed by 5 to 60 %, or none
// study_changes series FIRST COUNT    reports in order, with and without a change at a drawn date
// study_changes units FIRST COUNT     ten units, with and without an odd one
// Pairs are fitted; series and units are reports whose values scatter by their own standard errors, of 0.3 to
// 5 %, and units by 0.5 to 3 % from one to the next.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <string>

#include "base/normal.h"
#include "base/random.h"
#include "changes/changes.h"
#include "changes/series.h"
#include "gapscope/plant/effect.h"
#include "reference/rigs.h"

namespace gapscope {
namespace {

using namespace test;

// What may change, by the key of the fit.
const std::vector<std::string> kQuantities = {"gap",
                                              "load_coulomb_friction",
                                              "contact_stiffness",
                                              "mass_ratio",
                                              "cogging_torque.amplitude_nm",
                                              "load_unbalance.amplitude_nm",
                                              "input_delay.delay_s"};
constexpr double kRate = 1000.0, kDuration = 3.0;

double& number_of(independent_plant::BlindDrive& d, std::size_t quantity) {
  switch (quantity) {
    case 0:
      return d.gap;
    case 1:
      return d.load_coulomb;
    case 2:
      return d.contact_stiffness;
    case 3:
      return d.load_inertia;
    case 4:
      return d.effects.motor.cogging.amplitude;
    case 5:
      return d.effects.load.unbalance_nm;
    default:
      return d.effects.command.delay_s;
  }
}

/// As the fit has it.
double value_of(const independent_plant::BlindDrive& d, std::size_t quantity) {
  independent_plant::BlindDrive copy = d;
  const double v = number_of(copy, quantity);
  return quantity == 3 ? v / d.motor_inertia : v;
}

struct Pair {
  independent_plant::BlindDrive before, after;
  std::vector<BlindRig> first, second;
  int changed = -1;  ///< place in kQuantities; -1: nothing
  double by = 0.0;   ///< relative
};

BlindRig recorded(const independent_plant::BlindDrive& d, std::mt19937_64& g) {
  BlindRig rig;
  rig.drive = d;
  rig.sensor = independent_plant::BlindSensor::with_bits(18, uniform(g, 0.3, 1.0));
  rig.options = {kRate, kDuration, g(), independent_plant::kFastTolerance};
  const bool sine = uniform(g, 0.0, 1.0) < 0.5;
  rig.excitation.waveform =
      sine ? independent_plant::Waveform::kSine : independent_plant::Waveform::kMultisine;
  rig.excitation.frequency = sine ? uniform(g, 0.8, 1.6) : 0.6;
  rig.excitation.amplitude *= (sine ? 1.2 : 1.8) * uniform(g, 0.8, 1.4);
  rig.drive.x2 = 0.4 * d.gap * uniform(g, -1.0, 1.0);
  return rig;
}

Pair draw(std::uint64_t seed) {
  auto g = random_stream(seed, "what changed");
  Pair p;
  independent_plant::BlindDrive& d = p.before;
  d.gap = log_uniform(g, 8e-3, 40e-3);
  d.load_inertia = d.motor_inertia * log_uniform(g, 0.5, 3.0);
  d.contact_stiffness = log_uniform(g, 100.0, 600.0);
  d.load_coulomb = uniform(g, 0.01, 0.04);
  d.effects.motor.cogging.amplitude = uniform(g, 0.004, 0.012);
  d.effects.motor.cogging.phase_rad = uniform(g, -1.0, 1.0);
  d.effects.load.unbalance_nm = uniform(g, 0.01, 0.03);
  d.effects.command.delay_s = uniform(g, 0.5, 2.0) / kRate;
  p.after = d;
  p.changed = static_cast<int>(seed % (kQuantities.size() + 1)) - 1;
  p.by = uniform(g, 0.05, 0.6) * (uniform(g, 0.0, 1.0) < 0.5 ? -1.0 : 1.0);
  if (p.changed >= 0) number_of(p.after, static_cast<std::size_t>(p.changed)) *= 1.0 + p.by;
  const int count = 2 + static_cast<int>(seed / 8 % 2);
  for (int i = 0; i < count; ++i) p.first.push_back(recorded(p.before, g));
  for (int i = 0; i < count; ++i) p.second.push_back(recorded(p.after, g));
  return p;
}

/// What the configuration of such a drive would say: motor and contact damping known, the rest sought from
/// the numbers of a sheet.
ReferenceModel model_of(const independent_plant::BlindDrive& sheet) {
  ReferenceModel model = known_model(sheet);
  for (const int number :
       {kMotorDamping, kMassRatio, kGap, kLoadDamping, kLoadCoulombFriction, kContactStiffness})
    estimate(model, number, model.parameters[number].value);
  const auto& e = sheet.effects;
  ModelEffect cogging{find_effect("cogging_torque"), {}}, unbalance{find_effect("load_unbalance"), {}},
      delay{find_effect("input_delay"), {}};
  for (ParameterSetting& s : cogging.parameters) s = ParameterSetting::known(0.0);
  cogging.parameters[0] = ParameterSetting::sought(e.motor.cogging.amplitude);
  cogging.parameters[1] = ParameterSetting::known(e.motor.cogging.periods_per_turn);
  cogging.parameters[2] = ParameterSetting::sought(e.motor.cogging.phase_rad);
  unbalance.parameters[0] = ParameterSetting::sought(e.load.unbalance_nm);
  unbalance.parameters[1] = ParameterSetting::known(0.0);
  unbalance.parameters[2] = ParameterSetting::known(1.0);
  delay.parameters[0] = ParameterSetting::sought(e.command.delay_s);
  model.effects = {cogging, unbalance, delay};
  return model;
}

DriveReport fitted(const std::string& name, const std::vector<BlindRig>& rigs, const ReferenceModel& model) {
  std::vector<Recording> recordings;
  for (const BlindRig& rig : rigs) recordings.push_back(rig.recording());
  std::vector<MotorTrace> traces;
  for (const Recording& r : recordings) traces.push_back(r.motor_trace());
  DriveReport report;
  report.folder = report.name = name;
  FitOptions options;
  options.starts = 2;
  report.reference = fit(traces, model, options);
  return report;
}

/// How far the motion of the second group is from that of the unchanged drive, over the encoder's floor.
double floors_of(const Pair& p) {
  double square = 0.0, count = 0.0;
  for (BlindRig rig : p.second) {
    const auto with =
        independent_plant::simulate_blind(rig.drive, rig.excitation, rig.sensor, rig.options).truth.x1;
    const double x2 = rig.drive.x2;
    rig.drive = p.before, rig.drive.x2 = x2;
    const auto without =
        independent_plant::simulate_blind(rig.drive, rig.excitation, rig.sensor, rig.options).truth.x1;
    const double floor = std::hypot(rig.sensor.quantum / std::sqrt(12.0), rig.sensor.noise);
    for (std::size_t i = 0; i < with.size(); ++i)
      square += std::pow((with[i] - without[i]) / floor, 2), count += 1.0;
  }
  return std::sqrt(square / count);
}

bool names(const WhichDiffers& w, const std::string& key) {
  return std::ranges::find(w.numbers, key, &DifferingNumber::key) != w.numbers.end();
}

/// What is named is another number, and none that it calls alike is the one.
bool names_another(const WhichDiffers& w, const std::string& key) {
  return std::ranges::any_of(w.numbers, [&](const DifferingNumber& n) {
    return n.key != key && std::ranges::find(n.look_alikes, key) == n.look_alikes.end();
  });
}

struct PairCounts {
  int seen = 0, named = 0, alone = 0, one_of = 0, wrong = 0, none = 0, unfit = 0;
  int same = 0, same_told = 0, rows = 0, rows_wrong = 0, inside = 0, row_right = 0;
};

void count_rows(const Pair& p, const DriveChanges& all, PairCounts& n) {
  for (const DriveQuantity& q : all.quantities) {
    const auto place = std::ranges::find(kQuantities, q.key);
    if (q.from != "reference" || place == kQuantities.end() || !std::isfinite(q.changes[0].ci95.low))
      continue;
    const auto i = static_cast<std::size_t>(place - kQuantities.begin());
    const double truth = value_of(p.after, i) - value_of(p.before, i);
    const Change& c = q.changes[0];
    ++n.rows;
    const bool inside = c.ci95.low <= truth && truth <= c.ci95.high;
    n.inside += inside;
    if (!inside)
      fmt::print("  {} {:.6g} to {:.6g}, in truth {:.6g}\n", q.key, c.ci95.low, c.ci95.high, truth);
    const bool changed = c.verdict == ChangeVerdict::kChanged;
    n.rows_wrong += changed && truth == 0.0;
    n.row_right += changed && truth != 0.0 && c.difference * truth > 0.0;
  }
}

void count_pair(std::uint64_t seed, PairCounts& n) {
  const Pair p = draw(seed);
  const ReferenceModel model = model_of(p.before);
  const std::vector<DriveReport> reports = {fitted("a", p.first, model), fitted("b", p.second, model)};
  const DriveChanges all = changes(reports);
  const WhichDiffers& w = all.which.front();
  const std::string truth = p.changed < 0 ? "nothing" : kQuantities[static_cast<std::size_t>(p.changed)];
  std::string told = std::to_string(static_cast<int>(w.verdict));
  for (const DifferingNumber& d : w.numbers) told += fmt::format(" {}({})", d.key, d.look_alikes.size());
  for (const std::string& key : w.one_of) told += " ?" + key;
  const double floors = p.changed < 0 ? 0.0 : floors_of(p);
  fmt::print(
      "{} {} {:+.0f} % {:.1f} floors: {} p {:.2g}, rest {:.2g}, off {:.4g} {:.4g} {:.4g}, trust {} {}\n",
      seed, truth, 100.0 * p.by, floors, told, w.p_same, w.p_rest, w.off_shared, w.off_named, w.off_free,
      to_string(reports[0].reference->trust), to_string(reports[1].reference->trust));
  std::fflush(stdout);
  n.unfit += w.verdict == WhichVerdict::kNotAsked;
  count_rows(p, all, n);
  if (p.changed < 0) {
    ++n.same;
    n.same_told += w.verdict == WhichVerdict::kNone;
  } else if (floors >= 2.0) {
    ++n.seen;
    n.named += names(w, truth);
    n.alone += names(w, truth) && w.numbers.size() == 1;
    n.one_of += !names(w, truth) && std::ranges::find(w.one_of, truth) != w.one_of.end();
    n.wrong += names_another(w, truth);
    n.none += w.verdict == WhichVerdict::kNone;
  }
}

void count_pairs(std::uint64_t first, int count) {
  PairCounts n;
  for (int i = 0; i < count; ++i) count_pair(first + static_cast<std::uint64_t>(i), n);
  fmt::print(
      "of {} that leave two floors: named {} (as the only one {}), among several that may {}, another one {}, none {}; not "
      "asked {} of all\n"
      "of {} in which nothing changed: none {}\n"
      "rows: {} differences, {} within their 95 %; changed rightly {}, wrongly {}\n",
      n.seen, n.named, n.alone, n.one_of, n.wrong, n.none, n.unfit, n.same, n.same_told, n.rows, n.inside,
      n.row_right, n.rows_wrong);
}

/// Reports of eight quantities, of which one may change.
constexpr int kCount = 10, kQuantityCount = 8;

DriveChanges drawn_reports(std::mt19937_64& g, double unlike, int quantity, double factor, int from, int to) {
  DriveChanges all;
  for (int i = 0; i < kCount; ++i) all.reports.push_back(fmt::format("r{}", i));
  for (int k = 0; k < kQuantityCount; ++k) {
    DriveQuantity q;
    q.key = fmt::format("q{}", k), q.from = "reference";
    for (int i = 0; i < kCount; ++i) {
      const double std = log_uniform(g, 0.003, 0.05);
      double v = 1.0 + unlike * normal(g);
      if (k == quantity && i >= from && i < to) v *= factor;
      v += std * normal(g);
      Observation o;
      o.value = v, o.std = std, o.ci95 = normal_interval(v, std);
      q.observed.push_back(o);
    }
    all.quantities.push_back(q);
  }
  return all;
}

double drawn_factor(std::mt19937_64& g) {
  return 1.0 + uniform(g, 0.05, 0.6) * (uniform(g, 0.0, 1.0) < 0.5 ? -1.0 : 1.0);
}

void count_series(std::uint64_t first, int count) {
  int found = 0, late = 0, wrong = 0, alarms = 0;
  for (int i = 0; i < count; ++i) {
    auto g = random_stream(first + static_cast<std::uint64_t>(i), "a series of ten");
    const int at = 2 + static_cast<int>(g() % 7), quantity = static_cast<int>(g() % kQuantityCount);
    for (const QuantityCourse& c :
         internal::changes::courses(drawn_reports(g, 0.0, quantity, drawn_factor(g), at, kCount))) {
      if (c.since < 0) continue;
      const bool right = c.key == fmt::format("q{}", quantity);
      found += right && std::abs(c.since - at) <= 1;
      late += right && std::abs(c.since - at) > 1;
      wrong += !right;
    }
    const std::vector<QuantityCourse> still =
        internal::changes::courses(drawn_reports(g, 0.0, -1, 1.0, 0, 0));
    alarms += std::ranges::any_of(still, [](const QuantityCourse& c) { return c.since >= 0; });
  }
  fmt::print(
      "of {} series with a change: found within one report {}, elsewhere {}, another quantity {}\n"
      "of {} without: an alarm in {}\n",
      count, found, late, wrong, count, alarms);
}

/// Units of one batch lie 0.5 to 3 % apart.
void count_units(std::uint64_t first, int count) {
  int found = 0, found_large = 0, large = 0, wrong = 0, alarms = 0;
  for (int i = 0; i < count; ++i) {
    auto g = random_stream(first + static_cast<std::uint64_t>(i), "ten units");
    const int unit = static_cast<int>(g() % kCount), quantity = static_cast<int>(g() % kQuantityCount);
    const double unlike = log_uniform(g, 0.005, 0.03), factor = drawn_factor(g);
    const DriveChanges all = drawn_reports(g, unlike, quantity, factor, unit, unit + 1);
    const double error =
        all.quantities[static_cast<std::size_t>(quantity)].observed[static_cast<std::size_t>(unit)].std;
    const bool is_large = std::abs(factor - 1.0) > 6.0 * std::hypot(unlike, error);
    const auto odd = internal::changes::odd_units(all);
    const bool right =
        !odd.empty() && odd.front().report == unit && odd.front().key == fmt::format("q{}", quantity);
    found += right, large += is_large, found_large += right && is_large;
    wrong += std::ranges::any_of(odd, [&](const OddUnit& o) { return o.report != unit; });
    alarms += !internal::changes::odd_units(drawn_reports(g, unlike, -1, 1.0, 0, 0)).empty();
  }
  fmt::print(
      "of {} odd units: named first {}; of {} that lie more than six errors and spreads off {}; another one named "
      "in {}\nof {} fleets without an odd one: one named in {}\n",
      count, found, large, found_large, wrong, count, alarms);
}

}  // namespace
}  // namespace gapscope

int main(int argc, char** argv) {
  const std::string what = argc > 1 ? argv[1] : "";
  const std::uint64_t first = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1;
  const int count = argc > 3 ? std::atoi(argv[3]) : 24;
  if (what == "pairs")
    gapscope::count_pairs(first, count);
  else if (what == "series")
    gapscope::count_series(first, count);
  else if (what == "units")
    gapscope::count_units(first, count);
  else
    return fmt::print("study_changes pairs|series|units FIRST COUNT\n"), 2;
}

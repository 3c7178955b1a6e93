#include "reference/fit_problem.h"

#include <algorithm>
#include <cmath>

#include "base/require.h"
#include "reference/controller_numbers.h"
#include "reference/torque_scale.h"
#include "signals/encoder.h"

namespace gapscope::internal::reference {
namespace {

using namespace place;

/// Rates [1/sample] that a recording can still show, for derived bounds, and beyond which no trial is made.
/// The latter alone bounds what acts on a free load and has no start: the inertia that the recording suggests
/// may be a tenth of the drive's, and with a third of this rate the true stiffness was beyond its bound
/// (`study_reference 592009 1 rubs`, the gap 5.9 standard errors off; with 4 and 12 it is found as with 6).
/// With it `590001 24 rubs` has 21 at the optimum for 20, 24 not rejected for 22 and 23 that hold for 21,
/// `unknown` 22, 24 and 20 for 20, 23 and 21. Of a locked output more leaves no play for the gap.
constexpr double kVisible = 2.0;
constexpr double kFastest = 6.0;
constexpr double kBeyond = 1.5;  ///< a given start over the most that there can be: it is of another unit

/// Whether what the inertia says in the balance stands out of what that leaves, to which the impacts of a
/// free load add. Elsewhere it may be a hundredth of the drive's, or below zero: docs/science.md, "The
/// inertia".
bool tells_inertia(const signals::OneBody& rough) {
  return rough.inertia > 0.0 && rough.inertia_over_left >= 1.0;
}

/// Of a free load whose inertia the balance does not tell, the one that would be as large as what it leaves.
/// @param otherwise  where it tells nothing at all
double inertia_of(const signals::OneBody& rough, bool free_load, double otherwise) {
  if (free_load && !tells_inertia(rough) && rough.inertia_over_left > 0.0)
    return std::abs(rough.inertia) / rough.inertia_over_left;
  return rough.inertia > 0.0 ? rough.inertia : otherwise;
}

/// The size that each number probably has, from the balance of the recordings and the numbers that are given.
/// @param constant  torque per unit of u where it is not given
std::array<double, kDriveParameterCount> suggested(const signals::OneBody& rough, const ReferenceModel& model,
                                                   double constant) {
  const auto given = [&](int n, double otherwise) {
    const double v = model.parameters[n].value;
    return v > 0.0 ? v : otherwise;
  };
  std::array<double, kDriveParameterCount> s{};
  const bool free_load = model.structure.has_load && model.structure.load == LoadKind::kFree;
  const double km = s[kTorqueConstant] = given(kTorqueConstant, constant);
  const double peak = std::max(km * rough.peak_input, 1e-300);
  const double speed = std::max(rough.speed, 1e-300), travel = std::max(rough.travel, 1e-300);
  const double inertia = km * inertia_of(rough, free_load, 0.01 * peak / (km * speed));
  const double drag =
      peak / std::max(rough.peak_speed, speed);  // at top speed damping takes the torque at most
  const bool locked = model.structure.has_load && !free_load;  // whose balance knows nothing of the contact
  const double damping = rough.damping > 0.0 && !locked ? std::min(km * rough.damping, drag) : 0.3 * drag;
  s[kMotorInertia] = given(kMotorInertia, free_load ? 0.5 * inertia : inertia);
  s[kMotorDamping] = free_load ? 0.5 * damping : damping;
  s[kMassRatio] = given(kMassRatio, std::clamp(inertia / s[kMotorInertia] - 1.0, 0.1, 10.0));
  s[kGap] = (locked ? 0.5 : 0.2) * travel;
  s[kLoadDamping] = 0.5 * damping;
  s[kLoadCoulombFriction] = std::clamp(km * rough.friction, 0.02 * peak, 0.6 * peak);
  s[kContactStiffness] = free_load ? 6.0 * peak / given(kGap, s[kGap]) : 4.0 * peak / travel;
  const double mu = s[kMassRatio];
  const double reduced = s[kMotorInertia] * (free_load ? mu / (1.0 + mu) : 1.0);
  s[kContactDamping] = 0.2 * std::sqrt(given(kContactStiffness, s[kContactStiffness]) * reduced);
  return s;
}

Interval derived_bounds(int number, double start, bool given, double suggestion,
                        const signals::OneBody& rough) {
  switch (number) {
    case kGap:
      return {0.0, std::max(rough.travel, 1e-12)};
    case kContactStiffness:  // of which nothing is known, what the recording can show is the upper bound
      return {0.01 * start, given ? 100.0 * start : kInfinity};
    case kContactDamping:  // likewise: the suggestion is that of a contact as soft as the travel allows
      return {0.0, given ? std::max(100.0 * start, 10.0 * suggestion) : kInfinity};
    case kMotorInertia:
    case kTorqueConstant:
    case kMassRatio:
      return {0.01 * start, 100.0 * start};
    default:
      return {0.0, std::max(100.0 * start, 10.0 * suggestion)};
  }
}

/// The value at which a number of dampers and springs is as fast as a recording can show.
double visible(int number, bool given, const std::array<double, kDriveParameterCount>& sizes,
               const DriveStructure& structure, double dt) {
  const bool locked = structure.load == LoadKind::kLocked;
  const double m1 = sizes[kMotorInertia], mu = sizes[kMassRatio];
  const double rate = (locked || given ? kVisible : kFastest) / dt,
               reduced = locked ? m1 : m1 * mu / (1.0 + mu);
  switch (number) {
    case kMotorDamping:
      return m1 * rate;
    case kLoadDamping:
      return m1 * mu * rate;
    case kContactStiffness:
      return reduced * rate * rate;
    case kContactDamping:  // likewise: the suggestion is that of a contact as soft as the travel allows
      return reduced * rate;
    default:
      return kInfinity;
  }
}

/// Least value that the equations of motion allow.
double lowest_sensible(int number, double typical) {
  return number == kMotorInertia || number == kMassRatio || number == kContactStiffness ? 1e-4 * typical
                                                                                        : -kInfinity;
}

Parameter start_parameter(ParameterId id, const ParameterSetting& setting, double suggestion) {
  Parameter p;
  p.id = id;
  p.estimated = setting.estimate;
  p.given = std::isfinite(setting.value);
  GAPSCOPE_REQUIRE(p.given || p.estimated);
  p.start = p.given ? setting.value : suggestion;
  p.prior = setting.prior;
  return p;
}

void set_bounds(Parameter& p, const ParameterSetting& setting, const Interval& derived, double lowest) {
  p.low = std::max(std::isfinite(setting.low) ? setting.low : derived.low, lowest);
  p.high = std::max(std::isfinite(setting.high) ? setting.high : derived.high, p.low);
  p.start = std::clamp(p.start, p.low, p.high);
}

Parameter parameter_of_drive(int number, const ParameterSetting& setting, double suggestion, double most,
                             const signals::OneBody& rough) {
  Parameter p = start_parameter(drive_number(number), setting, suggestion);
  p.key = kDriveParameters[number].key;
  p.unit = kDriveParameters[number].unit;
  if (!p.estimated) return p;
  p.typical = p.start > 0.0 ? p.start : suggestion;
  Interval derived = derived_bounds(number, p.start, p.given, suggestion, rough);
  derived.high = std::min(derived.high, p.given ? std::max(most, 3.0 * p.start) : most);
  if (number == kGap)
    p.start = std::min(p.start, 0.9 * derived.high);  // at the travel itself no contact is made
  set_bounds(p, setting, derived, lowest_sensible(number, p.typical));
  p.coordinate = Coordinate::logarithmic(p.typical);
  return p;
}

Parameter parameter_of_effect(ParameterId id, const EffectEntry& effect, const ParameterSetting& setting,
                              const ScaleContext& context) {
  const EffectParameterSpec& spec = effect.parameters[id.index];
  const double scale = scale_value(spec.scale, context);
  const double usual = spec.low * scale + 0.1 * (spec.high - spec.low) * scale;
  Parameter p = start_parameter(id, setting, usual);
  p.key = std::string(effect.name) + "." + spec.key;
  p.unit = spec.unit;
  if (!p.estimated) return p;
  p.amount = spec.absent == 0.0 && spec.low == 0.0;
  const bool known_period = p.given && id.index == effect.period_at() && effect.turns_with != Shaft::kNone;
  const Interval derived =
      known_period ? Interval{0.5 * p.start, 2.0 * p.start} : Interval{spec.low * scale, spec.high * scale};
  if (p.given && std::isnan(setting.high) && p.start > kBeyond * derived.high) {
    p.impossible = p.start;
    p.given = false;
    p.start = usual;
  }
  set_bounds(p, setting, derived, -kInfinity);
  p.typical = p.start != 0.0 ? std::abs(p.start) : 0.01 * std::max(std::abs(p.low), std::abs(p.high));
  p.coordinate = p.low >= 0.0 ? Coordinate::logarithmic(p.typical) : Coordinate::linear(p.start, p.typical);
  return p;
}

/// A gap that another estimate has read, where the model names none: the search begins there, and still looks
/// everywhere.
ReferenceModel with_gap_seed(ReferenceModel model, const FitOptions& options) {
  ParameterSetting& gap = model.parameters[kGap];
  if (options.gap_seed && *options.gap_seed > 0.0 && gap.estimate && std::isnan(gap.value))
    gap.value = *options.gap_seed;
  return model;
}

void add_drive(FitProblem& problem, const ReferenceModel& model,
               const std::array<double, kDriveParameterCount>& sizes) {
  for (int n = 0; n < kDriveParameterCount; ++n) {
    if (!has_parameter(model.structure, n)) continue;
    const auto i = static_cast<std::size_t>(n);
    const double most = visible(n, std::isfinite(model.parameters[i].value), sizes, model.structure,
                                problem.recordings.front().dt);
    problem.parameters.push_back(parameter_of_drive(n, model.parameters[i], sizes[i], most, problem.rough));
    const Parameter& p = problem.parameters.back();
    if (n == kLoadCoulombFriction) problem.load_may_stick = p.estimated || p.start > 0.0;
  }
}

/// What the bounds of effects are measured in.
ScaleContext scales(const FitProblem& problem, const std::array<double, kDriveParameterCount>& sizes) {
  ScaleContext context;
  const MotorTrace& first = problem.recordings.front();
  context.peak_input = problem.rough.peak_input;
  context.peak_speed = problem.rough.peak_speed;
  context.travel = problem.rough.travel;
  context.quantum = std::max(first.quantum, problem.floors.front());
  context.dt = first.dt;
  context.duration = first.dt * static_cast<double>(first.size());
  for (int n = 0; n < kDriveParameterCount; ++n) drive_parameter(context.nominal, n) = sizes[n];
  for (const Parameter& p : problem.parameters) drive_parameter(context.nominal, p.id.index) = p.start;
  return context;
}

void add_effects(FitProblem& problem, const ReferenceModel& model, const ScaleContext& context) {
  for (std::size_t e = 0; e < model.effects.size(); ++e) {
    const ModelEffect& effect = model.effects[e];
    GAPSCOPE_REQUIRE(effect.entry != nullptr);
    problem.effects.push_back(effect.entry);
    for (std::size_t i = 0; i < effect.entry->parameters.size(); ++i)
      problem.parameters.push_back(parameter_of_effect({static_cast<int>(e), static_cast<int>(i)},
                                                       *effect.entry, effect.parameters[i], context));
  }
}

}  // namespace

bool Parameter::at_bound(double q) const {
  const double least = coordinate.solver(low), most = coordinate.solver(high);
  const double near = 1e-6 * (most - least);
  return q <= least + near || q >= most - near;
}

std::vector<int> FitProblem::free_states(const RecordingStart& start, bool free_run) const {
  std::vector<int> states;
  if (free_run) states.push_back(0);  // an observer has corrected it after a few samples
  if (start.moves || !recorded_may_stick())
    states.push_back(1);  // a body that sticks has no other speed than 0
  if (structure.has_load) states.push_back(2);
  if (structure.has_load && !locked() && start.variant.other_moves) states.push_back(3);
  return states;
}

double FitProblem::stiffness(const ModelNumbers<double>& n) const {
  const double m1 = n.drive(kMotorInertia);
  double rate = n.drive(kMotorDamping) / m1;
  if (!structure.has_load) return rate;
  const double inverse = 1.0 / m1 + (locked() ? 0.0 : 1.0 / (m1 * n.drive(kMassRatio)));
  if (!locked()) rate = std::max(rate, n.drive(kLoadDamping) / (m1 * n.drive(kMassRatio)));
  return rate + std::sqrt(n.drive(kContactStiffness) * inverse) + n.drive(kContactDamping) * inverse;
}

FitProblem with_law(const FitProblem& problem, const EffectEntry& law, std::span<const double> begins,
                    FitPoint& from) {
  FitProblem more = problem;
  for (std::size_t i = 0; i < problem.free_count(); ++i)
    more.parameters[problem.free[i]].start = problem.free_parameter(i).coordinate.physical(from.q[i]);
  const ScaleContext context = scales(more, {});
  const int place = static_cast<int>(more.effects.size());
  more.effects.push_back(&law);
  for (std::size_t i = 0; i < law.parameters.size(); ++i) {
    const EffectParameterSpec& spec = law.parameters[i];
    ParameterSetting setting;
    setting.estimate = !std::isnan(begins[i]);
    setting.value = (setting.estimate ? begins[i] : spec.absent) * scale_value(spec.scale, context);
    more.parameters.push_back(parameter_of_effect({place, static_cast<int>(i)}, law, setting, context));
    const Parameter& p = more.parameters.back();
    if (!p.estimated) continue;
    more.free.push_back(static_cast<int>(more.parameters.size()) - 1);
    from.q.push_back(p.coordinate.solver(p.start));
  }
  return more;
}

FitProblem make_problem(std::span<const MotorTrace> recordings, const ReferenceModel& given,
                        const FitOptions& options) {
  GAPSCOPE_REQUIRE(!recordings.empty());
  GAPSCOPE_REQUIRE(!given.structure.reads_load() || given.structure.load == LoadKind::kFree);
  for (const MotorTrace& r : recordings) {
    GAPSCOPE_REQUIRE(r.size() >= kFewestFitted);
    GAPSCOPE_REQUIRE(r.u.size() == r.size());
  }
  const ReferenceModel model = with_gap_seed(given, options);
  FitProblem problem;
  problem.recordings = recordings;
  problem.structure = model.structure;
  problem.options = options;
  if (model.controller) command_inputs(problem, model);
  const ParameterSetting& constant = model.parameters[kTorqueConstant];
  const bool scaled = constant.estimate && std::isnan(constant.value);
  TorqueScale scale{.body = {}, .constant = 1.0};
  if (scaled)
    scale = torque_scale(problem.recordings, model);
  else
    scale.body = signals::as_one_body(problem.recordings);
  problem.rough = scale.body;
  for (const MotorTrace& r : recordings) problem.floors.push_back(signals::encoder_floor(r));
  const std::array<double, kDriveParameterCount> sizes =
      suggested(problem.rough, model, scale.constant > 0.0 ? scale.constant : 1.0);
  if (problem.structure.has_load && !problem.locked() && tells_inertia(problem.rough))
    problem.inertia = sizes[kTorqueConstant] * problem.rough.inertia;
  add_drive(problem, model, sizes);
  for (Parameter& p : problem.parameters)
    if (p.id == drive_number(kGap)) p.given = std::isfinite(given.parameters[kGap].value);
  const ScaleContext context = scales(problem, sizes);
  if (model.controller) add_controller(problem, *model.controller);
  add_effects(problem, model, context);
  for (std::size_t i = 0; i < problem.parameters.size(); ++i)
    if (problem.parameters[i].estimated) problem.free.push_back(static_cast<int>(i));
  std::vector<double> q;
  for (std::size_t i = 0; i < problem.free_count(); ++i)
    q.push_back(problem.free_parameter(i).coordinate.solver(problem.free_parameter(i).start));
  const ModelNumbers<double> numbers = problem.numbers(q.data());
  problem.motor_may_stick = problem.plant_model(numbers).motor_sticks;
  problem.stiffest = std::max(kFastest / recordings.front().dt, 3.0 * problem.stiffness(numbers));
  return problem;
}

}  // namespace gapscope::internal::reference

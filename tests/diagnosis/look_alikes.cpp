#include "diagnosis/look_alikes.h"

#include <cmath>

#include "diagnosis/candidates.h"
#include "diagnosis/study.h"
#include "independent_plant/severity.h"

namespace gapscope::test {
namespace {

using namespace gapscope::internal::diagnosis;

constexpr double kHz = 3.0;
constexpr double kSeverity = 0.6;

independent_plant::BlindCase slow_case(std::uint64_t seed) {
  independent_plant::BlindCase c;
  c.options = {1000.0, 5.0, seed, independent_plant::kFastTolerance};
  c.sensor = independent_plant::BlindSensor::with_bits(16, 0.5);
  c.excitation.amplitude = 0.8;
  c.excitation.frequency = 0.5;
  return c;
}

ReferenceModel sheet_of(const independent_plant::BlindDrive& d, std::uint64_t seed) {
  const independent_plant::BlindDrive sheet = independent_plant::data_sheet(d, seed);
  const double values[kDriveParameterCount] = {sheet.motor_inertia, sheet.torque_constant,
                                               sheet.motor_damping, sheet.load_inertia / sheet.motor_inertia,
                                               sheet.gap,           sheet.load_damping,
                                               sheet.load_coulomb,  d.contact_stiffness,
                                               d.contact_damping};
  ReferenceModel model;
  for (std::size_t i = 0; i < kDriveParameterCount; ++i) {
    model.parameters[i].value = values[i];
    model.parameters[i].estimate = i >= 2 && i <= 6;
  }
  return model;
}

}  // namespace

LookAlikes look_alikes(const std::string& truth, const std::string& other, std::uint64_t seed) {
  LookAlikes pair{slow_case(seed), {}, {}};
  const ReferenceModel sheet = sheet_of(pair.drive.drive, seed);
  give_effect(pair.drive, truth, kSeverity, seed);
  pair.recording = simulate_blind(pair.drive).recording;
  const MotorTrace train[] = {pair.recording.motor_trace()};
  const DiagnosisOptions options;
  const Study study = make_study(train, train, sheet, options);
  const FittedModel nominal = fit_nominal(train, sheet, {}, kHz);
  const std::vector<internal::reference::FitLinearisation> bases = bases_of(study, nominal);
  for (const std::string& name : {truth, other}) {
    const EffectEntry& entry = *find_effect(name);
    const FittedModel fitted =
        RacedCandidate(study, nominal, bases, entry, effect_starts(entry), nullptr).refined();
    pair.rivals.push_back({name, fitted.model});
  }
  return pair;
}

double seen_excess(const LookAlikes& pair, const Recording& recorded) {
  const MotorTrace seen[] = {recorded.motor_trace()};
  double left[2];
  for (std::size_t i = 0; i < 2; ++i) left[i] = fit_near(seen, pair.rivals[i].model, {}, kHz).mean_cost;
  ReferenceModel moved = pair.rivals[1].model;  // the other effect on the drive that the truth has found
  moved.parameters = fit_near(seen, pair.rivals[0].model, {}, kHz).model.parameters;
  left[1] = std::min(left[1], fit_near(seen, moved, {}, kHz).mean_cost);
  return std::sqrt(std::max(0.0, left[1] - left[0]));
}

Recording played(const LookAlikes& pair, const NextExperiment& proposal) {
  independent_plant::BlindOptions options = pair.drive.options;
  options.rate = proposal.rate;
  options.duration = proposal.duration;
  options.seed += 1;
  return simulate_blind_command(pair.drive.drive, proposal.u, pair.drive.sensor, options).recording;
}

const std::vector<std::pair<std::string, std::string>>& look_alike_pairs() {
  static const std::vector<std::pair<std::string, std::string>> pairs = {
      {"input_delay", "actuator_lag"},
      {"actuator_lag", "input_delay"},
      {"constant_load_torque", "load_unbalance"},
      {"load_unbalance", "constant_load_torque"},
      {"stribeck_friction", "motor_coulomb_friction"},
      {"shaft_compliance", "impact_damping"},
      {"impact_damping", "shaft_compliance"},
      {"measurement_lag", "input_delay"},
      {"motor_coulomb_friction", "input_dead_zone"},
      {"quadratic_drag", "torque_saturation"}};
  return pairs;
}

}  // namespace gapscope::test

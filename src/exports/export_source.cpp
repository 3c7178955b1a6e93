#include "exports/export_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "base/shown.h"
#include "config/begun_model.h"
#include "gapscope/base/errors.h"
#include "gapscope/simulation/excitation.h"
#include "gapscope/simulation/stepper.h"
#include "run/run_pipeline.h"

namespace gapscope::internal::exports {
namespace {

/// A free run of seconds tells a target's error; over minutes it tells how errors add up to a drift.
constexpr double kLongestJudged = 10.0;  // s

/// Where no encoder is given: one of 20 bit.
constexpr double kUsualQuantum = 2.0 * kPi / (1 << 20);  // rad

double floor_of(const Configuration& c) {
  double quantum = c.position_quantum();
  if (quantum <= 0.0 && c.coordinates.rotational()) quantum = kUsualQuantum;
  return quantum > 0.0 ? quantum / std::sqrt(12.0) : kNaN;
}

std::string stem_of(const std::string& name) {
  std::string stem = name;
  for (char& c : stem)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  return std::isdigit(static_cast<unsigned char>(stem[0])) != 0 ? "drive_" + stem : stem;
}

/// What the user called the drive: the fitted model of a report has a suffix of its own.
std::string name_given(const std::string& name) {
  const bool fitted = name.size() > kFittedSuffix.size() && name.ends_with(kFittedSuffix);
  return fitted ? name.substr(0, name.size() - kFittedSuffix.size()) : name;
}

/// A configuration with `simulation:`, its input known.
ExportSource source_of(const Configuration& c, std::vector<double> u, const std::string& input) {
  const SimulationConfig& s = *c.simulation;
  const std::string name = name_given(c.name);
  ExportSource source{name,  stem_of(name),   c.coordinates, s.plant, s.plant.plant_model(),
                      {},    1.0 / s.rate,    std::move(u),  {},      floor_of(c),
                      input, resolved_yaml(c)};
  source.plant.structure.encoder = EncoderSide::kMotor;  // a simulator's motion is that of the motor
  source.initial = {s.initial.x1, s.initial.w1, s.initial.x2, s.initial.w2};
  source.all_u = source.u;
  if (c.anchor && !std::isnan(c.anchor->mass))
    source.hangs = {c.anchor->mass, c.anchor->arm, c.anchor->gravity};
  const auto most = static_cast<std::size_t>(std::llround(kLongestJudged * s.rate));
  source.u.resize(std::min(source.u.size(), std::max<std::size_t>(most, 1)));
  return source;
}

void require_known(const Configuration& c) {
  for (int i = 0; i < kDriveParameterCount; ++i)
    if (has_parameter(c.model.structure, i) && std::isnan(c.model.parameters[i].value))
      throw ConfigError(c.file,
                        fmt::format("{} of the model is not known, expected its number, or the report folder "
                                    "of a fit or diagnosis in place of the configuration",
                                    kDriveParameters[i].key));
}

ExportSource recorded_source(const Configuration& c) {
  require_known(c);
  const LoadedRecordings loaded = load_recordings(c, UnevenRows::kStamped, [](const std::string&) {});
  const Recording& first = loaded.recordings.front();
  if (!first.even())
    throw ConfigError(c.file,
                      first.file + " has uneven steps, expected resample: {rate: ...} for the export");
  const MotorTrace trace = first.motor_trace();
  const Configuration model = parse_configuration(model_yaml(c, c.reference_model(), "", trace), c.file);
  return source_of(model, first.u, "the input of " + shown(first.file));
}

}  // namespace

ExportSource export_source(const Configuration& c) {
  if (!c.simulation) return recorded_source(c);
  const SimulationConfig& s = *c.simulation;
  if (c.controller) {  // what it asks for is the input of the drive: the goal is that of the controller
    ExportSource source = source_of(c, simulated_recording(c).u, "what the controller makes of its goal");
    source.commanded = true;
    return source;
  }
  const std::string input = s.excitation.kind == ExcitationKind::kRecorded
                                ? "the input of " + shown(s.excitation.file)
                                : std::string("its ") + to_string(s.excitation.kind);
  return source_of(c, sample(s.excitation, s.rate, s.samples(), s.seed), input);
}

std::vector<double> model_motion(const ExportSource& source, const std::vector<double>& times) {
  // Times closer than this are one: what is left of rounding.
  const double same = 1e-7 * source.dt;
  std::vector<double> x1, breaks = times;
  for (std::size_t i = 0; i < source.u.size(); ++i) breaks.push_back(source.dt * static_cast<double>(i));
  std::sort(breaks.begin(), breaks.end());
  const auto last =
      std::unique(breaks.begin(), breaks.end(), [&](double a, double b) { return b - a <= same; });
  breaks.erase(last, breaks.end());
  double shortest = source.dt;
  for (std::size_t i = 1; i < breaks.size(); ++i) shortest = std::min(shortest, breaks[i] - breaks[i - 1]);
  DriveStepper<double> stepper(source.plant, source.dt, shortest);
  stepper.reset(source.initial);
  std::size_t next = 0;
  for (std::size_t i = 0; i < breaks.size() && next < times.size(); ++i) {
    if (times[next] <= breaks[i] + same) x1.push_back(stepper.measured()), ++next;
    const auto sample = static_cast<std::size_t>((breaks[i] + same) / source.dt);
    if (i + 1 < breaks.size())
      stepper.step(source.u[std::min(sample, source.u.size() - 1)], breaks[i + 1] - breaks[i]);
  }
  return x1;
}

}  // namespace gapscope::internal::exports

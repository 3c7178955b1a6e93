#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <string_view>
#include <vector>

#include "base/interrupt.h"
#include "base/require.h"
#include "config/configuration.h"
#include "config/model_config.h"
#include "gapscope/base/errors.h"
#include "gapscope/recording/recording_file.h"
#include "gapscope/simulation/closed_loop.h"
#include "gapscope/simulation/simulate.h"
#include "independent_plant/effects.h"
#include "independent_plant/simulate.h"
#include "recording/lost_rows.h"
#include "results/sha256.h"
#include "run/run_pipeline.h"
#include "run/shared_rows.h"

namespace gapscope {
namespace {

using Values = std::array<double, kMostEffectParameters>;

struct StatedAlike {
  const char* effect;
  void (*apply)(const Values& p, independent_plant::Effects& e);
};

constexpr StatedAlike kStatedAlike[] = {
    {"contact_adhesion", [](const Values& p, independent_plant::Effects& e) { e.contact.release_nm = p[0]; }},
    {"contact_hardening",
     [](const Values& p, independent_plant::Effects& e) {
       e.contact.hardening_per_rad2 = p[0] / (p[1] * p[1]);
       e.contact.hardening_knee_rad = p[1];
     }},
    {"motor_coulomb_friction",
     [](const Values& p, independent_plant::Effects& e) { e.motor.friction.level_nm = p[0]; }},
    {"presliding_friction",
     [](const Values& p, independent_plant::Effects& e) {
       e.motor.bristle = {p[0], p[1], p[2]};
     }},
    {"stribeck_friction", [](const Values& p, independent_plant::Effects& e) {
       e.motor.friction.level_nm = p[0];
       e.motor.friction.stiction_ratio = p[1];
       e.motor.friction.stribeck_speed_rad_s = p[2];
       e.motor.friction.stribeck_exponent = p[3];
     }}};

/// Effects of the catalogue as the independent plant has them: laws of contact and friction that both codes
/// state alike (test_simulation, Rigs). @throws std::logic_error for any that a configuration does not admit.
independent_plant::Effects independent_effects(const std::vector<EffectConfig>& effects) {
  independent_plant::Effects all;
  for (const EffectConfig& e : effects) {
    const auto known = std::find_if(std::begin(kStatedAlike), std::end(kStatedAlike), [&](const auto& k) {
      return std::string_view(k.effect) == e.effect.entry->name;
    });
    GAPSCOPE_REQUIRE(known != std::end(kStatedAlike));
    Values values{};
    std::transform(e.effect.parameters.begin(), e.effect.parameters.end(), values.begin(),
                   [](const ParameterSetting& p) { return p.value; });
    known->apply(values, all);
  }
  return all;
}

/// A row may hold so many time constants of the fastest motion, or the path through an impact in it cannot be
/// followed (and many times more take minutes).
inline constexpr double kMostTimesInARow = 1500.0;

/// What moves fastest in a drive: a body against its damper or, while the gap is closed, both against the
/// contact [1/s].
double fastest_rate(const SimulatedPlant& plant) {
  const DriveParameters<double>& p = plant.drive;
  const double motor = p.motor_damping / p.motor_inertia;
  if (!plant.structure.has_load) return motor;
  const bool locked = plant.structure.load == LoadKind::kLocked;
  const double of_load = locked ? 0.0 : 1.0 / (p.motor_inertia * p.mass_ratio);
  const double bodies = std::max(motor, p.load_damping * of_load);
  if (plant.structure.contact == ContactLaw::kRigid) return bodies;
  const double mobility = 1.0 / p.motor_inertia + of_load;
  return bodies + std::max(std::sqrt(p.contact_stiffness * mobility), p.contact_damping * mobility);
}

/// @throws ConfigError where that is out of all proportion to the rows of the simulation
void require_followable(const Configuration& c) {
  const SimulationConfig& s = *c.simulation;
  const double rate = fastest_rate(s.plant);
  if (rate <= kMostTimesInARow * s.rate) return;
  throw ConfigError(
      c.file, s.line,
      fmt::format(
          "simulates a drive whose fastest motion, of its inertias against dampers and contact, has a "
          "time constant of {:.2g} s: a row holds {:.2g} of them, expected at most {:.0f}: a larger "
          "motor_inertia, a softer contact, less damping, or a rate of {:.2g} Hz",
          1.0 / rate, rate / s.rate, kMostTimesInARow, rate / kMostTimesInARow));
}

/// The file's own name; where two files share it, the path as it was given, without separators, and where a
/// file comes twice, with the window.
std::string name_of(const RecordedFile& file, const std::vector<RecordedFile>& all) {
  const auto own = [](const RecordedFile& f) { return std::filesystem::path(f.path).filename().string(); };
  const auto same = std::count_if(all.begin(), all.end(), [&](const auto& f) { return own(f) == own(file); });
  if (same == 1) return own(file);
  std::string name = file.given;
  std::replace(name.begin(), name.end(), '/', '_');
  const bool again =
      std::count_if(all.begin(), all.end(), [&](const auto& f) { return f.path == file.path; }) > 1;
  return again && file.window ? fmt::format("{} {}..{} s", name, file.window->first, file.window->second)
                              : name;
}

/// The sheet knows better than the samples, but a large difference is worth a word.
void apply_sheet(Recording& r, const Configuration& c, std::vector<std::string>& warnings) {
  const double sheet = c.position_quantum(), seen = r.quantum;
  if (sheet == 0.0) return;
  r.quantum = sheet;
  if (seen == 0.0 || (seen < 1.5 * sheet && seen > sheet / 1.5)) return;
  warnings.push_back(fmt::format("{}: positions step by {:.4g} {} where encoder: says {:.4g}", r.file, seen,
                                 c.coordinates.position_unit(), sheet));
}

Recording read_one(const RecordedFile& file, const Configuration& c, UnevenRows uneven) {
  if (std::error_code unreachable; !std::filesystem::exists(file.path, unreachable))
    throw ConfigError(
        c.file, file.line,
        fmt::format("there is no recording {}, expected a file (relative to this configuration)",
                    file.given));
  return read_recording(file.path, c.recording->reading_of(file, uneven));
}

/// The plant of a configuration in the terms of the independent code.
independent_plant::BlindDrive independent_drive(const SimulationConfig& s) {
  const DriveParameters<double>& p = s.plant.drive;
  const DriveStructure& structure = s.plant.structure;
  independent_plant::BlindDrive d;
  d.load = !structure.has_load                   ? independent_plant::BlindLoad::kNone
           : structure.load == LoadKind::kLocked ? independent_plant::BlindLoad::kLocked
                                                 : independent_plant::BlindLoad::kFree;
  d.contact = structure.contact == ContactLaw::kRigid ? independent_plant::ContactKind::kRigid
                                                      : independent_plant::ContactKind::kCompliant;
  d.restitution = structure.restitution;
  d.motor_inertia = p.motor_inertia;
  d.torque_constant = p.torque_constant;
  d.motor_damping = p.motor_damping;
  if (structure.has_load) d.load_inertia = p.motor_inertia * p.mass_ratio;
  d.load_damping = p.load_damping;
  d.load_coulomb = p.load_coulomb_friction;
  d.gap = p.gap;
  d.contact_stiffness = p.contact_stiffness;
  d.contact_damping = p.contact_damping;
  d.effects = independent_effects(s.plant.effects);
  d.x1 = s.initial.x1, d.w1 = s.initial.w1;
  d.x2 = s.initial.x2, d.w2 = s.initial.w2;
  return d;
}

Recording independent_recording(const Configuration& c, const std::vector<double>& u) {
  const SimulationConfig& s = *c.simulation;
  independent_plant::BlindOptions options;
  options.rate = s.rate;
  options.duration = s.duration;
  options.seed = s.seed;
  options.tolerance = independent_plant::kFastTolerance;
  return independent_plant::simulate_blind_command(independent_drive(s), u, {c.position_quantum(), s.noise},
                                                   options)
      .recording;
}

/// What becomes of the time of a recording that is not uniform.
void note_time(const Recording& r, LostRows how, std::vector<std::string>& notes) {
  if (!r.resampling.empty()) notes.push_back(r.file + ": " + r.resampling);
  if (!r.even()) notes.push_back(r.file + ": uneven steps, each taken with its own length");
  const std::size_t lost = lost_rows(r);
  if (lost == 0) return;
  notes.push_back(fmt::format("{}: {} rows are missing; {}", r.file, lost,
                              how == LostRows::kBridged
                                  ? "u over them is a line to the next row"
                                  : "u is held over them, as recording: lost_rows: held says: bridged, where "
                                    "the drive got new inputs"));
}

/// What was mended in the rows of a recording; what was in them and is none is warned of.
void note_mended(const Recording& r, Coordinates coordinates, LoadedRecordings& loaded) {
  for (const Remark& assumed : r.assumed)
    if (!assumed.code().starts_with("table."))
      (assumed.code() == "load_position.copy" ? loaded.warnings : loaded.notes)
          .push_back(r.file + ": " + assumed.text(coordinates));
}

/// Where input and target both were recorded, the first is taken and the second tells of the controller.
void note_controller(const RecordedFile& file, const Configuration& c, UnevenRows uneven,
                     std::vector<std::string>& notes) {
  const ReadOptions options = c.recording->reading_of(file, uneven);
  const auto compared = compare_with_controller(file.path, options);
  if (!options.controller) return;
  if (!compared)
    notes.push_back(file.given +
                    ": the input is what the controller makes of the recorded target and position");
  else
    notes.push_back(
        fmt::format("{}: the input is the recorded one; what the controller makes of the target leaves "
                    "{:.2g} % of it, at {:.4g} "
                    "times its own size",
                    file.given, 100.0 * compared->left, compared->scale));
}

LoadedRecordings read_all(const Configuration& c, const std::vector<RecordedFile>& files, UnevenRows uneven,
                          const Progress& progress) {
  LoadedRecordings loaded;
  for (const RecordedFile& file : files) {
    stop_point();
    progress("reading " + file.given);
    Recording r = read_one(file, c, uneven);
    r.file = name_of(file, files);
    r.load = file.load;
    apply_sheet(r, c, loaded.warnings);
    note_time(r, c.recording->reading.lost_rows, loaded.notes);
    note_mended(r, c.coordinates, loaded);
    note_controller(file, c, uneven, loaded.notes);
    if (r.open_end)
      loaded.notes.push_back(r.file + ": its last line has no end, so the last number may be cut off");
    loaded.recordings.push_back(std::move(r));
  }
  internal::run::require_own_rows(c, {}, loaded.recordings);
  return loaded;
}

}  // namespace

std::vector<std::string> source_paths(const Configuration& c) {
  std::vector<std::string> paths = {c.file};
  if (c.recording)
    for (const auto* files : {&c.recording->files, &c.recording->held_out, &c.recording->simulated})
      for (const RecordedFile& f : *files) paths.push_back(f.path);
  if (c.simulation && !c.simulation->excitation.file.empty())
    paths.push_back(
        (std::filesystem::path(c.simulation->excitation.folder) / c.simulation->excitation.file).string());
  return paths;
}

namespace {

/// What an estimate and a diagnosis both rest on; what either alone is asked makes no other drive of it.
Configuration asked_of_both(Configuration c) {
  c.detector = {}, c.next_experiment = {}, c.diagnosis = {}, c.tolerance = {};
  c.excluded.clear();
  if (c.recording) c.recording->simulated.clear();
  return c;
}

}  // namespace

std::vector<FileHash> sources_of(const Configuration& c) {
  const Configuration both = asked_of_both(c);
  std::vector<FileHash> sources = {{"configuration", sha256(resolved_yaml(both))}};
  for (const std::string& path : source_paths(both)) {
    if (path == c.file) continue;
    const std::string name = std::filesystem::path(path).filename().string();
    std::error_code unreachable;  // what is held out need not be there for an estimate
    const bool there = std::filesystem::is_regular_file(path, unreachable);
    sources.push_back({name, there ? sha256_of_file(path) : ""});
  }
  return sources;
}

void require_unchanged(const Configuration& c, const std::vector<FileHash>& sources) {
  if (sources != sources_of(c))
    throw ConfigError(c.file, "names a file that changed while it was read, expected it to stay");
}

Recording simulated_recording(const Configuration& c) {
  require_followable(c);
  const SimulationConfig& s = *c.simulation;
  SimulationOptions options;
  options.rate = s.rate;
  options.seed = s.seed;
  options.initial = {s.initial.x1, s.initial.w1, s.initial.x2, s.initial.w2};
  options.encoder = {c.position_quantum(), s.noise};
  const std::vector<double> u = sample(s.excitation, s.rate, s.samples(), s.seed);
  stop_point();
  Recording r = c.controller
                    ? simulate_under_controller(s.plant.plant_model(), c.controller->at_start(), u, options,
                                                supply_of(s.excitation, s.rate, s.samples()))
                : s.independent ? independent_recording(c, u)
                                : simulate(s.plant.plant_model(), u, options);
  const bool load = c.encoder.sides == EncoderSides::kLoad && !r.x2.empty();
  if (c.encoder.sides == EncoderSides::kBoth || (load && s.independent))
    r.x2 = encoder_reads(r.x2, options.encoder, s.seed);
  if (load) r.encoder = EncoderSide::kLoad;
  r.file = c.name;
  return r;
}

std::vector<MotorTrace> LoadedRecordings::motor_traces() const {
  std::vector<MotorTrace> traces;
  for (const Recording& r : recordings) traces.push_back(r.motor_trace());
  return traces;
}

LoadedRecordings load_recordings(const Configuration& c, UnevenRows uneven, const Progress& progress) {
  if (!c.simulation) return read_all(c, c.recording->files, uneven, progress);
  progress("simulating " + c.name);
  LoadedRecordings loaded;
  loaded.recordings.push_back(simulated_recording(c));
  return loaded;
}

LoadedRecordings load_held_out(const Configuration& c, const Progress& progress) {
  if (!c.recording) return {};
  return read_all(c, c.recording->held_out, UnevenRows::kStamped, progress);
}

}  // namespace gapscope

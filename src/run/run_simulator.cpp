#include "run/run_simulator.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>

#include "base/input_facts.h"
#include "base/interrupt.h"
#include "base/text.h"
#include "gapscope/base/errors.h"
#include "gapscope/base/statistics.h"
#include "gapscope/telling/card.h"
#include "results/sha256.h"
#include "run/fitted_command.h"
#include "signals/encoder.h"

namespace gapscope::internal::run {
namespace {

constexpr double kFiner = 1.5;      // times: a simulator that reads finer than the encoder is rounded
constexpr double kSameShape = 0.5;  // of the drive's own rms: less is the same motion in another unit
constexpr double kFarStart = 0.05;  // of the travel: another start than the drive's
// of what the encoder's rounding and noise leave: a motion of one's own is all of it off, a copy with noise
// of a sixth of a count 0.58
constexpr double kRepeated = 0.75;

/// One instrument looks at both: nothing is told of the simulator that the drive's encoder could not show.
void read_by_encoder(Recording& simulated, double quantum) {
  if (quantum > 0.0 && kFiner * simulated.quantum < quantum)
    for (double& x : simulated.encoder == EncoderSide::kLoad ? simulated.x2 : simulated.x1)
      x = quantum * std::round(x / quantum);
  simulated.quantum = std::max(quantum, simulated.quantum);
}

void note_start(const Recording& simulated, const Recording& drive, Coordinates coordinates,
                std::vector<std::string>& warnings) {
  const std::vector<double>&begun = simulated.position(), &recorded = drive.position();
  const auto [low, high] = std::minmax_element(recorded.begin(), recorded.end());
  if (std::abs(begun.front() - recorded.front()) <= kFarStart * (*high - *low)) return;
  warnings.push_back(
      fmt::format("{} begins at x1 = {}, the drive at {}: its error contains that; begin it where {} does",
                  simulated.file, coordinates.thousandths(begun.front()),
                  coordinates.thousandths(recorded.front()), drive.file));
}

/// A position in another unit than the recording's is this many times off.
struct UnitSlip {
  double times;
  const char* looks_like;
};
constexpr UnitSlip kSlips[] = {{kPi / 180.0, "rad where the recording has deg"},
                               {180.0 / kPi, "deg where the recording has rad"},
                               {1e-3, "a unit a thousand times as large as the recording's"},
                               {1e3, "a unit a thousandth of the recording's"}};

/// Rms of a simulated motion, a times as large, about the drive's, both without their means, in parts of the
/// drive's own rms.
double shape_error(const Recording& simulated, const Recording& drive, double times) {
  const std::vector<double>&answer = simulated.position(), &recorded = drive.position();
  const std::size_t n = std::min(answer.size(), recorded.size());
  const auto mean = [n](const std::vector<double>& x) {
    return std::accumulate(x.begin(), x.begin() + static_cast<std::ptrdiff_t>(n), 0.0) /
           static_cast<double>(n);
  };
  const double middle = mean(answer), place = mean(recorded);
  double error = 0.0, moved = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const double own = recorded[i] - place, e = times * (answer[i] - middle) - own;
    error += e * e, moved += own * own;
  }
  return std::sqrt(error / moved);
}

/// The same motion but for a factor that is one between units is in another unit.
/// @throws ConfigError
void require_same_unit(const Recording& simulated, const Recording& drive) {
  for (const UnitSlip& slip : kSlips)
    if (shape_error(simulated, drive, 1.0 / slip.times) < kSameShape)
      throw ConfigError(
          simulated.file,
          fmt::format("moves {:.3g} times as far as {} and else alike: its position looks like {}, expected "
                      "the unit of the recording",
                      slip.times, drive.file, slip.looks_like));
}

/// Spread of simulated about recorded positions where the drive moves: at rest both may stand on one count
/// [rad].
double spread_in_motion(const std::vector<double>& simulated, const std::vector<double>& recorded) {
  std::vector<double> apart;
  for (std::size_t i = 1; i < recorded.size(); ++i)
    if (recorded[i] != recorded[i - 1]) apart.push_back(simulated[i] - recorded[i]);
  const double middle = mean(apart);
  for (double& e : apart) e -= middle;
  return rms(apart);
}

/// A copy of the recording, rounded or with a little noise, would differ from the drive in nothing.
/// @throws ConfigError
void require_own_motion(const Recording& simulated, const Recording& drive, const std::string& unit) {
  const double apart = spread_in_motion(simulated.position(), drive.position());
  const double least = kRepeated * signals::encoder_floor(drive.motor_trace());
  if (apart < least)
    throw ConfigError(
        simulated.file,
        fmt::format(
            "follows {} to {:.2g} {} where that moves, though rounding and noise of its encoder leave "
            "more in all that is simulated: that is the recording, expected what the simulator "
            "answers to its input (at least {:.2g} {} off)",
            drive.file, apart, unit, least, unit));
}

void require_there(const Configuration& c, const RecordedFile& file) {
  if (std::error_code unreachable; std::filesystem::exists(file.path, unreachable)) return;
  const std::string what = fmt::format(
      "there is no simulated recording {}, expected a file with what the simulator answers", file.given);
  if (file.line != 0) throw ConfigError(c.file, file.line, what);
  throw ConfigError("gapscope: --simulated: " + what);
}

Recording read_answer(const Configuration& c, const RecordedFile& file, const Recording& drive,
                      SimulatedRecordings& all) {
  require_there(c, file);
  Recording r = read_simulated(file.path, c.recording->reading_of(file, UnevenRows::kStamped).columns, drive);
  require_own_motion(r, drive, c.coordinates.position_unit());
  require_same_unit(r, drive);
  note_start(r, drive, c.coordinates, all.warnings);
  read_by_encoder(r, drive.quantum);
  all.files.push_back({r.file, sha256_of_file(file.path)});
  return r;
}

}  // namespace

SimulatedRecordings load_simulated(const Configuration& c, const DiagnosisRecordings& recordings,
                                   const Progress& progress) {
  SimulatedRecordings all;
  if (!c.recording) return all;
  const std::vector<RecordedFile>& files = c.recording->simulated;
  const std::vector<Recording>& train = recordings.train.recordings;
  for (std::size_t i = 0; i < files.size(); ++i) {
    stop_point();
    progress("reading " + files[i].given);
    const bool held = i >= train.size();
    const Recording& drive = held ? recordings.held_out.recordings[i - train.size()] : train[i];
    (held ? all.held_out : all.train).recordings.push_back(read_answer(c, files[i], drive, all));
  }
  if (!all.empty() && all.held_out.recordings.empty() && !recordings.held_out.recordings.empty())
    all.warnings.push_back(
        "the simulator was not run on what is held out: it is judged on the last third of each recording");
  return all;
}

SimulatorComparison compare_simulated(const Configuration& c, const DiagnosisRecordings& recordings,
                                      const SimulatedRecordings& simulated, const Diagnosis& drive,
                                      const DiagnosisOptions& options) {
  const std::vector<MotorTrace> train = recordings.train.motor_traces();
  const std::vector<MotorTrace> held_out =
      simulated.held_out.recordings.empty() ? std::vector<MotorTrace>{} : recordings.held_out.motor_traces();
  const std::vector<MotorTrace> simulated_train = simulated.train.motor_traces();
  const std::vector<MotorTrace> simulated_held_out = simulated.held_out.motor_traces();
  DiagnosisOptions asked = options;
  asked.known.detectable = false;
  asked.progress = [&](const std::string& what) { options.progress("simulator: " + what); };
  const Diagnosis of_simulator = diagnose(simulated_train, simulated_held_out, diagnosed_model(c, {}), asked);
  SimulatorComparison compared = compare_with_simulator(
      {train, held_out, simulated_train, simulated_held_out, drive, of_simulator}, options);
  put_into_words(compared, c.coordinates);
  compared.files = simulated.files;
  std::vector<std::string> warnings = simulated.warnings;
  for (const std::string& warning : of_simulator.warnings)
    if (!contains(drive.warnings, warning))
      warnings.push_back("diagnosis of the simulator: " + with_input_unit(warning, c.input_facts()));
  compared.warnings.insert(compared.warnings.begin(), warnings.begin(), warnings.end());
  return compared;
}

}  // namespace gapscope::internal::run

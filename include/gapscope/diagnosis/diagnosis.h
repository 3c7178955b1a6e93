#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "gapscope/base/coordinates.h"
#include "gapscope/base/doubt.h"
#include "gapscope/base/fields.h"
#include "gapscope/base/statistics.h"
#include "gapscope/diagnosis/added_effect.h"
#include "gapscope/diagnosis/detectable.h"
#include "gapscope/diagnosis/error_budget.h"
#include "gapscope/diagnosis/evidence.h"
#include "gapscope/diagnosis/last_resort.h"
#include "gapscope/diagnosis/loop_fit.h"
#include "gapscope/diagnosis/named_value.h"
#include "gapscope/diagnosis/next_experiment.h"
#include "gapscope/diagnosis/whole_run.h"
#include "gapscope/recording/recording.h"
#include "gapscope/reference/fit.h"

namespace gapscope {

/// Effect: the cause of the first addition is established. Helps: something of the catalogue shrinks the
/// held-out error, but its cause stays open. None: nothing is missing. Unknown: something is, and nothing
/// shrinks it.
enum class DiagnosisVerdict { kNotRun, kEffect, kHelps, kNone, kUnknown };

/// "effect", "helps", "none" or "unknown": the words of diagnosis.json.
const char* to_string(DiagnosisVerdict verdict);

/// Where the floor of the mismatch comes from: the encoder's quantum, its noise, or how far a drive that
/// repeats its input repeats its motion, or by how much its recordings disagree.
enum class FloorSource { kEncoder, kNoise, kRepeatability, kRecords };

/// The floor as readers are told of it; that of the encoder is its quantum or its noise.
inline const char* floor_name(FloorSource from) {
  return from == FloorSource::kRepeatability ? "repeatability floor" : "encoder floor";
}

/// One size of the mismatch on held-out data, as the median over windows.
struct MismatchMeasure {
  std::string name;  ///< "restarted free run 0.5 s", "predictions at 3 Hz", ...
  std::string unit;
  double before = kNaN;  ///< nominal model, refitted
  double after = kNaN;   ///< with the effects that were accepted; equal to before without
  double floor = kNaN;   ///< NaN: there is none
};

/// What the held-out motion is judged by: free runs that are restarted, or where a drive repeats too badly
/// for them, the predictions of an observer.
enum class JudgedBy { kFreeRun, kPrediction };

/// How large the mismatch is and how far it shrinks; the first of the measures.
struct MismatchSize {
  std::string measure;
  JudgedBy judged_by = JudgedBy::kFreeRun;
  double before = kNaN, after = kNaN, floor = kNaN;  ///< [rad]
  FloorSource floor_from = FloorSource::kEncoder;
  std::string floor_of;                              ///< what it was read from, in words: recordings, periods
  double before_torque = kNaN, after_torque = kNaN;  ///< missing torque, rms [N m]
  double floor_torque = kNaN, input_torque = kNaN;   ///< what no model gets below; what the input applies
  double shrink = kNaN;   ///< (before − after)/(before − floor); NaN while before < 1.3 floors
  Interval shrink_ci95;   ///< for the next recording of the same drive
  double remains = kNaN;  ///< after/floor
};

/// A candidate of one step, really refitted.
struct RankedEffect {
  std::string effect;
  /// Of being the missing effect, see Diagnosis::outside_probability; NaN where none was learned, as of
  /// drives with an error budget or with a repeatability floor
  double probability = kNaN;
  double held_out = kNaN;        ///< the measure of the mismatch with this effect [rad]
  double shrink = kNaN;          ///< of that measure
  double score = kNaN;           ///< S, see diagnose(); lower is better
  double rel = kNaN;             ///< share of the log distance to the floor
  double windows_better = kNaN;  ///< share of the windows above the floor that improve
  std::vector<NamedValue> parameters;
  std::string remark;  ///< why it was listed and not added, where that needs a word
};

/// Where the gap of a fitted model comes from: it is one body and has none, its configuration gives it, or
/// the recordings do.
enum class GapOrigin { kNone, kGiven, kEstimated };

/// The backlash gap of the model with all that was added: of its coupling, or of an effect that gives one
/// body a gap.
struct ModelGap {
  GapOrigin origin = GapOrigin::kNone;
  double value = kNaN;  ///< 2β [rad]
  Interval ci95;        ///< NaN where the fitted recordings do not determine it
  EncoderSide encoder =
      EncoderSide::kMotor;  ///< on the load it shows no gap: nobody tells it without a model
};

/// Where a fitted number stands in its bounds.
enum class BoundReached { kNone, kLower, kUpper };

/// What a nominal parameter reads with and without the effect: what it had to take the blame for. What ended
/// at a bound is no reading, nor is what was held: the torque balance leaves it where the nominal fit had it.
struct BlameShift {
  std::string key;
  std::string unit;
  double without = kNaN, with = kNaN;
  BoundReached without_at = BoundReached::kNone, with_at = BoundReached::kNone;
  bool held = false;
};

/// An estimated number whose 95 % interval leaves out the value that the configuration gives it: a claim that
/// the recordings contradict, or a start that somebody had to write.
struct RefittedNumber {
  std::string key;  ///< "motor_damping", of an effect "load_unbalance.amplitude_nm"
  std::string unit;
  double configured = kNaN, fitted = kNaN;
  Interval ci95;  ///< of the fitted one
};

/// One bin of a map: its share of the squared error and the share that an error without a place would have.
struct MapShare {
  std::string bin;
  double share = 0.0;
  double expected = 0.0;
};

/// Where the mismatch of the nominal model is: the correcting torque, spread over seven quantities.
struct MismatchPlace {
  std::string headline;                  ///< the following in words; whoever tells it fills it in
  std::optional<ContactPhase> phase;     ///< of contact where it is densest; nothing: there is but one
  std::vector<ResidualPattern> follows;  ///< what orders it, that of a found effect first
  std::vector<MapShare> mode, direction, speed, angle, input, frequency, time;
  double periods_per_turn = kNaN;  ///< of a residual that repeats with the motor angle [1/rev]
  MapShare behind_impacts;         ///< at impacts and 33 ms behind them; told where nothing else orders it
  bool reverses = true;            ///< its means forward and backward have opposite signs
  bool explained = false;  ///< by an effect: then how it is spread over the directions is the motion's
};

/// A torque that repeats with the motor angle, -A sin(N x1 + phase), in what the model leaves.
struct PeriodicTorque {
  double periods_per_turn = kNaN;  ///< N [1/rev]
  double period = kNaN;            ///< 2π/N [rad]
  double amplitude = kNaN;         ///< A [N m]
  double phase = kNaN;             ///< [rad]
  double stands_out = kNaN;        ///< times what neighbouring periods show; NaN where the period was given
  int windows = 0, better = 0;     ///< held-out windows, and those that it improves
  bool holds = false;              ///< more of them improve than chance would let, at 1 %
  bool given = false;              ///< the period was given, not found
};

/// A step after the first: every candidate on top of the effects so far.
struct DiagnosisStep {
  std::vector<std::string> on_top_of;  ///< effects of the model that it began with
  std::string effect;                  ///< best candidate
  bool accepted = false;               ///< it was added
  std::vector<std::string> group;    ///< all that it cannot be told from, itself included; empty unless added
  std::vector<std::string> dropped;  ///< earlier effects that it made superfluous
  MismatchSize mismatch;             ///< of this step alone
  std::string remaining;             ///< the following in words; empty unless added
  MismatchPlace left;                ///< where what the model leaves after it is; not stored
  std::vector<RankedEffect> ranking;
};

/// Errors beside one held-out recording, for figures. Columns of equal length.
struct MismatchTrace {
  std::string file;
  double start = 0.0, dt = 0.0;
  std::size_t scored_from = 0;  ///< samples before it were fitted
  std::vector<double> u, x1;
  std::vector<double> error_before, error_after;    ///< restarted free runs [rad]
  std::vector<double> torque_before, torque_after;  ///< correcting torque [N m]
  std::vector<Mode> mode;                           ///< of the nominal model
  std::vector<double> stamps = {};                  ///< time of each sample [s]; empty: evenly sampled
  EncoderSide encoder = EncoderSide::kMotor;        ///< of the load: x1 is that of the load
  /// What u was made of by a controller [rad], and the supply that multiplies its output [V]; empty: neither.
  std::vector<double> target = {}, supply = {};
  /// Position of the model, without and with what was added, from the first sample on simulated freely, or
  /// under the drive's controller where there is one [rad]; empty: its motion diverges, or it was not stored.
  std::vector<double> simulated_before = {}, simulated_after = {};

  double time(std::size_t i) const {
    return stamps.empty() ? start + dt * static_cast<double>(i) : stamps[i];
  }
};

/// What the diagnosis says. A default-built one says that it was not run.
struct Diagnosis {
  DiagnosisVerdict verdict = DiagnosisVerdict::kNotRun;
  std::string sentence;  ///< all of this in a sentence or two; whoever tells it fills it in
  bool stopped = false;  ///< the search was asked to finish before its end; what it says is what it had found
  /// The model with what was added has the numbers of the torque balance: a refit to the motion, in which
  /// something is still missing, would bend them. Of the others it has those of the nominal fit
  bool balanced = false;
  bool exhausted = false;  ///< it has taken all the work it may, after which it begins no further step
  /// What is held out asks more of the drive than what is fitted: the other way round may tell more
  bool better_swapped = false;
  std::vector<std::string> effects;  ///< what was added, in order
  std::vector<std::string> group;    ///< all that the first one cannot be told from, itself included
  std::vector<AddedEffect> added;    ///< the same effects, each with what it takes
  MismatchSize mismatch;
  std::optional<ModelGap> model_gap;  ///< nothing: not told
  /// What the fitted recordings leave open of the held-out motion: standard deviation of the prediction [rad]
  double undetermined = kNaN;
  std::optional<WholeRun> whole_run;      ///< nothing: not told
  std::vector<HeldOutRun> held_out_runs;  ///< each held-out recording
  Interval looked_at_hz;                  ///< in which a torque was looked for: none is denied outside [Hz]
  std::optional<AsConfigured> as_configured;  ///< nothing: the configuration leaves numbers to the fit
  ErrorBudget budget;
  std::vector<MismatchMeasure> measures;
  std::vector<RankedEffect> ranking;     ///< first step, best first
  double outside_probability = kNaN;     ///< that no effect of the catalogue is what is missing first
  std::vector<DiagnosisStep> steps;      ///< the later steps; the last one may not have been taken
  std::vector<PeriodicTorque> periodic;  ///< in what the accepted effects leave: given, then found ones
  std::vector<LastResortLaw> laws;  ///< of what the effects leave, where a free-form law takes much of it
  MismatchPlace where;
  MismatchPlace remaining;  ///< of what the accepted effects leave
  std::vector<BlameShift> blame;
  /// Those that moved farthest first; none of a model that something unknown is missing from
  std::vector<RefittedNumber> refitted;
  std::vector<std::string> modelled;  ///< effects that the model of the configuration has
  /// Dampings and frictions of the drive that the model holds, by key: no sheet tells them well, and where
  /// one is wrong an effect takes its place
  std::vector<std::string> held;
  std::vector<Doubt> doubts;  ///< of what was fitted and held out, and of what the fitted model leaves of it
  std::vector<std::string> warnings;
  std::vector<MismatchTrace> traces;
  ReferenceModel nominal;  ///< the model refitted before anything was added; not stored
  ReferenceModel fitted;   ///< the model as fitted, accepted effects included
  double observer_hz = kNaN;
  StepEvidence evidence;  ///< of the first step; not stored in diagnosis.json

  /// For each candidate that was not added what would have been named; empty: nobody asked for it.
  std::vector<DetectableEffect> detectable;

  std::vector<Rival> rivals;  ///< models between which these recordings do not decide well; empty: they do
  NextExperiment next_experiment;  ///< that would; left to the caller, as it takes time
  std::optional<LoopFit>
      loop;  ///< under its controller, where that follows what is held out nearer than `fitted`
  std::optional<ClosedLoop> closed_loop;           ///< where a controller is at work that is known
  std::optional<DriveController> controller = {};  ///< that controller, as fitted with what was added

  /// Whether the next recording's motion would show what was added, too: the interval of the shrink is above
  /// zero.
  bool is_shown_by_motion() const { return mismatch.shrink_ci95.low > 0.0; }
};

/// Whether the sizes of a mismatch in torque are of what is missing. Those of the torque balance always are,
/// where it has all that was added. The observer's correcting torque holds the encoder's noise in its whole
/// band: it tells what is left only where it falls as far as the motion's error does.
bool is_told_in_torque(const Diagnosis& diagnosis);

/// `diagnosis:` – what is known of the drive beforehand, and what is asked beside the verdict.
struct DiagnosisKnowledge {
  std::vector<double> periods_per_turn;  ///< pole pairs, slots, teeth: cycles of a torque [1/rev]
  std::vector<double> periods;           ///< the same as a length, such as a screw's pitch [rad]
  double outside_catalogue = 0.5;  ///< how likely, before any recording, the catalogue lacks what is missing
  /// Whether to tell the smallest amounts that would have been named; of "none" and "unknown" they always are
  bool detectable = false;

  void fields(FieldVisitor& visitor);
};

struct DiagnosisOptions {
  FitOptions fit;  ///< of the nominal model
  DiagnosisKnowledge known;
  std::vector<std::string> excluded;  ///< effects that are no candidates
  int threads = 0;                    ///< 0: all cores; the answer is the same for any number
  Coordinates coordinates;            ///< of a translation: rad and N·m mean m and N in texts
  ShaftTurns turns;                   ///< of a rotation; along a slide nothing is known to turn
  std::function<void(const std::string&)> progress = [](const std::string&) {};
  std::optional<DriveController> controller = {};  ///< that made u of the commands, where the model has none
};

/// Why does the fitted model not move like the recorded drive?
///
/// The nominal model is fitted to `train`, then every effect of the catalogue that it could have is added in
/// turn and everything refitted, from several magnitudes of the effect and from the given values as well as
/// the nominal fit. What counts is `held_out`:
///   S = ½ mean log(W_inn + 0.3) + ½ mean log(W_free + 0.3) + 0.04 · (extra parameters),
/// W_inn the mean square of an observer's innovations in windows of 0.25 s, W_free that of free runs
/// restarted every 0.5 s from the observer's state, both in floors squared.
///
/// Further effects are looked for on top of the first in the same way, to the floor or to the last step that
/// the held-out data asks for; an earlier effect that a later one has made superfluous is taken out again. A
/// first step that explains too little alone is accepted once a second one leads from it to the floor, one
/// that leads but leaves more than a trace once any second one is accepted.
///
/// Where `train` is explained and `held_out` is not, `train` asks for too little: the first half of what is
/// held out is then fitted with it, the second half judges, and a warning says so.
///
/// With no held-out recordings the last third of each file is held out; one that is too short for that
/// (kFewestFitted) is fitted whole, judges nothing, and a warning names it.
///
/// After request_finish() the search ends with its present step and says so (Diagnosis::stopped).
/// @throws std::logic_error for an empty span or an unknown excluded effect; ConfigError where nothing moves,
///   or where no recording can judge; Interrupted.
Diagnosis diagnose(std::span<const MotorTrace> train, std::span<const MotorTrace> held_out,
                   const ReferenceModel& model, const DiagnosisOptions& options = {});

}  // namespace gapscope

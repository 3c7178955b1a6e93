#include "run/run_pipeline.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <set>

#include "base/interrupt.h"
#include "base/parallel.h"
#include "diagnosis/comparison.h"
#include "gapscope/base/errors.h"
#include "gapscope/base/version.h"
#include "gapscope/reference/fit.h"
#include "gapscope/sliding_mode/detector.h"
#include "run/checked.h"
#include "run/fitted_command.h"
#include "run/run_words.h"
#include "run/settle_rate.h"
#include "telling/answer.h"

namespace gapscope {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// A result of f and how long it took [s].
template <class Function>
auto timed(double& seconds, const Function& f) {
  const auto begin = Clock::now();
  auto result = f();
  seconds = seconds_since(begin);
  return result;
}

/// The interval of (13), and what it is from.
struct PublishedBound {
  Interval bound;  ///< [rad/s²]; NaN where model and input do not tell it
  BoundKnowledge known;
};

/// As the detector is told to take it, or else from what the model and the input tell: then it estimates
/// nothing from it, and only says what the published choice of L would have shown.
PublishedBound published_bound(const Configuration& c, const std::vector<MotorTrace>& traces) {
  if (c.detector.from_model) return {bound_from_model(c), *c.detector.from_model};
  DriveParameters<double> drive;
  for (int i = 0; i < kDriveParameterCount; ++i) drive_parameter(drive, i) = c.model.parameters[i].value;
  PublishedBound published;
  published.known.load_force_bound = drive.load_coulomb_friction;
  for (const MotorTrace& trace : traces)
    for (const double u : trace.u)
      published.known.input_limit = std::max(published.known.input_limit, std::abs(u));
  const Interval bound = acceleration_bound(drive, published.known);
  if (c.model.structure.has_load && std::isfinite(bound.low) && std::isfinite(bound.high))
    published.bound = bound;
  return published;
}

/// Of a rejected model a reader is told which of its numbers are open; the report has what each would need.
std::vector<std::string> warnings_of_fit(const FitSummary& f) {
  if (!f.rejected()) return texts_of(f.warnings);
  static const std::set<std::string> of_numbers{"not_explained",      "at_bound",        "no_trace",
                                                "like_initial_state", "change_together", "not_determined",
                                                "no_information",     "little_known",    "values_move"};
  std::vector<std::string> told, open;
  for (const Remark& warning : f.warnings)
    if (!of_numbers.contains(warning.code())) told.push_back(warning.text());
  for (const FittedParameter& p : f.parameters)
    if (p.estimated && (p.at_bound || !p.identifiable)) open.push_back(p.key);
  if (!open.empty())
    told.push_back(fmt::format(
        "the fitted model is rejected, and its numbers say nothing of the drive; not determined, or at a bound: {} "
        "(the report tells the reason of each).",
        fmt::join(open, ", ")));
  return told;
}

double largest_travel(const std::vector<Recording>& recordings) {
  double largest = 0.0;
  for (const Recording& recording : recordings) {
    const auto x = recording.position();
    if (x.empty()) continue;
    const auto [low, high] = std::minmax_element(x.begin(), x.end());
    largest = std::max(largest, *high - *low);
  }
  return largest;
}

/// "... eq. (13) with the configuration's numbers (|u| <= 0.5, G = 5e-05 N·m): 98.01 < L < 147 rad/s²; ..."
std::string told_bound(const PublishedBound& p, Coordinates coordinates, double taken) {
  return fmt::format(
      "bound of the paper's eq. (13) with the configuration's numbers (|u| <= {:.4g}, G = {:.3g} {}): {:.4g} < L < "
      "{:.4g} {}; {}",
      p.known.input_limit, p.known.load_force_bound, coordinates.shown_unit("N m"), p.bound.low, p.bound.high,
      coordinates.shown_unit("rad/s^2"),
      taken > 0.0 ? fmt::format("L = {:.4g} is taken", taken) : "the bank of bounds does not use it");
}

DetectorOptions detector_options(const Configuration& c, const std::vector<MotorTrace>& traces,
                                 std::vector<std::string>& notes) {
  DetectorOptions options;
  options.method = c.detector.method;
  options.encoder = c.encoder.side();  // also of a model of one body: the drive may have a gap all the same
  options.locked = c.model.given && c.model.structure.has_load && c.model.structure.load == LoadKind::kLocked;
  if (c.detector.bound) {
    options.bound = *c.detector.bound;
    return options;
  }
  const PublishedBound published = published_bound(c, traces);
  if (!std::isfinite(published.bound.low)) return options;
  options.paper_bound = published.bound.low;
  if (c.detector.from_model) options.bound = chosen_bound(published.bound);
  notes.push_back(told_bound(published, c.coordinates, options.bound));
  return options;
}

/// What another choice of L would have shown is no doubt about this reading.
void note_published_bound(RunResult& r) {
  if (!r.model_free) return;
  std::erase_if(r.model_free->warnings, [&](const Remark& warning) {
    const bool other = warning.code() == "paper_bound_misses";
    if (other) r.notes.push_back(warning.text(r.coordinates));
    return other;
  });
}

/// Parameters that the configuration does not mention and that count as a number all the same.
void note_defaults(const ModelConfig& model, std::vector<std::string>& notes) {
  std::vector<std::string> keys;
  for (int i = 0; i < kDriveParameterCount; ++i)
    if (model.defaulted[i] && !model.parameters[i].estimate && has_parameter(model.structure, i))
      keys.emplace_back(kDriveParameters[i].key);
  if (!keys.empty()) notes.push_back(fmt::format("not given and taken as 0: {}", fmt::join(keys, ", ")));
}

/// What the estimators have to say, in the units of the drive.
void put_into_words(RunResult& r) {
  const auto put = [&](Remark& remark) { remark.put_into_words(r.coordinates); };
  const auto put_all = [&](std::vector<Remark>& remarks) {
    std::for_each(remarks.begin(), remarks.end(), put);
  };
  if (r.model_free)
    put(r.model_free->reason), put(r.model_free->lost_motion.meaning), put_all(r.model_free->warnings);
  if (r.literal) put(r.literal->reason), put_all(r.literal->warnings);
  if (r.reference)
    put(r.reference->message), put(r.reference->why), put_all(r.reference->warnings),
        put_all(r.reference->advice);
}

std::vector<MotorTrace> traces_of(const std::vector<Recording>& recordings) {
  std::vector<MotorTrace> traces;
  for (const Recording& recording : recordings) traces.push_back(recording.motor_trace());
  return traces;
}

/// What the detector takes: the recordings themselves where they are even, or the same on a grid.
/// @returns the grids, empty where there are none
LoadedRecordings grids_for_detector(const Configuration& c, const std::vector<Recording>& recordings,
                                    const Progress& progress) {
  const bool even = std::all_of(recordings.begin(), recordings.end(), [](const auto& r) { return r.even(); });
  if (even && !(c.recording && c.recording->resample_for_detector)) return {};
  return load_recordings(c, UnevenRows::kRefused, progress);
}

/// What the detector saw on its grid, at the recorded samples: of the nearest one each.
ErrorTrace at_recorded(const Recording& recorded, const Recording& grid, const ErrorTrace& seen) {
  ErrorTrace trace{seen.file, {}, {}};
  for (std::size_t i = 0; i < recorded.size(); ++i) {
    const double place = std::round((recorded.time(i) - grid.start) / grid.dt);
    const auto nearest =
        static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(grid.size() - 1)));
    trace.error.push_back(seen.error[nearest]);
    trace.velocity.push_back(seen.velocity[nearest]);
  }
  return trace;
}

std::vector<MotorTrace> traces_for_detector(const LoadedRecordings& grids,
                                            const std::vector<Recording>& recordings) {
  return grids.recordings.empty() ? traces_of(recordings) : grids.motor_traces();
}

/// The estimate of the grids, or of the recordings where there are none.
GapEstimate model_free(const Configuration& c, const LoadedRecordings& grids,
                       const std::vector<Recording>& recordings, std::vector<std::string>& notes) {
  const std::vector<MotorTrace> traces = traces_for_detector(grids, recordings);
  if (grids.recordings.empty()) return detect_gap(traces, detector_options(c, traces, notes));
  GapEstimate g = detect_gap(traces, detector_options(c, traces, notes));
  for (std::size_t i = 0; i < g.traces.size(); ++i)
    g.traces[i] = at_recorded(recordings[i], grids.recordings[i], g.traces[i]);
  return g;
}

/// S1 to S6 as printed, beside the others: its numbers and passages, no figure of its own.
GapEstimate literal(const Configuration& c, const LoadedRecordings& grids,
                    const std::vector<Recording>& recordings) {
  DetectorOptions options;
  options.method = DetectorMethod::kLiteral;
  options.encoder = c.encoder.side();
  options.bound = *c.detector.literal;
  GapEstimate g = detect_gap(traces_for_detector(grids, recordings), options);
  g.traces.clear();
  g.map.reset();
  return g;
}

void append(std::vector<std::string>& all, const std::vector<std::string>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

/// The estimators, the model's beside the others where there are threads: none knows of another.
void estimate(const Configuration& c, const Estimators& wanted, const LoadedRecordings& grids,
              const Progress& progress, int threads, RunOutcome& out) {
  RunResult& r = out.result;
  std::vector<std::string> notes;  // of the detector
  if (wanted.model_free) progress("model-free detector");
  if (wanted.reference) progress("fitting the model");
  const auto begin = Clock::now();
  const auto fitted = [&] { return fit(traces_of(r.recordings), c.reference_model(), c.fit); };
  parallel_for(2, threads, [&](std::size_t which) {
    stop_point();
    if (which == 0 && wanted.model_free)
      r.model_free =
          timed(out.timing.model_free_s, [&] { return model_free(c, grids, r.recordings, notes); });
    if (which == 0 && wanted.literal && c.detector.literal)
      r.literal = timed(out.timing.literal_s, [&] { return literal(c, grids, r.recordings); });
    if (which == 1 && wanted.reference) try {
        r.reference = timed(out.timing.reference_s, fitted);
      } catch (const Interrupted&) {
        if (!wanted.reading_is_kept) throw;
        out.stopped = true;
      }
  });
  out.timing.wall_s = seconds_since(begin);
  append(r.notes, notes);
  if (out.stopped) {
    clear_stop_request();  // what is left is the report
    out.warnings.push_back(
        "the fit of the model was stopped: the report has the reading without a model alone.");
    r.notes.push_back(out.warnings.back());
  }
  if (!r.reference) return;
  note_defaults(c.model, r.notes);
  if (c.anchor) r.notes.push_back(c.anchor->told(c.coordinates));
  if (c.controller && c.controller->estimates())
    internal::run::command_anew(fitted_controller(*c.controller, *r.reference), r.recordings);
}

/// A fit to doubtful recordings is none to rely on, however well it follows them.
void limit_by(const std::vector<Doubt>& doubts, FitSummary& fit) {
  if (doubts.empty() || fit.trust != FitTrust::kGood) return;
  fit.trust = FitTrust::kLimited;
  fit.why = Remark("doubtful_recording", "The recording is doubtful: {}.", {doubts.front().found});
}

}  // namespace

RunOutcome run_pipeline(const Configuration& given, const Estimators& wanted, const Progress& progress,
                        int threads) {
  if (wanted.reference) require_reference_model(given);
  RunOutcome out;
  std::vector<std::string> rate;
  const Configuration c = wanted.reference ? internal::run::with_settled_rate(given, progress, rate) : given;
  RunResult& r = out.result;
  r.name = c.name;
  r.version = version();
  r.configuration = resolved_yaml(c);
  r.coordinates = c.coordinates;
  r.input = internal::run::known_input(c);
  r.simulated_data = internal::run::simulated_words(c, wanted.reference);
  const UnevenRows uneven = wanted.reference ? UnevenRows::kStamped : UnevenRows::kRefused;
  LoadedRecordings loaded = load_recordings(c, uneven, progress);
  const LoadedRecordings grids = wanted.model_free && wanted.reference
                                     ? grids_for_detector(c, loaded.recordings, progress)
                                     : LoadedRecordings{};
  r.notes = std::move(loaded.notes);
  for (const Recording& grid : grids.recordings)
    r.notes.push_back(grid.file + ": for the detector alone " + grid.resampling);
  out.warnings = std::move(loaded.warnings);
  append(out.warnings, rate);
  internal::run::Checked checked;
  if (c.recording) {
    const Purpose purpose = wanted.reference ? Purpose::kAll : Purpose::kGap;
    checked = internal::run::check_files(c, c.recording->files, purpose);
  }
  append(out.warnings, checked.warnings);
  r.recordings = std::move(loaded.recordings);
  if (c.simulation && c.simulation->plant.structure.has_load) r.simulated_gap = c.simulation->plant.drive.gap;
  estimate(c, wanted, grids, progress, threads, out);
  stop_point();  // the last one: what is left is done soon, and nothing that was estimated is thrown away
  if (c.encoder.sides == EncoderSides::kBoth)
    r.second_encoder = validate_by_load(r.recordings, r.reference ? &*r.reference : nullptr);
  if (r.reference) limit_by(checked.of_fit, *r.reference);
  note_published_bound(r);
  if (r.model_free && r.reference) take_for_first_gap(*r.reference, *r.model_free);
  put_into_words(r);
  if (r.model_free) append(out.warnings, texts_of(r.model_free->warnings));
  if (r.reference) append(out.warnings, warnings_of_fit(*r.reference));
  if (r.reference) append(out.warnings, internal::run::guess_warnings(c));
  if (const FittedParameter* p = r.reference ? r.reference->find("load_unbalance.phase_rad") : nullptr)
    if (std::string hangs = internal::run::hanging_warning(c, p->value); !hangs.empty())
      out.warnings.push_back(std::move(hangs));
  for (std::string& warning : out.warnings) warning = with_input_unit(warning, c.input_facts());
  if (r.model_free && r.reference) r.comparison = compare(*r.model_free, *r.reference);
  if (r.comparison) r.comparison->map_width = map_width(r.recordings);
  r.answer = answer_of({r.model_free ? &*r.model_free : nullptr, r.reference ? &*r.reference : nullptr,
                        r.comparison ? r.comparison->agree : std::nullopt, r.coordinates,
                        largest_travel(r.recordings)});
  r.doubts = r.answer->from == AnswerSource::kReference ? checked.of_fit : checked.of_reading;
  put_in_doubt(*r.answer, r.doubts);
  r.answer->tolerance = c.tolerance;
  return out;
}

}  // namespace gapscope

#include "run/run_diagnosis.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

#include "base/cut_short.h"
#include "base/text.h"
#include "gapscope/base/errors.h"
#include "gapscope/base/version.h"
#include "gapscope/telling/card.h"
#include "inspection/reach.h"
#include "run/checked.h"
#include "run/closed_loop.h"
#include "run/doubtful_delay.h"
#include "run/fitted_command.h"
#include "run/read_gap.h"
#include "run/run_simulator.h"
#include "run/run_words.h"
#include "run/settle_rate.h"
#include "run/shared_rows.h"

namespace gapscope {
namespace {

/// What is fitted and what is held out alike.
internal::run::Checked checked(const Configuration& c, const Progress& progress) {
  if (!c.recording) return {};
  progress("checking the recordings");
  std::vector<RecordedFile> all = c.recording->files;
  all.insert(all.end(), c.recording->held_out.begin(), c.recording->held_out.end());
  return internal::run::check_files(c, all, Purpose::kDiagnosis);
}

/// "a.csv", "[a.csv, b.csv]"
std::string listed(const std::vector<RecordedFile>& files) {
  std::vector<std::string> names;
  for (const RecordedFile& f : files) names.push_back(f.given);
  return names.size() == 1 ? names.front() : fmt::format("[{}]", fmt::join(names, ", "));
}

/// Where what is held out asks more of the drive than what is fitted; empty where it does not.
std::string other_way_round(const Configuration& c, const DiagnosisRecordings& recordings) {
  if (!c.recording || c.recording->held_out.empty()) return "";
  const std::string farther = goes_farther(reach_of(recordings.train.motor_traces()),
                                           reach_of(recordings.held_out.motor_traces()), c.coordinates);
  if (farther.empty()) return "";
  const std::string fitted = listed(c.recording->files), held_out = listed(c.recording->held_out);
  return with_input_unit(
      fmt::format("{}, held out, asks more of the drive than {}, which is fitted ({}): the model is judged "
                  "where it was not fitted, which can last far longer and name something else; the other way "
                  "round (file: {}, held_out: {}) is worth a diagnosis, too.",
                  held_out, fitted, farther, held_out, fitted),
      c.input_facts());
}

/// Whoever excludes a cause gets the next best name for it; empty where none was looked for.
std::string excluded_words(const Configuration& c, const Diagnosis& d) {
  constexpr std::size_t kNamed = 3;
  if (c.excluded.empty() || d.verdict == DiagnosisVerdict::kNone) return "";
  std::vector<std::string> names;
  for (const std::string& effect : c.excluded) names.push_back(readable(effect));
  return fmt::format(
      "{} {} no candidate, as was asked for (exclude): if that is missing, something else is named in its "
      "place.",
      names.size() > kNamed ? fmt::format("{} effects of the catalogue", names.size())
                            : fmt::format("{}", fmt::join(names, ", ")),
      names.size() > 1 ? "were" : "was");
}

/// A servo that holds a position takes goals, not inputs.
bool takes_goals(const Configuration& c) {
  return c.recording && !c.recording->reading.columns.target.empty();
}

/// What the controllers of the recordings were at work in.  @throws ConfigError where that is of none enough
std::vector<Recording> at_work(const Configuration& c, const std::vector<Recording>& recordings,
                               std::vector<std::string>& too_short) {
  std::vector<Recording> on = internal::run::switched_on(recordings, too_short);
  if (on.empty() && !recordings.empty())
    throw ConfigError(c.file, fmt::format("the controller was at work through fewer than {} samples of {}, "
                                          "expected a recording of a longer motion under it",
                                          kFewestSamples, fmt::join(too_short, ", ")));
  return on;
}

/// Where the recordings do not decide: what would.
void ask_further(const Configuration& c, const MotorTrace& like, const DiagnosisOptions& options,
                 Diagnosis& d) {
  if (d.rivals.size() < 2) return;
  const InputFacts input = c.input_facts();
  const auto tell = [&](bool goals) {
    const Told told = experiment_of(d.next_experiment, d.rivals, goals);
    d.next_experiment.sentence = with_input_unit(in_words(told, Detail::kWhole, c.coordinates), input);
  };
  if (takes_goals(c)) return tell(true);
  const auto sought = [&] {
    return next_experiment(d.rivals, like, c.next_experiment, d.observer_hz, options.threads,
                           options.progress);
  };
  std::optional<NextExperiment> next = unless_finishing(sought);
  if (!next) {
    if (!d.stopped) d.warnings.push_back("stopped before the experiment was found that would decide.");
    return;
  }
  d.next_experiment = *std::move(next);
  tell(false);
  for (TriedInput& tried : d.next_experiment.tried) tried.input = with_input_unit(tried.input, input);
}

}  // namespace

DiagnosisRecordings load_for_diagnosis(const Configuration& c, const Progress& progress) {
  DiagnosisRecordings all{load_recordings(c, UnevenRows::kStamped, progress), {}};
  require_possible_experiment(c, all.train.recordings.front().dt);
  all.held_out = load_held_out(c, progress);
  internal::run::require_own_rows(c, all.train.recordings, all.held_out.recordings);
  const internal::run::SettledController settled =
      internal::run::settle_controller(c, all.train.recordings, all.held_out.recordings);
  all.controller = settled.known, all.sought = settled.sought;
  if (!settled.said.empty()) all.train.warnings.push_back(settled.said);
  return all;
}

Diagnosis diagnose_recordings(const Configuration& c, const DiagnosisRecordings& recordings,
                              const DiagnosisOptions& options) {
  DiagnosisOptions asked = options;
  asked.controller = recordings.controller;
  if (!asked.fit.gap_seed) asked.fit.gap_seed = internal::run::read_gap(c, recordings);
  const std::optional<LoopFit> loop = internal::run::fitted_loop(c, recordings, options);
  std::vector<std::string> too_short;
  std::vector<Recording> train = at_work(c, recordings.train.recordings, too_short),
                         held_out = at_work(c, recordings.held_out.recordings, too_short);
  std::optional<ControllerModel> sought = recordings.sought;
  if (loop && internal::run::has_another_law(*loop)) {
    asked.controller = loop->controller, sought.reset();
    internal::run::command_anew(loop->controller, train);
    internal::run::command_anew(loop->controller, held_out);
  }
  Diagnosis d = diagnose(internal::run::traces_of(train), internal::run::traces_of(held_out),
                         internal::run::diagnosed_model(c, sought), asked);
  put_into_words(d, c.coordinates);
  if (!too_short.empty())
    d.warnings.push_back(
        fmt::format("left out, as the controller was at work through fewer than {} samples: {}.",
                    kFewestSamples, fmt::join(too_short, ", ")));
  d.controller = d.fitted.controller ? d.fitted.controller->at_start() : asked.controller;
  internal::run::tell_closed_loop(recordings, loop, d);
  if (finish_requested()) {
    d.fitted.controller.reset();
    return d;
  }
  const std::string found = internal::run::controller_found(c, d, recordings.train.recordings);
  if (!found.empty()) d.warnings.push_back(found);
  d.fitted.controller.reset();
  return d;
}

DiagnosisOutcome run_diagnosis(const Configuration& given, const DiagnosisOptions& options,
                               const Progress& told_before) {
  std::vector<std::string> rate;
  const Configuration c = internal::run::with_settled_rate(given, options.progress, rate);
  const std::vector<FileHash> sources = sources_of(c);
  DiagnosisRecordings recordings = load_for_diagnosis(c, options.progress);
  const internal::run::SimulatedRecordings simulated =
      internal::run::load_simulated(c, recordings, options.progress);
  require_unchanged(c, sources);
  std::vector<std::string> warnings = std::move(recordings.train.warnings);
  warnings.insert(warnings.begin(), rate.begin(), rate.end());
  bool swapped = false;
  if (std::string order = other_way_round(c, recordings); !order.empty()) {
    told_before(order);
    warnings.push_back(std::move(order));
    swapped = true;
  }
  const internal::run::Checked seen = checked(c, options.progress);
  for (const auto& more : {recordings.held_out.warnings, seen.warnings})
    warnings.insert(warnings.end(), more.begin(), more.end());
  DiagnosisResult result{c.name, version(), resolved_yaml(c), c.coordinates,
                         diagnose_recordings(c, recordings, options)};
  result.sources = sources;
  result.input = internal::run::known_input(c);
  result.simulated_data = internal::run::simulated_words(c, true);
  result.answer.emplace().tolerance = c.tolerance;
  Diagnosis& d = result.diagnosis;
  d.better_swapped = swapped;
  d.doubts.insert(d.doubts.begin(), seen.of_fit.begin(), seen.of_fit.end());
  const std::vector<std::string> guesses = internal::run::guess_warnings(c);
  warnings.insert(warnings.end(), guesses.begin(), guesses.end());
  for (std::string more :
       {internal::run::hanging_warning(c, d.fitted),
        internal::run::doubtful_delay(c, recordings.train.motor_traces(), d), excluded_words(c, d)})
    if (!more.empty()) warnings.push_back(std::move(more));
  d.warnings.insert(d.warnings.begin(), warnings.begin(), warnings.end());
  for (std::string& warning : d.warnings) warning = with_input_unit(warning, c.input_facts());
  if (!simulated.empty()) {
    result.simulated = unless_finishing(
        [&] { return internal::run::compare_simulated(c, recordings, simulated, d, options); });
    if (!result.simulated)
      d.warnings.emplace_back(
          "stopped before the simulator was looked at to the end: nothing is said of it.");
  }
  ask_further(c, recordings.train.recordings.front().motor_trace(), options, d);
  put_into_words(d, c.coordinates);  // once more: what would decide is known now
  return {std::move(result), std::move(recordings.train.recordings.front())};
}

}  // namespace gapscope

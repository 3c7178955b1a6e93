#include "results/run_result.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "base/require.h"
#include "gapscope/base/errors.h"
#include "recording/supply.h"
#include "results/json_archive.h"
#include "results/json_schema.h"
#include "results/run_result_fields.h"
#include "results/traces.h"

namespace gapscope {
namespace fs = std::filesystem;
namespace {

using internal::results::Document;
using internal::results::JsonReader;
using internal::results::JsonWriter;
using internal::results::kSchema;
using internal::results::StoredRecording;
using internal::results::TraceSet;
using internal::results::TraceSink;

/// What the contract of the file promises; another state is a bug of the caller.
void require_consistent(const GapEstimate& g) {
  GAPSCOPE_REQUIRE(g.verdict != GapVerdict::kNotRun);
  GAPSCOPE_REQUIRE(std::isnan(g.gap) == (g.verdict != GapVerdict::kBacklash));
  GAPSCOPE_REQUIRE(g.verdict != GapVerdict::kInconclusive || !g.reason.empty());
  GAPSCOPE_REQUIRE(g.verdict != GapVerdict::kNone || !std::isnan(g.smallest_visible_gap));
  for (const GapEvent& e : g.events) GAPSCOPE_REQUIRE(e.direction == 1 || e.direction == -1);
}

/// The trace of each recording, nullptr where it has none. Recordings of one name take the traces of that
/// name in turn.
template <class Part>
auto traces_by_recording(const std::vector<Recording>& recordings, std::optional<Part>& part) {
  using Trace = typename decltype(part->traces)::value_type;
  std::vector<Trace*> found(recordings.size(), nullptr);
  if (!part) return found;
  for (Trace& trace : part->traces) {
    std::size_t i = 0;
    while (i < recordings.size() && (found[i] || recordings[i].file != trace.file)) ++i;
    if (i == recordings.size()) throw std::logic_error("the trace of " + trace.file + " has no recording");
    found[i] = &trace;
  }
  return found;
}

void save(const std::string& path, JsonWriter& writer) { internal::results::save_json(path, writer.json); }

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directory(folder, error);
  if (error) throw std::runtime_error(folder.string() + ": cannot be created: " + error.message());
}

/// Target and supply of its samples; without a supply none.
std::pair<std::vector<double>, std::vector<double>> commanded_part(const Recording& r) {
  const CommandRows& rows = *r.command;
  const auto part_of = [&](const std::vector<double>& values) {
    const auto begin = values.begin() + static_cast<std::ptrdiff_t>(r.command_first);
    return std::vector<double>(begin, begin + static_cast<std::ptrdiff_t>(r.size()));
  };
  return {part_of(rows.target), is_supplied(rows) ? part_of(rows.supply) : std::vector<double>()};
}

/// Takes the samples along, so that a long recording is held once.
StoredRecording store_recording(std::size_t index, Recording& recording, ErrorTrace* error, FitTrace* fit,
                                const TraceSink& sink) {
  StoredRecording stored;
  stored.trace = trace_name(index, recording.file);
  stored.samples = static_cast<int>(recording.size());
  stored.has_error = error != nullptr;
  stored.has_fit = fit != nullptr;
  stored.recording = {recording.file,    recording.start,     recording.dt, {}, {}, {}, {},
                      recording.quantum, recording.resampling};
  stored.recording.encoder = recording.encoder;
  TraceSet set;
  if (recording.command) std::tie(set.target, set.supply) = commanded_part(recording);
  set.recording = std::move(recording);
  if (error) set.error = std::move(*error);
  if (fit) set.fit = std::move(*fit);
  sink(stored.trace, std::move(set));
  return stored;
}

/// All but the samples, which go where the sink takes them.
Document store_samples(RunResult result, const TraceSink& sink) {
  if (result.model_free) require_consistent(*result.model_free);
  Document document;
  document.run = std::move(result);
  RunResult& run = document.run;
  const auto errors = traces_by_recording(run.recordings, run.model_free);
  const auto fits = traces_by_recording(run.recordings, run.reference);
  for (std::size_t i = 0; i < run.recordings.size(); ++i)
    document.recordings.push_back(store_recording(i, run.recordings[i], errors[i], fits[i], sink));
  run.recordings.clear();
  if (run.model_free) run.model_free->traces.clear();
  if (run.reference) run.reference->traces.clear();
  return document;
}

void load_recording(const std::string& folder, const StoredRecording& stored, RunResult& run) {
  const std::string path = internal::results::trace_path(folder, stored.trace);
  TraceSet set;
  set.recording = stored.recording;
  set.error.file = set.fit.file = stored.recording.file;
  set.fit.encoder = stored.recording.encoder;
  internal::results::read_trace(path, set);
  if (set.fit.x2.empty()) set.fit.encoder = EncoderSide::kMotor;  // one body: x1 is both
  if (static_cast<int>(set.recording.size()) != stored.samples)
    throw ConfigError(path, "has " + std::to_string(set.recording.size()) + " samples, expected " +
                                std::to_string(stored.samples));
  if (stored.has_error && set.error.error.empty())
    throw ConfigError(path, 1, "there is no column e_x_rad, expected it as result.json says");
  if (stored.has_fit && set.fit.x1.empty())
    throw ConfigError(path, 1, "there is no column fit_x1_rad, expected it as result.json says");
  if (stored.has_error && run.model_free) run.model_free->traces.push_back(std::move(set.error));
  if (stored.has_fit && run.reference) run.reference->traces.push_back(std::move(set.fit));
  run.recordings.push_back(std::move(set.recording));
}

/// A map spans its bounds on a logarithmic axis.
void require_bounds(const JsonReader& reader, const RunResult& run) {
  if (!run.model_free || !run.model_free->map) return;
  const std::vector<double>& bounds = run.model_free->map->bounds;
  const auto no_rise = [](double a, double b) { return !(a < b); };
  const bool rises = std::adjacent_find(bounds.begin(), bounds.end(), no_rise) == bounds.end();
  if (bounds.size() < 2 || !rises || !(bounds.front() > 0.0))
    reader.fail_at("model_free.bound_map.bounds_rad_s2",
                   "does not rise, expected two bounds above 0 or more");
}

/// A passage of the gap takes samples: more events than there are would only be drawn for a long time.
void require_events(const JsonReader& reader, const Document& document) {
  if (!document.run.model_free || document.recordings.empty()) return;
  std::size_t samples = 0;
  for (const StoredRecording& stored : document.recordings)
    samples += static_cast<std::size_t>(std::max(0, stored.samples));
  const std::size_t events = document.run.model_free->events.size();
  if (events > samples)
    reader.fail_at("model_free.events", "has " + std::to_string(events) +
                                            " items, expected at most one for each of " +
                                            std::to_string(samples) + " samples");
}

}  // namespace

RunResult write_run_result(const std::string& folder, RunResult result) {
  if (!result.recordings.empty()) make_folder(fs::path(folder) / "traces");
  if (result.model_free && result.model_free->map && !result.recordings.empty())
    internal::results::write_bound_map(folder + "/traces/" + internal::results::kBoundMapName,
                                       *result.model_free->map);
  Document document = store_samples(std::move(result), internal::results::into_folder(folder));
  JsonWriter writer;
  fields(writer, document);
  save(folder + "/result.json", writer);
  return std::move(document.run);
}

StoredResult stored_run_result(RunResult result) {
  StoredResult stored;
  Document document = store_samples(std::move(result), internal::results::into_tables(stored.traces));
  JsonWriter writer;
  fields(writer, document);
  stored.json = internal::results::file_text(writer.json);
  return stored;
}

RunResult read_run_result(const std::string& folder) {
  const std::string path = folder + "/result.json";
  const internal::results::Json json = internal::results::load_json(path);
  JsonReader reader(json, path, "");
  Document document;
  reader.schema(kSchema);
  fields(reader, document);
  RunResult& run = document.run;
  require_bounds(reader, run);
  require_events(reader, document);
  for (const StoredRecording& stored : document.recordings) load_recording(folder, stored, run);
  if (run.model_free && run.model_free->map && !run.recordings.empty())
    internal::results::read_bound_map(folder + "/traces/" + internal::results::kBoundMapName,
                                      *run.model_free->map);
  return std::move(run);
}

namespace internal::results {

Json result_schema() {
  Json schema = document_schema(kSchema, Document());
  Json& estimate = schema["properties"]["model_free"]["anyOf"][0]["properties"];
  const auto describe = [](Json& properties, const char* key, const char* text) {
    properties[key]["description"] = text;
  };
  describe(
      estimate, "smallest_visible_gap_rad",
      "smallest gap that would have shown, for loads of 0.3 of the motor's inertia and more, by none of 0.1 "
      "and more; null where it is not known, and where it is no smaller than a gap that shows");
  describe(
      estimate, "gap_at_most_rad",
      "no gap is larger: by the denial, by the loop of lost motion, whose play at one torque level is a "
      "bound and a gap only where the output is declared locked, or by passages that end in an impact, if "
      "their load was no faster than the motor; null where no bound is known");
  Json& event = estimate["events"]["items"]["properties"];
  describe(event, "t_c_s", "e_x is at rest from here to t1; null where it was not");
  describe(event, "t1_s", "contact is lost; null where only the impact is seen");
  describe(event, "t2_s", "contact is regained");
  return schema;
}

Json timing_schema() {
  Timing timing;
  return SchemaWriter::schema_of(timing);
}

}  // namespace internal::results

void write_timing(const std::string& folder, const Timing& timing) {
  Timing copy = timing;
  JsonWriter writer;
  fields(writer, copy);
  save(folder + "/timing.json", writer);
}

Timing read_timing(const std::string& folder) {
  const std::string path = folder + "/timing.json";
  Timing timing;
  if (!fs::exists(path)) return timing;
  const internal::results::Json json = internal::results::load_json(path);
  JsonReader reader(json, path, "");
  fields(reader, timing);
  return timing;
}

}  // namespace gapscope

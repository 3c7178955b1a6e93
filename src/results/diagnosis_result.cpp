#include "results/diagnosis_result.h"

#include <fmt/format.h>

#include <filesystem>

#include "base/require.h"
#include "gapscope/base/errors.h"
#include "results/diagnosis_result_fields.h"
#include "results/json_schema.h"
#include "results/traces.h"

namespace gapscope {
namespace {

using internal::results::DiagnosisDocument;
using internal::results::JsonReader;
using internal::results::JsonWriter;
using internal::results::SimulatorDocument;
using internal::results::StoredMismatch;
using internal::results::StoredSimulatorTrace;
using internal::results::TraceSet;
using internal::results::TraceSink;

/// What the contract of the file promises; another state is a bug of the caller.
void require_consistent(const Diagnosis& d) {
  GAPSCOPE_REQUIRE(d.verdict != DiagnosisVerdict::kNotRun);
  const bool found = d.verdict == DiagnosisVerdict::kEffect || d.verdict == DiagnosisVerdict::kHelps;
  GAPSCOPE_REQUIRE(found == !d.effects.empty() && d.added.size() == d.effects.size());
  GAPSCOPE_REQUIRE(d.effects.empty() == d.group.empty());
}

TraceSet set_of(const MismatchTrace& m) {
  Recording r{m.file, m.start, m.dt, m.u, m.x1, {}, m.mode, 0.0, "", false, m.stamps, m.encoder};
  if (m.encoder == EncoderSide::kLoad) std::swap(r.x1, r.x2);
  TraceSet set{std::move(r), {}, {}, m.error_before, m.error_after, m.torque_before, m.torque_after};
  set.target = m.target, set.supply = m.supply;
  set.simulated_before = m.simulated_before, set.simulated_after = m.simulated_after;
  return set;
}

StoredMismatch store(std::size_t index, const MismatchTrace& m, const TraceSink& sink) {
  StoredMismatch stored;
  stored.trace = held_out_trace_name(index, m.file);
  stored.samples = static_cast<int>(m.x1.size());
  stored.scored_from = static_cast<int>(m.scored_from);
  stored.mismatch.file = m.file, stored.mismatch.start = m.start, stored.mismatch.dt = m.dt;
  stored.mismatch.encoder = m.encoder;
  sink(stored.trace, set_of(m));
  return stored;
}

TraceSet read_set(const std::string& folder, const std::string& trace, int samples, double start, double dt,
                  EncoderSide encoder = EncoderSide::kMotor) {
  const std::string path = internal::results::trace_path(folder, trace);
  TraceSet set;
  set.recording.start = start, set.recording.dt = dt, set.recording.encoder = encoder;
  internal::results::read_trace(path, set);
  if (static_cast<int>(set.recording.size()) != samples)
    throw ConfigError(path, "has " + std::to_string(set.recording.size()) + " samples, expected " +
                                std::to_string(samples));
  return set;
}

MismatchTrace load(const std::string& folder, const StoredMismatch& stored) {
  MismatchTrace m = stored.mismatch;
  TraceSet set = read_set(folder, stored.trace, stored.samples, m.start, m.dt, m.encoder);
  m.scored_from = static_cast<std::size_t>(stored.scored_from);
  if (m.encoder == EncoderSide::kLoad) std::swap(set.recording.x1, set.recording.x2);
  m.u = std::move(set.recording.u), m.x1 = std::move(set.recording.x1),
  m.mode = std::move(set.recording.mode), m.stamps = std::move(set.recording.stamps);
  m.error_before = std::move(set.error_before), m.error_after = std::move(set.error_after);
  m.torque_before = std::move(set.torque_before), m.torque_after = std::move(set.torque_after);
  m.target = std::move(set.target), m.supply = std::move(set.supply);
  m.simulated_before = std::move(set.simulated_before), m.simulated_after = std::move(set.simulated_after);
  return m;
}

SimulatorDocument store(const SimulatorComparison& comparison, const TraceSink& sink) {
  SimulatorDocument document{comparison, {}};
  for (const SimulatorTrace& t : comparison.traces) {
    StoredSimulatorTrace stored;
    stored.trace = trace_name(document.traces.size(), t.file).insert(7, "held_out_simulator_");
    stored.samples = static_cast<int>(t.x1.size());
    stored.scored_from = static_cast<int>(t.scored_from);
    stored.of.file = t.file, stored.of.simulated = t.simulated, stored.of.start = t.start,
    stored.of.dt = t.dt;
    TraceSet set;
    set.recording = {t.file, t.start, t.dt, t.u, t.x1, {}, {}, 0.0, "", false, t.stamps};
    set.fit.x1 = t.fitted, set.simulator = t.simulator, set.stand_in = t.stand_in, set.mended = t.mended;
    sink(stored.trace, std::move(set));
    document.traces.push_back(std::move(stored));
  }
  return document;
}

SimulatorComparison load(const std::string& folder, SimulatorDocument& document) {
  SimulatorComparison comparison = std::move(document.comparison);
  for (const StoredSimulatorTrace& stored : document.traces) {
    SimulatorTrace t = stored.of;
    TraceSet set = read_set(folder, stored.trace, stored.samples, t.start, t.dt);
    t.scored_from = static_cast<std::size_t>(stored.scored_from);
    t.u = std::move(set.recording.u), t.x1 = std::move(set.recording.x1);
    t.stamps = std::move(set.recording.stamps), t.fitted = std::move(set.fit.x1);
    t.simulator = std::move(set.simulator), t.stand_in = std::move(set.stand_in),
    t.mended = std::move(set.mended);
    comparison.traces.push_back(std::move(t));
  }
  return comparison;
}

/// The document, its traces where the sink takes them.
internal::results::Json store(const DiagnosisResult& result, const TraceSink& sink) {
  require_consistent(result.diagnosis);
  DiagnosisDocument document;
  document.result = result;
  for (std::size_t i = 0; i < result.diagnosis.traces.size(); ++i)
    document.held_out.push_back(store(i, result.diagnosis.traces[i], sink));
  if (result.simulated) document.simulated = store(*result.simulated, sink);
  JsonWriter writer;
  fields(writer, document);
  return std::move(writer.json);
}

}  // namespace

namespace internal::results {

Json diagnosis_schema() { return document_schema(kDiagnosisSchema, DiagnosisDocument()); }

}  // namespace internal::results

std::string held_out_trace_name(std::size_t index, const std::string& recording_file) {
  return trace_name(index, recording_file).insert(7, "held_out_");  // after "traces/"
}

void write_diagnosis_result(const std::string& folder, const DiagnosisResult& result) {
  std::filesystem::create_directories(folder + "/traces");
  internal::results::save_json(folder + "/diagnosis.json",
                               store(result, internal::results::into_folder(folder)));
}

StoredResult stored_diagnosis_result(const DiagnosisResult& result) {
  StoredResult stored;
  stored.json = internal::results::file_text(store(result, internal::results::into_tables(stored.traces)));
  return stored;
}

DiagnosisResult read_diagnosis_result(const std::string& folder) {
  const std::string path = folder + "/diagnosis.json";
  const internal::results::Json json = internal::results::load_json(path);
  JsonReader reader(json, path, "");
  DiagnosisDocument document;
  reader.schema(internal::results::kDiagnosisSchema);
  fields(reader, document);
  for (const StoredMismatch& stored : document.held_out)
    document.result.diagnosis.traces.push_back(load(folder, stored));
  if (document.simulated) document.result.simulated = load(folder, *document.simulated);
  return std::move(document.result);
}

std::string compensation_name(const LastResortLaw& law) { return "compensation_" + law.law + ".csv"; }

std::string compensation_csv(const LastResortLaw& law) {
  const char* const abscissa = law.variable == "speed"      ? "speed_rad_s"
                               : law.variable == "position" ? "position_rad"
                                                            : "input";
  std::string text = fmt::format("{},compensation_nm,low_nm,high_nm\n", abscissa);
  for (const CurvePoint& p : law.curve)  // what the drive lacks, with the other sign
    text += fmt::format("{},{},{},{}\n", p.at, 0.0 - p.torque, 0.0 - p.ci95.high, 0.0 - p.ci95.low);
  return text;
}

std::string input_csv(const NextExperiment& experiment) {
  std::string text = "t,u\n";
  for (std::size_t i = 0; i < experiment.u.size(); ++i)
    text += fmt::format("{},{}\n", static_cast<double>(i) / experiment.rate, experiment.u[i]);
  return text;
}

}  // namespace gapscope

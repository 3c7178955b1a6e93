#include "results/stream_lines.h"

#include <algorithm>

#include "gapscope/base/version.h"
#include "results/json_schema.h"
#include "results/run_result_fields.h"

namespace gapscope {
namespace internal::results {

template <class Archive>
void fields(Archive& archive, LearntFacts& l) {
  archive("until_s", l.until);
  archive("half_period_s", l.half_period);
  archive("quantum_rad", l.quantum);
  archive("noise_rad", l.noise);
  archive("travel_rad", l.travel);
  archive("sliding_bound_rad_s2", l.sliding_bound);
  archive("least_bound_rad_s2", l.least_bound);
  archive("bounds_rad_s2", l.bounds);
  archive("floors_rad", l.floors);
}

namespace {

constexpr const char* kStreamSchema = "gapscope.stream/1";
constexpr const char* kNotInEvents[] = {"file", "t_c_s"};
constexpr const char* kNotInSummaries[] = {"bound_t1_rad_s2", "paper_bound_rad_s2", "scale", "events",
                                           "bound_map"};

SchemaWriter schema_of_line(const char* kind) {
  SchemaWriter writer;
  writer.constant("schema", kStreamSchema);
  writer.constant("kind", kind);
  return writer;
}

Json settings_schema() {
  SchemaWriter writer = schema_of_line("settings");
  std::string text;
  writer("version", text);
  writer.configuration(text);
  return writer.schema();
}

Json summary_schema() {
  SchemaWriter writer = schema_of_line("summary");
  GapEstimate estimate;
  writer("until_s", estimate.gap);
  for (const char* key : {"samples", "passages", "passages_judged"}) writer.count(key);
  fields(writer, estimate);
  for (const char* of_a_report : kNotInSummaries) writer.erase(of_a_report);
  return writer.schema();
}

}  // namespace

Json stream_schema() {
  LearntFacts facts;
  GapEvent passage;
  SchemaWriter learnt = schema_of_line("learnt"), event = schema_of_line("event");
  fields(learnt, facts);
  fields(event, passage);
  for (const char* of_a_report : kNotInEvents) event.erase(of_a_report);
  return {{"oneOf", {settings_schema(), learnt.schema(), event.schema(), summary_schema()}}};
}

}  // namespace internal::results

namespace {

using internal::results::JsonWriter;

JsonWriter line_of(std::string kind) {
  JsonWriter writer;
  std::string schema = internal::results::kStreamSchema;
  writer("schema", schema);
  writer("kind", kind);
  return writer;
}

}  // namespace

std::string settings_line(const std::string& configuration) {
  std::string program = version(), resolved = configuration;
  JsonWriter writer = line_of("settings");
  writer("version", program);
  writer.configuration(resolved);
  return internal::results::text_of(writer.json, -1) + "\n";
}

std::string learnt_line(const LearntFacts& learnt) {
  LearntFacts l = learnt;
  JsonWriter writer = line_of("learnt");
  internal::results::fields(writer, l);
  return writer.json.dump() + "\n";
}

std::string event_line(const GapEvent& event) {
  GapEvent e = event;
  JsonWriter writer = line_of("event");
  fields(writer, e);
  for (const char* of_a_report : internal::results::kNotInEvents) writer.json.erase(of_a_report);
  return writer.json.dump() + "\n";
}

std::string summary_line(const GapEstimate& estimate, const StreamProgress& progress) {
  GapEstimate g = estimate;
  JsonWriter writer = line_of("summary");
  double until = progress.until;
  writer("until_s", until);
  writer.json["samples"] = progress.samples;
  writer.json["passages"] = progress.passages;
  writer.json["passages_judged"] = std::min(progress.passages, StreamDetector::kMostJudged);
  fields(writer, g);
  for (const char* of_a_report : internal::results::kNotInSummaries) writer.json.erase(of_a_report);
  return writer.json.dump() + "\n";
}

}  // namespace gapscope

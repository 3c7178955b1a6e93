#include "gapscope/results/stream_lines.h"

#include <algorithm>

#include "results/run_result_fields.h"

namespace gapscope {
namespace {

using internal::JsonWriter;

JsonWriter line_of(std::string kind) {
  JsonWriter writer;
  std::string schema = "gapscope.stream/1";
  writer("schema", schema);
  writer("kind", kind);
  return writer;
}

}  // namespace

std::string learnt_line(const LearntFacts& learnt) {
  LearntFacts l = learnt;
  JsonWriter writer = line_of("learnt");
  writer("until_s", l.until);
  writer("half_period_s", l.half_period);
  writer("quantum_rad", l.quantum);
  writer("noise_rad", l.noise);
  writer("travel_rad", l.travel);
  writer("sliding_bound_rad_s2", l.sliding_bound);
  writer("least_bound_rad_s2", l.least_bound);
  writer("bounds_rad_s2", l.bounds);
  writer("floors_rad", l.floors);
  return writer.json.dump() + "\n";
}

std::string event_line(const GapEvent& event) {
  GapEvent e = event;
  JsonWriter writer = line_of("event");
  fields(writer, e);
  writer.json.erase("file");
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
  for (const char* of_a_report : {"bound_t1_rad_s2", "paper_bound_rad_s2", "scale", "events", "bound_map"})
    writer.json.erase(of_a_report);
  return writer.json.dump() + "\n";
}

}  // namespace gapscope

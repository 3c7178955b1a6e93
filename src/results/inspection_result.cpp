#include "gapscope/results/inspection_result.h"

#include "results/json_archive.h"

namespace gapscope {
namespace internal {

template <class Archive>
void fields(Archive& archive, Finding& f) {
  archive("rule", f.rule);
  archive.choice(
      "severity", f.severity,
      Words<Severity>{{Severity::kFine, "fine"}, {Severity::kNote, "note"}, {Severity::kSpoils, "spoils"}});
  archive("found", f.found);
  archive("advice", f.advice);
}

template <class Archive>
void fields(Archive& archive, RecordingFacts& f) {
  archive("samples", f.samples);
  archive("skipped_rows", f.skipped_rows);
  archive("uniform", f.uniform);
  archive("missing_samples", f.missing_samples);
  archive("start_s", f.start);
  archive("duration_s", f.duration);
  archive("rate_hz", f.rate);
  archive("shortest_step_s", f.shortest_step);
  archive("longest_step_s", f.longest_step);
  archive("quantum_rad", f.quantum);
  archive("noise_rad", f.noise);
  archive("travel_rad", f.travel);
  archive("speed_rms_rad_s", f.speed_rms);
  archive("period_s", f.period);
  archive("half_periods", f.half_periods);
  archive("input_peak", f.input_peak);
  archive("input_noise", f.input_noise);
  archive("input_period_s", f.input_period);
  archive("input_frequency_hz", f.input_frequency);
  archive("line_share", f.line_share);
  archive("input_band_hz", f.input_band);
  archive("clipped_share", f.clipped_share);
  archive("work_cosine", f.work_cosine);
  archive("inertia_u_s2_rad", f.inertia);
  archive("damping_u_s_rad", f.damping);
  archive("friction_u", f.friction);
  archive("feedback", f.feedback);
  archive("rest_share", f.rest_share);
}

}  // namespace internal

std::string inspection_json(const Inspection& inspection) {
  Inspection i = inspection;
  std::string schema = "gapscope.check/1", coordinates = i.rotation ? "rotation" : "translation";
  bool spoilt = i.spoilt();
  internal::JsonWriter writer;
  writer("schema", schema);
  writer("file", i.file);
  writer("coordinates", coordinates);
  writer("spoilt", spoilt);
  writer.list("findings", i.findings);
  writer.single("facts", i.facts);
  return writer.json.dump(1) + "\n";
}

}  // namespace gapscope

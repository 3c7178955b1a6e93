#include "results/inspection_result.h"

#include "gapscope/base/errors.h"
#include "gapscope/base/version.h"
#include "results/json_archive.h"
#include "results/json_schema.h"

namespace gapscope {
namespace internal::results {

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
  archive("coarse_clock", f.coarse_clock);
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

/// What was taken for granted.
struct Assumption {
  std::string code, told;
};

template <class Archive>
void fields(Archive& archive, Assumption& a) {
  archive("code", a.code);
  archive("told", a.told);
}

std::vector<Assumption> assumptions_of(const Inspection& inspection) {
  std::vector<Assumption> all;
  for (const Remark& r : inspection.assumed) all.push_back({r.code(), r.text(inspection.coordinates)});
  return all;
}

/// What was found, by which version, read in which way.
struct InspectionDocument {
  Inspection inspection;
  std::vector<Assumption> assumed;
  std::string version, configuration;
};

template <class Archive>
void fields(Archive& archive, InspectionDocument& d) {
  Inspection& i = d.inspection;
  bool spoilt = i.spoilt();
  archive("file", i.file);
  archive("version", d.version);
  coordinates_field(archive, i.coordinates);
  archive.choice("asked_for", i.purpose,
                 Words<Purpose>{{Purpose::kAll, "all"},
                                {Purpose::kGap, "gap"},
                                {Purpose::kFit, "fit"},
                                {Purpose::kDiagnosis, "diagnosis"}});
  archive("spoilt", spoilt);
  archive.list("assumed", d.assumed);
  archive.list("findings", i.findings);
  archive.single("facts", i.facts);
  archive.configuration(d.configuration);
}

constexpr const char* kCheckSchema = "gapscope.check/1";

Json check_schema() { return document_schema(kCheckSchema, InspectionDocument()); }

}  // namespace internal::results

bool is_inspection_file(const std::string& path) {
  try {
    const internal::results::Json json = internal::results::load_json(path);
    internal::results::JsonReader(json, path, "").schema(internal::results::kCheckSchema);
    return true;
  } catch (const ConfigError&) {
    return false;
  }
}

std::string inspection_json(const Inspection& inspection, const std::string& configuration) {
  internal::results::InspectionDocument document{inspection, internal::results::assumptions_of(inspection),
                                                 version(), configuration};
  std::string schema = internal::results::kCheckSchema;
  internal::results::JsonWriter writer;
  writer("schema", schema);
  fields(writer, document);
  return internal::results::file_text(writer.json);
}

}  // namespace gapscope

#include "gapscope/results/certificate.h"

#include "results/json_document.h"
#include "results/json_schema.h"

namespace gapscope {
namespace internal::results {
namespace {

constexpr const char* kExportSchema = "gapscope.export/1";

}  // namespace

template <class Archive>
void fields(Archive& archive, CarriedPart& p) {
  archive("part", p.part);
  archive.choice("fidelity", p.fidelity,
                 Words<Fidelity>{{Fidelity::kExact, "exact"},
                                 {Fidelity::kApproximate, "approximate"},
                                 {Fidelity::kLeftOut, "left_out"}});
  archive("how", p.how);
}

template <class Archive>
void fields(Archive& archive, TargetError& e) {
  archive("integrator", e.integrator);
  archive("step_s", e.step);
  archive("rms_rad", e.rms);
  archive("max_rad", e.max);
  archive("diverges", e.diverges);
  archive("unstable", e.unstable);
  archive("within_encoder", e.within_encoder);
}

template <class Archive>
void fields(Archive& archive, StepLimits& l) {
  archive("integrator", l.integrator);
  archive("against_itself", l.against_itself);
  archive("largest_step_s", l.largest);
  archive("within_encoder_step_s", l.within_encoder);
}

template <class Archive>
void fields(Archive& archive, Certificate& c) {
  archive("name", c.name);
  archive("version", c.version);
  archive("format", c.format);
  coordinates_field(archive, c.coordinates);
  archive("files", c.files);
  archive.list("parts", c.parts);
  archive("input", c.input);
  archive("duration_s", c.duration);
  archive("travel_rad", c.travel);
  archive("encoder_floor_rad", c.encoder_floor);
  archive.list("errors", c.errors);
  archive.list("limits", c.limits);
  archive("default_friction_rms_rad", c.default_error);
  archive("own_file", c.own_file);
  archive("warnings", c.warnings);
  archive.configuration(c.configuration);
}

Json export_schema() { return document_schema(kExportSchema, Certificate()); }

}  // namespace internal::results

std::string certificate_json(const Certificate& certificate) {
  return internal::results::file_text(
      internal::results::document_of(internal::results::kExportSchema, certificate));
}

}  // namespace gapscope

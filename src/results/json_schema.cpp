#include "results/json_schema.h"

#include "results/json_schemas.h"

namespace gapscope {
namespace internal::results {

void SchemaWriter::operator()(const char* key, Interval& value) { add(key, type_of(value)); }

Json SchemaWriter::type_of(const Interval&) {
  return {{"type", {"array", "null"}}, {"items", {{"type", "number"}}}, {"minItems", 2}, {"maxItems", 2}};
}

void SchemaWriter::bound(const char* key, double&) {
  add(key, {{"anyOf", {type_of(0.0), {{"enum", {"inf", "-inf"}}}}}});
}

void SchemaWriter::configuration(std::string& resolved) {
  SchemaWriter made;
  made("resolved", resolved);
  made.add("sha256", {{"type", "string"}, {"pattern", "^[0-9a-f]{64}$"}});
  add(kConfiguration, {{"description", "absent in files that were written before it was stored"},
                       {"anyOf", {made.schema(), {{"type", "null"}}}}});
}

Json SchemaWriter::schema() const {
  Json required = Json::array();
  for (const auto& [key, any] : properties_.items())
    if (!additions_.contains(key)) required.push_back(key);
  return {{"type", "object"}, {"properties", properties_}, {"required", required}};
}

namespace {

std::string text_of(const char* title, const Json& schema) {
  Json document = {{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", title}};
  document.update(schema);
  return document.dump(1) + "\n";
}

}  // namespace
}  // namespace internal::results

std::vector<JsonSchema> json_schemas() {
  using namespace internal::results;
  return {
      {"blind", text_of("blind.json of gapscope blind score and run", blind_schema())},
      {"blind_answers", text_of("The answers of gapscope blind answer", blind_answers_schema())},
      {"blind_labels", text_of("The labels of gapscope blind make and seal", blind_labels_schema())},
      {"blind_manifest", text_of("manifest.json of gapscope blind make and seal", blind_manifest_schema())},
      {"campaign", text_of("campaign.json of gapscope campaign", campaign_schema())},
      {"check", text_of("What gapscope check --json says", check_schema())},
      {"compare", text_of("compare.json of gapscope compare", compare_schema())},
      {"diagnosis", text_of("diagnosis.json of gapscope diagnose", diagnosis_schema())},
      {"export", text_of("certificate.json of gapscope export", export_schema())},
      {"files", text_of("files.json of every folder that gapscope writes", files_schema())},
      {"result", text_of("result.json of gapscope run, detect and fit", result_schema())},
      {"stream", text_of("A line of gapscope detect --stream", stream_schema())},
      {"timing", text_of("timing.json of gapscope run, detect and fit", timing_schema())}};
}

}  // namespace gapscope

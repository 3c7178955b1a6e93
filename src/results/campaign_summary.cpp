#include "results/campaign_summary.h"

#include <algorithm>
#include <filesystem>

#include "results/json_archive.h"
#include "results/json_schema.h"

namespace gapscope {
namespace internal::results {

constexpr const char* kCampaignSchema = "gapscope.campaign/2";

template <class Archive>
void fields(Archive& archive, SummaryBin& b) {
  archive("label", b.label);
  archive("value", b.value);
}

template <class Archive>
void fields(Archive& archive, SummaryAxis& a) {
  archive("path", a.path);
  archive("name", a.name);
  archive.list("bins", a.bins);
}

template <class Archive>
void fields(Archive& archive, EstimatorScore& s) {
  archive("runs", s.runs);
  archive("answered", s.answered);
  archive("denied", s.denied);
  archive("judged", s.judged);
  archive("within_1_percent", s.within_1);
  archive("within_2_percent", s.within_2);
  archive("within_5_percent", s.within_5);
  archive("claimed", s.claimed);
  archive("covered", s.covered);
  archive("good", s.good);
  archive("good_covered", s.good_covered);
  archive("median_relative_error", s.median_error);
  archive("relative_error_of_90_percent", s.error_90);
  archive("relative_bias", s.bias);
  archive("relative_bias_ci95", s.bias_ci);
  archive("median_relative_width", s.median_width);
  archive("relative_interval_score", s.interval_score);
  archive("passes", s.passes);
}

template <class Archive>
void fields(Archive& archive, SummaryCell& c) {
  archive("a", c.a);
  archive("b", c.b);
  archive("runs", c.runs);
  archive("failed", c.failed);
  archive.single("literal", c.literal);
  archive.single("model_free", c.model_free);
  archive.single("reference", c.reference);
  archive("both_answered", c.both);
  archive("disagree", c.disagree);
  archive("model_free_nearer", c.model_free_nearer);
}

template <class Archive>
void fields(Archive& archive, EstimatorPair& p) {
  archive("first", p.first);
  archive("second", p.second);
  archive("both", p.both);
  archive("first_nearer", p.first_nearer);
  archive("first_median_relative_error", p.first_error);
  archive("second_median_relative_error", p.second_error);
  archive("relative_advantage", p.advantage);
  archive("relative_advantage_ci95", p.advantage_ci);
  archive("claimed", p.claimed);
  archive("disagree", p.disagree);
  archive("correlation", p.correlation);
  archive("correlation_ci95", p.correlation_ci);
  archive("disagree_correlated", p.disagree_correlated);
}

template <class Archive>
void fields(Archive& archive, SummaryTold& t) {
  archive("estimator", t.estimator);
  archive("told", t.told);
  archive("lacks", t.lacks);
}

template <class Archive>
void fields(Archive& archive, SummaryTable& t) {
  archive("axis_a", t.a);
  archive("axis_b", t.b);
  archive.list("cells", t.cells);
}

template <class Archive>
void fields(Archive& archive, SummaryCount& c) {
  archive("text", c.text);
  archive("runs", c.runs);
}

template <class Archive>
void fields(Archive& archive, SummaryAnswer& a) {
  archive("tolerance", a.tolerance);
  archive("estimator", a.estimator);
  archive("parameters", a.parameters);
  archive("needs", a.needs);
}

template <class Archive>
void fields(Archive& archive, CampaignSummary& s) {
  archive("name", s.name);
  archive("version", s.version);
  archive.configuration(s.configuration);
  archive("runs", s.runs);
  archive("done", s.done);
  archive("repeated", s.repeated);
  archive("literal", s.literal);
  archive("model_free", s.model_free);
  archive("reference", s.reference);
  archive("samples", s.samples);
  archive("recorded_s", s.recorded);
  archive.list("told", s.told);
  archive.list("axes", s.axes);
  archive.single("total", s.total);
  archive.list("contests", s.contests);
  archive.list("answers", s.answers);
  archive.list("along_axes", s.lines);
  archive.list("over_pairs", s.pairs);
  archive.list("refusals", s.refusals);
  archive.list("errors", s.errors);
}

template <class Archive>
void fields(Archive& archive, CampaignTimes& t) {
  archive("literal_s", t.literal_s);
  archive("model_free_s", t.model_free_s);
  archive("reference_s", t.reference_s);
}

Json campaign_schema() { return document_schema(kCampaignSchema, CampaignSummary()); }

}  // namespace internal::results

namespace {

std::string summary_in(const std::string& folder) { return folder + "/campaign.json"; }
std::string times_in(const std::string& folder) { return folder + "/timing.json"; }

/// A place in a list of this size; where there is no list, -1.
void require_place(const internal::results::JsonReader& reader, const std::string& key, int place,
                   std::size_t size) {
  const int last = static_cast<int>(size) - 1;
  if (place < std::min(0, last) || place > last)
    reader.fail_at(key, "is " + std::to_string(place) + ", expected " +
                            (size == 0 ? "-1" : "0 to " + std::to_string(last)));
}

/// Every table names its axes by their places, and every cell its bins.
void require_places(const internal::results::JsonReader& reader, const CampaignSummary& s,
                    const std::string& key, const std::vector<SummaryTable>& tables, bool pairs) {
  for (std::size_t i = 0; i < tables.size(); ++i) {
    const SummaryTable& t = tables[i];
    const std::string table = key + "[" + std::to_string(i) + "]";
    require_place(reader, table + ".axis_a", t.a, s.axes.size());
    require_place(reader, table + ".axis_b", t.b, pairs ? s.axes.size() : 0);
    for (std::size_t k = 0; k < t.cells.size(); ++k) {
      const std::string cell = table + ".cells[" + std::to_string(k) + "]";
      require_place(reader, cell + ".a", t.cells[k].a, s.axes[t.a].bins.size());
      require_place(reader, cell + ".b", t.cells[k].b, pairs ? s.axes[t.b].bins.size() : 0);
    }
  }
}

}  // namespace

void write_campaign_summary(const std::string& folder, const CampaignSummary& summary) {
  CampaignSummary copy = summary;
  internal::results::JsonWriter writer;
  std::string schema = internal::results::kCampaignSchema;
  writer("schema", schema);
  internal::results::fields(writer, copy);
  internal::results::save_json(summary_in(folder), writer.json);
}

CampaignSummary read_campaign_summary(const std::string& folder) {
  const std::string path = summary_in(folder);
  const internal::results::Json json = internal::results::load_json(path);
  internal::results::JsonReader reader(json, path, "");
  reader.schema(internal::results::kCampaignSchema);
  CampaignSummary summary;
  internal::results::fields(reader, summary);
  require_places(reader, summary, "along_axes", summary.lines, false);
  require_places(reader, summary, "over_pairs", summary.pairs, true);
  return summary;
}

void write_campaign_times(const std::string& folder, const CampaignTimes& times) {
  CampaignTimes copy = times;
  internal::results::JsonWriter writer;
  internal::results::fields(writer, copy);
  internal::results::save_json(times_in(folder), writer.json);
}

bool has_campaign_summary(const std::string& folder) { return std::filesystem::exists(summary_in(folder)); }

}  // namespace gapscope

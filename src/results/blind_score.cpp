#include "results/blind_score.h"

#include <filesystem>

#include "results/json_document.h"
#include "results/json_schema.h"

namespace gapscope {
namespace internal::results {

template <class Archive>
void fields(Archive& archive, BlindCount& c) {
  double share = c.share();
  Interval limits = c.limits();
  archive("name", c.name);
  archive("count", c.count);
  archive("of", c.of);
  archive("share", share);
  archive("ci95", limits);
  archive("aim", c.aim);
  archive("at_most", c.at_most);
}

template <class Archive>
void fields(Archive& archive, BlindSlice& s) {
  archive("by", s.by);
  archive("name", s.name);
  archive("cases", s.cases);
  archive("seen", s.seen);
  archive("first", s.first);
  archive("named", s.named);
  archive("wrong", s.wrong);
  archive("shrink", s.shrink);
}

template <class Archive>
void fields(Archive& archive, ReliabilityBin& b) {
  archive("cases", b.cases);
  archive("predicted", b.predicted);
  archive("right", b.right);
}

template <class Archive>
void fields(Archive& archive, BlindCalibration& c) {
  archive("weights", c.weights);
  archive("learnt_on", c.learnt_on);
  archive("judged_on", c.judged_on);
  archive.list("bins", c.bins);
  archive("error", c.error);
  archive("error_before", c.error_before);
  archive("brier", c.brier);
  archive("brier_before", c.brier_before);
}

template <class Archive>
void fields(Archive& archive, AbstentionPoint& p) {
  archive("threshold", p.threshold);
  archive("answered", p.answered);
  archive("right", p.right);
}

template <class Archive>
void fields(Archive& archive, ScoredImplant& i) {
  archive("size", i.size);
  archive("foretold_share", i.foretold_share);
  archive("parameter", i.parameter);
  archive("unit", i.unit);
  archive("amount", i.amount);
  archive("told", i.told);
  archive("stranger", i.stranger);
}

template <class Archive>
void fields(Archive& archive, ScoredCase& c) {
  archive("name", c.name);
  archive("part", c.part);
  archive("rig", c.rig);
  archive("severity", c.severity);
  archive("truth", c.truth);
  archive("verdict", c.verdict);
  archive("named", c.named);
  archive("before_floor", c.before);
  archive("shrink", c.shrink);
  archive("probability", c.probability);
  archive("right", c.right);
  archive.seldom("implant", c.implant);
}

template <class Archive>
void fields(Archive& archive, ConfusionCell& c) {
  archive("truth", c.truth);
  archive("answer", c.answer);
  archive("count", c.count);
}

template <class Archive>
void fields(Archive& archive, BlindScore& s) {
  archive("name", s.name);
  archive("version", s.version);
  archive("manifest_sha256", s.manifest_sha256);
  archive("answers_seal_sha256", s.answers_seal);
  archive.addition("announced_seal_sha256", s.announced_seal);
  archive.configuration(s.configuration);
  archive("calibration_cases", s.calibration_cases);
  archive("report_cases", s.report_cases);
  archive.list("counts", s.counts);
  archive("group_median", s.group_median);
  archive("group_mean", s.group_mean);
  archive("shrink_median", s.shrink_median);
  archive("shrink_tenth_percentile", s.shrink_tenth);
  archive("shrink_other_law_median", s.shrink_other_law);
  archive.list("confusion", s.confusion);
  archive.list("slices", s.slices);
  archive.single("calibration", s.calibration);
  archive.list("abstention", s.abstention);
  archive.list("cases", s.cases);
}

namespace {
constexpr const char* kScore = "gapscope.blind/1";
}

Json blind_schema() { return document_schema(kScore, BlindScore()); }

}  // namespace internal::results

void write_blind_score(const std::string& folder, const BlindScore& score) {
  internal::results::write_document(folder + "/blind.json", internal::results::kScore, score);
}

BlindScore read_blind_score(const std::string& folder) {
  return internal::results::read_document<BlindScore>(folder + "/blind.json", internal::results::kScore);
}

bool has_blind_score(const std::string& folder) { return std::filesystem::exists(folder + "/blind.json"); }

}  // namespace gapscope

#include "gapscope/base/errors.h"
#include "results/blind_files.h"
#include "results/json_document.h"
#include "results/json_schema.h"
#include "results/shared_fields.h"

namespace gapscope {
namespace internal::results {

template <class Archive>
void fields(Archive& archive, ModelEvidence& e) {
  archive("effect", e.effect);
  archive.bound("score", e.score);
  archive("mean_square_floor2", e.mean_cost);
  archive("median_free_floor", e.median_free);
  archive("median_innovation_floor", e.median_innovation);
  archive("windows_better", e.windows_better);
}

template <class Archive>
void fields(Archive& archive, StepEvidence& e) {
  archive.single("nominal", e.nominal);
  archive("alone_floor", e.alone);
  archive("repeats_badly", e.repeats_badly);
  archive.list("candidates", e.candidates);
  archive.list("excluded_parents", e.excluded_parents);
}

template <class Archive>
void fields(Archive& archive, ToldPlace& p) {
  archive("phase", p.phase);
  archive("follows", p.follows);
  archive("periods_per_turn", p.periods_per_turn);
}

template <class Archive>
void answer_fields(Archive& archive, BlindAnswer& a) {
  archive("name", a.name);
  archive.list("files", a.files);
  archive("verdict", a.verdict);
  archive("effects", a.effects);
  archive("group", a.group);
  archive.seldom("alike", a.alike);
  archive.seldom("established", a.established);
  archive("headline", a.headline);
  archive.single("where", a.where);
  archive("before_rad", a.before);
  archive("after_rad", a.after);
  archive("floor_rad", a.floor);
  archive("shrink", a.shrink);
  archive("shrink_ci95", a.shrink_ci95);
  archive.single("evidence", a.evidence);
}

template <class Archive>
void fields(Archive& archive, BlindAnswer& a) {
  answer_fields(archive, a);
  archive("seal_sha256", a.seal);
}

template <class Archive>
void head_fields(Archive& archive, BlindAnswers& a) {
  archive("name", a.name);
  archive("version", a.version);
  archive("manifest_sha256", a.manifest_sha256);
}

template <class Archive>
void fields(Archive& archive, BlindAnswers& a) {
  head_fields(archive, a);
  archive.list("cases", a.cases);
}

namespace {
constexpr const char* kAnswers = "gapscope.blind_answers/3";
}  // namespace

Json blind_answers_schema() { return document_schema(kAnswers, BlindAnswers()); }

}  // namespace internal::results

void write_blind_answers(const std::string& path, const BlindAnswers& answers, const Replaceable& found) {
  internal::results::write_document(path, internal::results::kAnswers, answers, found);
}

BlindAnswers read_blind_answers(const std::string& path) {
  return internal::results::read_document<BlindAnswers>(path, internal::results::kAnswers);
}

bool is_answers_file(const std::string& path, const std::string& manifest_sha256) {
  try {
    return read_blind_answers(path).manifest_sha256 == manifest_sha256;
  } catch (const ConfigError&) {
    return false;
  }
}

std::string line_of(const BlindAnswer& answer) {
  BlindAnswer copy = answer;
  internal::results::JsonWriter writer;
  internal::results::answer_fields(writer, copy);
  return internal::results::text_of(writer.json, -1);
}

std::string head_line_of(const BlindAnswers& all) {
  BlindAnswers copy{all.name, all.version, all.manifest_sha256, {}};
  internal::results::JsonWriter writer;
  internal::results::head_fields(writer, copy);
  return internal::results::text_of(writer.json, -1);
}

BlindAnswer blind_answer_of(const std::string& line, const std::string& file) {
  const internal::results::Json json = internal::results::parsed_json(line, file);
  internal::results::JsonReader reader(json, file, "");
  BlindAnswer answer;
  internal::results::answer_fields(reader, answer);
  return answer;
}

}  // namespace gapscope

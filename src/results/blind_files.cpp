#include "results/blind_files.h"

#include "gapscope/base/errors.h"
#include "results/json_document.h"
#include "results/json_schema.h"
#include "results/sha256.h"
#include "results/shared_fields.h"

namespace gapscope {
namespace internal::results {

template <class Archive>
void fields(Archive& archive, ImplantLabel& i) {
  archive("size", i.size);
  archive("foretold_share", i.foretold_share);
  archive.named_members("values", i.values, &NamedValue::key, &NamedValue::value);
  archive.named_members("units", i.values, &NamedValue::key, &NamedValue::unit);
  archive("undisturbed", i.undisturbed);
  archive("own", i.own);
}

template <class Archive>
void fields(Archive& archive, BlindLabel& l) {
  archive("name", l.name);
  archive("part", l.part);
  archive("effects", l.effects);
  archive("rig", l.rig);
  archive("severity", l.severity);
  archive("cycles_per_turn", l.cycles_per_turn);
  archive("seed", l.seed);
  archive("salt", l.salt);
  archive.seldom("implant", l.implant);
}

template <class Archive>
void fields(Archive& archive, BlindLabels& l) {
  archive("name", l.name);
  archive.configuration(l.configuration);
  archive.list("cases", l.cases);
}

template <class Archive>
void fields(Archive& archive, SealedCase& c) {
  archive("name", c.name);
  archive("part", c.part);
  archive("label_sha256", c.label_sha256);
  archive.list("files", c.files);
}

template <class Archive>
void fields(Archive& archive, BlindManifest& m) {
  archive("name", m.name);
  archive("version", m.version);
  archive("labels_sha256", m.labels_sha256);
  archive.list("cases", m.cases);
}

namespace {

constexpr const char* kLabels = "gapscope.blind_labels/1";
constexpr const char* kManifest = "gapscope.blind_manifest/2";

}  // namespace

Json blind_labels_schema() { return document_schema(kLabels, BlindLabels()); }
Json blind_manifest_schema() { return document_schema(kManifest, BlindManifest()); }

}  // namespace internal::results

void write_blind_labels(const std::string& path, const BlindLabels& labels, const Replaceable& found) {
  internal::results::write_document(path, internal::results::kLabels, labels, found);
}
BlindLabels read_blind_labels(const std::string& path) {
  return internal::results::read_document<BlindLabels>(path, internal::results::kLabels);
}

void write_blind_manifest(const std::string& path, const BlindManifest& manifest, const Replaceable& found) {
  internal::results::write_document(path, internal::results::kManifest, manifest, found);
}
BlindManifest read_blind_manifest(const std::string& path) {
  return internal::results::read_document<BlindManifest>(path, internal::results::kManifest);
}

ReadManifest read_manifest_once(const std::string& path) {
  const std::string text = internal::results::text_of_file(path);
  return {internal::results::parsed_document<BlindManifest>(text, path, internal::results::kManifest),
          sha256(text)};
}

bool is_labels_file(const std::string& path, const std::string& name, const std::string& configuration) {
  try {
    const BlindLabels there = read_blind_labels(path);
    return there.name == name && there.configuration == configuration;
  } catch (const ConfigError&) {
    return false;
  }
}

bool is_manifest_file(const std::string& path) {
  try {
    read_blind_manifest(path);
    return true;
  } catch (const ConfigError&) {
    return false;
  }
}

std::string line_of(const BlindLabel& label) {
  BlindLabel copy = label;
  internal::results::JsonWriter writer;
  internal::results::fields(writer, copy);
  return internal::results::text_of(writer.json, -1);
}

std::string head_line_of(const BlindLabels& all) {
  internal::results::Json head;
  head["name"] = all.name;
  head["configuration"] = all.configuration;
  for (const BlindLabel& label : all.cases) head["salts"].push_back(label.salt);
  return internal::results::text_of(head, -1);
}

}  // namespace gapscope

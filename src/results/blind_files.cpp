#include "gapscope/results/blind_files.h"

#include "results/blind_fields.h"
#include "results/json_schema.h"

namespace gapscope {
namespace internal {

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
  archive.list("cases", m.cases);
}

namespace {

constexpr const char* kLabels = "gapscope.blind_labels/1";
constexpr const char* kManifest = "gapscope.blind_manifest/1";

}  // namespace

Json blind_labels_schema() { return document_schema(kLabels, BlindLabels()); }
Json blind_manifest_schema() { return document_schema(kManifest, BlindManifest()); }

}  // namespace internal

void write_blind_labels(const std::string& path, const BlindLabels& labels) {
  internal::write_document(path, internal::kLabels, labels);
}
BlindLabels read_blind_labels(const std::string& path) {
  return internal::read_document<BlindLabels>(path, internal::kLabels);
}

void write_blind_manifest(const std::string& path, const BlindManifest& manifest) {
  internal::write_document(path, internal::kManifest, manifest);
}
BlindManifest read_blind_manifest(const std::string& path) {
  return internal::read_document<BlindManifest>(path, internal::kManifest);
}

}  // namespace gapscope

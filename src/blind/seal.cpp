#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <map>
#include <set>

#include "gapscope/base/errors.h"
#include "gapscope/base/version.h"
#include "gapscope/blind/blind_check.h"
#include "gapscope/config/configuration.h"
#include "gapscope/results/blind_files.h"
#include "gapscope/results/sha256.h"

namespace gapscope {
namespace {

constexpr std::size_t kShortestSalt = 16;

/// A case's name is also that of its files.
bool is_plain(const std::string& name) {
  return !name.empty() && name.find_first_not_of(
                              "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                              "0123456789_-") == std::string::npos;
}

void require_sound(const BlindLabels& labels, const std::string& file) {
  std::set<std::string> names;
  for (const BlindLabel& l : labels.cases) {
    if (!is_plain(l.name))
      throw ConfigError(file, "has a case '" + l.name + "', expected a name of letters, digits, _ and -");
    if (!names.insert(l.name).second) throw ConfigError(file, "labels " + l.name + " twice, expected once");
    if (l.part != "calibration" && l.part != "report")
      throw ConfigError(file, l.name + " is of the part '" + l.part + "', expected calibration or report");
    if (l.salt.size() < kShortestSalt)
      throw ConfigError(file, l.name + fmt::format(" has a salt of {} characters, expected at least {}",
                                                   l.salt.size(), kShortestSalt));
  }
}

/// The sheet and the recordings that it names.
std::vector<SealedFile> files_of(const std::string& folder, const std::string& name) {
  const std::string sheet = name + ".yaml", path = folder + "/" + sheet;
  const Configuration c = load_configuration(path);
  if (!c.recording) throw ConfigError(path, "simulates, expected recording: {file, held_out}");
  std::vector<SealedFile> files = {{sheet, sha256_of_file(path)}};
  for (const auto* list : {&c.recording->files, &c.recording->held_out})
    for (const RecordedFile& r : *list) files.push_back({r.given, sha256_of_file(folder + "/" + r.given)});
  return files;
}

}  // namespace

std::string label_hash(const BlindLabel& l) {
  const auto number = [](double value) { return std::isfinite(value) ? fmt::format("{}", value) : "null"; };
  return sha256(fmt::format("{}\n{}\n{}\n{}\n{}\n{}\n{}\n{}\n", l.salt, l.name, l.part,
                            fmt::join(l.effects, "+"), l.rig, number(l.severity), number(l.cycles_per_turn),
                            l.seed));
}

BlindManifest seal_blind_check(const std::string& folder, const std::string& labels) {
  const BlindLabels secret = read_blind_labels(labels);
  require_sound(secret, labels);
  BlindManifest manifest{secret.name, version(), {}};
  for (const BlindLabel& l : secret.cases)
    manifest.cases.push_back({l.name, l.part, label_hash(l), files_of(folder, l.name)});
  write_blind_manifest(folder + "/manifest.json", manifest);
  return manifest;
}

void verify_recordings(const BlindManifest& manifest, const std::string& folder) {
  for (const SealedCase& c : manifest.cases)
    for (const SealedFile& f : c.files)
      if (sha256_of_file(folder + "/" + f.file) != f.sha256)
        throw ConfigError(folder + "/" + f.file,
                          "is not the file of " + c.name + " that was sealed, expected SHA-256 " + f.sha256);
}

void verify_labels(const BlindManifest& manifest, const BlindLabels& labels, const std::string& file) {
  std::map<std::string, const BlindLabel*> by_name;
  for (const BlindLabel& l : labels.cases) by_name[l.name] = &l;
  if (labels.cases.size() != manifest.cases.size() || by_name.size() != manifest.cases.size())
    throw ConfigError(file, fmt::format("labels {} cases, expected the {} of the manifest, each once",
                                        labels.cases.size(), manifest.cases.size()));
  for (const SealedCase& c : manifest.cases) {
    const auto label = by_name.find(c.name);
    if (label == by_name.end()) throw ConfigError(file, "has no label of " + c.name + ", expected one");
    if (label->second->part != c.part || label_hash(*label->second) != c.label_sha256)
      throw ConfigError(file, "has another label of " + c.name +
                                  " than the one that was sealed, expected one of SHA-256 " + c.label_sha256);
  }
}

}  // namespace gapscope

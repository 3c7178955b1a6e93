#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "base/plain_name.h"
#include "base/shown.h"
#include "blind/blind_check.h"
#include "blind/sealed_files.h"
#include "config/configuration.h"
#include "gapscope/base/errors.h"
#include "gapscope/base/version.h"
#include "results/blind_files.h"
#include "results/sha256.h"

namespace gapscope {
namespace {

constexpr std::size_t kShortestSalt = 16;

/// A case's name is also that of its files.
bool is_plain(const std::string& name) {
  return !name.empty() &&
         name.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-") ==
             std::string::npos;
}

/// Names and words of a label are shown in tables, joined by '+'.
bool is_word(const std::string& text) {
  return std::none_of(text.begin(), text.end(), [](unsigned char c) { return c < ' ' || c == 0x7f; });
}

void require_sound(const BlindLabel& l, const std::string& file) {
  if (!is_plain(l.name))
    throw ConfigError(
        file, "has a case '" + printable(l.name, 100) + "', expected a name of letters, digits, _ and -");
  if (l.part != "calibration" && l.part != "report")
    throw ConfigError(file, l.name + " is of the part " + shown(l.part) + ", expected calibration or report");
  if (l.salt.size() < kShortestSalt)
    throw ConfigError(file, l.name + fmt::format(" has a salt of {} characters, expected at least {}",
                                                 l.salt.size(), kShortestSalt));
  if (l.severity < 0.0 || l.severity > 1.0)  // NaN: not told
    throw ConfigError(file,
                      l.name + fmt::format(" has the severity {:g}, expected 0 to 1 or null", l.severity));
  if (l.cycles_per_turn <= 0.0 || l.cycles_per_turn > 1e6)
    throw ConfigError(file, l.name + fmt::format(" has {:g} cycles per turn, expected up to 1e6 or null",
                                                 l.cycles_per_turn));
  if (l.effects.size() > 2 || (l.effects.size() == 2 && l.effects[0] == l.effects[1]))
    throw ConfigError(file, l.name + " is not of one or two different effects, expected that or [] for none");
  for (const std::string* text : {&l.rig, &l.seed, &l.salt})
    if (!is_word(*text)) throw ConfigError(file, l.name + " has a control character, expected plain text");
  for (const std::string& effect : l.effects)
    if (effect.empty() || !is_word(effect) || effect.find('+') != effect.npos)
      throw ConfigError(file, l.name + " has the effect " + shown(effect) +
                                  ", expected a name without + and control characters, one item each");
}

void require_sound(const BlindLabels& labels, const std::string& file) {
  blind::require_plain_name(labels.name, file);
  if (labels.cases.empty()) throw ConfigError(file, "labels no case, expected at least one");
  std::set<std::string> names;
  for (const BlindLabel& l : labels.cases) {
    require_sound(l, file);
    if (!names.insert(l.name).second) throw ConfigError(file, "labels " + l.name + " twice, expected once");
  }
}

/// The sheet and the recordings that it names.
std::vector<FileHash> files_of(const std::string& folder, const std::string& name) {
  const std::string sheet = name + ".yaml", path = folder + "/" + sheet;
  const Configuration c = load_configuration(path);
  if (!c.recording) throw ConfigError(path, "simulates, expected recording: {file, held_out}");
  std::vector<FileHash> files = {{sheet, sha256_of_file(path)}};
  for (const auto* list : {&c.recording->files, &c.recording->held_out})
    for (const RecordedFile& r : *list) {
      blind::require_inside(r.given, path);
      files.push_back({r.given, sha256_of_file(folder + "/" + r.given)});
    }
  return files;
}

}  // namespace

void blind::require_plain_name(const std::string& name, const std::string& file) {
  if (!is_plain_name(name))
    throw ConfigError(file, "has the name " + shown(name) + ", expected a plain file name");
}

void blind::require_inside(const std::string& name, const std::string& file) {
  const std::filesystem::path path(name);
  const bool leaves = std::find(path.begin(), path.end(), "..") != path.end();
  if (name.empty() || path.is_absolute() || leaves)
    throw ConfigError(file,
                      "names the file " + shown(name) + ", expected one in the folder that is handed out");
}

std::string label_hash(const BlindLabel& label) { return sha256(line_of(label)); }
std::string labels_hash(const BlindLabels& labels) { return sha256(head_line_of(labels)); }

BlindManifest seal_blind_check(const std::string& folder, const std::string& labels) {
  const std::string path = folder + "/manifest.json";
  const ConfigError another(path, "is there and seals something else, expected that it is moved away");
  const bool there = std::filesystem::exists(std::filesystem::symlink_status(path));
  if (there && !is_manifest_file(path)) throw another;
  const BlindLabels secret = read_blind_labels(labels);
  require_sound(secret, labels);
  BlindManifest manifest{secret.name, version(), labels_hash(secret), {}};
  for (const BlindLabel& l : secret.cases)
    manifest.cases.push_back({l.name, l.part, label_hash(l), files_of(folder, l.name)});
  if (there && !(read_blind_manifest(path) == manifest)) throw another;
  if (!there) write_blind_manifest(path, manifest, "");
  return manifest;
}

void verify_recordings(const BlindManifest& manifest, const std::string& folder) {
  blind::require_plain_name(manifest.name, folder + "/manifest.json");
  for (const SealedCase& c : manifest.cases)
    for (const FileHash& f : c.files) {
      blind::require_inside(f.file, folder + "/manifest.json");
      blind::verify_file(folder + "/" + f.file, sha256_of_file(folder + "/" + f.file), c.name, f);
    }
}

void blind::verify_file(const std::string& path, const std::string& found, const std::string& name,
                        const FileHash& sealed) {
  if (found != sealed.sha256)
    throw ConfigError(path,
                      "is not the file of " + name + " that was sealed, expected SHA-256 " + sealed.sha256);
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
  if (labels.name != manifest.name || labels_hash(labels) != manifest.labels_sha256)
    throw ConfigError(file,
                      "has another name or configuration than those that were sealed, expected SHA-256 " +
                          manifest.labels_sha256);
}

}  // namespace gapscope

#include <filesystem>

#include "blind/blind_check.h"
#include "gapscope/base/errors.h"
#include "gapscope/base/version.h"
#include "results/blind_files.h"
#include "results/sha256.h"

namespace gapscope {
namespace {

namespace fs = std::filesystem;

/// Whether the recordings and labels are there, whole, and those of the configuration.
bool is_made(const std::string& resolved, const std::string& cases, const std::string& labels) {
  if (!fs::exists(cases + "/manifest.json") || !fs::exists(labels)) return false;
  try {
    const BlindManifest manifest = read_blind_manifest(cases + "/manifest.json");
    const BlindLabels stored = read_blind_labels(labels);
    verify_recordings(manifest, cases);
    verify_labels(manifest, stored, labels);
    return manifest.version == version() && stored.configuration == resolved;
  } catch (const ConfigError&) {
    return false;
  }
}

bool is_answered(const std::string& cases, const std::string& answers) {
  if (!fs::exists(answers)) return false;
  const BlindAnswers stored = read_blind_answers(answers);
  return stored.version == version() && stored.manifest_sha256 == sha256_of_file(cases + "/manifest.json");
}

}  // namespace

BlindScore score_blind_check(const std::string& folder, const std::string& labels, const std::string& answers,
                             const std::string& seal) {
  const std::string public_file = folder + "/manifest.json";
  const ReadManifest read = read_manifest_once(public_file);
  const BlindManifest& manifest = read.manifest;
  verify_recordings(manifest, folder);
  const BlindLabels opened = read_blind_labels(labels);
  verify_labels(manifest, opened, labels);
  const BlindAnswers given = read_blind_answers(answers);
  if (given.manifest_sha256 != read.sha256)
    throw ConfigError(answers, "answers another manifest, expected that of " + public_file);
  verify_answers(manifest, given, answers);
  if (!seal.empty() && given.seal() != seal)
    throw ConfigError(answers, "has the seal " + given.seal() + ", expected the one announced, " + seal);
  BlindScore score = score_blind_answers(opened, given);
  score.announced_seal = seal;
  return score;
}

namespace {

/// @param make  makes what is not there, from the folder of the cases and the file of the labels
BlindScore run_check(const std::string& resolved, const std::string& folder, int threads,
                     const BlindProgress& answered,
                     const std::function<void(const std::string&, const std::string&)>& make) {
  const std::string cases = folder + "/cases", labels = folder + "/labels.json",
                    answers = folder + "/answers.json";
  const bool is_there = is_made(resolved, cases, labels);
  if (!is_there && fs::exists(answers))
    throw ConfigError(answers, "answers another check, expected another folder for this one");
  if (!is_there) make(cases, labels);
  if (!is_answered(cases, answers)) answer_blind_check(cases, answers, threads, answered);
  return score_blind_check(cases, labels, answers);
}

}  // namespace

BlindScore run_blind_check(const BlindConfig& config, const std::string& folder, int threads,
                           const BlindProgress& made, const BlindProgress& answered) {
  return run_check(resolved_yaml(config), folder, threads, answered,
                   [&](const std::string& cases, const std::string& labels) {
                     make_blind_check(config, cases, labels, threads, made);
                   });
}

BlindScore run_implanted_check(const Configuration& c, const std::string& folder, int threads,
                               const BlindProgress& made, const BlindProgress& answered,
                               const Progress& progress) {
  return run_check(resolved_yaml(c), folder, threads, answered,
                   [&](const std::string& cases, const std::string& labels) {
                     make_implanted_check(c, cases, labels, threads, made, progress);
                   });
}

}  // namespace gapscope

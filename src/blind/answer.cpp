#include <fmt/format.h>
#include <stdlib.h>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

#include "base/input_file.h"
#include "base/interrupt.h"
#include "base/move_file.h"
#include "base/parallel.h"
#include "base/shown.h"
#include "base/text.h"
#include "blind/answer_journal.h"
#include "blind/blind_check.h"
#include "blind/expected_place.h"
#include "blind/sealed_files.h"
#include "gapscope/base/errors.h"
#include "gapscope/base/version.h"
#include "gapscope/diagnosis/diagnosis.h"
#include "gapscope/plant/effect.h"
#include "results/blind_files.h"
#include "results/blind_records.h"
#include "results/sha256.h"
#include "run/run_diagnosis.h"

namespace gapscope {
namespace {

/// The files of a case, verified and in a place that nobody else knows: whatever happens to the originals
/// meanwhile, what is diagnosed is what was sealed.
class CaseCopy {
 public:
  /// @throws ConfigError for a file that is not the one that was sealed; std::runtime_error where there is no
  /// room for the copies
  CaseCopy(const std::string& folder, const SealedCase& sealed);
  ~CaseCopy();
  CaseCopy(const CaseCopy&) = delete;
  CaseCopy& operator=(const CaseCopy&) = delete;

  const std::string& folder() const { return folder_; }

 private:
  std::string folder_;
};

namespace fs = std::filesystem;

std::string bytes_of(const std::string& path) {
  std::ifstream in = open_input_file(path, "one that was sealed");
  std::string bytes{std::istreambuf_iterator<char>(in), {}};
  if (in.bad()) throw ConfigError(path, "cannot be read, expected a readable file");
  return bytes;
}

void copy_file(const std::string& folder, const std::string& name, const FileHash& sealed,
               const fs::path& to) {
  blind::require_inside(sealed.file, folder + "/manifest.json");
  const std::string from = folder + "/" + sealed.file, bytes = bytes_of(from);
  blind::verify_file(from, sha256(bytes), name, sealed);
  fs::create_directories((to / sealed.file).parent_path());
  std::ofstream out(to / sealed.file, std::ios::binary);
  if (!(out << bytes).flush())
    throw std::runtime_error((to / sealed.file).string() + ": cannot be written, expected room for a copy");
}

CaseCopy::CaseCopy(const std::string& folder, const SealedCase& sealed) {
  std::string name = (fs::temp_directory_path() / "gapscope-case-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr)
    throw std::runtime_error(name + ": cannot be made, expected a writable folder for temporary files");
  folder_ = name;
  try {
    for (const FileHash& file : sealed.files) copy_file(folder, sealed.name, file, folder_);
  } catch (...) {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
    throw;
  }
}

CaseCopy::~CaseCopy() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

/// What a sheet names was sealed with it.
void require_sealed(const Configuration& c, const SealedCase& sealed) {
  if (!c.recording) throw ConfigError(c.file, "simulates, expected recording: {file, held_out}");
  for (const auto* files : {&c.recording->files, &c.recording->held_out})
    for (const RecordedFile& r : *files)
      if (std::none_of(sealed.files.begin(), sealed.files.end(),
                       [&](const FileHash& f) { return f.file == r.given; }))
        throw ConfigError(c.file, r.line,
                          "names " + shown(r.given) + ", expected a recording that was sealed with it");
}

/// On one thread: cases, not candidates, share the cores.
Diagnosis diagnosis_of(const std::string& sheet, const SealedCase& sealed) {
  const Configuration c = load_configuration(sheet);
  require_sealed(c, sealed);
  require_reference_model(c);
  DiagnosisOptions options = diagnosis_options(c);
  options.threads = 1;
  return diagnose_recordings(c, load_for_diagnosis(c, [](const std::string&) {}), options);
}

/// What is said of a copy, said of the original.
std::string of_original(std::string message, const std::string& copy, const std::string& folder) {
  for (auto at = message.find(copy); at != message.npos; at = message.find(copy, at + folder.size()))
    message.replace(at, copy.size(), folder);
  return message;
}

/// Members of the groups of all additions that are not added themselves.
std::vector<std::string> groups_of(const Diagnosis& d) {
  std::vector<std::string> names;
  for (const AddedEffect& a : d.added)
    for (const std::string& name : a.group)
      if (!contains(d.effects, name) && !contains(names, name)) names.push_back(name);
  return names;
}

std::vector<std::string> established_of(const Diagnosis& d) {
  std::vector<std::string> names;
  for (const AddedEffect& a : d.added)
    if (a.established) names.push_back(a.effect);
  return names;
}

BlindAnswer answer_to(const std::string& folder, const SealedCase& c) {
  const CaseCopy copy(folder, c);
  Diagnosis d;
  try {
    d = diagnosis_of(copy.folder() + "/" + c.name + ".yaml", c);
  } catch (const ConfigError& error) {
    throw ConfigError(of_original(error.what(), copy.folder(), folder));
  }
  stop_point();  // a diagnosis that was asked to stop has judged by less than it had
  return {c.name,
          c.files,
          to_string(d.verdict),
          d.effects,
          d.group,
          groups_of(d),
          established_of(d),
          d.where.headline,
          blind::told_place(d.where),
          d.mismatch.before,
          d.mismatch.after,
          d.mismatch.floor,
          d.mismatch.shrink,
          d.mismatch.shrink_ci95,
          d.evidence,
          ""};
}

std::string sealed_after(const std::string& previous, const BlindAnswer& answer) {
  return sha256(previous + "\n" + line_of(answer) + "\n");
}

void require_given(const BlindAnswer& a, const SealedCase& c, const std::string& file) {
  if (a.files != c.files)
    throw ConfigError(file, "answers " + c.name + " from other recordings, expected those of the manifest");
}

/// An answer that a diagnosis can give, whoever wrote it.
void require_answer(const BlindAnswer& a, const std::string& file) {
  constexpr std::size_t kLongestHeadline = 4000;
  const auto fail = [&](const std::string& what) {
    throw ConfigError(file, "its answer to " + shown(a.name) + what);
  };
  const bool added = a.verdict == "effect" || a.verdict == "helps";
  if (!added && a.verdict != "none" && a.verdict != "unknown")
    fail(" is " + shown(a.verdict) + ", expected effect, helps, none or unknown");
  if (added == a.effects.empty() || added == a.group.empty())
    fail(" is " + shown(a.verdict) + " with " + std::to_string(a.effects.size()) +
         " effects, expected at least one where it is 'effect' or 'helps' and none elsewhere");
  if (a.headline.size() > kLongestHeadline) fail(" has a headline of that length, expected a sentence");
  for (const ModelEvidence& e : a.evidence.candidates)
    if (find_effect(e.effect) == nullptr)
      fail(" ranks " + shown(e.effect) + ", expected an effect of the catalogue");
}

/// Answers may be given again; those to another check stay, and so does any other file.
std::string require_replaceable(const std::string& path, const BlindManifest& manifest,
                                const std::string& manifest_sha256) {
  std::string found = content_identity(path);
  if (found.empty() || is_answers_file(path, manifest_sha256)) return found;
  throw ConfigError(path, "is there and holds no answers to " + manifest.name + ", expected another name");
}

}  // namespace

BlindAnswers answer_blind_check(const std::string& folder, const std::string& path, int threads,
                                const BlindProgress& progress) {
  const ReadManifest read = read_manifest_once(folder + "/manifest.json");
  const BlindManifest& manifest = read.manifest;
  verify_recordings(manifest, folder);
  require_replaceable(path, manifest, read.sha256);
  BlindAnswers answers{manifest.name, version(), read.sha256, {}};
  const std::string head = sha256(head_line_of(answers));
  if (const auto parent = std::filesystem::path(path).parent_path(); !parent.empty())
    std::filesystem::create_directories(parent);
  blind::AnswerJournal journal(path + ".partial",
                               fmt::format("manifest {}, gapscope {}", answers.manifest_sha256, version()));
  std::vector<const SealedCase*> open;
  for (const SealedCase& c : manifest.cases) {
    const auto answered = journal.answers().find(c.name);
    if (answered == journal.answers().end()) {
      open.push_back(&c);
      continue;
    }
    require_answer(answered->second, path + ".partial");
    require_given(answered->second, c, path + ".partial");
  }
  std::atomic<std::size_t> done{manifest.cases.size() - open.size()};
  parallel_for(open.size(), threads, [&](std::size_t i) {
    stop_point();
    journal.add(answer_to(folder, *open[i]));
    if (const std::size_t count = ++done; progress) progress(count, manifest.cases.size());
  });
  for (const SealedCase& c : manifest.cases) {
    BlindAnswer answer = journal.answers().at(c.name);
    answer.seal = sealed_after(answers.cases.empty() ? head : answers.seal(), answer);
    answers.cases.push_back(std::move(answer));
  }
  write_blind_answers(path, answers, require_replaceable(path, manifest, read.sha256));
  journal.remove();
  return answers;
}

void verify_answers(const BlindManifest& manifest, const BlindAnswers& answers, const std::string& file) {
  if (answers.cases.size() != manifest.cases.size())
    throw ConfigError(file, fmt::format("answers {} cases, expected the {} of the manifest",
                                        answers.cases.size(), manifest.cases.size()));
  if (answers.name != manifest.name)
    throw ConfigError(file,
                      "answers the check " + shown(answers.name) + ", expected " + shown(manifest.name));
  std::string previous = sha256(head_line_of(answers));
  for (std::size_t i = 0; i < manifest.cases.size(); ++i) {
    const SealedCase& c = manifest.cases[i];
    const BlindAnswer& a = answers.cases[i];
    if (a.name != c.name) throw ConfigError(file, "answers " + a.name + " where " + c.name + " was expected");
    require_given(a, c, file);
    if (sealed_after(previous, a) != a.seal)
      throw ConfigError(file, "has another answer to " + c.name +
                                  " than the one that was sealed, expected one of seal " + a.seal);
    require_answer(a, file);
    previous = a.seal;
  }
}

}  // namespace gapscope

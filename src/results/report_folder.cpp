#include "results/report_folder.h"

#include <stdlib.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "base/input_file.h"
#include "base/move_file.h"
#include "gapscope/base/errors.h"
#include "gapscope/base/version.h"
#include "results/file_list.h"
#include "results/folder_content.h"
#include "results/replace_files.h"
#include "results/sha256.h"
#include "results/stored_half.h"

namespace gapscope {
namespace fs = std::filesystem;
namespace {

using internal::results::FileList;

[[noreturn]] void fail(const fs::path& path, const std::string& what) {
  throw std::runtime_error(path.string() + ": " + what);
}

[[noreturn]] void refuse_to_write(const fs::path& path, const std::string& why) {
  throw ConfigError(path.string(),
                    "cannot be written in, expected a writable folder for the report (" + why + ")");
}

fs::path without_trailing_slash(const std::string& folder) {
  fs::path path = folder;  // ".." stays: behind a link it is not what the text says
  while (!path.has_filename() && path != path.root_path()) path = path.parent_path();
  return path;
}

/// A result is found when all that belongs to it is there.
bool is_result(const std::string& file) {
  return file == "result.json" || file == "diagnosis.json" || file == "campaign.json" ||
         file == "blind.json" || file == "compare.json" || file == "certificate.json" ||
         file == "manifest.json" || file == "truth.csv";
}

/// An entry of the list for a file that was just written. Wall times are no function of the input.
FileHash listed(const fs::path& folder, const std::string& file) {
  const bool varies = file == "timing.json" || file == "results.sqlite";
  return {file, varies ? "" : sha256_of_file((folder / file).string())};
}

/// Whether a file is as this entry has it.
bool is_still(const fs::path& folder, const FileHash& entry) {
  return FileList{"", "", "", {entry}}.wrote(folder, entry.file);
}

}  // namespace

ReportFolder::ReportFolder(const std::string& folder, FolderKind kind, const std::vector<std::string>& inputs)
    : ReportFolder(folder, kind, inputs, false) {}

ReportFolder ReportFolder::to_redraw(const std::string& folder, FolderKind kind) {
  ReportFolder redrawn(folder, kind, {}, true);
  const FileList* list = redrawn.before_.get();
  for (const std::string& file : internal::results::files_below(redrawn.final_)) {
    if (!internal::results::is_stored(file)) continue;
    if (list != nullptr && redrawn.changed_.empty() && !list->wrote(redrawn.final_, file))
      redrawn.changed_ = file + " was changed since gapscope wrote it: the report is of what it says now.";
    redrawn.take_over(file);
  }
  if (list != nullptr) redrawn.dropped_ = list->dropped;
  return redrawn;
}

ReportFolder::ReportFolder(const std::string& folder, FolderKind kind, const std::vector<std::string>& inputs,
                           bool redraw)
    : kind_(kind), redraw_(redraw), final_(without_trailing_slash(folder).string()) {
  try {
    make_target();
    take(inputs, redraw);
    make_partial();
  } catch (...) {
    clear();
    throw;
  }
}

ReportFolder::ReportFolder(ReportFolder&& other) noexcept = default;

ReportFolder::~ReportFolder() { clear(); }

std::string in_its_folder(std::string message) {
  const std::string hidden = std::string("/") + internal::results::kPartial;
  constexpr std::size_t kRandom = 6;
  for (auto at = message.find(hidden); at != message.npos; at = message.find(hidden, at))
    message.erase(at, hidden.size() + kRandom);
  return message;
}

void ReportFolder::make_target() {
  std::error_code problem;
  const fs::file_status there = fs::status(final_, problem);
  if (fs::exists(there) && !fs::is_directory(there))
    throw ConfigError(final_, "is a file, expected the folder of a report");
  constexpr int kPatience = 100;  // another process may be removing what it made and did not need
  for (int attempt = 0; attempt < kPatience && make_missing(); ++attempt) {
  }
}

/// @returns whether a folder above was removed meanwhile
bool ReportFolder::make_missing() {
  std::error_code problem;
  std::vector<fs::path> missing;
  for (fs::path path = final_; !path.empty() && !fs::exists(path, problem); path = path.parent_path())
    missing.push_back(path);
  std::reverse(missing.begin(), missing.end());
  for (const fs::path& path : missing) {
    const bool made = fs::create_directory(path, problem);
    if (problem == std::errc::no_such_file_or_directory) return true;
    if (problem) refuse_to_write(path.has_parent_path() ? path.parent_path() : ".", problem.message());
    if (made) made_.push_back(path.string());
  }
  return false;
}

void ReportFolder::take(const std::vector<std::string>& inputs, bool redraw) {
  lock_ = std::make_unique<ProcessLock>(final_);
  if (lock_->held_by_another())
    throw ConfigError(final_, "is being written by another process, expected one at a time");
  internal::results::remove_left_behind(final_);
  list_hash_ = hash_of_list();
  if (auto list = internal::results::read_file_list(final_))
    before_ = std::make_unique<FileList>(*std::move(list));
  if (redraw)
    internal::results::require_redrawable(final_, internal::results::word_of(kind_), before_.get());
  else
    internal::results::require_own(final_, internal::results::word_of(kind_), before_.get());
  internal::results::require_no_input(final_, before_.get(), inputs);
}

void ReportFolder::make_partial() {
  std::string name = final_ + "/" + internal::results::kPartial + "XXXXXX";
  if (mkdtemp(name.data()) == nullptr) refuse_to_write(final_, std::strerror(errno));
  partial_ = name;
  unfinished_ = std::make_unique<Unfinished>([partial = partial_, folder = final_, made = made_] {
    internal::results::remove_partial(partial, folder);
    std::for_each(made.rbegin(), made.rend(), [](const std::string& path) { rmdir(path.c_str()); });
    return !fs::exists(partial);
  });
  std::ofstream mark(partial_ + "/" + internal::results::kMark);
  mark << internal::results::kMarkText;
  if (!mark.flush()) refuse_to_write(final_, "no room for a file");
}

void ReportFolder::clear() noexcept {
  const Moment moment;
  unfinished_.reset();
  lock_.reset();
  if (!partial_.empty()) internal::results::remove_partial(partial_, final_);
  partial_.clear();
  for (; !made_.empty(); made_.pop_back())
    rmdir(made_.back().c_str());  // a folder that is empty, nothing else
}

void ReportFolder::leave() {
  made_.clear();
  clear();
}

void ReportFolder::take_over(const std::string& file) {
  const fs::path from = fs::path(final_) / file, to = fs::path(partial_) / file;
  std::error_code error;
  require_input_file(from.string(), "a file of the report as gapscope wrote it");
  fs::create_directories(to.parent_path(), error);
  if (!error) fs::copy_file(from, to, error);
  if (error) fail(final_, "cannot be written in: " + error.message());
  kept_.insert(file);
}

void ReportFolder::keep(const char* result, const std::vector<const char*>& others, bool held_out_traces) {
  const fs::path from = final_;
  take_over(result);
  for (const char* other : others)
    if (fs::exists(from / other)) take_over(other);
  for (const std::string& file : internal::results::files_below(from))
    if (file.starts_with("traces/") && file.starts_with("traces/held_out_") == held_out_traces)
      take_over(file);
}

void ReportFolder::require_same_data(const ReportedData& data) const {
  internal::results::require_same_data(final_, data);
}

void ReportFolder::keep_estimate(const std::string& version, const std::vector<FileHash>& sources) {
  dropped_ = internal::results::why_not_together(final_, "result.json", version, sources);
  if (dropped_.empty() && fs::exists(fs::path(final_) / "result.json"))
    keep("result.json", {"timing.json"}, false);
}

void ReportFolder::keep_diagnosis(const std::string& version, const std::vector<FileHash>& sources) {
  dropped_ = internal::results::why_not_together(final_, "diagnosis.json", version, sources);
  if (dropped_.empty() && fs::exists(fs::path(final_) / "diagnosis.json"))
    keep("diagnosis.json",
         {internal::results::kBesideDiagnosis.begin(), internal::results::kBesideDiagnosis.end()}, true);
}

/// Of the list as it is now; empty where there is none.
std::string ReportFolder::hash_of_list() const {
  const std::string path = final_ + "/" + internal::results::kFileList;
  std::error_code problem;
  return fs::exists(fs::symlink_status(path, problem)) ? sha256_of_file(path) : "";
}

/// Takes the place of the list that was found.  @returns its content identity
std::string ReportFolder::put_list(const FileList& list, const std::string& found) const {
  const fs::path written = fs::path(partial_) / ".list",
                 aside = fs::path(partial_) / internal::results::kReplaced;
  for (const fs::path& folder : {written, aside}) fs::create_directory(folder);
  internal::results::write_file_list(written, list);
  const fs::path fresh = aside / internal::results::kFileList;  // where the one that was found ends up
  fs::rename(written / internal::results::kFileList, fresh);
  std::string moved = content_identity(fresh);
  replace_file(found, fresh, fs::path(final_) / internal::results::kFileList);
  return moved;
}

/// What is gapscope's own of what goes out of the way; anything else there came meanwhile.
void ReportFolder::write_own(const FileList& meanwhile, const FileList& after) const {
  const fs::path own = fs::path(partial_) / internal::results::kOwn;
  fs::create_directory(own);
  FileList list = before_ ? *before_ : FileList{after.version, after.kind, "", {}};
  if (before_) list.files.push_back({internal::results::kFileList, list_hash_});
  for (const FileList* one : {&meanwhile, &after}) {
    internal::results::write_file_list(own, *one);
    list.files.push_back(listed(own, internal::results::kFileList));
  }
  internal::results::write_file_list(own, list);
}

/// What the folder will list, and what of the earlier report goes.
FileList ReportFolder::list_after(const std::vector<std::string>& fresh,
                                  std::vector<std::string>& stale) const {
  const std::string kind = internal::results::word_of(kind_);
  FileList after{version(), kind, dropped_, {}};
  for (const std::string& file : fresh) after.files.push_back(listed(partial_, file));
  for (const FileHash& old : before_ ? before_->files : std::vector<FileHash>{}) {
    if (after.holds(old.file) || internal::results::is_left_alone(kind, old.file)) continue;
    const bool drawn =
        old.file == "report.md" || old.file == "report.html" || internal::results::is_figure(old.file);
    if (!is_still(final_, old)) continue;  // nor of the two that a killed process left of one name
    if (kept_.contains(old.file) || (redraw_ && !drawn))
      after.files.push_back(old);
    else
      stale.push_back(old.file);
  }
  for (const std::string& file : internal::results::files_left_alone(final_, kind))
    if (!after.holds(file)) after.files.push_back({file, ""});
  const auto by_name = [](const FileHash& a, const FileHash& b) { return a.file < b.file; };
  std::sort(after.files.begin(), after.files.end(), by_name);
  return after;
}

void ReportFolder::commit() {
  const Moment moment;
  std::vector<std::string> fresh, stale;
  for (const std::string& file : internal::results::files_below(partial_))
    if (!kept_.contains(file)) fresh.push_back(file);
  std::stable_partition(fresh.begin(), fresh.end(), [](const std::string& f) { return !is_result(f); });
  const FileList after = list_after(fresh, stale);
  FileList meanwhile = after;  // whatever ends this process on the way, what is ours is known
  if (before_) meanwhile.files.insert(meanwhile.files.end(), before_->files.begin(), before_->files.end());
  write_own(meanwhile, after);
  const std::string list = final_ + "/" + internal::results::kFileList;
  const std::string found = content_identity(list);
  if (hash_of_list() != list_hash_) throw ConfigError(list, "changed during the work, expected it as it was");
  internal::results::require_out_of_the_way(final_, before_.get(), fresh);
  const std::string moved = put_list(meanwhile, found);
  made_.clear();
  try {
    internal::results::replace_files(partial_, final_, fresh, stale,
                                     fs::path(partial_) / internal::results::kReplaced, is_result,
                                     before_.get());
  } catch (...) {
    if (before_) put_list(*before_, moved);
    throw;
  }
  put_list(after, moved);
  clear();
}

}  // namespace gapscope

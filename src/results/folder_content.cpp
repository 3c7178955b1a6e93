#include "results/folder_content.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <set>
#include <string_view>

#include "base/input_file.h"
#include "base/shown.h"
#include "gapscope/base/errors.h"

namespace gapscope::internal::results {
namespace {

namespace fs = std::filesystem;

constexpr const char* kExpected = "expected an empty folder or one that holds a report of its own";

bool is_one_of(const std::string& file, std::initializer_list<const char*> names) {
  return std::any_of(names.begin(), names.end(), [&](const char* name) { return file == name; });
}

/// Names that every report may take.
bool is_taken(const std::string& file) {
  return is_stored(file) || is_one_of(file, {"report.md", "report.html", "truth.csv", "certificate.md"});
}

bool is_partial(const fs::directory_entry& entry) {
  const std::string name = entry.path().filename().string();
  constexpr std::size_t kRandom = 6;
  return name.starts_with(kPartial) && name.size() == std::string_view(kPartial).size() + kRandom &&
         entry.is_directory() && !entry.is_symlink();
}

/// A file system of its own begins with a folder for what fsck finds.
bool is_of_the_system(const fs::directory_entry& entry) {
  return entry.path().filename() == "lost+found" && entry.is_directory();
}

fs::directory_iterator entries_of(const fs::path& folder) {
  std::error_code problem;
  fs::directory_iterator entries(folder, problem);
  if (problem) throw ConfigError(folder.string(), "cannot be read: " + problem.message() + ", " + kExpected);
  return entries;
}

[[noreturn]] void refuse(const fs::path& folder, const std::string& what) {
  throw ConfigError(folder.string(), what + ", " + kExpected);
}

/// A file that a process was writing aside when it was killed.
bool is_aside(const std::string& name) {
  const std::string_view begin = ".gapscope-";
  return name.starts_with(begin) && name.size() > begin.size() &&
         name.find_first_not_of("0123456789-", begin.size()) == name.npos;
}

void require_nothing(const fs::path& folder, const std::string& kind) {
  std::set<std::string> others;
  for (const fs::directory_entry& entry : entries_of(folder))
    if (const std::string name = entry.path().filename().string();
        !is_left_alone(kind, name) && !is_of_the_system(entry) && !is_aside(name))
      others.insert(name);
  if (!others.empty())
    refuse(folder, "holds " + gapscope::shown(*others.begin()) + " and no report of gapscope");
}

void require_unchanged(const fs::path& folder, const FileList& list, const std::string& file) {
  if (is_there(folder / file) && !list.wrote(folder, file))
    refuse(folder, list.holds(file)
                       ? "holds " + gapscope::shown(file) + ", which was changed since gapscope wrote it"
                       : "holds " + gapscope::shown(file) + ", which gapscope did not write there");
}

}  // namespace

std::string word_of(FolderKind kind) {
  constexpr std::array kWords = {"drive", "campaign", "blind", "cases", "drives", "changes", "export"};
  return kWords[static_cast<std::size_t>(kind)];
}

bool is_there(const fs::path& path) {
  std::error_code problem;
  return fs::exists(fs::symlink_status(path, problem)) || problem.value() == EACCES;
}

std::vector<std::string> files_below(const fs::path& folder) {
  std::vector<std::string> files;
  if (!fs::is_directory(folder)) return files;
  const auto hidden = [](const fs::path& path) { return path.filename().string().starts_with('.'); };
  for (auto entry = fs::recursive_directory_iterator(folder); entry != fs::recursive_directory_iterator();
       ++entry) {
    if (entry->is_directory() && (hidden(entry->path()) || entry->is_symlink()))
      entry.disable_recursion_pending();
    if (!entry->is_directory() && !hidden(entry->path()))
      files.push_back(entry->path().lexically_relative(folder).string());
  }
  std::sort(files.begin(), files.end());
  return files;
}

bool is_stored(const std::string& file) {
  const fs::path path(file);
  if (path.has_parent_path()) return path.parent_path() == "traces" && path.extension() == ".csv";
  return is_one_of(file, {"result.json", "diagnosis.json", "campaign.json", "blind.json", "compare.json",
                          "certificate.json", "resolved.yaml", "timing.json"}) ||
         std::find(kBesideDiagnosis.begin(), kBesideDiagnosis.end(), file) != kBesideDiagnosis.end();
}

bool is_left_alone(const std::string& kind, const std::string& file) {
  if (kind == "campaign") return file.starts_with("results.sqlite") && !file.ends_with(".csv");
  return kind == "blind" && is_one_of(file, {"cases", "labels.json", "answers.json", "answers.json.partial"});
}

std::vector<std::string> files_left_alone(const fs::path& folder, const std::string& kind) {
  std::vector<std::string> files;
  for (const fs::directory_entry& entry : entries_of(folder))
    if (const std::string name = entry.path().filename().string();
        is_left_alone(kind, name) && entry.is_regular_file())
      files.push_back(name);
  return files;
}

std::string shown_again(const fs::path& aside, const fs::path& to) {
  rmdir((aside / "traces").c_str());  // folders that are empty, nothing else
  rmdir(aside.c_str());
  if (!is_there(aside)) return "";
  const std::string hidden = aside.parent_path().filename().string();
  constexpr std::size_t kRandom = 6;
  const fs::path place =
      to / ("not_put_back_" + hidden.substr(hidden.size() - std::min(kRandom, hidden.size())));
  std::error_code problem;
  fs::rename(aside, place, problem);
  return problem ? aside.string() : place.string();
}

namespace {

/// @returns whether nothing is left there
bool removed_replaced(const fs::path& partial, const fs::path& to) {
  const fs::path aside = partial / kReplaced;
  if (!is_there(aside)) return true;
  std::error_code problem;
  if (const std::optional<FileList> own = read_file_list(partial / kOwn))
    for (const FileHash& f : own->files)
      if (own->wrote(aside, f.file)) fs::remove(aside / f.file, problem);
  shown_again(aside, to);
  return !is_there(aside);
}

bool holds_mark_alone(const fs::path& partial) {
  std::error_code gone;
  std::vector<fs::path> content;
  for (const auto& entry : fs::directory_iterator(partial, gone)) content.push_back(entry.path().filename());
  return content == std::vector<fs::path>{kMark};
}

}  // namespace

/// The mark goes last, and only where nothing else is left.
void remove_partial(const fs::path& partial, const fs::path& to) noexcept try {
  if (!removed_replaced(partial, to)) return;
  std::vector<fs::path> content;
  for (const fs::directory_entry& entry : fs::directory_iterator(partial)) content.push_back(entry.path());
  for (const fs::path& path : content)
    if (path.filename() != kMark) fs::remove_all(path);
  fs::remove(partial / kMark);
  rmdir(partial.c_str());
} catch (const std::exception&) {  // the next report tries again
}

void remove_left_behind(const fs::path& folder) {
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
    if (!is_partial(entry)) continue;
    std::ifstream in = try_input_file((entry.path() / kMark).string());
    const std::string mark(std::istreambuf_iterator<char>(in), {});
    if (mark == kMarkText) remove_partial(entry.path(), folder);
    if (holds_mark_alone(entry.path()) && std::string_view(kMarkText).starts_with(mark))
      fs::remove(entry.path() / kMark, ignored);  // killed while it was written
    fs::remove(entry.path(), ignored);  // if it is empty: killed before the mark came, or after it went
  }
}

namespace {

void require_kind(const fs::path& folder, const std::string& kind, const FileList& list) {
  if (list.kind != kind)
    throw ConfigError(folder.string(), "holds a report of another kind (" + printable(list.kind, 20) +
                                           "), expected one of its own kind (" + kind +
                                           ") or another folder");
}

}  // namespace

void require_own(const fs::path& folder, const std::string& kind, const FileList* list) {
  if (list == nullptr) return require_nothing(folder, kind);
  require_kind(folder, kind, *list);
  for (const FileHash& f : list->files)
    if (!is_left_alone(kind, f.file)) require_unchanged(folder, *list, f.file);
  for (const fs::directory_entry& entry : entries_of(folder)) {
    const std::string name = entry.path().filename().string();
    if (is_taken(name)) require_unchanged(folder, *list, name);
  }
  if (!is_there(folder / "traces")) return;
  if (!fs::is_directory(fs::symlink_status(folder / "traces")))
    refuse(folder, "holds 'traces', which gapscope did not write there");
  for (const fs::directory_entry& entry : entries_of(folder / "traces"))
    require_unchanged(folder, *list, "traces/" + entry.path().filename().string());
}

void require_redrawable(const fs::path& folder, const std::string& kind, const FileList* list) {
  if (list != nullptr) require_kind(folder, kind, *list);
  const FileList none;
  if (list == nullptr) list = &none;
  for (const char* text : {"report.md", "report.html"}) require_unchanged(folder, *list, text);
  for (const FileHash& f : list->files)
    if (is_figure(f.file)) require_unchanged(folder, *list, f.file);
}

void require_no_input(const fs::path& folder, const FileList* list, const std::vector<std::string>& inputs) {
  if (list == nullptr) return;
  std::error_code problem;
  for (const std::string& input : inputs)
    for (const FileHash& f : list->files)
      if (fs::equivalent(input, folder / f.file, problem))
        throw ConfigError(
            input, "is read, and would be replaced by the report, expected another folder for it (-o)");
}

void require_out_of_the_way(const fs::path& folder, const FileList* list,
                            const std::vector<std::string>& files) {
  const FileList none;
  if (list == nullptr) list = &none;
  std::error_code problem;
  const fs::path traces = folder / "traces";
  if (is_there(traces) && !fs::is_directory(fs::symlink_status(traces, problem)))
    throw ConfigError(traces.string(), "is no folder of gapscope's any more, expected it as it was");
  const auto in_the_way = [&](const std::string& file) {
    throw ConfigError((folder / file).string(),
                      "is in the way of the report and not what gapscope wrote there, expected it elsewhere");
  };
  for (const std::string& file : files) {
    if (is_there(folder / file) && !list->wrote(folder, file)) in_the_way(file);
    if (file == "results.sqlite")  // of another one what SQLite keeps beside it would become part of this one
      for (const std::string& other : files_left_alone(folder, "campaign")) in_the_way(other);
  }
}

}  // namespace gapscope::internal::results

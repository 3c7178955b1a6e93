#include "gapscope/results/report_folder.h"

#include <stdlib.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <stdexcept>
#include <vector>

namespace gapscope {
namespace fs = std::filesystem;
namespace {

constexpr std::chrono::seconds kStillBeingMade{60};  ///< a folder that is younger may not be locked yet

[[noreturn]] void fail(const fs::path& path, const std::string& what) {
  throw std::runtime_error(path.string() + ": " + what);
}

/// Files below a folder as paths relative to it: sorted, so that every commit goes the same way, and the
/// result last, so that whoever finds a new result finds all that belongs to it.
std::vector<fs::path> files_below(const fs::path& folder) {
  std::vector<fs::path> files;
  if (!fs::is_directory(folder)) return files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (!entry.is_directory()) files.push_back(entry.path().lexically_relative(folder));
  const auto is_result = [](const fs::path& f) {
    return f == "result.json" || f == "diagnosis.json" || f == "campaign.json" || f == "blind.json" ||
           f == "compare.json";
  };
  std::sort(files.begin(), files.end(), [&](const fs::path& a, const fs::path& b) {
    return std::make_pair(is_result(a), a) < std::make_pair(is_result(b), b);
  });
  return files;
}

/// The figures that the report.md of an earlier report shows.
std::set<std::string> figures_of(const fs::path& folder) {
  std::set<std::string> names;
  std::ifstream in(folder / "report.md");
  static const std::regex figure(R"rx(\]\(([^)/]+\.png)\))rx");
  std::smatch match;
  for (std::string line; std::getline(in, line);)
    for (std::string rest = line; std::regex_search(rest, match, figure); rest = match.suffix())
      names.insert(match[1]);
  return names;
}

/// Is this something that a report with these figures wrote?
bool is_ours(const fs::path& file, const std::set<std::string>& figures) {
  if (!file.has_parent_path()) {
    static const char* const names[] = {
        "report.md",   "result.json",          "diagnosis.json",     "campaign.json",
        "blind.json",  "compare.json",         "resolved.yaml",      "timing.json",
        "fitted.yaml", "next_experiment.yaml", "next_experiment.csv"};
    return figures.contains(file.string()) ||
           std::any_of(std::begin(names), std::end(names), [&](const char* name) { return file == name; });
  }
  return *file.begin() == "traces" && file.extension() == ".csv";
}

fs::path without_trailing_slash(const std::string& folder) {
  const fs::path path = fs::absolute(folder).lexically_normal();
  return path.has_filename() ? path : path.parent_path();
}

/// What a process left that was killed while it made the same report.
void remove_left_behind(const fs::path& target, const std::string& prefix) {
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(target.parent_path(), ignored)) {
    if (!entry.path().filename().string().starts_with(prefix)) continue;
    const bool fresh = fs::file_time_type::clock::now() - entry.last_write_time(ignored) < kStillBeingMade;
    if (!fresh && !ProcessLock(entry.path().string()).held_by_another())
      fs::remove_all(entry.path(), ignored);
  }
}

}  // namespace

ReportFolder::ReportFolder(const std::string& folder) {
  const fs::path target = without_trailing_slash(folder);
  if (fs::exists(target) && !fs::is_directory(target)) fail(target, "is not a folder");
  std::error_code error;
  fs::create_directories(target.parent_path(), error);
  if (error) fail(target.parent_path(), "cannot be created: " + error.message());
  const std::string prefix = "." + target.filename().string() + ".partial-";
  remove_left_behind(target, prefix);
  std::string name = target.parent_path().string() + "/" + prefix + "XXXXXX";
  if (mkdtemp(name.data()) == nullptr)
    fail(target.parent_path(), std::string("cannot be written in: ") + std::strerror(errno));
  fs::permissions(name, fs::perms(0755),
                  error);  // mkdtemp gives 0700, which would survive as the report's own
  lock_ = std::make_unique<ProcessLock>(name);
  final_ = target.string();
  partial_ = name;
}

ReportFolder::~ReportFolder() {
  std::error_code ignored;
  if (!partial_.empty()) fs::remove_all(partial_, ignored);
}

void ReportFolder::take_over(const std::string& file) {
  const fs::path from = fs::path(final_) / file, to = fs::path(partial_) / file;
  std::error_code error;
  fs::create_directories(to.parent_path(), error);
  if (!error) fs::copy_file(from, to, error);
  if (error) fail(fs::path(final_).parent_path(), "cannot be written in: " + error.message());
}

void ReportFolder::keep(const char* result, const std::vector<const char*>& others, bool held_out_traces) {
  const fs::path from = final_;
  if (!fs::exists(from / result)) return;
  take_over(result);
  for (const char* other : others)
    if (fs::exists(from / other)) take_over(other);
  for (const fs::path& file : files_below(from / "traces"))
    if (file.string().starts_with("held_out_") == held_out_traces) take_over("traces/" + file.string());
}

void ReportFolder::keep_stored() {
  for (const fs::path& file : files_below(final_))
    if (is_ours(file, {}) && file != "report.md") take_over(file.string());
}

void ReportFolder::keep_estimate() { keep("result.json", {"timing.json"}, false); }
void ReportFolder::keep_diagnosis() {
  keep("diagnosis.json", {"fitted.yaml", "next_experiment.yaml", "next_experiment.csv"}, true);
}

void ReportFolder::commit() {
  const std::vector<fs::path> fresh = files_below(partial_);
  const std::vector<fs::path> old = files_below(final_);
  const std::set<std::string> old_figures = figures_of(final_);
  std::error_code error;
  for (const fs::path& file : fresh) {
    const fs::path target = fs::path(final_) / file;
    fs::create_directories(target.parent_path(), error);
    if (!error) fs::rename(fs::path(partial_) / file, target, error);
    if (error) fail(target, "cannot be written: " + error.message());
  }
  for (const fs::path& file : old) {
    if (!is_ours(file, old_figures) || std::find(fresh.begin(), fresh.end(), file) != fresh.end()) continue;
    fs::remove(fs::path(final_) / file, error);
    if (error) fail(fs::path(final_) / file, "cannot be removed: " + error.message());
  }
  const fs::path traces = fs::path(final_) / "traces";
  if (fs::is_directory(traces) && fs::is_empty(traces)) fs::remove(traces, error);
  fs::remove_all(partial_, error);
  partial_.clear();
}

}  // namespace gapscope

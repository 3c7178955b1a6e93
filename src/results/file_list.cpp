#include "results/file_list.h"

#include <algorithm>

#include "base/shown.h"
#include "gapscope/base/errors.h"
#include "results/json_document.h"
#include "results/json_schema.h"
#include "results/sha256.h"
#include "results/shared_fields.h"

namespace gapscope::internal::results {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFilesSchema = "gapscope.files/1";

/// "report.md" or "traces/1_a.csv": a list that came from elsewhere reaches no other folder.
bool is_below(const std::string& file) {
  const fs::path path(file), folder = path.parent_path();
  const fs::path name = path.filename();
  return !name.empty() && name != "." && name != ".." && (folder.empty() || folder == "traces");
}

/// Whether the folder of a file below another one is a link to somewhere else.
bool has_linked_folder(const fs::path& folder, const std::string& file) {
  std::error_code problem;
  const fs::path parent = fs::path(file).parent_path();
  return !parent.empty() && !fs::is_directory(fs::symlink_status(folder / parent, problem));
}

/// Wall times have no hash that they could be known by.
bool holds_wall_times(const fs::path& path) {
  try {
    const Json json = load_json(path.string());
    return json.is_object() && json.contains("model_free_s") && json.contains("reference_s") &&
           json.size() == 2u + json.count("wall_s") + json.count("literal_s");
  } catch (const ConfigError&) {
    return false;
  }
}

}  // namespace

template <class Archive>
void fields(Archive& archive, FileList& l) {
  archive("version", l.version);
  archive("kind", l.kind);
  archive("dropped", l.dropped);
  archive.list("files", l.files);
}

bool FileList::holds(const std::string& file) const {
  return std::any_of(files.begin(), files.end(), [&](const FileHash& f) { return f.file == file; });
}

bool FileList::wrote(const fs::path& folder, const std::string& file) const {
  std::error_code problem;
  const fs::path path = folder / file;
  if (!fs::is_regular_file(fs::symlink_status(path, problem))) return false;
  if (!fs::is_directory(fs::status(folder, problem)) || has_linked_folder(folder, file)) return false;
  std::string found;
  return std::any_of(files.begin(), files.end(), [&](const FileHash& f) {
    if (f.file != file) return false;
    if (!f.sha256.empty() && found.empty()) found = sha256_of_file(path.string());
    return f.sha256.empty() ? file == "timing.json" && holds_wall_times(path) : f.sha256 == found;
  });
}

std::optional<FileList> read_file_list(const fs::path& folder) {
  std::error_code problem;
  const fs::path path = folder / kFileList;
  const fs::file_status there = fs::symlink_status(path, problem);
  if (!fs::exists(there)) return {};
  if (!fs::is_regular_file(there))
    throw ConfigError(path.string(), "is no regular file, expected a list of gapscope");
  FileList list = read_document<FileList>(path.string(), kFilesSchema);
  for (const FileHash& f : list.files)
    if (!is_below(f.file))
      throw ConfigError(path.string(),
                        "lists the file " + gapscope::shown(f.file) + ", expected one in the folder itself");
  return list;
}

void write_file_list(const fs::path& folder, const FileList& list) {
  write_document((folder / kFileList).string(), kFilesSchema, list);
}

Json files_schema() { return document_schema(kFilesSchema, FileList()); }

}  // namespace gapscope::internal::results

#include "results/file_list.h"

#include <algorithm>

#include "gapscope/base/errors.h"
#include "gapscope/base/shown.h"
#include "gapscope/results/sha256.h"
#include "results/file_hash_fields.h"
#include "results/json_document.h"
#include "results/json_schema.h"

namespace gapscope::internal {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSchema = "gapscope.files/1";

/// "report.md" or "traces/1_a.csv": a list that came from elsewhere reaches no other folder.
bool is_below(const std::string& file) {
  const fs::path path(file), folder = path.parent_path();
  const fs::path name = path.filename();
  return !name.empty() && name != "." && name != ".." && (folder.empty() || folder == "traces");
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
  std::string found;
  return std::any_of(files.begin(), files.end(), [&](const FileHash& f) {
    if (f.file != file) return false;
    if (!f.sha256.empty() && found.empty()) found = sha256_of_file(path.string());
    return f.sha256.empty() || f.sha256 == found;
  });
}

std::optional<FileList> read_file_list(const fs::path& folder) {
  std::error_code problem;
  const fs::path path = folder / kFileList;
  if (!fs::exists(fs::symlink_status(path, problem))) return {};
  FileList list = read_document<FileList>(path.string(), kSchema);
  for (const FileHash& f : list.files)
    if (!is_below(f.file))
      throw ConfigError(path.string(),
                        "lists the file " + gapscope::shown(f.file) + ", expected one in the folder itself");
  return list;
}

void write_file_list(const fs::path& folder, const FileList& list) {
  write_document((folder / kFileList).string(), kSchema, list);
}

Json files_schema() { return document_schema(kSchema, FileList()); }

}  // namespace gapscope::internal

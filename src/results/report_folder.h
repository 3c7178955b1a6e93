#pragma once

#include <memory>
#include <set>
#include <string>
#include <vector>

#include "base/at_once.h"
#include "base/file_hash.h"
#include "base/process_lock.h"

namespace gapscope {

namespace internal::results {
struct FileList;
}

/// What a folder holds. A folder takes reports of one kind.
enum class FolderKind { kDrive, kCampaign, kBlind, kCases, kDrives, kChanges, kExport };

/// What the report of a drive is made from. The same recordings are the same drive, whatever is asked of
/// them.
struct ReportedData {
  std::string name;               ///< of the configuration: by it a simulated drive is known
  bool simulated = false;         ///< nothing was recorded
  std::vector<FileHash> sources;  ///< as the result has them
};

/// A folder that is written whole or not at all, and in which nothing is touched that gapscope did not write
/// there. It is taken before the work: files.json in it lists what gapscope wrote, with SHA-256, and only
/// what is listed and unchanged since may be replaced or removed. A folder that holds anything else instead
/// is refused.
///
/// What is to be stored is first written into a hidden folder within the final one; commit() then moves it
/// file by file, the results last, and removes what the earlier report had and the new one does not. Until
/// then what an earlier run left stays as it was. Without commit() nothing remains; what a killed process
/// left is removed by the next one that takes the folder.
class ReportFolder {
 public:
  /// @param inputs  files that the command reads; none of them is replaced
  /// @throws ConfigError where the folder holds something else, is written by another process, would replace
  /// an input, or cannot be written: nothing has been changed then
  ReportFolder(const std::string& folder, FolderKind kind, const std::vector<std::string>& inputs = {});

  /// For drawing again what is stored there: only the text and the figures are replaced. All that is stored
  /// is taken over; what of it is not as gapscope wrote it, changed() says.
  static ReportFolder to_redraw(const std::string& folder, FolderKind kind);

  ~ReportFolder();
  ReportFolder(ReportFolder&&) noexcept;
  ReportFolder& operator=(ReportFolder&&) = delete;

  /// Where to write; exists and is empty at the start.
  const std::string& path() const { return partial_; }

  /// Whether a report stands there that this one takes the place of.
  bool replaces() const { return before_ != nullptr; }

  /// Before the work: what stands there must be of one of these recordings, or of this simulation, as the new
  /// report takes its place.  @throws ConfigError
  void require_same_data(const ReportedData& data) const;

  // Each takes over what the other kind of command stored here, so that the new report shows it too, if it is
  // of the same version, configuration and recordings; else it is dropped, and dropped() says so.
  /// Of run, detect, fit.
  void keep_estimate(const std::string& version, const std::vector<FileHash>& sources);
  void keep_diagnosis(const std::string& version, const std::vector<FileHash>& sources);  ///< of diagnose

  /// A sentence on what was not taken over; empty where nothing was there, or all goes together.
  const std::string& dropped() const { return dropped_; }

  /// A sentence on the first file that is drawn again though it was changed; empty where there is none, or
  /// where no files.json is to tell.
  const std::string& changed() const { return changed_; }

  /// Leaves the folder, empty if it was new, to what else is written there: nothing is committed.
  void leave();

  /// @throws ConfigError for a file that is in the way, std::runtime_error with the path of what could not be
  /// moved or removed.
  void commit();

 private:
  ReportFolder(const std::string& folder, FolderKind kind, const std::vector<std::string>& inputs,
               bool redraw);
  void make_target();
  bool make_missing();
  void take(const std::vector<std::string>& inputs, bool redraw);
  void make_partial();
  void keep(const char* result, const std::vector<const char*>& others, bool held_out_traces);
  void take_over(const std::string& file);
  std::string hash_of_list() const;
  std::string put_list(const internal::results::FileList& list, const std::string& found) const;
  void write_own(const internal::results::FileList& meanwhile,
                 const internal::results::FileList& after) const;
  internal::results::FileList list_after(const std::vector<std::string>& fresh,
                                         std::vector<std::string>& stale) const;
  void clear() noexcept;

  FolderKind kind_;
  bool redraw_;
  std::string final_, partial_, dropped_, changed_;
  std::string list_hash_;          ///< of files.json as it was found; empty: there was none
  std::vector<std::string> made_;  ///< folders, the outermost first
  std::set<std::string> kept_;     ///< files that stay as they are
  std::unique_ptr<internal::results::FileList> before_;
  std::unique_ptr<ProcessLock> lock_;
  std::unique_ptr<Unfinished> unfinished_;
};

/// A message about a file on its way into a folder, as one about the file in that folder.
std::string in_its_folder(std::string message);

}  // namespace gapscope

#include "results/replace_files.h"

#include <unistd.h>

#include <algorithm>
#include <stdexcept>

#include "base/move_file.h"
#include "gapscope/base/errors.h"
#include "results/folder_content.h"

namespace gapscope::internal::results {
namespace {

namespace fs = std::filesystem;

/// Renames that can be taken back.
class Moves {
 public:
  /// Nothing may be at the new place. What is moved away is put back whatever it is: it was there.
  void move_away(const fs::path& from, const fs::path& to) { move(from, to, ""); }
  void move_in(const fs::path& from, const fs::path& to) { move(from, to, content_identity(from)); }

  /// What came or changed meanwhile stays where it is, and so does what that stands in the way of.
  void take_back() noexcept {
    for (; !done_.empty(); done_.pop_back()) try {
        const Done& last = done_.back();
        if (last.own.empty())
          moved_where_nothing_is(last.to, last.from);
        else
          moved_if_still(last.own, last.to, last.from);
      } catch (const std::runtime_error&) {
      }
  }

 private:
  struct Done {
    fs::path from, to;
    std::string own;  ///< identity of a file of the new report; empty: one that was there
  };

  void move(const fs::path& from, const fs::path& to, std::string own) {
    std::error_code error;
    fs::create_directories(to.parent_path(), error);
    if (error) throw std::runtime_error(from.string() + ": cannot be replaced: " + error.message());
    if (!moved_where_nothing_is(from, to))
      throw ConfigError(to.string(), "came to be there meanwhile, expected that it stays free");
    done_.push_back({from, to, std::move(own)});
  }

  std::vector<Done> done_;
};

}  // namespace

void replace_files(const fs::path& from, const fs::path& to, const std::vector<std::string>& fresh,
                   const std::vector<std::string>& stale, const fs::path& aside,
                   bool (*is_result)(const std::string&), const FileList* before) {
  Moves moves;
  const auto away = [&](const std::string& file) {
    if (!is_there(to / file)) return;
    moves.move_away(to / file, aside / file);
    if (before == nullptr || !before->wrote(aside, file))  // it changed since the last look at it
      throw ConfigError((to / file).string(), "changed meanwhile, expected it as it was");
  };
  try {
    for (const bool results : {true, false})
      for (const auto* files : {&fresh, &stale})
        for (const std::string& file : *files)
          if (is_result(file) == results) away(file);
    for (const std::string& file : fresh) moves.move_in(from / file, to / file);
  } catch (const std::runtime_error& error) {
    moves.take_back();
    const std::string left = shown_again(aside, to);
    if (left.empty()) throw;
    throw std::runtime_error(error.what() + ("; what could not be put back is in " + left));
  } catch (...) {
    moves.take_back();
    throw;
  }
  rmdir((to / "traces").c_str());  // a folder that is empty, nothing else
}

}  // namespace gapscope::internal::results

#include "blind/handing_out.h"

#include <algorithm>

#include "base/interrupt.h"
#include "blind/blind_check.h"
#include "gapscope/base/errors.h"
#include "gapscope/recording/recording_file.h"
#include "results/blind_files.h"

namespace gapscope::blind {
namespace {

namespace fs = std::filesystem;

/// The same labels may be there already; any others stay.
void write_or_find(const std::string& path, const BlindLabels& labels) {
  if (!fs::exists(fs::symlink_status(path))) return write_blind_labels(path, labels, "");
  const BlindLabels there = read_blind_labels(path);
  const auto same = [](const BlindLabel& a, const BlindLabel& b) { return line_of(a) == line_of(b); };
  if (head_line_of(there) != head_line_of(labels) ||
      !std::equal(there.cases.begin(), there.cases.end(), labels.cases.begin(), labels.cases.end(), same))
    throw ConfigError(path, "holds other labels of " + labels.name + ", expected another name");
}

}  // namespace

void require_labels_apart(const fs::path& folder, const fs::path& labels) {
  const fs::path inside = fs::weakly_canonical(labels).lexically_relative(fs::weakly_canonical(folder));
  if (!inside.empty() && *inside.begin() != "..")
    throw ConfigError(labels.string(), "lies in the folder of the recordings, expected a place apart");
}

void require_own_labels(const std::string& labels, const std::string& name,
                        const std::string& configuration) {
  if (fs::exists(labels) && !is_labels_file(labels, name, configuration))
    throw ConfigError(labels, "is there and holds no labels of " + name + ", expected another name");
}

void write_motor_side(const fs::path& path, Recording recording) {
  recording.x2.clear();
  recording.mode.clear();
  write_csv(path.string(), recording);
}

void hand_out(ReportFolder& cases, const std::string& labels, const BlindLabels& stored) {
  if (const fs::path parent = fs::path(labels).parent_path(); !parent.empty()) fs::create_directories(parent);
  write_or_find(labels, stored);
  seal_blind_check(cases.path(), labels);
  stop_point();
  cases.commit();
}

}  // namespace gapscope::blind

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <ostream>

#include "blind/blind_pair.h"
#include "blind/case_plan.h"
#include "gapscope/base/errors.h"
#include "gapscope/base/interrupt.h"
#include "gapscope/base/parallel.h"
#include "gapscope/base/whole_file.h"
#include "gapscope/blind/blind_check.h"
#include "gapscope/config/configuration.h"
#include "gapscope/recording/recording_file.h"
#include "gapscope/results/blind_files.h"
#include "gapscope/results/report_folder.h"

namespace gapscope {
namespace {

namespace fs = std::filesystem;

/// The sheet as a configuration: nothing of it comes from the effects.
std::string sheet_of(const std::string& name, const blind::BlindPair& pair) {
  Configuration c;
  c.name = name;
  c.recording.emplace();
  c.recording->files = {{name + "_train.csv", "", 0}};
  c.recording->held_out = {{name + "_held_out.csv", "", 0}};
  c.encoder.quantum = pair.train.quantum;
  c.model.given = true;
  c.model.structure = pair.sheet.structure;
  c.model.parameters = pair.sheet.parameters;
  return yaml_of(c, "");
}

void write_motor_side(const fs::path& path, Recording recording) {
  recording.x2.clear();
  recording.mode.clear();
  write_csv(path.string(), recording);
}

/// Notes in the label what is drawn on the way.
void write_case(const fs::path& folder, double duration, blind::PlannedCase& planned) {
  BlindLabel& label = planned.label;
  const blind::BlindPair pair =
      blind::blind_pair(label.rig, label.effects, label.severity, planned.seed, duration);
  if (label.effects.size() == 1) label.cycles_per_turn = pair.cycles_per_turn;
  write_motor_side(folder / (label.name + "_train.csv"), pair.train);
  write_motor_side(folder / (label.name + "_held_out.csv"), pair.held_out);
  write_whole_file((folder / (label.name + ".yaml")).string(),
                   [&](std::ostream& out) { out << sheet_of(label.name, pair); });
}

/// The same labels may be there already; any others stay.
void write_or_find(const std::string& path, const BlindLabels& labels) {
  if (!fs::exists(fs::symlink_status(path))) return write_blind_labels(path, labels, "");
  const BlindLabels there = read_blind_labels(path);
  const auto same = [](const BlindLabel& a, const BlindLabel& b) { return line_of(a) == line_of(b); };
  if (head_line_of(there) != head_line_of(labels) ||
      !std::equal(there.cases.begin(), there.cases.end(), labels.cases.begin(), labels.cases.end(), same))
    throw ConfigError(path, "holds other labels of " + labels.name + ", expected another name");
}

void require_apart(const fs::path& folder, const fs::path& labels) {
  const fs::path inside = fs::weakly_canonical(labels).lexically_relative(fs::weakly_canonical(folder));
  if (!inside.empty() && *inside.begin() != "..")
    throw ConfigError(labels.string(), "lies in the folder of the recordings, expected a place apart");
}

}  // namespace

void make_blind_check(const BlindConfig& config, const std::string& folder, const std::string& labels,
                      int threads, const BlindProgress& progress) {
  require_apart(folder, labels);
  const std::string resolved = resolved_yaml(config);
  if (fs::exists(labels) && !is_labels_file(labels, config.name, resolved))
    throw ConfigError(labels, "is there and holds no labels of " + config.name + ", expected another name");
  ReportFolder handed_out(folder, FolderKind::kCases);
  std::vector<blind::PlannedCase> cases = blind::plan_cases(config);
  std::atomic<std::size_t> done{0};
  parallel_for(cases.size(), threads, [&](std::size_t i) {
    stop_point();
    write_case(handed_out.path(), config.duration, cases[i]);
    if (const std::size_t count = ++done; progress) progress(count, cases.size());
  });
  BlindLabels stored{config.name, resolved, {}};
  for (const blind::PlannedCase& c : cases) stored.cases.push_back(c.label);
  if (const fs::path parent = fs::path(labels).parent_path(); !parent.empty()) fs::create_directories(parent);
  write_or_find(labels, stored);
  seal_blind_check(handed_out.path(), labels);
  stop_point();
  handed_out.commit();
}

}  // namespace gapscope

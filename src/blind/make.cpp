#include <atomic>
#include <filesystem>
#include <ostream>

#include "base/interrupt.h"
#include "base/parallel.h"
#include "blind/blind_check.h"
#include "blind/blind_pair.h"
#include "blind/case_plan.h"
#include "blind/handing_out.h"
#include "config/configuration.h"
#include "engine_plant/mujoco_plant.h"
#include "gapscope/base/whole_file.h"

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

/// Notes in the label what is drawn on the way.
void write_case(const fs::path& folder, const BlindConfig& config, blind::PlannedCase& planned) {
  BlindLabel& label = planned.label;
  const blind::BlindPair pair = blind::blind_pair(label.rig, label.effects, label.severity, planned.seed,
                                                  config.duration, config.plant);
  if (label.effects.size() == 1) label.cycles_per_turn = pair.cycles_per_turn;
  blind::write_motor_side(folder / (label.name + "_train.csv"), pair.train);
  blind::write_motor_side(folder / (label.name + "_held_out.csv"), pair.held_out);
  write_whole_file((folder / (label.name + ".yaml")).string(),
                   [&](std::ostream& out) { out << sheet_of(label.name, pair); });
}

}  // namespace

void make_blind_check(const BlindConfig& config, const std::string& folder, const std::string& labels,
                      int threads, const BlindProgress& progress) {
  if (config.plant == BlindPlant::kMujoco) engine_plant::require_mujoco();
  blind::require_labels_apart(folder, labels);
  const std::string resolved = resolved_yaml(config);
  blind::require_own_labels(labels, config.name, resolved);
  ReportFolder handed_out(folder, FolderKind::kCases);
  std::vector<blind::PlannedCase> cases = blind::plan_cases(config);
  std::atomic<std::size_t> done{0};
  parallel_for(cases.size(), threads, [&](std::size_t i) {
    stop_point();
    write_case(handed_out.path(), config, cases[i]);
    if (const std::size_t count = ++done; progress) progress(count, cases.size());
  });
  BlindLabels stored{config.name, resolved, {}};
  for (const blind::PlannedCase& c : cases) stored.cases.push_back(c.label);
  blind::hand_out(handed_out, labels, stored);
}

}  // namespace gapscope

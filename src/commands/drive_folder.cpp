#include "commands/drive_folder.h"

#include "run/run_pipeline.h"

namespace gapscope {

ReportFolder drive_folder(const std::string& folder, const Configuration& c) {
  ReportFolder report(folder, FolderKind::kDrive, source_paths(c));
  if (report.replaces()) report.require_same_data({c.name, c.simulation.has_value(), sources_of(c)});
  return report;
}

}  // namespace gapscope

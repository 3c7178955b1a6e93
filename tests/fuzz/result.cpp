#include "fuzz/attempt.h"
#include "fuzz/readers.h"
#include "results/blind_files.h"
#include "results/blind_score.h"
#include "results/campaign_summary.h"
#include "results/diagnosis_result.h"
#include "results/drive_changes.h"
#include "results/file_list.h"
#include "results/run_result.h"
#include "results/traces.h"
#include "support/reading.h"

namespace gapscope::testing {
namespace {

/// What a stored result may ask for beside itself: a trace of five samples.
constexpr const char* kTrace =
    "t_s,u,x1_rad,e_x_rad,w1_hat_rad_s,fit_x1_rad,mode\n"
    "0,0,0,0,0,0,gap\n0.1,0.5,0.01,0,0.1,0.01,gap\n0.2,1,0.04,,0.4,0.04,impact\n"
    "0.3,0.5,0.09,1e-3,0.6,0.09,engagement+\n0.4,0,0.1,0,0,0.1,engagement-\n";

/// A report every file of which is the one that is given.
class Report {
 public:
  Report() {
    namespace fs = std::filesystem;
    const fs::path folder = file.folder();
    fs::create_directory(folder / "traces");
    std::ofstream(folder / "traces/1_rig.csv") << kTrace;
    for (const char* name :
         {"result.json", "diagnosis.json", "campaign.json", "blind.json", "compare.json", "timing.json"})
      fs::create_symlink("stored", folder / name);
  }
  const GivenFile file{"stored"};
};

/// Every schema reads the same bytes; all but one refuse them at once.
int read_json(const Report& report) {
  const std::string folder = report.file.folder(), path = report.file.path();
  int taken = attempt([&] { read_run_result(folder); });
  taken += attempt([&] { read_diagnosis_result(folder); });
  taken += attempt([&] { read_campaign_summary(folder); });
  taken += attempt([&] { read_blind_score(folder); });
  taken += attempt([&] { read_drive_changes(folder); });
  taken += attempt([&] { read_timing(folder); });
  static const GivenFile list(internal::results::kFileList);  // which may be no link
  list.fill(testing::text_of(path));
  taken += attempt([&] { internal::results::read_file_list(list.folder()); });
  taken += attempt([&] { read_blind_labels(path); });
  taken += attempt([&] { read_blind_manifest(path); });
  return taken + attempt([&] { read_blind_answers(path); });
}

/// A line of the journal of answers comes back as it was written.
void read_line(const std::string& line) {
  const std::string once = line_of(blind_answer_of(line, "answers.partial"));
  require(line_of(blind_answer_of(once, "answers.partial")) == once, "another answer: " + once);
}

}  // namespace

int read_result(std::string_view bytes) {
  static const Report report;
  report.file.fill(bytes);
  if (bytes.starts_with('{')) return read_json(report) + attempt([&] { read_line(std::string(bytes)); });
  const int taken = attempt([&] {
    internal::results::TraceSet set;
    internal::results::read_trace(report.file.path(), set);
  });
  return taken + attempt([&] {
           BoundMap map;
           map.bounds = {1.0, 2.0};
           internal::results::read_bound_map(report.file.path(), map);
         });
}

}  // namespace gapscope::testing

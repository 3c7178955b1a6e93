// Rows that are not what they seem: drives of the independent plant as they were recorded, every second row,
// every row twice, x1 held over two rows, and a line between the rows, through check, run and diagnose.
//   study_rows FIRST LAST FOLDER [run|diagnose] [recorded|second|twice|held|line]
// e.g. study_rows 5101 5140 rows run; study_rows 5101 5140 rows diagnose second
// Prints for each how many check finds filled, how many numbers are told, how many with good trust, and how
// many of these miss the gap. Recordings stay in FOLDER; without a command check alone is asked.
#include <fmt/format.h>

#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "blind/random_drives.h"
#include "gapscope/inspection/inspection.h"
#include "gapscope/recording/recording_file.h"
#include "results/drive_card.h"
#include "run/changed_rows.h"
#include "run/run_diagnosis.h"

namespace gapscope {
namespace {

struct Kind {
  const char* name;
  std::function<Recording(const Recording&)> change;
  int filled = 0, told = 0, good = 0, missed = 0;
};

bool is_filled(const std::string& file) {
  for (const Finding& f : inspect(file).findings)
    if (f.rule == "fresh samples" && f.severity == Severity::kSpoils) return true;
  return false;
}

Answer answer_to(const Configuration& c, const std::string& command) {
  if (command == "run")
    return *run_pipeline(
                c, {true, true}, [](const std::string&) {}, 0)
                .result.answer;
  DiagnosisResult result = run_diagnosis(c, {}).result;
  add_card(result);
  return *result.answer;
}

/// The gap of each drive, of which truth.csv has a row; the third field.
std::vector<double> true_gaps(const std::string& folder) {
  std::vector<double> gaps;
  std::FILE* file = std::fopen((folder + "/truth.csv").c_str(), "r");
  char line[2000];
  for (double gap = 0.0; file != nullptr && std::fgets(line, sizeof line, file) != nullptr;)
    if (std::sscanf(line, "%*[^,],%*[^,],%lf", &gap) == 1) gaps.push_back(gap);
  if (file != nullptr) std::fclose(file);
  return gaps;
}

void count(const std::string& folder, const std::string& drive, double gap, const std::string& command,
           Kind& kind) {
  Configuration c = load_configuration(folder + "/" + drive + ".yaml");
  const std::string file = fmt::format("{}/{}_{}.csv", folder, drive, kind.name);
  write_csv(file, kind.change(read_recording(folder + "/" + drive + ".csv")));
  kind.filled += is_filled(file);
  if (command.empty()) return;
  c.recording->files.front().path = c.recording->files.front().given = file;
  const Answer a = answer_to(c, command);
  if (std::isnan(a.gap)) return;
  const bool misses = a.ci95.low > gap || a.ci95.high < gap;
  ++kind.told, kind.good += a.trust == AnswerTrust::kGood,
      kind.missed += misses && a.trust == AnswerTrust::kGood;
  fmt::print("{} {} {:.6g} [{:.6g}, {:.6g}] of {:.6g} mrad, {}\n", drive, kind.name, 1e3 * a.gap,
             1e3 * a.ci95.low, 1e3 * a.ci95.high, 1e3 * gap, to_string(a.trust));
  std::fflush(stdout);
}

int study(std::uint64_t first, std::uint64_t last, const std::string& folder, const std::string& command,
          const std::string& only) {
  std::vector<Kind> kinds = {{"recorded", [](const Recording& r) { return r; }},
                             {"second", [](const Recording& r) { return every_second(r); }},
                             {"twice", [](const Recording& r) { return twice(r, false); }},
                             {"held", [](const Recording& r) { return held(r, 2); }},
                             {"line", [](const Recording& r) { return twice(r, true); }}};
  if (!only.empty()) std::erase_if(kinds, [&](const Kind& k) { return k.name != only; });
  write_random_drives(RandomDriveKind::kGap, first, last, folder, {});
  const std::vector<double> gaps = true_gaps(folder);
  for (std::uint64_t seed = first; seed <= last; ++seed)
    for (Kind& kind : kinds) count(folder, fmt::format("gap_{}", seed), gaps.at(seed - first), command, kind);
  for (const Kind& k : kinds)
    fmt::print("{:<9} filled {:3}, told {:3}, good {:3}, of these missed {:3}\n", k.name, k.filled, k.told,
               k.good, k.missed);
  return 0;
}

}  // namespace
}  // namespace gapscope

int main(int argc, char** argv) {
  if (argc < 4) return std::fprintf(stderr, "study_rows FIRST LAST FOLDER [run|diagnose] [KIND]\n"), 2;
  return gapscope::study(std::stoull(argv[1]), std::stoull(argv[2]), argv[3], argc > 4 ? argv[4] : "",
                         argc > 5 ? argv[5] : "");
}

#pragma once

#include <string>
#include <vector>

#include "results/diagnosis_result.h"
#include "run/run_pipeline.h"

namespace gapscope::cli {

/// "1:05", "2:01:05": minutes or hours, minutes and seconds.
std::string stopwatch(double seconds);

/// Progress on standard error: the time since this call, and what is done. On a terminal each step, elsewhere
/// (a log, a script) the present one twice a minute.
Progress progress_on_terminal(bool quiet);

/// One line of an answer on standard output.
void say(const char* what, const std::string& text);

void print_warnings(const std::vector<std::string>& warnings);

/// What stands for CONFIG in a command that is told, so that it does what this one did: each as a shell takes
/// it, with a space before; empty where there is none.
struct ToldConfiguration {
  std::string file;           ///< as it was given
  std::string settings = "";  ///< " --set KEY=VALUE ..."
  std::string model = "";     ///< " --model-from FILE"
  std::string folder = "";    ///< " -o DIR"
  /// What `gapscope init` is given where the configuration has no model; else empty.
  std::string to_begin = "";
};

/// The headline of a run on standard output: the report, both estimates with intervals, and how they compare.
void print_headline(const std::string& folder, const RunResult& result,
                    const ToldConfiguration& configuration);

/// The answer of a diagnosis on standard output: the report, the verdict, the sentence and the place.
void print_diagnosis(const std::string& folder, const DiagnosisResult& result,
                     const ToldConfiguration& configuration);

}  // namespace gapscope::cli

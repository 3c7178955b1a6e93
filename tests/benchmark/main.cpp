#include <benchmark/benchmark.h>

#include <vector>

namespace {

/// Minimum, median and complexity only: on a shared machine the mean says little.
class Reporter final : public benchmark::ConsoleReporter {
 public:
  using ConsoleReporter::ConsoleReporter;
  void ReportRuns(const std::vector<Run>& runs) override {
    std::vector<Run> kept;
    for (const Run& run : runs)
      if (run.error_occurred || run.report_big_o || run.report_rms || run.aggregate_name == "min" ||
          run.aggregate_name == "median")
        kept.push_back(run);
    if (!kept.empty()) ConsoleReporter::ReportRuns(kept);
  }
};

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  Reporter reporter(benchmark::ConsoleReporter::OO_Tabular);
  benchmark::RunSpecifiedBenchmarks(&reporter);
  benchmark::Shutdown();
}

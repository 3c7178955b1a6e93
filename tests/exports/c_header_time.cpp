// How long a step of the exported C header takes against one of the simulator, on one core:
//   ninja -C build c_header_time && build/bin/c_header_time CONFIG.yaml...
// Each is run over the configuration's input, the fastest of twenty runs counts; the C compiler is `cc -O2`.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>

#include "exports/export.h"
#include "gapscope/simulation/excitation.h"
#include "gapscope/simulation/stepper.h"
#include "support/temporary_file.h"

namespace {

using namespace gapscope;

constexpr int kRuns = 20;

constexpr const char* kTimed = R"(#include <stdio.h>
#include <stdlib.h>
#include <time.h>
#include "drive.h"
int main(void) {
  static double u[2000000];
  int count = 0, run, i;
  double best = 1e9, sum = 0.0;
  while (count < 2000000 && scanf("%lf", &u[count]) == 1) ++count;
  for (run = 0; run < RUNS; ++run) {
    STEM_state drive;
    clock_t begin = clock();
    double took;
    STEM_start(&drive);
    for (i = 0; i < count; ++i) sum += STEM_step(&drive, u[i]);
    took = (double)(clock() - begin) / CLOCKS_PER_SEC;
    if (took < best) best = took;
  }
  fprintf(stderr, "%g\n", sum);
  printf("%.9g\n", 1e9 * best / count);
  return 0;
}
)";

/// [ns] a step
double header_time(const ExportedFile& header, const std::vector<double>& u) {
  const testing::TemporaryFile place("", "mark");
  const std::string folder = place.folder().string();
  std::string program = kTimed;
  for (auto at = program.find("STEM"); at != program.npos; at = program.find("STEM"))
    program.replace(at, 4, header.name.substr(0, header.name.find('.')));
  program.replace(program.find("RUNS"), 4, std::to_string(kRuns));
  std::ofstream(folder + "/drive.h") << header.text;
  std::ofstream(folder + "/main.c") << program;
  {
    std::ofstream input(folder + "/u");
    for (const double value : u) input << fmt::format("{:.17g}\n", value);
  }
  const std::string run = "cd " + folder + " && cc -std=c99 -O2 main.c -o main -lm && ./main <u >ns 2>sum";
  if (std::system(run.c_str()) != 0) return 0.0;
  double time = 0.0;
  std::ifstream(folder + "/ns") >> time;
  return time;
}

double simulator_time(const SimulationConfig& s, const std::vector<double>& u, double& sum) {
  double best = 1e9;
  for (int run = 0; run < kRuns; ++run) {
    DriveStepper<double> stepper(s.plant.plant_model(), 1.0 / s.rate);
    stepper.reset({s.initial.x1, s.initial.w1, s.initial.x2, s.initial.w2});
    const auto begin = std::chrono::steady_clock::now();
    for (const double input : u) stepper.step(input), sum += stepper.state().x1;
    best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
  }
  return 1e9 * best / static_cast<double>(u.size());
}

}  // namespace

int main(int argc, char** argv) {
  double sum = 0.0;
  for (int i = 1; i < argc; ++i) {
    const Configuration c = load_configuration(argv[i]);
    const SimulationConfig& s = *c.simulation;
    const std::vector<double> u = sample(s.excitation, s.rate, s.samples(), s.seed);
    const double ours = simulator_time(s, u, sum);
    const double theirs = header_time(export_drive(c, ExportFormat::kC).files[0], u);
    fmt::print("{:<40} simulator {:6.0f} ns, header {:6.0f} ns a step, ratio {:.2f}\n", argv[i], ours, theirs,
               theirs / ours);
  }
  return sum == 0.5 ? 1 : 0;
}

// `simulate`: a recording as CSV from the `simulation:` block.
#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "base/interrupt.h"
#include "cli/commands.h"
#include "cli/console.h"
#include "cli/field_help.h"
#include "gapscope/base/errors.h"
#include "gapscope/recording/recording_file.h"
#include "run/run_pipeline.h"

namespace gapscope::cli {
namespace {

namespace fs = std::filesystem;

struct SimulateArguments {
  ConfigArguments config;
  std::string file;
  bool quiet = false;
};

void simulate_to_file(const SimulateArguments& a, const Configuration& c) {
  if (!c.simulation)
    throw ConfigError(c.file, "there is no simulation, expected simulation: to make data from");
  require_file_name(a.file, source_paths(c), is_made_by_simulate);
  const Progress progress = progress_on_terminal(a.quiet);
  progress("simulating " + c.name);
  const Recording r = simulated_recording(c);
  stop_point();
  write_csv(a.file, r, require_file_name(a.file, source_paths(c), is_made_by_simulate));
  if (fs::is_regular_file(a.file) && !a.file.starts_with("/dev/"))  // which may be standard output itself
    fmt::print("{}: {} samples at {} Hz\n", a.file, r.size(), c.simulation->rate);
}

std::string excitation_help() {
  std::string text = "Excitations (simulation: excitation), one of:\n";
  for (const auto& spec : excitation_kinds()) {
    Excitation excitation;
    excitation.kind = spec.kind;
    text += fmt::format("  {}: {}\n{}", spec.name, spec.doc, field_help(excitation, "    "));
  }
  return text;
}

std::string details() {
  InitialState initial;
  return "Writes t [s], u [unit of u], x1 [rad], x2 [rad] (where there is a load) and mode: gap, engagement+,\n"
         "engagement-, impact; of a drive of one body one_body.\n"
         "The torque on the motor is torque_constant x u.\n\n"
         "Keys of simulation:\n"
         "  rate [Hz], duration [s]   rate x duration from 50 to 2e7 samples\n"
         "  seed                      whole number, the only source of randomness (default 1)\n"
         "  excitation                see below\n"
         "  initial                   state at the first sample, optional\n"
         "  noise [rad]               rms, before quantisation (default 0)\n"
         "  plant                     simulator (default), the one that is fitted, or independent:\n"
         "                            code that shares nothing with the estimators; it has no effects here\n"
         "  model                     the true plant where it differs from model, optional\n\n" +
         excitation_help() + "\nInitial state (simulation: initial):\n" + field_help(initial, "    ") +
         "\nExample: gapscope simulate configs/02_experiment.yaml -o experiment.csv";
}

}  // namespace

void add_simulate(CommandLine& app) {
  auto arguments = std::make_shared<SimulateArguments>();
  CommandLine command = app.add_command("simulate", "A simulated recording as CSV");
  add_config_arguments(command, arguments->config);
  command.add_option("-o,--output", arguments->file, "recording to write (CSV)").required().value("FILE");
  command.add_flag("--quiet", arguments->quiet, "no progress");
  command.footer(details());
  command.action([arguments] {
    with_simulated_drive(arguments->config, [&](const Configuration& c) { simulate_to_file(*arguments, c); });
  });
}

}  // namespace gapscope::cli

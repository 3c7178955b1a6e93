// gapscope: one command line for both estimators, their comparison, simulated recordings and reports.
// Exit status: 0 done, 1 the work failed, 2 the input or the command line is wrong, 3 a check found what
// spoils the estimates, 130 interrupted.
#include <fmt/format.h>

#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>
#include <string>

#include "base/shown.h"
#include "cli/commands.h"
#include "cli/interrupts.h"
#include "gapscope/base/errors.h"
#include "gapscope/base/version.h"
#include "results/report_folder.h"

namespace gapscope::cli {
namespace {

constexpr int kFailed = 1, kWrongInput = 2;

void add_commands(CommandLine& program) {
  program.heading_of_commands("Your drive");
  add_check(program);
  add_init(program);
  add_run(program);
  add_detect(program);
  add_fit(program);
  add_diagnose(program);
  add_compare(program);
  add_simulate(program);
  add_drive_export(program);
  add_report(program);
  program.heading_of_commands("Many runs");
  add_campaign(program);
  program.heading_of_commands("Is it to be believed");
  add_blind(program);
  program.heading_of_commands("To look up");
  add_effects(program);
  add_schema(program);
  add_completion(program);
  add_man(program);
}

int parse_and_run(int argc, char** argv) {
  const Program program{
      "gapscope", "Backlash gap and sim-to-real gap of a drive with a single motor encoder",
      std::string("gapscope ") + version(),
      "Angles are in rad, torques in N m, times in s, unless a key or a message says otherwise.\n"
      "gapscope COMMAND --help says more.\n"
      "Exit status: 0 done, whatever the answer; 1 the work failed; 2 the input or the command line is\n"
      "wrong; 3 check found what would spoil the estimates; 130 interrupted, what was complete is kept.\n\n"
      "Example: gapscope run configs/02_experiment.yaml",
      add_commands};
  return parse_and_run(program, argc, argv, kWrongInput);
}

/// On one line, whatever a file or a name brought into it.
void tell(const std::string& message) {
  std::fputs((printable(in_its_folder(message), 4000) + "\n").c_str(), stderr);  // which may be closed
}

int guarded(int argc, char** argv) {
  try {
    const int status = parse_and_run(argc, argv);
    if (std::fflush(stdout) != 0) throw std::runtime_error("standard output cannot be written");
    return status;
  } catch (const ConfigError& error) {
    tell(error.what());
    return kWrongInput;
  } catch (const Interrupted&) {
    interrupt_is_answered();
    tell("gapscope: interrupted");
    return kInterrupted;
  } catch (const std::bad_alloc&) {
    tell("gapscope: there is not enough memory, expected fewer samples or threads");
    return kFailed;
  } catch (const std::filesystem::filesystem_error& error) {
    const std::string path = error.path1().string();
    tell(fmt::format("{}: {}", path.empty() ? "gapscope" : path, error.code().message()));
    return kFailed;
  } catch (const std::exception& error) {
    tell(fmt::format("gapscope: {}", error.what()));
    return kFailed;
  }
}

}  // namespace
}  // namespace gapscope::cli

int main(int argc, char** argv) {
  gapscope::cli::answer_interrupts();
  std::signal(SIGCHLD, SIG_DFL);  // who started this may not care how its processes end
  std::signal(SIGXFSZ, SIG_IGN);  // a file beyond the limit is a write that fails, and says so
  return gapscope::cli::guarded(argc, argv);
}

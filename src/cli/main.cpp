// gapscope: one command line for both estimators, their comparison, simulated recordings and reports.
// Exit status: 0 done, 1 the work failed, 2 the input or the command line is wrong, 3 a check found what
// spoils the estimates, 130 interrupted.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>
#include <string>

#include "cli/command_tree.h"
#include "cli/commands.h"
#include "gapscope/base/errors.h"
#include "gapscope/base/interrupt.h"
#include "gapscope/base/shown.h"
#include "gapscope/base/version.h"
#include "gapscope/results/report_folder.h"

namespace gapscope::cli {
namespace {

constexpr int kDone = 0, kFailed = 1, kWrongInput = 2, kInterrupted = 130;

/// The first Ctrl-C asks, the second one does not wait for the answer.
extern "C" void on_interrupt(int) {
  if (stop_requested()) _exit(kInterrupted);
  request_stop();
}

void add_commands(CLI::App& app) {
  app.description("Backlash gap and sim-to-real gap of a drive with a single motor encoder");
  app.set_version_flag("--version", std::string("gapscope ") + version());
  app.require_subcommand(1);
  app.footer(
      "Angles are in rad, torques in N m, times in s, unless a key or a message says otherwise.\n"
      "gapscope COMMAND --help tells more.\n"
      "Exit status: 0 done, whatever the answer; 1 the work failed; 2 the input or the command line is\n"
      "wrong; 3 check found what would spoil the estimates; 130 interrupted, what was complete is kept.\n\n"
      "Example: gapscope run configs/02_experiment.yaml");
  add_check(app);
  add_init(app);
  add_run(app);
  add_detect(app);
  add_fit(app);
  add_diagnose(app);
  add_compare(app);
  add_simulate(app);
  add_report(app);
  add_effects(app);
  add_schema(app);
  add_campaign(app);
  add_blind(app);
  add_completion(app);
  add_man(app);
}

std::string command_names(const CLI::App& app) {
  std::string names;
  for (const CLI::App* command : app.get_subcommands(nullptr))
    names += (names.empty() ? "" : ", ") + command->get_name();
  return names;
}

/// "gapscope run CONFIG [-o DIR] [--quiet]" of the command that was being read, else the names of all.
std::string expectation(const CLI::App& app) {
  const CLI::App* used = &app;
  while (!used->get_subcommands().empty()) used = used->get_subcommands()[0];
  return used == &app ? "one of the commands " + command_names(app) : usage(describe(*used));
}

bool is_unknown_command(const CLI::App& app, const std::string& word) {
  if (!word.empty() && word[0] == '-') return false;
  const auto commands = app.get_subcommands(nullptr);
  return std::none_of(commands.begin(), commands.end(), [&](const auto* c) { return c->get_name() == word; });
}

std::string what_is_wrong(const CLI::App& app, const CLI::ParseError& error) {
  const bool no_command =
      app.get_subcommands().empty() && dynamic_cast<const CLI::RequiredError*>(&error) != nullptr;
  std::string what = no_command ? "there is no command" : error.what();
  std::replace(what.begin(), what.end(), '\n', ' ');
  return what;
}

int wrong_command_line(const CLI::App& app, const std::string& what) {
  fmt::print(stderr, "gapscope: {}, expected {}\n", what, expectation(app));
  return kWrongInput;
}

int parse_and_run(int argc, char** argv) {
  CLI::App app;
  app.name("gapscope");
  add_commands(app);
  if (argc > 1 && is_unknown_command(app, argv[1]))
    return wrong_command_line(app, fmt::format("there is no command '{}'", argv[1]));
  try {
    app.parse(argc, argv);  // the action of the command runs in here
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::RuntimeError& answer) {  // a command's own exit status
    return answer.get_exit_code();
  } catch (const CLI::ParseError& error) {
    return wrong_command_line(app, what_is_wrong(app, error));
  }
  return kDone;
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
  std::signal(SIGINT, gapscope::cli::on_interrupt);
  std::signal(SIGTERM, gapscope::cli::on_interrupt);
  if (std::signal(SIGHUP, gapscope::cli::on_interrupt) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);  // nohup
  std::signal(SIGCHLD, SIG_DFL);  // who started this may not care how its processes end
  std::signal(SIGXFSZ, SIG_IGN);  // a file beyond the limit is a write that fails, and says so
  return gapscope::cli::guarded(argc, argv);
}

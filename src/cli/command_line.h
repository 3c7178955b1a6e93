#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace gapscope::cli {

/// An option or a positional argument that a command has just been given. Each call refines it.
class Option {
 public:
  explicit Option(CLI::Option* option) : option_(option) {}

  Option& required(bool yes = true);
  Option& value(const char* name);       ///< what stands for its value in the help: "DIR"
  Option& values(int fewest);            ///< so many or more
  Option& values(int fewest, int most);  ///< how many it takes at once
  Option& one_value_each();              ///< repeated to give several
  Option& one_of(const std::vector<std::string>& words);
  Option& within(int low, int high);
  Option& within(double low, double high);  ///< which no NaN is
  /// @param what_is_wrong  with a text that was given; empty where nothing is
  Option& accepts(const std::function<std::string(const std::string& text)>& what_is_wrong);
  Option& needs(const Option& other);
  Option& excludes(const Option& other);

  bool given() const;  ///< within an action: whether the command line has it

 private:
  CLI::Option* option_;
};

/// A command while it is told what it is called with: the one door to the library that reads command lines,
/// which costs seconds wherever it is included.
class CommandLine {
 public:
  explicit CommandLine(CLI::App& app) : app_(&app) {}

  /// In the help, over the commands, or the options, that are added from here on.
  void heading_of_commands(const char* heading) { heading_ = heading; }
  void heading_of_options(const char* heading);

  CommandLine add_command(const char* name, const char* doc);

  /// @param names  "-o,--output", or "CONFIG" for a positional argument
  /// @param value  where what is given is put, and what holds where it is not; must outlive the command
  Option add_option(const char* names, std::string& value, const char* doc);
  Option add_option(const char* names, int& value, const char* doc);
  Option add_option(const char* names, double& value, const char* doc);
  Option add_option(const char* names, std::vector<std::string>& values, const char* doc);
  Option add_option(const char* names, std::vector<double>& values, const char* doc);
  Option add_flag(const char* names, bool& value, const char* doc);
  Option option(const char* name);  ///< that was added before

  void footer(const std::string& text);
  void action(const std::function<void()>& what);
  void needs_command();     ///< does nothing without one of its own commands
  void may_have_command();  ///< at most one of its own commands
  /// Within an action: the options that the command line has, as a shell takes them: "--input-unit 'N m'".
  /// @param without  names of options that are left out; positional arguments are, always
  std::string given_options(const std::vector<std::string>& without) const;
  bool has_command() const;  ///< within an action: whether one of its own commands is called

  const CLI::App& app() const { return *app_; }

 private:
  CLI::App* app_;
  std::string heading_;
};

inline constexpr int kInterruptedWithReport = 130;  ///< as of any command that was interrupted

/// Thrown by an action that answers with an exit status of its own.
struct ExitStatus {
  int status;
};

/// Thrown by an action, which the command line has not told enough for.
[[noreturn]] void throw_missing(const char* name);

/// A number as configurations write it, too: decimal, nothing before or after it.
std::optional<double> decimal(const std::string& text);

/// What the program is, and its commands.
struct Program {
  const char* name;
  const char* doc;
  std::string version, footer;
  void (*add_commands)(CommandLine& program);
};

/// Reads the command line and runs the action of its command.
/// @returns exit status: 0 done or help printed, `wrong_input` after telling what was expected, or a
/// command's own
int parse_and_run(const Program& program, int argc, char** argv, int wrong_input);

}  // namespace gapscope::cli

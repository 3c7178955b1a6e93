#pragma once

#include <string>
#include <vector>

#include "cli/command_line.h"

namespace gapscope::cli {

/// An option or a positional argument, as the help of its command has it.
struct Argument {
  std::vector<std::string> names;    ///< "-o", "--output"; empty for a positional one
  std::string value;                 ///< "DIR"; empty for a flag
  std::string limits;                ///< of a number, in words; empty if there are none
  std::vector<std::string> choices;  ///< where the value is one of a few words
  std::string doc;
  bool required = false;
  bool repeated = false;  ///< positional: one or more of them
};

/// A command with what its help says, and the commands below it.
struct Command {
  std::string name;  ///< as one types it: "gapscope campaign merge"
  std::string doc, footer;
  std::vector<Argument> arguments;
  std::vector<Command> commands;
  bool needs_command = false;  ///< does nothing without one of `commands`
};

/// What there is to know of a command line: the one source of usages, the manual and the completions.
Command command_of(const CommandLine& line);

/// "gapscope run CONFIG [-o DIR] [--quiet]": without --help.
std::string usage(const Command& command);

}  // namespace gapscope::cli

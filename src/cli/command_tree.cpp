#include "cli/command_tree.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <sstream>

namespace gapscope::cli {
namespace {

std::string full_name(const CLI::App& app) {
  return app.get_parent() == nullptr ? app.get_name() : full_name(*app.get_parent()) + " " + app.get_name();
}

/// The type of an option reads "DIR", "RATE:FLOAT in [1 - 9]" or "TEXT:{gap,gap_free}".
void read_type(const std::string& type, Argument& argument) {
  const std::size_t colon = type.find(':');
  argument.value = type.substr(0, colon);
  if (colon == type.npos) return;
  argument.limits = type.substr(colon + 1);
  if (argument.limits[0] != '{') return;
  std::istringstream words(argument.limits.substr(1, argument.limits.size() - 2));
  for (std::string word; std::getline(words, word, ',');) argument.choices.push_back(word);
  argument.value = fmt::format("{}", fmt::join(argument.choices, "|"));
  argument.limits.clear();
}

Argument command_of(const CLI::Option& option) {
  Argument argument;
  for (const std::string& name : option.get_snames()) argument.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) argument.names.push_back("--" + name);
  if (option.get_items_expected_max() > 0) read_type(option.get_type_name(), argument);
  if (option.get_positional() && argument.choices.empty()) argument.value = option.get_name(true);
  argument.doc = option.get_description();
  argument.required = option.get_required();
  argument.repeated = option.get_positional() && option.get_expected_max() > 1;
  return argument;
}

std::string usage(const Argument& a) {
  std::string text = a.names.empty() ? "" : a.names[0];
  if (!a.value.empty()) text += (text.empty() ? "" : " ") + a.value + (a.repeated ? "..." : "");
  return a.required ? text : "[" + text + "]";
}

Command describe_app(const CLI::App& app) {
  Command command{
      full_name(app), app.get_description(), app.get_footer(), {}, {}, app.get_require_subcommand_min() > 0};
  for (const bool positional : {true, false})
    for (const CLI::Option* option : app.get_options())
      if (option->get_positional() == positional) command.arguments.push_back(command_of(*option));
  for (const CLI::App* below : app.get_subcommands(nullptr)) command.commands.push_back(describe_app(*below));
  return command;
}

}  // namespace

Command command_of(const CommandLine& line) { return describe_app(line.app()); }

std::string usage(const Command& command) {
  std::string text = command.name;
  for (const Argument& a : command.arguments)
    if (a.names.empty() || a.names.back() != "--help") text += " " + usage(a);
  if (!command.commands.empty()) text += command.needs_command ? " COMMAND ..." : " [COMMAND ...]";
  return text;
}

}  // namespace gapscope::cli

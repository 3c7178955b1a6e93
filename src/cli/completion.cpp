// `completion`: what a shell needs to complete a command line of gapscope.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <memory>

#include "cli/command_tree.h"
#include "cli/commands.h"

namespace gapscope::cli {
namespace {

// A script has three parts. The first and the last are a shell's own, the one between them is understood by
// both: from what was typed before it finds the command, what that offers in this place, and of which kind
// files are. It keeps clear of the names that zsh has for itself: options, commands, path, words.

constexpr const char* kBashBegins = R"(# Completion for bash, written by `gapscope completion bash`.
_gapscope() {
  local typed=("${COMP_WORDS[@]:1:COMP_CWORD-1}") word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]}
)";
constexpr const char* kBashEnds = R"(  COMPREPLY=()
  case $kind in
    file) mapfile -t COMPREPLY < <(compgen -f -- "$word") ;;
    folder) mapfile -t COMPREPLY < <(compgen -d -- "$word") ;;
    configuration) mapfile -t COMPREPLY < <(compgen -d -- "$word"; compgen -f -X '!*.yaml' -- "$word") ;;
    effect) offered=$("${COMP_WORDS[0]}" effects 2>/dev/null) ;;
  esac
  [[ ${#COMPREPLY[@]} -eq 0 ]] || compopt -o filenames 2>/dev/null
  mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(compgen -W "$offered" -- "$word")
}
complete -F _gapscope gapscope
)";

constexpr const char* kZshBegins = R"(#compdef gapscope
# Completion for zsh, written by `gapscope completion zsh`.
_gapscope() {
  local typed=("${(@)words[2,CURRENT-1]}") word=${words[CURRENT]} before=${words[CURRENT-1]}
)";
constexpr const char* kZshEnds = R"(  case $kind in
    file) _files ;;
    folder) _files -/ ;;
    configuration) _files -g '*.yaml' ;;
    effect) offered=$(${words[1]} effects 2>/dev/null) ;;
  esac
  compadd -- ${=offered}
}
compdef _gapscope gapscope
[[ ${funcstack[1]} != _gapscope ]] || _gapscope  # loaded by the shell on its first use, not by source
)";

/// What the shell offers in place of a value: by its name, as the help has it.
std::string kind_of(const Argument& a) {
  static const std::map<std::string, std::string> kinds = {
      {"ANSWERS", "file"}, {"CASES", "folder"},  {"CONFIG", "configuration"},
      {"DIR", "folder"},   {"EFFECT", "effect"}, {"FILE", "file"},
      {"LABELS", "file"},  {"MODEL", "file"},    {"SOURCE", "file"}};
  const auto known = kinds.find(a.value);
  return known == kinds.end() ? "" : known->second;
}

/// "/campaign/merge" of "gapscope campaign merge", empty of "gapscope".
std::string path_of(const Command& command) {
  std::string path = command.name.substr(std::min(command.name.find(' '), command.name.size()));
  std::replace(path.begin(), path.end(), ' ', '/');
  return path;
}

/// What can be told of each command: that it is one; what it offers; what its options take.
struct Cases {
  std::vector<std::string> paths, places;
  std::map<std::string, std::vector<std::string>> values;  ///< of all options that take the same

  explicit Cases(const Command& command) { add(command); }

  void add(const Command& command) {
    const std::string path = path_of(command);
    if (!path.empty()) paths.push_back(path);
    std::vector<std::string> options, offered;
    std::string kind;
    for (const Argument& a : command.arguments) {
      options.insert(options.end(), a.names.begin(), a.names.end());
      if (!a.names.empty() && !a.value.empty()) add_value(path, a);
      if (!a.names.empty()) continue;
      offered.insert(offered.end(), a.choices.begin(), a.choices.end());
      kind = kind.empty() || kind == kind_of(a) ? kind_of(a) : "file";
    }
    for (const Command& c : command.commands) offered.push_back(c.name.substr(c.name.rfind(' ') + 1));
    places.push_back(fmt::format("'{}') flags='{}' offered='{}' kind='{}' ;;", path, fmt::join(options, " "),
                                 fmt::join(offered, " "), kind));
    for (const Command& c : command.commands) add(c);
  }

  void add_value(const std::string& path, const Argument& a) {
    auto& alike = values[fmt::format("offered='{}' kind='{}'", fmt::join(a.choices, " "), kind_of(a))];
    for (const std::string& name : a.names) alike.push_back(fmt::format("'{} {}'", path, name));
  }
};

std::string both_shells(const Command& command) {
  const Cases cases(command);
  std::string values;
  for (const auto& [taken, options] : cases.values)
    values += fmt::format("    {}) {} ;;\n", fmt::join(options, "|"), taken);
  return fmt::format(R"(  local command='' flags='' offered='' kind='' part
  for part in "${{typed[@]}}"; do
    case "$command/$part" in
      {}) command+=/$part ;;
    esac
  done
  case "$command" in
    {}
  esac
  case "$command $before" in
{}    *) [[ $word != -* ]] || {{ offered=$flags kind=''; }} ;;
  esac
)",
                     fmt::join(cases.paths, "|"), fmt::join(cases.places, "\n    "), values);
}

std::string completion(const Command& command, const std::string& shell) {
  const bool bash = shell == "bash";
  return (bash ? kBashBegins : kZshBegins) + both_shells(command) + (bash ? kBashEnds : kZshEnds);
}

}  // namespace

void add_completion(CommandLine& app) {
  auto shell = std::make_shared<std::string>();
  CommandLine command = app.add_command("completion", "Completion of the command line for a shell");
  command.add_option("SHELL", *shell, "bash or zsh").required().one_of({"bash", "zsh"});
  command.footer(
      "The script on standard output; an installed gapscope has both where the shells look for them.\n\n"
      "Example: source <(gapscope completion bash)");
  command.action([&app, shell] { fmt::print("{}", completion(command_of(app), *shell)); });
}

}  // namespace gapscope::cli

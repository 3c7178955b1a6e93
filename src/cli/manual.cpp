// `man`: the manual page, from the help of every command.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>

#include "cli/command_tree.h"
#include "cli/commands.h"
#include "gapscope/base/version.h"

namespace gapscope::cli {
namespace {

/// What roff would not print as it stands: its own characters, and a dot that begins a line.
std::string roff(const std::string& text) {
  std::string out;
  bool line_begins = true;
  for (const char c : text) {
    if (line_begins && c == '.') out += "\\&";
    line_begins = c == '\n';
    switch (c) {
      case '\\':
        out += "\\(rs";
        break;
      case '-':
        out += "\\-";
        break;
      case '\'':
        out += "\\(aq";
        break;
      case '`':
        out += "\\(ga";
        break;
      case '"':
        out += "\\(dq";
        break;
      case '^':
        out += "\\(ha";
        break;
      case '~':
        out += "\\(ti";
        break;
      default:
        out += c;
    }
  }
  return out;
}

/// Lines that are not to be filled.
std::string as_it_stands(const std::string& text) {
  return text.empty() ? "" : ".nf\n" + roff(text) + "\n.fi\n";
}

std::string options(const Command& command) {
  std::string text;
  for (const Argument& a : command.arguments) {
    std::string names;
    for (const std::string& name : a.names)
      names += (names.empty() ? "" : ", ") + ("\\fB" + roff(name) + "\\fR");
    if (!a.value.empty()) names += (names.empty() ? "" : " ") + ("\\fI" + roff(a.value) + "\\fR");
    text += fmt::format(".TP\n{}\n{}{}\n", names, roff(a.doc),
                        a.limits.empty() ? "" : roff(" (" + a.limits + ")"));
  }
  return text;
}

/// A command, and after it those below it.
std::string sections(const Command& command) {
  std::string text = fmt::format(".SS {}\n{}\n.PP\n.B {}\n{}.PP\n{}", roff(command.name), roff(command.doc),
                                 roff(usage(command)), options(command), as_it_stands(command.footer));
  for (const Command& below : command.commands) text += sections(below);
  return text;
}

std::string manual(const Command& command) {
  std::string name = command.name, what = command.doc;
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::toupper(c); });
  std::string text = fmt::format(
      ".TH {} 1 \"\" \"{} {}\" \"User Commands\"\n.ad l\n.SH NAME\n{} \\- {}\n.SH SYNOPSIS\n.B {}\n"
      ".SH DESCRIPTION\n{}.SH OPTIONS\n{}.SH COMMANDS\n",
      name, command.name, version(), command.name, roff(what), roff(usage(command)),
      as_it_stands(command.footer), options(command));
  for (const Command& below : command.commands) text += sections(below);
  return text;
}

}  // namespace

void add_man(CommandLine& app) {
  CommandLine command = app.add_command("man", "The manual page on standard output");
  command.footer(
      "Everything that --help says, of every command, for man.\n\nExample: gapscope man | man -l -");
  command.action([&app] { fmt::print("{}", manual(command_of(app))); });
}

}  // namespace gapscope::cli

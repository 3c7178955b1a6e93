#include "cli/command_line.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>

#include "base/shell_word.h"
#include "base/text.h"
#include "cli/command_tree.h"

namespace gapscope::cli {
namespace {

/// Says on its own what is wrong; the help tells it in words of the option.
template <class Check>
CLI::Validator unnamed(const Check& check) {
  return CLI::Validator([check](std::string& text) -> std::string { return check(text); }, "");
}

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands(nullptr)) names.push_back(command->get_name());
  return names;
}

/// The whole of a short usage, what must be given of a long one.
std::string brief_usage(Command command) {
  constexpr std::size_t kFew = 8;
  if (command.arguments.size() <= kFew) return usage(command);
  std::erase_if(command.arguments, [](const Argument& a) { return !a.required; });
  return fmt::format("{} [OPTIONS]; `{} --help` lists them", usage(command), command.name);
}

/// "gapscope run CONFIG [-o DIR] [--quiet]" of the command that was being read, else the names of all.
std::string expectation(CLI::App& app) {
  CLI::App* used = &app;
  while (!used->get_subcommands().empty()) used = used->get_subcommands()[0];
  return used == &app ? fmt::format("one of the commands {}", fmt::join(command_names(app), ", "))
                      : brief_usage(command_of(CommandLine(*used)));
}

bool is_unknown_command(const CLI::App& app, const std::string& word) {
  if (!word.empty() && word[0] == '-') return false;
  return !contains(command_names(app), word);
}

std::string what_is_wrong(const CLI::App& app, const CLI::ParseError& error) {
  const bool no_command =
      app.get_subcommands().empty() && dynamic_cast<const CLI::RequiredError*>(&error) != nullptr;
  std::string what = no_command ? "there is no command" : error.what();
  std::replace(what.begin(), what.end(), '\n', ' ');
  const bool has_settings = !app.get_subcommands().empty() &&
                            app.get_subcommands().front()->get_option_no_throw("--set") != nullptr;
  if (has_settings && what.find("--held-out") != what.npos)
    what += " (the recording that is held out is the configuration's: --set recording.held_out=FILE)";
  return what;
}

void tell(CLI::App& app, const std::string& what) {
  fmt::print(stderr, "gapscope: {}, expected {}\n", what, expectation(app));
}

Option not_empty(Option option) {
  return option.accepts([](const std::string& text) { return std::string(text.empty() ? "is empty" : ""); });
}

/// A value as it follows its option.
std::string value_word(const std::string& value) {
  return value.size() > 1 && value[0] == '-' ? "-" + shell_word(value.substr(1)) : shell_word(value);
}

std::string option_words(const CLI::Option& option) {
  const std::string name =
      option.get_lnames().empty() ? "-" + option.get_snames().front() : "--" + option.get_lnames().front();
  if (option.get_items_expected_max() == 0) return name;
  const std::vector<std::string> values = option.results();
  if (values.size() == 1 && values[0].starts_with('-')) return name + "=" + value_word(values[0]);
  const bool one_each = !option.get_allow_extra_args() && option.get_expected_min() < 2;
  std::string text;
  for (const std::string& value : values) {
    if (text.empty() || one_each) text += (text.empty() ? "" : " ") + name;
    text += " " + value_word(value);
  }
  return text;
}

}  // namespace

Option& Option::required(bool yes) { return option_->required(yes), *this; }
Option& Option::value(const char* name) { return option_->type_name(name), *this; }
Option& Option::values(int fewest) {
  option_->expected(fewest, CLI::detail::expected_max_vector_size);
  return *this;
}
Option& Option::values(int fewest, int most) {
  option_->expected(fewest, most);
  if (fewest == most) option_->allow_extra_args(false);  // what follows is no value of it
  return *this;
}
Option& Option::one_value_each() { return option_->allow_extra_args(false), *this; }
Option& Option::needs(const Option& other) { return option_->needs(other.option_), *this; }
Option& Option::excludes(const Option& other) { return option_->excludes(other.option_), *this; }
bool Option::given() const { return option_->count() > 0; }

Option& Option::one_of(const std::vector<std::string>& words) {
  return option_->check(CLI::IsMember(words)), *this;
}

Option& Option::within(int low, int high) {
  return option_->check(CLI::Range(low, high).description("")), *this;
}

Option& Option::within(double low, double high) {
  return accepts([low, high](const std::string& text) {
    const std::optional<double> value = decimal(text);
    return value && *value >= low && *value <= high
               ? std::string()
               : fmt::format("expected a number from {:g} to {:g}", low, high);
  });
}

Option& Option::accepts(const std::function<std::string(const std::string& text)>& what_is_wrong) {
  return option_->check(unnamed(what_is_wrong)), *this;
}

std::optional<double> decimal(const std::string& text) {
  const char *begin = text.data(), *last = begin + text.size();
  if (begin != last && *begin == '+') ++begin;
  double value = 0.0;
  const auto [end, problem] = std::from_chars(begin, last, value);
  return problem == std::errc() && end == last ? std::optional(value) : std::nullopt;
}

CommandLine CommandLine::add_command(const char* name, const char* doc) {
  CLI::App* command = app_->add_subcommand(name, doc);
  if (!heading_.empty()) command->group(heading_);
  return CommandLine(*command);
}

void CommandLine::heading_of_options(const char* heading) { app_->option_defaults()->group(heading); }

Option CommandLine::add_option(const char* names, std::string& value, const char* doc) {
  return not_empty(Option(app_->add_option(names, value, doc)));
}
Option CommandLine::add_option(const char* names, int& value, const char* doc) {
  return Option(app_->add_option(names, value, doc));
}
Option CommandLine::add_option(const char* names, double& value, const char* doc) {
  return Option(app_->add_option(names, value, doc));
}
Option CommandLine::add_option(const char* names, std::vector<std::string>& values, const char* doc) {
  return not_empty(Option(app_->add_option(names, values, doc)));
}
Option CommandLine::add_option(const char* names, std::vector<double>& values, const char* doc) {
  return Option(app_->add_option(names, values, doc));
}
Option CommandLine::add_flag(const char* names, bool& value, const char* doc) {
  return Option(app_->add_flag(names, value, doc));
}
Option CommandLine::option(const char* name) { return Option(app_->get_option(name)); }

void CommandLine::footer(const std::string& text) { app_->footer(text); }
void CommandLine::action(const std::function<void()>& what) { app_->callback(what); }
void CommandLine::needs_command() { app_->require_subcommand(1); }
void CommandLine::may_have_command() { app_->require_subcommand(0, 1); }
std::string CommandLine::given_options(const std::vector<std::string>& without) const {
  std::string text;
  for (const CLI::Option* option : app_->get_options()) {
    const bool left_out = std::any_of(without.begin(), without.end(),
                                      [&](const std::string& name) { return option->check_name(name); });
    if (option->count() == 0 || option->get_positional() || left_out) continue;
    text += (text.empty() ? "" : " ") + option_words(*option);
  }
  return text;
}
bool CommandLine::has_command() const { return !app_->get_subcommands().empty(); }

void throw_missing(const char* name) { throw CLI::RequiredError(name); }

int parse_and_run(const Program& program, int argc, char** argv, int wrong_input) {
  CLI::App app;
  app.name(program.name);
  app.description(program.doc);
  app.set_version_flag("--version", program.version);
  app.require_subcommand(1);
  app.footer(program.footer);
  CommandLine line(app);
  program.add_commands(line);
  if (argc > 1 && is_unknown_command(app, argv[1]))
    return tell(app, fmt::format("there is no command '{}' (nearest: {})", argv[1],
                                 nearest_name(argv[1], command_names(app)))),
           wrong_input;
  try {
    app.parse(argc, argv);  // the action of the command runs in here
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const ExitStatus& answer) {
    return answer.status;
  } catch (const CLI::ParseError& error) {
    return tell(app, what_is_wrong(app, error)), wrong_input;
  }
  return 0;
}

}  // namespace gapscope::cli

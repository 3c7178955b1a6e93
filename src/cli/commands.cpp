#include "cli/commands.h"

#include <ostream>

namespace gapscope::cli {

void write_text(const std::string& path, const std::string& text, const Replaceable& found) {
  write_whole_file(
      path, [&](std::ostream& out) { out << text; }, found);
}

std::vector<Setting> ConfigArguments::settings() const {
  std::vector<Setting> all;
  for (const std::string& text : set) all.push_back(read_setting(text));
  return all;
}

void add_config_arguments(CommandLine& command, ConfigArguments& arguments, const char* name,
                          const char* what) {
  command.add_option(name, arguments.file, what).required();
  command
      .add_option("--set", arguments.set,
                  "a value in place of the configuration's, e.g. model.parameters.gap=0.02; may be repeated "
                  "(model.effects.NAME.KEY: of an effect)")
      .value("KEY=VALUE")
      .one_value_each();
}

void with_configuration(const ConfigArguments& arguments, const std::function<void(Configuration&)>& work) {
  const std::vector<Setting> settings = arguments.settings();
  telling_settings(settings, [&] {
    Configuration c = load_configuration(arguments.file, settings);
    work(c);
  });
}

void add_work_options(CommandLine& command, int& threads, bool& quiet) {
  command.add_option("-j,--threads", threads, "threads (default: all cores); the results do not depend on it")
      .within(1, 1024)
      .value("N");
  command.add_flag("--quiet", quiet, "no progress");
}

}  // namespace gapscope::cli

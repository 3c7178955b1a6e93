#include "cli/commands.h"

#include <fmt/format.h>

#include <filesystem>
#include <ostream>

#include "base/shell_word.h"
#include "base/text.h"
#include "cli/console.h"
#include "config/starter.h"

namespace gapscope::cli {

void write_text(const std::string& path, const std::string& text, const Replaceable& found) {
  write_whole_file(
      path, [&](std::ostream& out) { out << text; }, found);
}

std::vector<Setting> ConfigArguments::settings() const {
  std::vector<Setting> all;
  if (!model_from.empty()) all = gapscope::model_from(model_from);
  for (const std::string& text : set) all.push_back(read_setting(text));
  return all;
}

std::vector<Setting> ConfigArguments::simulated_settings() const {
  return over_both_models(file, settings());
}

ToldConfiguration ConfigArguments::told(const std::string& folder, const std::string& axis) const {
  ToldConfiguration told{file};
  for (const std::string& text : set) told.settings += " --set " + shell_word(text);
  if (!axis.empty()) told.settings += " --axis " + shell_word(axis);
  if (!model_from.empty()) told.model = " --model-from " + shell_word(model_from);
  if (!folder.empty()) told.folder = " -o " + shell_word(folder);
  return told;
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
  command
      .add_option("--model-from", arguments.model_from,
                  "another configuration whose model: (and anchor:) replaces this one's, e.g. the "
                  "fitted.yaml of a report; what this one estimates is estimated from there on")
      .value("FILE");
}

namespace {

/// What a configuration says of what is simulated, its plant written out.
std::string simulated_part(const Configuration& c) {
  const std::string all = resolved_yaml(c);
  const std::size_t from = all.find("\nsimulation:");
  if (from == std::string::npos) return "";
  std::size_t to = from + 1;
  do to = all.find('\n', to + 1);
  while (to + 1 < all.size() && all[to + 1] == ' ');
  return all.substr(from, to - from);
}

/// Warns of each `--set model...` that the simulated drive does not see: a fitted.yaml's sees them all.
void warn_of_idle_settings(const ConfigArguments& arguments, const Configuration& c) {
  const std::vector<Setting> settings = arguments.settings();
  if (!c.simulation || arguments.simulated_settings().size() > settings.size()) return;
  for (std::size_t i = 0; i < settings.size(); ++i) {
    if (!settings[i].key.starts_with("model.")) continue;
    std::vector<Setting> others = settings;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    if (simulated_part(load_configuration(arguments.file, others)) == simulated_part(c))
      print_warnings(
          {fmt::format("--set {0} changes nothing of what is simulated: where a configuration has "
                       "simulation: model, that is the drive; --set simulation.{0} changes it",
                       settings[i].key)});
  }
}

/// Whether a file is a recording, by its ending: none that configurations have. JSON may be either.
bool is_recording(const std::string& file) {
  const std::vector<std::string> of_configurations = {"", ".yaml", ".yml", ".json", ".conf", ".cfg"};
  return !contains(of_configurations, std::filesystem::path(file).extension().string());
}

/// A recording in place of a configuration: what `init` writes of it, told in two lines.
Configuration configuration_of(const std::string& recording, const std::vector<Setting>& settings) {
  RecordingArguments arguments;
  arguments.file = recording;
  const RecordingArguments one = arguments.each_axis().front();
  const std::filesystem::path as_written = std::filesystem::path(recording).replace_extension(".yaml");
  const std::string folder = as_written.parent_path().string();
  const Starter starter = starter_configuration(one.configuration(), one.encoder(), one.coordinates(),
                                                folder.empty() ? "." : folder, {});
  print_warnings(starter.spoiling);
  if (const std::string told = one.told_by_names(); !told.empty()) say("units", told);
  tell_assumed(starter.assumed, one.coordinates());
  say("model", starter.model + " (gapscope init " + shell_word(recording) + " writes it down)");
  return parse_configuration(starter.yaml, as_written.string(), settings);
}

void with_settings(const std::string& file, const std::vector<Setting>& settings,
                   const std::function<void(Configuration&)>& work) {
  telling_settings(settings, [&] {
    Configuration c =
        is_recording(file) ? configuration_of(file, settings) : load_configuration(file, settings);
    work(c);
  });
}

}  // namespace

void with_configuration(const ConfigArguments& arguments, const std::function<void(Configuration&)>& work) {
  with_settings(arguments.file, arguments.settings(), work);
}

void with_simulated_drive(const ConfigArguments& arguments, const std::function<void(Configuration&)>& work) {
  with_settings(arguments.file, arguments.simulated_settings(), [&](Configuration& c) {
    warn_of_idle_settings(arguments, c);
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

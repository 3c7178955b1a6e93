#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace gapscope {

/// A value that is laid over a configuration before it is read: `--set model.parameters.gap=0.02`.
struct Setting {
  std::string key;         ///< keys from the outermost on with dots between them; in a list the place, from 0
  std::string yaml;        ///< the value, as it would stand in the file: a number, a word, a list, a map
  std::string place = "";  ///< as messages name it; empty: "--set KEY"
  bool removed = false;    ///< the key is not to be there
  bool taken = false;      ///< of another configuration: what the own one estimates, it estimates from there
};

/// From "KEY=VALUE".  @throws ConfigError "gapscope: --set ..." for any other text
Setting read_setting(const std::string& text);

/// `model:` and `anchor:`, which goes where there is none, of another configuration, such as the
/// `fitted.yaml` of a report. What the configuration that they are laid over estimates is estimated from
/// their numbers on, and so are the effects that it does not have.
/// @throws ConfigError where the file is none, or has no model
std::vector<Setting> model_from(const std::string& file);

/// Of a configuration that has one drive twice, as a `fitted.yaml` has it (model: and simulation: model
/// alike), each setting of `model` is laid over both; of any other one they are as they were.
/// @throws ConfigError where the file is none
std::vector<Setting> over_both_models(const std::string& file, const std::vector<Setting>& settings);

/// Does the work, in which what is wrong with a setting is told of `--set KEY` in place of a file and line,
/// also where it shows long after the configuration was read.
void telling_settings(std::span<const Setting> settings, const std::function<void()>& work);

}  // namespace gapscope

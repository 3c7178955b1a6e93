// `effects`: the catalogue of unmodelled effects.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>

#include "base/shown.h"
#include "base/text.h"
#include "cli/commands.h"
#include "gapscope/base/errors.h"
#include "gapscope/plant/effect.h"

namespace gapscope::cli {
namespace {

/// Names, units and laws hold nothing that JSON would have to escape.
std::string quoted(const std::string& text) { return "\"" + text + "\""; }

bool is_last_resort(const EffectEntry& e) {
  const auto laws = last_resort_table();
  return std::find(laws.begin(), laws.end(), &e) != laws.end();
}

std::string json_of(const EffectEntry& e) {
  std::vector<std::string> parameters, look_alikes;
  for (const EffectParameterSpec& p : e.parameters)
    parameters.push_back(fmt::format("{{\"key\": {}, \"unit\": {}}}", quoted(p.key), quoted(p.unit)));
  for (const char* other : e.look_alikes) look_alikes.push_back(quoted(other));
  return fmt::format(
      "{{\"effect\": {}, \"side\": {}, \"law\": {}, \"parameters\": [{}], \"look_alikes\": [{}], "
      "\"last_resort\": {}}}",
      quoted(e.name), quoted(to_string(e.side)), quoted(e.law), fmt::join(parameters, ", "),
      fmt::join(look_alikes, ", "), is_last_resort(e));
}

/// The catalogue, then the laws of last resort.
std::vector<const EffectEntry*> listed() {
  std::vector<const EffectEntry*> all;
  for (const auto table : {effect_table(), last_resort_table()})
    all.insert(all.end(), table.begin(), table.end());
  return all;
}

void print_json() {
  std::vector<std::string> rows;
  for (const EffectEntry* e : listed()) rows.push_back("  " + json_of(*e));
  fmt::print("[\n{}\n]\n", fmt::join(rows, ",\n"));
}

std::string parameters_of(const EffectEntry& e) {
  std::vector<std::string> parameters;
  for (const EffectParameterSpec& p : e.parameters)
    parameters.push_back(fmt::format("{} [{}]", p.key, p.unit));
  if (e.period_at() >= 0) parameters.emplace_back("or period_rad [rad] in place of periods_per_turn");
  return fmt::format("{}", fmt::join(parameters, ", "));
}

void print_laws() {
  for (const EffectEntry* e : listed())
    fmt::print("{:<23} {:<8} {}\n{:<32} {}\n", e->name, to_string(e->side), e->law, "", parameters_of(*e));
}

/// One effect, and how it is written.
void print_one(const std::string& name) {
  const EffectEntry* e = find_effect(name);
  if (e == nullptr) {
    std::vector<std::string> names;
    for (const EffectEntry* other : listed()) names.emplace_back(other->name);
    throw ConfigError(
        fmt::format("gapscope: there is no effect {}, expected one of `gapscope effects`; the nearest is {}",
                    shown(name), nearest_name(name, names)));
  }
  std::vector<std::string> written;
  for (const EffectParameterSpec& p : e->parameters)
    written.push_back(fmt::format("{}: {{estimate: true}}", p.key));
  fmt::print("effect      {}\nacts on     {}\nlaw         {}\nparameters  {}\n", e->name, to_string(e->side),
             e->law, parameters_of(*e));
  if (!e->look_alikes.empty()) fmt::print("look-alikes {}\n", fmt::join(e->look_alikes, ", "));
  fmt::print("known       effects: [{{{}: {{{}: NUMBER{}}}}}]\nfitted      effects: [{{{}: {{{}}}}}]\n",
             e->name, e->parameters.front().key, e->parameters.size() > 1 ? ", ..." : "", e->name,
             fmt::join(written, ", "));
}

}  // namespace

void add_effects(CommandLine& app) {
  auto json = std::make_shared<bool>(false), laws = std::make_shared<bool>(false);
  auto name = std::make_shared<std::string>();
  CommandLine command = app.add_command("effects", "Lists the effects that a model or a simulation can have");
  const Option one =
      command.add_option("NAME", *name, "one of them, and how it is written (default: all names)");
  const Option as_json =
      command.add_flag("--json", *json, "with side, law, parameters and units, and look-alikes")
          .excludes(one);
  command
      .add_flag(
          "--laws", *laws,
          "each with what it acts on (command, motor, contact, load, sensor), its law and its parameters")
      .excludes(as_json)
      .excludes(one);
  command.footer(
      "One identifier a line. In a law x1, w1 are angle and speed of the motor, x2, w2 of the load, u is the input.\n"
      "The last three are laws of last resort, any function of speed, input or position: what `diagnose` lays\n"
      "over what no effect explains.\n"
      "In a configuration: effects: [{cogging_torque: {amplitude_nm: 0.004,\n"
      "periods_per_turn: 24}}], under model: (known effects) or simulation: model: (the true plant).\n"
      "periods_per_turn counts the turns of x1 (x2); it may be written as a length, period_rad [rad, m on a\n"
      "slide]. Unbalance and both eccentricities come once per turn of the load and of the encoder, as\n"
      "recording: gear_ratio: says; a slide has no turn, and they need period_rad, such as a screw's pitch.\n\n"
      "Example: gapscope effects cogging_torque");
  command.action([json, laws, name] {
    if (!name->empty()) return print_one(*name);
    if (*json) return print_json();
    if (*laws) return print_laws();
    for (const EffectEntry* e : listed()) fmt::print("{}\n", e->name);
  });
}

}  // namespace gapscope::cli

// `schema`: what the JSON of every command and the YAML of a configuration look like, for those who read and
// write them.
#include <fmt/format.h>

#include <memory>

#include "cli/commands.h"
#include "config/configuration_schema.h"
#include "gapscope/base/errors.h"
#include "results/json_schemas.h"

namespace gapscope::cli {
namespace {

std::vector<JsonSchema> all_schemas() {
  std::vector<JsonSchema> all = json_schemas();
  all.push_back({"configuration", configuration_schema()});
  return all;
}

void print_schema(const std::string& name) {
  std::string names;
  for (const JsonSchema& schema : all_schemas()) {
    if (schema.name == name) return fmt::print("{}", schema.text);
    names += schema.name + (name.empty() ? "\n" : ", ");
  }
  if (!name.empty())
    throw ConfigError("gapscope: there is no schema '" + name + "', expected one of " +
                      names.substr(0, names.size() - 2));
  fmt::print("{}", names);
}

}  // namespace

void add_schema(CommandLine& app) {
  auto name = std::make_shared<std::string>();
  CommandLine command =
      app.add_command("schema", "JSON schemas of what the commands write, and of a configuration");
  command.add_option("NAME", *name, "which one (default: lists the names)");
  command.footer(
      "configuration is that of the YAML which the commands read: editors complete and check it by it, with\n"
      "the first line `# yaml-language-server: $schema=FILE`.\n\n"
      "Every stored JSON says in its key schema what it is (gapscope.result/1); NAME is the word between.\n"
      "JSON Schema, draft 2020-12; each line of a stream is a document of its own. Keys carry their units.\n\n"
      "Example: gapscope schema result > result.schema.json");
  command.action([name] { print_schema(*name); });
}

}  // namespace gapscope::cli

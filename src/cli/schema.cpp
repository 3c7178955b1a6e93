// `schema`: what the JSON of every command looks like, for those who read it.
#include <fmt/format.h>

#include <memory>

#include "cli/commands.h"
#include "gapscope/base/errors.h"
#include "gapscope/results/json_schemas.h"

namespace gapscope::cli {
namespace {

void print_schema(const std::string& name) {
  std::string names;
  for (const JsonSchema& schema : json_schemas()) {
    if (schema.name == name) return fmt::print("{}", schema.text);
    names += schema.name + "\n";
  }
  if (!name.empty())
    throw ConfigError("gapscope: there is no schema '" + name + "', expected one of `gapscope schema`");
  fmt::print("{}", names);
}

}  // namespace

void add_schema(CommandLine& app) {
  auto name = std::make_shared<std::string>();
  CommandLine command = app.add_command("schema", "JSON schemas of what the commands write");
  command.add_option("NAME", *name, "which one (default: lists the names)");
  command.footer(
      "Every stored JSON says in its key schema what it is (gapscope.result/1); NAME is the word between.\n"
      "JSON Schema, draft 2020-12; each line of a stream is a document of its own. Keys carry their "
      "units.\n\n"
      "Example: gapscope schema result > result.schema.json");
  command.action([name] { print_schema(*name); });
}

}  // namespace gapscope::cli

#include "cli/commands.h"

#include <ostream>

namespace gapscope::cli {

void write_text(const std::string& path, const std::string& text, const Replaceable& found) {
  write_whole_file(
      path, [&](std::ostream& out) { out << text; }, found);
}

void add_work_options(CommandLine& command, int& threads, bool& quiet) {
  command.add_option("-j,--threads", threads, "threads (default: all cores); the results do not depend on it")
      .within(1, 1024)
      .value("N");
  command.add_flag("--quiet", quiet, "no progress");
}

}  // namespace gapscope::cli

#include "cli/written_json.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>

#include "support/reading.h"

namespace gapscope::testing {
namespace {

namespace fs = std::filesystem;

fs::path kept() { return fs::temp_directory_path() / ("gapscope_written_" + std::to_string(getpid())); }

/// The same document twice is kept once. timing.json does not name its schema: its name does.
void keep(const fs::path& name, const std::string& text) {
  const fs::path folder = kept() / std::to_string(std::hash<std::string>()(text));
  fs::create_directories(folder);
  std::ofstream(folder / name, std::ios::binary) << text;
}

class EveryWrittenJsonIsValid : public ::testing::Environment {
  void TearDown() override {
    if (!fs::exists(kept())) return;
    const std::string source = GAPSCOPE_SOURCE_DIR, said = kept().string() + ".said";
    const std::string command = "python3 " + source + "/tests/cli/validate.py " + source + "/docs/schemas " +
                                kept().string() + " >" + said + " 2>&1";
    const int ended = std::system(command.c_str()), status = WIFEXITED(ended) ? WEXITSTATUS(ended) : -1;
    if (status == 77 || status == 127)
      std::fputs("what was written is not judged: python3-jsonschema is not there\n", stderr);
    else
      EXPECT_EQ(status, 0) << text_of(said);
    fs::remove_all(kept());
    fs::remove(said);
  }
};

[[maybe_unused]] const auto* const registered =
    ::testing::AddGlobalTestEnvironment(new EveryWrittenJsonIsValid);

}  // namespace

void keep_written_json(const fs::path& folder, const std::set<std::string>& except) {
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const fs::path path = entry.path(), name = path.lexically_relative(folder);
    const bool json = path.extension() == ".json" || path.extension() == ".jsonl";
    if (json && entry.is_regular_file() && !except.contains(name.string()))
      keep(path.filename(), text_of(path));
  }
}

void keep_printed_json(const std::string& text) {
  if (text.starts_with("{\n \"schema\": \"gapscope.")) keep("printed.json", text);
}

}  // namespace gapscope::testing

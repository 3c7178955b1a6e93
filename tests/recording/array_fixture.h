#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "gapscope/recording/recording_file.h"
#include "support/reading.h"
#include "support/temporary_file.h"

namespace gapscope::testing {

/// A file that another program wrote (tests/recording/files, make_*.* beside it).
inline std::string written_file(const std::string& name) {
  return std::string(GAPSCOPE_SOURCE_DIR) + "/tests/recording/files/" + name;
}

inline ReadOptions columns_named(const std::string& time, const std::string& input,
                                 const std::string& position) {
  ReadOptions options;
  options.columns.time = time, options.columns.input = input, options.columns.position = position;
  options.columns.position_named = true;
  return options;
}

/// A change of the bytes of a good file, and what is said of it.
struct Malformed {
  const char* name;
  std::function<void(std::string& bytes)> change;
  std::vector<std::string> said;  ///< the place or the name, what is wrong, what to do
};

/// Every one is refused with all that is to be said.
inline void expect_refused(const std::string& good, const std::string& ending, const ReadOptions& options,
                           const std::vector<Malformed>& cases) {
  const std::string bytes = text_of(good);
  for (const Malformed& c : cases) {
    SCOPED_TRACE(c.name);
    std::string changed = bytes;
    c.change(changed);
    const TemporaryFile file(changed, "r" + ending);
    const std::string what = refusal([&] { read_recording(file.path(), options); });
    EXPECT_THAT(what, ::testing::HasSubstr("r" + ending + ":"));
    EXPECT_THAT(what, ::testing::HasSubstr("expected"));
    for (const std::string& said : c.said) EXPECT_THAT(what, ::testing::HasSubstr(said));
  }
}

/// Writes a number, the lowest byte first.
inline void put(std::string& bytes, std::size_t at, std::uint64_t value, std::size_t width) {
  for (std::size_t i = 0; i < width; ++i) bytes.at(at + i) = static_cast<char>(value >> (8 * i));
}

}  // namespace gapscope::testing

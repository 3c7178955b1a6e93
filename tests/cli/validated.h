#pragma once

#include "cli/executable.h"

namespace gapscope::testing {

/// What a validator of JSON schemas says of files of the place, by the schemas of docs/schemas: "3 files are
/// valid" with a newline, or what is wrong. Empty where there is no validator.
inline std::string judged(const Workplace& place, const std::string& files) {
  const std::string source = GAPSCOPE_SOURCE_DIR, said = (place.folder() / "said").string();
  const std::string command =
      "python3 " + source + "/tests/cli/validate.py " + source + "/docs/schemas " + files;
  const int status =
      std::system(("cd " + place.folder().string() + " && " + command + " >" + said + " 2>&1").c_str());
  return WEXITSTATUS(status) == 77 || WEXITSTATUS(status) == 127 ? "" : text_of(said);
}

}  // namespace gapscope::testing

#define GAPSCOPE_NEEDS_VALIDATOR(said) \
  if ((said).empty()) GTEST_SKIP() << "no python3-jsonschema here"

#pragma once

#include <memory>
#include <string>

#include "recording/array_file.h"

namespace gapscope::internal::recording {

/// The variables of a .mat file.
class MatContent : public ArrayFile {
 public:
  const char* noun() const override { return "variable"; }
};

/// Versions 4 and 7.3, by matio, in processes of their own.
/// @returns nothing where it is no such file
std::unique_ptr<ArrayFile> open_by_matio(const std::string& path);

/// Version 5 (also "6" and "7"). Not by matio: it allocates what a damaged header asks for and fills what is
/// cut off with zeros; here nothing is taken that is not there.
/// @throws ConfigError where the variables do not fill the file
std::unique_ptr<ArrayFile> open_version_5(const std::string& path);

}  // namespace gapscope::internal::recording

#pragma once

#include <tinyxml2.h>

#include <string>

namespace gapscope::internal::config {

/// @returns why the file is no XML with a root; empty where it is one  @throws ConfigError where it cannot be
/// read
std::string load_xml(const std::string& path, tinyxml2::XMLDocument& document);

/// Puts what stands in the files that an MJCF includes in the place of each <include file="..."/>, as MuJoCo
/// does: below the root of that file, which may include others; every name is relative to the folder of the
/// first file.
/// @throws ConfigError with file and line for an <include> without a file, of a file that cannot be read, is
///   included already (so that none includes itself), is not within that folder or larger than 64 MB; and
///   beyond 16 files one in the other, or 1000 in all
void follow_includes(tinyxml2::XMLDocument& document, const std::string& path);

}  // namespace gapscope::internal::config

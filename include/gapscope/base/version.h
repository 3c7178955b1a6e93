#pragma once

// The last release, by hand: docs/changelog.md says what changed. CMake reads it here, too.
#define GAPSCOPE_VERSION_MAJOR 0
#define GAPSCOPE_VERSION_MINOR 2
#define GAPSCOPE_VERSION_PATCH 0

/// For `#if GAPSCOPE_VERSION >= GAPSCOPE_VERSION_OF(0, 2, 0)`.
#define GAPSCOPE_VERSION_OF(major, minor, patch) ((major)*10000 + (minor)*100 + (patch))
#define GAPSCOPE_VERSION \
  GAPSCOPE_VERSION_OF(GAPSCOPE_VERSION_MAJOR, GAPSCOPE_VERSION_MINOR, GAPSCOPE_VERSION_PATCH)

namespace gapscope {

/// Of the build, as stored results carry it: "0.2.0" of a release or of sources without a repository, else
/// with the commits since then, the commit and whether files were changed: "0.2.0-17-g1a2b3c4d-dirty".
const char* version();

}  // namespace gapscope

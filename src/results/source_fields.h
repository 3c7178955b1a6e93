#pragma once

#include "gapscope/results/source_file.h"

namespace gapscope::internal {

template <class Archive>
void fields(Archive& archive, SourceFile& s) {
  archive("file", s.file);
  archive("sha256", s.sha256);
}

}  // namespace gapscope::internal

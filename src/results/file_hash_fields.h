#pragma once

#include "base/file_hash.h"

namespace gapscope::internal::results {

template <class Archive>
void fields(Archive& archive, FileHash& f) {
  archive("file", f.file);
  archive("sha256", f.sha256);
}

}  // namespace gapscope::internal::results

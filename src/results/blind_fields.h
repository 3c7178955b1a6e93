#pragma once

#include <string>

#include "gapscope/blind/records.h"
#include "results/json_document.h"

namespace gapscope::internal {

template <class Archive>
void fields(Archive& archive, SealedFile& f) {
  archive("file", f.file);
  archive("sha256", f.sha256);
}

}  // namespace gapscope::internal

#pragma once

#include "gapscope/base/doubt.h"

namespace gapscope::internal::results {

template <class Archive>
void fields(Archive& archive, Doubt& d) {
  archive("code", d.code);
  archive("found", d.found);
  archive("advice", d.advice);
}

}  // namespace gapscope::internal::results

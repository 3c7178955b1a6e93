#pragma once

#include "base/input_facts.h"

namespace gapscope::internal::results {

template <class Archive>
void fields(Archive& archive, InputFacts& f) {
  archive("unit", f.unit);
  archive("torque_constant_guessed", f.constant_guessed);
}

}  // namespace gapscope::internal::results

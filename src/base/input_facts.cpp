#include "gapscope/base/input_facts.h"

#include "gapscope/base/text.h"

namespace gapscope {

std::string with_input_unit(const std::string& text, const InputFacts& input) {
  return input.unit.empty() ? text : replaced(text, "units of u", input.unit);
}

}  // namespace gapscope

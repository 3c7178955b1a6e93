#pragma once

#include <map>
#include <string>

namespace gapscope::internal::diagnosis {

/// What to do about a reference that is not good, by the code of its reason.
const std::map<std::string, std::string>& remedies();

}  // namespace gapscope::internal::diagnosis

#pragma once

#include <string>

namespace gapscope {

/// The JSON Schema (draft 2020-12) of a configuration, for editors: every key with its range, its unit and
/// what it is for, made from the lists that the readers go by. A configuration that is read is valid by it;
/// what several keys say together (a gap with bounds that exclude its value) only the reader judges.
std::string configuration_schema();

}  // namespace gapscope

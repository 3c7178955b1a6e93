#include "gapscope/base/version.h"

namespace gapscope {

const char* version() { return GAPSCOPE_VERSION; }

}  // namespace gapscope

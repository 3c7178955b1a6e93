#pragma once

namespace gapscope {

/// Of the program, as stored results carry it: "0.1.0".
const char* version();

}  // namespace gapscope

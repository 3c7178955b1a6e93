#pragma once

#include <ctime>

namespace gapscope::benchmarks {

/// CPU time of the process [s]: other programs on the machine count less than in wall time.
inline double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

}  // namespace gapscope::benchmarks

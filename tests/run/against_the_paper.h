#pragma once

#include <string>

namespace gapscope::test {

/// What the source paper says of its figures and equations beside what its runs give here, as the table of
/// docs/against_the_paper.md: configs/01 and 12 simulated, S1 to S6 as printed.
std::string against_the_paper();

}  // namespace gapscope::test

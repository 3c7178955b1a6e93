// What libFuzzer calls: the reader that this program was built for.
#include <cstddef>
#include <cstdint>

#include "fuzz/readers.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  gapscope::testing::GAPSCOPE_FUZZED({reinterpret_cast<const char*>(data), size});
  return 0;
}

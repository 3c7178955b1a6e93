#pragma once

#include <string>

#include "inspection/rows.h"

namespace gapscope {

/// Six seconds of a drive of one body at 500 Hz and 18 bits, as a file.
inline std::string one_body_csv(double (*input)(double)) {
  TestDrive body;
  body.m2 = 0.0, body.d1 = 0.01;
  TestEncoder encoder;
  encoder.rate = 500.0, encoder.duration = 6.0, encoder.bits = 18, encoder.step = 1e-4;
  return testing::rows_of(record(body, input, encoder)).csv();
}

}  // namespace gapscope

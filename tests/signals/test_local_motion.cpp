#include <gtest/gtest.h>

#include "signals/local_motion.h"

namespace gapscope::internal::signals {
namespace {

TEST(LocalMotion, TheFirstSamplesOfAParabolaGiveItsSpeed) {
  Recording r;
  r.dt = 1e-3;
  for (int i = 0; i < 100; ++i) {
    const double t = i * r.dt;
    r.x1.push_back(0.2 + 3.0 * t - 5.0 * t * t);
    r.u.push_back(0.0);
  }
  const LocalMotion motion = local_motion(r.motor_trace(), 1e-6);
  EXPECT_NEAR(motion.x, 0.2, 1e-12);
  EXPECT_NEAR(motion.w, 3.0, 1e-9);
}

}  // namespace
}  // namespace gapscope::internal::signals

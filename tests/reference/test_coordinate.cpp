#include <gtest/gtest.h>

#include "reference/coordinate.h"

namespace gapscope::internal::reference {
namespace {

TEST(Coordinate, RunsBothWaysOverTwelveDecadesAndThroughZero) {
  const Coordinate c = Coordinate::logarithmic(0.02);
  for (const double p : {0.0, 1e-9, 1e-5, 0.02, 1.0, 1e3})
    EXPECT_NEAR(c.physical(c.solver(p)), p, 1e-13 * (p + c.scale));
  const Coordinate l = Coordinate::linear(3.0, 0.5);
  EXPECT_DOUBLE_EQ(l.physical(l.solver(-7.0)), -7.0);
}

TEST(Coordinate, ARatioIsAStepOfItsLogarithm) {
  // asinh x = ln 2x + O(1/4x²): 1e-6 at a thousand scales.
  const Coordinate c = Coordinate::logarithmic(1.0);
  EXPECT_NEAR(c.solver(10.0) - c.solver(1.0), std::log(10.0), 1e-5);
}

TEST(Coordinate, ItsSlopeIsThatOfTheJet) {
  const Coordinate c = Coordinate::logarithmic(2.0);
  const Jet<4> p = c.physical(Jet<4>(1.7, 0));
  EXPECT_DOUBLE_EQ(p.v[0], c.slope(1.7));
}

}  // namespace
}  // namespace gapscope::internal::reference

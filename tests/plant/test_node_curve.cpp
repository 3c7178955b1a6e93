// The curve through the nodes of a law of last resort: through them, smooth between them, and as it says
// beyond.
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "plant/effects/node_curve.h"

namespace gapscope::internal::plant {
namespace {

constexpr int kPieces = 6;

/// A bent curve and its slope at a place.
template <Beyond beyond>
std::pair<double, double> bent(double s) {
  const NodeWeights<kPieces, beyond> weights(s);
  double value = 0.0, slope = 0.0;
  for (int k = 0; k <= kPieces; ++k) {
    const double node = std::sin(3.0 * Nodes<kPieces>::at(k));
    value += weights.value(k) * node, slope += weights.slope(k) * node;
  }
  return {value, slope};
}

TEST(NodeCurve, PassesItsNodesAndItsSlopeIsThatOfItsValues) {
  for (int k = 0; k <= kPieces; ++k)
    EXPECT_NEAR(bent<Beyond::kLevel>(Nodes<kPieces>::at(k)).first, std::sin(3.0 * Nodes<kPieces>::at(k)),
                1e-12);
  const double h = 1e-6;
  for (const double s : {0.01, 0.2, 0.5, 0.99, 1.0, 1.03, 1.2})
    EXPECT_NEAR(bent<Beyond::kLevel>(s).second,
                (bent<Beyond::kLevel>(s + h).first - bent<Beyond::kLevel>(s - h).first) / (2.0 * h), 1e-5);
}

TEST(NodeCurve, GoesOnStraightOrLevelsOffBeyondItsLastNode) {
  const auto [end, slope] = bent<Beyond::kStraight>(1.0);
  EXPECT_NEAR(bent<Beyond::kStraight>(1.7).first, end + 0.7 * slope, 1e-12);
  EXPECT_NEAR(bent<Beyond::kStraight>(1.7).second, slope, 1e-12);
  constexpr double over = NodeWeights<kPieces, Beyond::kLevel>::kLevelledOver;
  EXPECT_NEAR(bent<Beyond::kLevel>(1.7).first, end + 0.5 * over * slope, 1e-12);
  EXPECT_EQ(bent<Beyond::kLevel>(1.7).second, 0.0);
}

}  // namespace
}  // namespace gapscope::internal::plant

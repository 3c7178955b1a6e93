#include "sliding_mode/marks/torque_turns.h"

#include <algorithm>
#include <cmath>

namespace gapscope::internal::sliding_mode {
namespace {

constexpr double kZero = 1e-3, kTurned = 0.15;  ///< of the largest |u|

}  // namespace

std::vector<TorqueTurn> torque_turns(const MotorTrace& trace) {
  double most = 0.0;
  for (const double u : trace.u) most = std::max(most, std::abs(u));
  std::vector<TorqueTurn> turns;
  int side = 0;
  std::size_t quiet = 0, zero = 0;
  for (std::size_t i = 0; i < trace.size(); ++i) {
    const double u = trace.u[i];
    if (side == 0 || side * u <= kZero * most) {
      if (std::abs(u) <= kZero * most || (i > 0 && u * trace.u[i - 1] <= 0.0)) {
        if (zero + 1 != i) quiet = i;
        zero = i;
      }
    }
    const int now = u > kTurned * most ? 1 : u < -kTurned * most ? -1 : side;
    if (now == side) continue;
    if (!turns.empty()) turns.back().next = zero;
    if (side != 0) turns.push_back({quiet, zero, trace.size() - 1, now});
    side = now;
  }
  return turns;
}

}  // namespace gapscope::internal::sliding_mode

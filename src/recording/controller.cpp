#include "gapscope/recording/controller.h"

#include "base/require.h"

namespace gapscope {

std::vector<double> commanded_input(const DriveController& controller, const CommandRows& rows) {
  const std::size_t n = rows.t.size();
  GAPSCOPE_REQUIRE(n >= 2 && rows.target.size() == n && rows.position.size() == n && rows.supply.size() == n);
  return commanded_input(controller, rows, 0, n);
}

InputComparison compare_inputs(std::span<const double> recorded, std::span<const double> commanded) {
  double product = 0.0, square = 0.0, left = 0.0, moved = 0.0;
  for (std::size_t i = 0; i < recorded.size(); ++i)
    product += recorded[i] * commanded[i], square += commanded[i] * commanded[i];
  InputComparison found;
  if (!(square > 0.0)) return found;
  found.scale = product / square;
  const double center = mean(recorded);
  for (std::size_t i = 0; i < recorded.size(); ++i) {
    left += std::pow(recorded[i] - found.scale * commanded[i], 2);
    moved += std::pow(recorded[i] - center, 2);
  }
  if (moved > 0.0) found.left = std::sqrt(left / moved);
  return found;
}

}  // namespace gapscope

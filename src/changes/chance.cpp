#include "changes/chance.h"

#include <cmath>

namespace gapscope::internal::changes {

double normal_beyond(double z) { return std::erfc(std::abs(z) / std::sqrt(2.0)); }

double two_sided_quantile(double p) {
  double low = 0.0, high = 40.0;
  for (int step = 0; step < 100; ++step) {
    const double middle = 0.5 * (low + high);
    (normal_beyond(middle) > p ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double squares_beyond(double sum, double freedom) {
  if (freedom < 0.5) return 1.0;
  if (freedom < 1.5) return normal_beyond(std::sqrt(sum));
  const double spread = 2.0 / (9.0 * freedom);
  return 0.5 * std::erfc((std::cbrt(sum / freedom) - 1.0 + spread) / std::sqrt(2.0 * spread));
}

double normal_of_student(double t, double freedom) {
  const double size = std::sqrt(freedom * std::log1p(t * t / freedom));
  return std::copysign((8.0 * freedom + 1.0) / (8.0 * freedom + 3.0) * size, t);
}

}  // namespace gapscope::internal::changes

#include "inspection/first_row.h"

#include <algorithm>
#include <cmath>

#include "signals/encoder.h"

namespace gapscope {
namespace {

constexpr double kOn = 0.1;             ///< of the largest |u|
constexpr double kSoon = 0.1;           ///< a drive that stands longer under its input is held by it [s]
constexpr std::size_t kFewestRows = 3;  ///< at one place: else it moves already
constexpr double kMoved = 14.0;         ///< encoder floors, four counts, in two more stretches as long

}  // namespace

std::optional<double> begins_under_input(const MotorTrace& r) {
  if (r.u.empty()) return {};
  const auto louder = [](double a, double b) { return std::abs(a) < std::abs(b); };
  const double peak = std::abs(*std::max_element(r.u.begin(), r.u.end(), louder));
  if (!(std::abs(r.u.front()) > kOn * peak)) return {};
  const double floor = internal::signals::encoder_floor(r);
  std::size_t moved = 0;
  while (moved < r.size() && !internal::signals::exceeds_a_count(r.x1[moved] - r.x1.front(), floor)) ++moved;
  if (moved < kFewestRows || 3 * moved >= r.size() || r.elapsed(moved) > kSoon) return {};
  const double way = r.x1[3 * moved] - r.x1.front();
  if (!(way * r.u.front() > 0.0) || std::abs(way) < kMoved * floor) return {};
  return r.elapsed(moved);
}

}  // namespace gapscope

#include "inspection/switched_off.h"

#include <algorithm>
#include <utility>

namespace gapscope::internal::inspection {
namespace {

/// Of the recording, that u is zero at one go. `gapscope check` of the 20 recordings of real drives at hand
/// finds both of a falling arm (0.75) and no other (0.007 at most), with half and with double as well.
constexpr double kSwitchedOff = 0.1;
constexpr double kMoved = 10.0;  ///< quanta of x1: it moves

}  // namespace

OffStretch switched_off(std::span<const double> u, std::span<const double> x1, double quantum) {
  OffStretch longest, second;
  for (std::size_t i = 0; i < u.size();) {
    std::size_t end = i;
    while (end < u.size() && u[end] == 0.0) ++end;
    if (const OffStretch zeros{i, end}; zeros.length() > longest.length())
      second = std::exchange(longest, zeros);
    else if (zeros.length() > second.length())
      second = zeros;
    i = std::max(end, i + 1);
  }
  if (longest.length() == 0 ||
      static_cast<double>(longest.length()) < kSwitchedOff * static_cast<double>(u.size()) ||
      2 * second.length() > longest.length())
    return {};
  const auto [low, high] = std::minmax_element(x1.begin() + static_cast<std::ptrdiff_t>(longest.from),
                                               x1.begin() + static_cast<std::ptrdiff_t>(longest.to));
  return *high - *low > kMoved * quantum ? longest : OffStretch{};
}

}  // namespace gapscope::internal::inspection

#include "base/percents.h"

#include <algorithm>
#include <cmath>

#include "base/decimals.h"
#include "gapscope/base/statistics.h"

namespace gapscope {
namespace {

/// Decimals that show so many significant digits.
int decimals_of(double size, int digits) {
  return digits - 1 - static_cast<int>(std::floor(std::log10(size)));
}

}  // namespace

Percents::Percents(std::span<const double> together) {
  double least = kInfinity, most = 0.0;
  for (const double percent : together) {
    const double size = std::abs(percent);
    if (!(size > 0.0) || !std::isfinite(size)) continue;
    least = std::min(least, size), most = std::max(most, size);
  }
  if (most > 0.0) decimals_ = std::max(0, std::min(decimals_of(least, 2), decimals_of(most, 4)));
}

std::string Percents::number(double percent) const {
  return std::isfinite(percent) ? with_decimals(percent, decimals_) : "–";
}

std::string Percents::operator()(double percent) const {
  return std::isfinite(percent) ? number(percent) + " %" : "–";
}

}  // namespace gapscope

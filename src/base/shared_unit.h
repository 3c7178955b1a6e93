#pragma once

#include <string>

#include "gapscope/base/statistics.h"

namespace gapscope {

/// A size with the prefix that keeps the first of several between 1 and 1000; all of them in that unit.
class SharedUnit {
 public:
  /// @param first  size that chooses the prefix   @param unit  "N·m", "N", "rad" or "m"
  SharedUnit(double first, const std::string& unit);
  std::string number(double value) const;                                       ///< "9.66"
  std::string operator()(double value) const { return number(value) + unit_; }  ///< "9.66 N"
  /// "9.66 N, 95 %: 9.41 to 9.91": two digits of the half width; without an interval as above.
  std::string with_interval(double value, const Interval& ci95) const;
  /// "9.66 N (95 %: 9.41 to 9.91)"
  std::string with_interval_aside(double value, const Interval& ci95) const;

 private:
  std::string interval_after(double value, const Interval& ci95, const char* before, const char* after) const;

  double factor_ = 1.0;
  std::string unit_;  ///< with the space before it; empty of a ratio
};

}  // namespace gapscope

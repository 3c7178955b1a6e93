#pragma once

#include <span>
#include <string>

namespace gapscope {

/// Percents that stand together, as in the column of a table, with the same decimals: two significant digits
/// of the smallest, no more than four of the largest.
class Percents {
 public:
  /// @param together  [%]; what is no number counts for nothing
  explicit Percents(std::span<const double> together);

  /// "2.5 %"; a dash for what is no number.
  std::string operator()(double percent) const;
  std::string number(double percent) const;  ///< "2.5"

 private:
  int decimals_ = 0;
};

}  // namespace gapscope

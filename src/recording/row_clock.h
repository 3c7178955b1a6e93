#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace gapscope::internal::recording {

/// Times that a clock shows, as seconds since the first one: "10:00:00.5" or whole numbers of 16 digits and
/// more (ns since an epoch), which as a double would have lost their ends. Of a text with a date the date
/// itself is not read: from row to row less than half a day goes by, to either side.
class RowClock {
 public:
  /// Whether a text is such a time.
  static bool reads(std::string_view text);

  /// @param unit  of whole numbers [s]
  /// @returns nothing where it is none
  std::optional<double> seconds(std::string_view text, double unit);

  bool begun() const { return begun_; }

 private:
  std::optional<double> of_day(std::string_view text);

  bool begun_ = false;
  std::int64_t origin_ = 0;
  double first_ = 0.0, last_ = 0.0, days_ = 0.0;  // [s]
};

}  // namespace gapscope::internal::recording

#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "gapscope/recording/recording_file.h"

namespace gapscope {

/// A CSV (see read_recording()) that arrives piece by piece and need not end. The sampling interval is that
/// of the first kClockRows rows; every later step must be within 0.1 % of it. Where the time is not uniform,
/// the rows can be brought to a rate, as `resample:` does of a whole recording. Keeps no row that was taken.
class CsvStream {
 public:
  static constexpr std::size_t kClockRows = 1000;
  static constexpr std::size_t kLongestLine = 1 << 16;  ///< characters

  struct Sample {
    double t = 0.0;   ///< [s]
    double u = 0.0;   ///< [unit of u]
    double x1 = 0.0;  ///< [rad]
  };

  /// @param name  for messages: "standard input"
  /// @param resample_rate  that the rows are brought to [Hz]; 0: they are taken as they stand
  explicit CsvStream(std::string name, const RecordingColumns& columns = {}, double resample_rate = 0.0);
  ~CsvStream();

  /// Takes a piece of the text, cut anywhere. Rows before a broken one can still be taken.
  /// @throws ConfigError with the line, as read_recording() does, and for a line that does not end
  void feed(std::string_view text);

  /// The text ends here.  @throws ConfigError as feed(), and for fewer than kFewestSamples rows
  void finish();

  bool has_clock() const;  ///< whether the sampling interval is known; before that no sample is given out
  double start() const;    ///< [s]
  double dt() const;       ///< [s]
  std::vector<Sample> take();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace gapscope

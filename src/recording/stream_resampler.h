#pragma once

#include <vector>

#include "recording/csv_stream.h"

namespace gapscope::internal::recording {

/// resample() on rows that arrive one by one: positions linearly, the input as the mean over each interval of
/// the grid, which begins at the first row.
class StreamResampler {
 public:
  explicit StreamResampler(double rate) : rate_(rate) {}

  double start() const { return start_; }  ///< of the grid: the time of the first row [s]

  /// @param row  later than the one before it
  void take(const CsvStream::Sample& row, std::vector<CsvStream::Sample>& out);
  /// No row comes any more: the input of the last one is held.
  void finish(std::vector<CsvStream::Sample>& out);

 private:
  double grid(std::size_t i) const { return start_ + static_cast<double>(i) / rate_; }
  void close(double u, std::vector<CsvStream::Sample>& out);

  double rate_, start_ = 0.0;
  bool begun_ = false;
  CsvStream::Sample row_;  ///< the last one
  std::size_t next_ = 0;   ///< of the grid: the sample that is being made
  double x_ = 0.0;         ///< its position
  double impulse_ = 0.0;   ///< of the input since it began, up to
  double from_ = 0.0;      ///< this time [s]
};

}  // namespace gapscope::internal::recording

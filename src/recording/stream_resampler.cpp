#include "recording/stream_resampler.h"

namespace gapscope::internal::recording {

void StreamResampler::take(const CsvStream::Sample& row, std::vector<CsvStream::Sample>& out) {
  if (!begun_) {
    begun_ = true;
    start_ = from_ = row.t;
    x_ = row.x1;
    row_ = row;
    return;
  }
  while (grid(next_ + 1) <= row.t) {
    close(row_.u, out);
    const double part = (grid(next_) - row_.t) / (row.t - row_.t);
    x_ = row_.x1 + part * (row.x1 - row_.x1);
  }
  impulse_ += row_.u * (row.t - from_);
  from_ = row.t;
  row_ = row;
}

void StreamResampler::finish(std::vector<CsvStream::Sample>& out) {
  if (begun_ && grid(next_) <= row_.t) close(row_.u, out);
}

/// @param u  held from `from_` to the end of the interval
void StreamResampler::close(double u, std::vector<CsvStream::Sample>& out) {
  const double begin = grid(next_), end = grid(next_ + 1);
  // One row over the whole interval keeps its own number, free of rounding.
  const double mean = from_ == begin ? u : (impulse_ + u * (end - from_)) / (end - begin);
  out.push_back({begin, mean, x_});
  ++next_;
  impulse_ = 0.0;
  from_ = end;
}

}  // namespace gapscope::internal::recording

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "gapscope/recording/recording_file.h"
#include "recording/recorded_rows.h"

namespace gapscope {
namespace {

using internal::recording::RecordedRows;

constexpr double kSameStamp = 0.1;   // of the mean step: clocks of a text have few digits
constexpr double kSameInput = 1e-3;  // of the input's peak: so have its columns

double peak_of(const std::vector<double>& u) {
  double peak = 0.0;
  for (const double value : u) peak = std::max(peak, std::abs(value));
  return peak;
}

/// The row of a time; rows before `first` are too early.
std::size_t row_at(const RecordedRows& rows, double t, std::size_t first, const Recording& like) {
  const double near = kSameStamp * like.dt;
  std::size_t row = first;
  while (row + 1 < rows.size() && rows.t[row] < t - near) ++row;
  if (std::abs(rows.t[row] - t) <= near) return row;
  rows.fail(rows.line[row],
            fmt::format(
                "there is no row at {:.9g} s, the next one is at {:.9g} s, expected one at every time of {} "
                "({:.9g} to {:.9g} s; rows between them do no harm)",
                t, rows.t[row], like.file, like.time(0), like.time(like.size() - 1)));
}

void require_same_input(const RecordedRows& rows, std::size_t row, double u, double peak,
                        const Recording& like) {
  if (std::isnan(rows.u[row]) || std::abs(rows.u[row] - u) <= kSameInput * peak) return;
  rows.fail(
      rows.line[row],
      fmt::format("the input is {:.6g} at {:.9g} s where {} has {:.6g}, expected the simulator's answer to "
                  "the recorded input (within 0.1 % of its peak {:.4g}), or no column of the input",
                  rows.u[row], rows.t[row], like.file, u, peak));
}

}  // namespace

Recording read_simulated(const std::string& path, const RecordingColumns& columns, const Recording& like) {
  ReadOptions options;
  options.columns = columns;
  if (options.columns.reads_input()) options.columns.input_column = InputColumn::kOptional;
  const RecordedRows rows = internal::recording::read_window(path, options);
  const double peak = peak_of(like.u);
  Recording r;
  r.file = std::filesystem::path(path).filename().string();
  r.start = like.start, r.dt = like.dt, r.u = like.u, r.stamps = like.stamps;
  r.quantum = seen_quantum(rows.x1);
  std::size_t row = 0;
  for (std::size_t i = 0; i < like.size(); ++i) {
    row = row_at(rows, like.time(i), row, like);
    require_same_input(rows, row, like.u[i], peak, like);
    r.x1.push_back(rows.x1[row]);
  }
  r.encoder = like.encoder;
  if (r.encoder == EncoderSide::kLoad) std::swap(r.x1, r.x2);
  return r;
}

}  // namespace gapscope

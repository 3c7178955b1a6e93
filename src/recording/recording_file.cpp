#include "gapscope/recording/recording_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <tuple>

#include "gapscope/base/errors.h"
#include "gapscope/base/statistics.h"
#include "recording/let_go.h"
#include "recording/limits.h"
#include "recording/lost_rows.h"
#include "recording/recorded_rows.h"
#include "recording/resample.h"

namespace gapscope {
namespace {

using internal::recording::RecordedRows;

void require_samples(const RecordedRows& table, std::size_t count, const std::string& where) {
  if (count >= kFewestSamples) return;
  if (count + table.skipped.size() >= kFewestSamples)
    table.fail(table.skipped.front(),
               fmt::format("t is not later than in the row before, and so in {} rows, expected time that "
                           "increases from row to row",
                           table.skipped.size()));
  throw ConfigError(table.path, fmt::format("{} sample{}{}, expected at least {}", count,
                                            count == 1 ? "" : "s", where, kFewestSamples));
}

void cut_to_window(RecordedRows& table, const std::pair<double, double>& window) {
  const auto first = std::lower_bound(table.t.begin(), table.t.end(), window.first);
  const auto last = std::upper_bound(first, table.t.end(), window.second);
  const std::string where = fmt::format(" in the window {} to {} s (the file has {} to {} s)", window.first,
                                        window.second, table.t.front(), table.t.back());
  require_samples(table, static_cast<std::size_t>(last - first), where);
  table.keep(static_cast<std::size_t>(first - table.t.begin()), static_cast<std::size_t>(last - first));
}

void require_clock(const RecordedRows& table) {
  const double mean = internal::recording::mean_step(table);
  if (mean < internal::recording::kShortestStep || mean > internal::recording::kLongestStep)
    table.fail(table.line.back(),
               fmt::format("time goes on by {:.3g} s from row to row, expected {:g} to {:g} s", mean,
                           internal::recording::kShortestStep, internal::recording::kLongestStep));
}

void require_uniform(const RecordedRows& table) {
  if (internal::recording::is_uniform(table)) return;
  const double mean = internal::recording::mean_step(table);
  const std::size_t worst = internal::recording::worst_step(table);
  const double step = table.t[worst] - table.t[worst - 1];
  table.fail(
      table.line[worst],
      fmt::format(
          "time is not uniform: a step of {:.6g} ms, {:.3g} % off the mean of {:.6g} ms, expected every "
          "step within 0.1 % of the mean, or resample: {{rate: ...}} (here about {:.4g} Hz); fit and diagnose "
          "take it as it is",
          1e3 * step, 100.0 * std::abs(step - mean) / mean, 1e3 * mean, 1.0 / mean));
}

bool reproduces_times(const RecordedRows& table, double dt) {
  for (std::size_t i = 0; i < table.size(); ++i)
    if (table.t.front() + dt * static_cast<double>(i) != table.t[i]) return false;
  return true;
}

/// The sampling interval. Of all numbers within rounding of the mean step the one that gives back the times
/// of the file exactly, one over a whole rate first, so that a recording that was written reads back the
/// same.
double sampling_interval(const RecordedRows& table) {
  const double mean = internal::recording::mean_step(table);
  double below = mean, above = mean;
  std::vector<double> candidates = {1.0 / std::round(1.0 / mean), mean};
  for (int ulp = 0; ulp < 3; ++ulp) {
    candidates.push_back(below = std::nextafter(below, 0.0));
    candidates.push_back(above = std::nextafter(above, kInfinity));
  }
  for (const double dt : candidates)
    if (reproduces_times(table, dt)) return dt;
  return mean;
}

}  // namespace

namespace internal::recording {
namespace {

CommandRows command_of(const RecordedRows& table, const ReadOptions& options) {
  CommandRows rows = {table.t, table.target, table.x1, table.supply, options.gain_times};
  const bool bridges = options.lost_rows == LostRows::kBridged && !options.resample_rate;
  if (bridges) rows.bridged = losses_of(table.t);
  if (options.off)
    std::tie(rows.off_from, rows.off_to) = *options.off;
  else
    rows.off_from = let_go_at(rows);
  return rows;
}

/// A supply of one voltage, where no column has it.
void supply_by(double voltage, const ReadOptions& options, RecordedRows& table) {
  if (options.columns.reads_input())
    for (double& u : table.u) u *= voltage;
  table.supply.assign(table.size(), voltage);
}

/// The input is what the controller made of the target.
void command(const ReadOptions& options, RecordedRows& table) {
  table.command = std::make_shared<const CommandRows>(command_of(table, options));
  table.u = commanded_input(*options.controller, *table.command);
}

}  // namespace

RecordedRows read_window(const std::string& path, const ReadOptions& options, EarlierRow earlier) {
  RecordedRows table = read_rows(path, options.columns, earlier);
  require_samples(table, table.size(), "");
  mend_rows(options, table);
  if (options.voltage) supply_by(*options.voltage, options, table);
  if (options.controller && !options.columns.reads_input()) command(options, table);
  if (options.window) cut_to_window(table, *options.window);
  return table;
}

double mean_step(const RecordedRows& table) {
  return (table.t.back() - table.t.front()) / static_cast<double>(table.size() - 1);
}

std::size_t worst_step(const RecordedRows& table) {
  const double mean = mean_step(table);
  std::size_t worst = 1;
  const auto deviation = [&](std::size_t i) { return std::abs(table.t[i] - table.t[i - 1] - mean); };
  for (std::size_t i = 1; i < table.size(); ++i)
    if (deviation(i) > deviation(worst)) worst = i;
  return worst;
}

bool is_uniform(const RecordedRows& table) {
  const double mean = mean_step(table);
  const std::size_t worst = worst_step(table);
  return std::abs(table.t[worst] - table.t[worst - 1] - mean) <= kUniformTolerance * mean;
}

Recording recording_of(RecordedRows&& table, UnevenRows uneven) {
  require_clock(table);
  if (uneven == UnevenRows::kRefused) require_uniform(table);
  const bool even = is_uniform(table);
  Recording r;
  r.start = table.t.front();
  r.dt = even ? sampling_interval(table) : mean_step(table);
  r.u = std::move(table.u);
  r.x1 = std::move(table.x1);
  r.x2 = std::move(table.x2);
  r.command = std::move(table.command);
  r.command_first = table.command_first;
  if (!even) r.stamps = std::move(table.t);
  return r;
}

Recording uniform_recording(RecordedRows&& table) {
  return recording_of(std::move(table), UnevenRows::kRefused);
}

}  // namespace internal::recording

RecordingColumns RecordingColumns::read_from_load() const {
  RecordingColumns c = *this;
  if (!load_reads_load_position()) {
    c.load_position = position == "x1" ? "x2" : "x1";
    return c;
  }
  std::swap(c.position, c.load_position);
  std::swap(c.scales.position, c.scales.load_position);
  std::swap(c.position_named, c.load_position_required);
  return c;
}

std::optional<InputComparison> compare_with_controller(const std::string& path, const ReadOptions& options) {
  if (!options.controller || !options.columns.reads_input()) return {};
  const RecordedRows table = internal::recording::read_window(path, options);
  const CommandRows rows = internal::recording::command_of(table, options);
  return compare_inputs(table.u, commanded_input(*options.controller, rows));
}

Recording read_recording(const std::string& path, const ReadOptions& options) {
  RecordedRows table = internal::recording::read_window(path, options);
  const bool open_end = table.open_end;
  const double quantum =
      options.columns.position_is_speed ? 0.0 : seen_quantum(table.x1);  // of the raw samples
  std::vector<Remark> assumed = std::move(table.assumed);
  Recording r = options.resample_rate ? internal::recording::resample(table, *options.resample_rate)
                                      : internal::recording::recording_of(std::move(table), options.uneven);
  if (r.size() < kFewestSamples) require_samples(table, r.size(), " after resampling");
  if (r.command) command_by(*options.controller, r);
  if (options.lost_rows == LostRows::kBridged && !r.command) bridge_lost_rows(r);
  r.file = std::filesystem::path(path).filename().string();
  r.open_end = open_end;
  r.quantum = quantum;
  r.assumed = std::move(assumed);
  r.encoder = options.encoder;
  if (r.encoder == EncoderSide::kLoad) std::swap(r.x1, r.x2);
  return r;
}

}  // namespace gapscope

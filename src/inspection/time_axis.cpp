// Whether the rows follow each other in time as every command expects.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "base/shown.h"
#include "inspection/rules.h"
#include "recording/lost_rows.h"

namespace gapscope::internal::inspection {
namespace {

constexpr double kSlowest = 5.0;  ///< rate below which t is hardly in seconds [Hz]
constexpr double kFastest = 1e6;  ///< … above which

struct Steps {
  double median = kNaN, shortest = kNaN, longest = kNaN;  ///< [s]
  std::size_t longest_row = 0, pauses = 0;
  double missing = 0.0;
  double usual = 0.0;  ///< in the mean, where nothing is missing [s]
};

Steps steps_of(const recording::RecordedRows& rows) {
  std::vector<double> all;
  for (std::size_t i = 1; i < rows.size(); ++i) all.push_back(rows.t[i] - rows.t[i - 1]);
  Steps s;
  const auto [shortest, longest] = std::minmax_element(all.begin(), all.end());
  s.shortest = *shortest, s.longest = *longest;
  s.longest_row = static_cast<std::size_t>(longest - all.begin());
  s.median = median(all);
  s.usual = rows.t.back() - rows.t.front();
  for (const Loss& loss : losses_of(rows.t))
    ++s.pauses, s.missing += static_cast<double>(loss.lost), s.usual -= all[loss.row];
  s.usual /= static_cast<double>(all.size() - s.pauses);
  return s;
}

std::string resample_advice(const RecordingFacts& facts) {
  return fmt::format(
      "fit and diagnose use each step with its own length; the detector (run, detect) needs recording: "
      "resample: {{rate: {:.4g}, for: detector}}, times within a step stay unsure there",
      facts.rate);
}

/// Share of the rows whose stamp is not one tick after the row before, where all are of a clock that goes on
/// by 15.6 ms, as those of PCs do that are not asked for better; 0 where it is another one.
double off_a_pc_tick(const recording::RecordedRows& rows) {
  constexpr double kTick = 1.0 / 64.0, kOff = 0.8e-3;  // [s]; stamps in whole milliseconds are off by so much
  constexpr double kNearlyAll = 0.98, kMostTicks = 20.0;
  if (recording::is_uniform(rows) && rows.skipped.empty()) return 0.0;  // no coarse clock is
  std::size_t of_ticks = 0, other_than_one = rows.skipped.size();
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const double step = rows.t[i] - rows.t[i - 1], ticks = std::round(step / kTick);
    of_ticks += ticks >= 1.0 && ticks <= kMostTicks && std::abs(step - ticks * kTick) < kOff;
    other_than_one += ticks > 1.0;
  }
  const double steps = static_cast<double>(rows.size() - 1);
  if (static_cast<double>(of_ticks) < kNearlyAll * steps) return 0.0;
  return static_cast<double>(other_than_one) / (steps + static_cast<double>(rows.skipped.size()));
}

Finding pc_clock(const Material& m, double off) {
  return {
      kTimeRule, Severity::kSpoils,
      fmt::format(
          "all stamps are whole ticks of 15.6 ms, a PC's coarse clock; {:.0f} % of the rows are not one "
          "tick after the row before, {} share a stamp",
          100.0 * off, m.rows.skipped.size()),
      "these are not the times at which x1 was read: record the drive's own clock or the PC's fine one; where "
      "the drive samples at a fixed rate, write t = row number / rate"};
}

Finding other_rate(const Material& m, const RecordingFacts& facts) {
  return {
      kTimeRule, Severity::kSpoils,
      fmt::format("declared to come at {:.4g} Hz, but by {} of the file they come at {:.4g} Hz in the mean",
                  facts.rate, shown(m.named_rate.column), m.named_rate.rate),
      "leave out recording: rate (--rate): the time is read then, in the unit that is declared; or give "
      "the rate at which x1 was read"};
}

Finding skipped_rows(const Material& m) {
  return {kTimeRule, Severity::kSpoils,
          fmt::format("{} rows are not later than the row before, the first in {}", m.rows.skipped.size(),
                      m.rows.place(m.rows.skipped.front())),
          "export each sample once and in order; the rest is judged without these rows"};
}

/// Windows of what was recorded between long pauses, as of several tests in one log; empty: there are none.
std::string tests_between(const recording::RecordedRows& rows, double usual) {
  constexpr double kLongPause = 20.0;  ///< usual steps
  constexpr std::size_t kMost = 6;
  std::vector<std::string> windows;
  double from = rows.t.front();
  for (std::size_t i = 1; i <= rows.size(); ++i) {
    if (i < rows.size() && rows.t[i] - rows.t[i - 1] < kLongPause * usual) continue;
    windows.push_back(fmt::format("{:.6g} {:.6g}", from, rows.t[i - 1]));
    if (i < rows.size()) from = rows.t[i];
  }
  if (windows.size() < 2) return "";
  const std::size_t told = std::min(windows.size(), kMost);
  return fmt::format("; several tests in one log? Each by itself: --window {}{}",
                     fmt::join(windows.begin(), windows.begin() + static_cast<std::ptrdiff_t>(told), ", or "),
                     told < windows.size() ? ", ..." : "");
}

Finding pauses(const Material& m, const Steps& s, const RecordingFacts& facts) {
  return {
      kTimeRule, m.resampled ? Severity::kNote : Severity::kSpoils,
      fmt::format("{:.0f} samples are missing at {} places, most of them in {:.4g} s from t = {:.6g} s on",
                  s.missing, s.pauses, s.longest, m.rows.t[s.longest_row]),
      m.resampled ? "the resampled motion is a straight line there; better record without losses"
                  : "u is held over each gap (recording: lost_rows: bridged, where the drive got new inputs "
                    "meanwhile): record "
                    "without losses, or cut a whole part with recording: window; " +
                        resample_advice(facts) + tests_between(m.rows, s.median)};
}

Finding jitter(const Material& m, const Steps& s, const RecordingFacts& facts) {
  return {
      kTimeRule, Severity::kNote,
      fmt::format("steps of {:.4g} to {:.4g} ms, {:.4g} ms in the middle: not uniform within 0.1 %",
                  1e3 * s.shortest, 1e3 * s.longest, 1e3 * s.median),
      m.resampled ? "resampled; delays and high frequencies are not to be trusted" : resample_advice(facts)};
}

}  // namespace

Finding check_time(const Material& m, RecordingFacts& facts) {
  const Steps s = steps_of(m.rows);
  facts.samples = static_cast<int>(m.rows.size());
  facts.skipped_rows = static_cast<int>(m.rows.skipped.size());
  facts.uniform = recording::is_uniform(m.rows) && m.rows.skipped.empty();
  facts.missing_samples = static_cast<int>(std::min(s.missing, 2e9));
  facts.start = m.rows.t.front();
  facts.duration = m.rows.t.back() - m.rows.t.front() + s.median;
  facts.rate = 1.0 / s.usual;
  facts.shortest_step = s.shortest, facts.longest_step = s.longest;
  constexpr double kUnlikeLosses = 0.15;
  if (const double off = off_a_pc_tick(m.rows); off > kUnlikeLosses) {
    facts.coarse_clock = true;
    return pc_clock(m, off);
  }
  constexpr double kOtherRate = 0.2;  // a time in whole seconds says so much of 5 s; lost rows are as few
  if (std::abs(std::log(facts.rate / m.named_rate.rate)) > kOtherRate && !m.named_rate.column.empty())
    return other_rate(m, facts);
  if (!m.rows.skipped.empty()) return skipped_rows(m);
  const bool of_clock = std::any_of(m.rows.assumed.begin(), m.rows.assumed.end(),
                                    [](const Remark& r) { return r.code() == "table.clock"; });
  if (facts.rate < kSlowest && of_clock)
    return {kTimeRule, Severity::kSpoils,
            fmt::format("a row in {:.4g} s: slower than a drive moves", s.median),
            "record at 50 Hz or more, 200 Hz for a gap"};
  if (facts.rate < kSlowest || facts.rate > kFastest)
    return {
        kTimeRule, Severity::kSpoils,
        fmt::format("t goes on by {:.4g} from row to row: {:.4g} Hz if it is in seconds", s.median,
                    facts.rate),
        "give t in seconds, or declare its unit: recording: units: {time: ms} (--time-unit ms; or us, ns, or the "
        "seconds per row number)"};
  if (s.pauses > 0) return pauses(m, s, facts);
  if (!facts.uniform) return jitter(m, s, facts);
  if (m.rows.open_end)
    return {
        kTimeRule, Severity::kNote,
        fmt::format("{} samples, {:.5g} s at {:.5g} Hz, uniform; the last line has no end", facts.samples,
                    facts.duration, facts.rate),
        "if the file was cut off, its last number is another: leave the last row out with recording: window"};
  return {
      kTimeRule, Severity::kFine,
      fmt::format("{} samples, {:.5g} s at {:.5g} Hz, uniform", facts.samples, facts.duration, facts.rate),
      ""};
}

}  // namespace gapscope::internal::inspection

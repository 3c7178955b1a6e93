#include "recording/csv_stream.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <utility>

#include "base/shown.h"
#include "gapscope/base/errors.h"
#include "recording/csv_row.h"
#include "recording/limits.h"
#include "recording/recorded_rows.h"
#include "recording/stream_resampler.h"

namespace gapscope {
namespace {

constexpr double kLongestPause = 1e6;  ///< between two rows that are brought to a rate [samples of it]

}  // namespace

struct CsvStream::State {
  std::string name, line;  // the line that has not ended yet
  internal::recording::CsvRow row;
  internal::recording::RecordedRows first;  // rows until the clock is known
  double start = 0.0, dt = 0.0, last = 0.0;
  std::vector<Sample> samples;
  std::optional<internal::recording::StreamResampler> resampler = {};
  std::size_t rows = 0;

  void take_line(std::string_view text) {
    if (!row.next(text)) return;
    const Sample s{row.time(), row.input(), row.position()};
    require_number(row.columns().time, s.t);
    if (row.has_input()) require_number(row.columns().input, s.u);
    require_number(row.columns().position, s.x1);
    if (resampler) return bring_to_rate(s);
    if (dt > 0.0) return go_on(s);
    if (first.size() > 0) require_later(s, first.t.back());
    first.t.push_back(s.t), first.u.push_back(s.u), first.x1.push_back(s.x1);
    first.line.push_back(row.line());
    if (first.size() == kClockRows) set_clock();
  }

  void require_number(const std::string& column, double value) const {
    if (!std::isnan(value)) return;
    const std::string text = row.text_of(column);
    row.fail(fmt::format("{} is {}, expected a finite number", column, text.empty() ? "empty" : shown(text)));
  }

  void require_later(const Sample& s, double before) const {
    if (!(s.t > before))
      row.fail(fmt::format("{} goes from {} to {} s, expected time that increases from row to row",
                           row.columns().time, before, s.t));
  }

  void bring_to_rate(const Sample& s) {
    if (rows > 0) require_later(s, last);
    if (rows > 0 && s.t - last > kLongestPause * dt)
      row.fail(fmt::format("a pause of {:.4g} s, expected at most {:.4g} s between two rows", s.t - last,
                           kLongestPause * dt));
    resampler->take(s, samples);
    start = resampler->start(), last = s.t;
    ++rows;
  }

  void require_uniform() const {
    if (internal::recording::is_uniform(first)) return;
    const std::size_t worst = internal::recording::worst_step(first);
    const double step = first.t[worst] - first.t[worst - 1], mean = internal::recording::mean_step(first);
    first.fail(
        first.line[worst],
        fmt::format("time is not uniform: a step of {:.6g} ms, {:.3g} % off the mean of {:.6g} ms, "
                    "expected every step within 0.1 % of the mean, or --resample RATE (here about {:.4g} Hz)",
                    1e3 * step, 100.0 * std::abs(step - mean) / mean, 1e3 * mean, 1.0 / mean));
  }

  void set_clock() {
    require_uniform();
    const std::vector<double> t = first.t;
    const Recording r = internal::recording::uniform_recording(std::move(first));
    start = r.start, dt = r.dt, last = t.back();
    for (std::size_t i = 0; i < t.size(); ++i) samples.push_back({t[i], r.u[i], r.x1[i]});
    first = {};
  }

  void go_on(const Sample& s) {
    const double step = s.t - last;
    if (!(std::abs(step - dt) <= internal::recording::kUniformTolerance * dt))
      row.fail(fmt::format(
          "time is not uniform: a step of {:.6g} ms, expected {:.6g} ms as before, within 0.1 %, or --resample RATE",
          1e3 * step, 1e3 * dt));
    last = s.t;
    samples.push_back(s);
  }

  void require_end(std::size_t length) const {
    if (length > kLongestLine)
      throw ConfigError(name, row.line() + 1,
                        fmt::format("a line of more than {} characters, expected a CSV", kLongestLine));
  }
};

CsvStream::CsvStream(std::string name, const RecordingColumns& columns, double resample_rate)
    : state_(new State{name, "", {name, columns}, {}, 0.0, 0.0, 0.0, {}}) {
  state_->first.path = name;
  if (!(resample_rate > 0.0)) return;
  state_->dt = 1.0 / resample_rate;
  state_->resampler.emplace(resample_rate);
}

CsvStream::~CsvStream() = default;

void CsvStream::feed(std::string_view text) {
  State& s = *state_;
  for (auto end = text.find('\n'); end != text.npos; end = text.find('\n')) {
    s.require_end(s.line.size() + end);
    s.line.append(text.substr(0, end));
    text.remove_prefix(end + 1);
    const std::string line = std::exchange(s.line, {});
    s.take_line(line);
  }
  s.require_end(s.line.size() + text.size());
  s.line.append(text);
}

void CsvStream::finish() {
  State& s = *state_;
  if (!s.line.empty()) s.take_line(std::exchange(s.line, {}));
  s.row.require_header();
  if (s.resampler) s.resampler->finish(s.samples);
  const std::size_t rows = s.resampler ? s.rows : s.first.size();
  if (s.dt > 0.0 && !(s.resampler && rows < kFewestSamples)) return;
  if (rows < kFewestSamples)
    throw ConfigError(s.name, fmt::format("{} samples, expected at least {}", rows, kFewestSamples));
  s.set_clock();
}

bool CsvStream::has_clock() const { return state_->dt > 0.0 && (!state_->resampler || state_->rows > 0); }
double CsvStream::start() const { return state_->start; }
double CsvStream::dt() const { return state_->dt; }
std::vector<CsvStream::Sample> CsvStream::take() { return std::exchange(state_->samples, {}); }

}  // namespace gapscope

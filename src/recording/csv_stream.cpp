#include "gapscope/recording/csv_stream.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "gapscope/base/errors.h"
#include "recording/csv_row.h"
#include "recording/limits.h"
#include "recording/recorded_rows.h"

namespace gapscope {

struct CsvStream::State {
  std::string name, line;  // the line that has not ended yet
  internal::recording::CsvRow row;
  internal::recording::RecordedRows first;  // rows until the clock is known
  double start = 0.0, dt = 0.0, last = 0.0;
  std::vector<Sample> samples;

  void take_line(std::string_view text) {
    if (!row.next(text)) return;
    const Sample s{row.time(), row.input(), row.position()};
    if (dt > 0.0) return go_on(s);
    if (first.size() > 0 && !(s.t > first.t.back()))
      row.fail(fmt::format("{} goes from {} to {} s, expected time that increases from row to row",
                           row.columns().time, first.t.back(), s.t));
    first.t.push_back(s.t), first.u.push_back(s.u), first.x1.push_back(s.x1);
    first.line.push_back(row.line());
    if (first.size() == kClockRows) set_clock();
  }

  void set_clock() {
    const std::vector<double> t = first.t;
    const Recording r = internal::recording::uniform_recording(std::move(first));
    start = r.start, dt = r.dt, last = t.back();
    for (std::size_t i = 0; i < t.size(); ++i) samples.push_back({t[i], r.u[i], r.x1[i]});
    first = {};
  }

  void go_on(const Sample& s) {
    const double step = s.t - last;
    if (!(std::abs(step - dt) <= internal::recording::kUniformTolerance * dt))
      row.fail(
          fmt::format("time is not uniform: a step of {:.6g} ms, expected {:.6g} ms as before, within 0.1 %",
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

CsvStream::CsvStream(std::string name, const RecordingColumns& columns)
    : state_(new State{name, "", {name, columns}, {}, 0.0, 0.0, 0.0, {}}) {
  state_->first.path = name;
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
  if (s.dt > 0.0) return;
  if (s.first.size() < kFewestSamples)
    throw ConfigError(s.name,
                      fmt::format("{} samples, expected at least {}", s.first.size(), kFewestSamples));
  s.set_clock();
}

bool CsvStream::has_clock() const { return state_->dt > 0.0; }
double CsvStream::start() const { return state_->start; }
double CsvStream::dt() const { return state_->dt; }
std::vector<CsvStream::Sample> CsvStream::take() { return std::exchange(state_->samples, {}); }

}  // namespace gapscope

#include "gapscope/inspection/inspection.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/shown.h"
#include "gapscope/base/errors.h"
#include "gapscope/recording/recording_file.h"
#include "inspection/rules.h"
#include "recording/resample.h"
#include "signals/encoder.h"

namespace gapscope {
namespace {

using internal::inspection::Material;
using internal::recording::RecordedRows;

using Rule = Finding (*)(const Material&, RecordingFacts&);

/// In the order in which they are told: what the others rest on comes first.
constexpr Rule kRules[] = {internal::inspection::check_time,     internal::inspection::check_position_unit,
                           internal::inspection::check_encoder,  internal::inspection::check_jumps,
                           internal::inspection::check_hold,     internal::inspection::check_travel,
                           internal::inspection::check_periods,  internal::inspection::check_speed,
                           internal::inspection::check_rest,     internal::inspection::check_input,
                           internal::inspection::check_clipping, internal::inspection::check_spectrum,
                           internal::inspection::check_sign,     internal::inspection::check_scale,
                           internal::inspection::check_feedback, internal::inspection::check_repeats};

/// A grid at the median step, but never many times finer than the rows: one row far off must not fill the
/// memory.
double grid_rate(const RecordedRows& rows) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < rows.size(); ++i) steps.push_back(rows.t[i] - rows.t[i - 1]);
  return std::min(1.0 / median(std::move(steps)), 4.0 / internal::recording::mean_step(rows));
}

Recording on_grid(RecordedRows rows, const ReadOptions& options) {
  // An integral steps by no encoder.
  const double quantum = rows.integrated ? 0.0 : internal::signals::quantum_or_least_step(rows.x1);
  Recording r = options.resample_rate ? internal::recording::resample(rows, *options.resample_rate)
                : internal::recording::is_uniform(rows)
                    ? internal::recording::uniform_recording(RecordedRows(rows))
                    : internal::recording::resample(rows, grid_rate(rows));
  if (r.size() < kFewestSamples)
    throw ConfigError(rows.path, fmt::format("{} samples after resampling, expected at least {}", r.size(),
                                             kFewestSamples));
  r.quantum = quantum;
  return r;
}

/// The numbers in the input's column; where the rows have a unit or a supply, the file is read for them.
std::vector<double> as_it_stands(const RecordedRows& rows, const std::string& path, ReadOptions options) {
  RecordingColumns& columns = options.columns;
  const UnitScale& unit = columns.scales.input;
  if (!columns.reads_input() || unit.form.is_one()) return {};
  if (columns.voltage.empty() && unit.factor == unit.divisor) return rows.u;
  columns.voltage.clear();
  columns.scales.input = {};
  return internal::recording::read_window(path, options, internal::recording::EarlierRow::kSkipped).u;
}

/// What the supply's voltage multiplies; empty: u is no such product.
std::vector<double> without_voltage(const std::string& path, ReadOptions options) {
  if (options.columns.voltage.empty()) return {};
  options.columns.voltage.clear();
  return internal::recording::read_window(path, options, internal::recording::EarlierRow::kSkipped).u;
}

std::string wrapped(const std::string& text, std::size_t indent) {
  constexpr std::size_t kWidth = 110;
  std::string out, line;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    const std::string word = text.substr(at, end - at);
    if (!line.empty() && indent + line.size() + 1 + word.size() > kWidth) {
      out += line + "\n" + std::string(indent, ' ');
      line.clear();
    }
    line += (line.empty() ? "" : " ") + word;
    at = end + 1;
  }
  return out + line;
}

std::string sum_of(const Inspection& inspection) {
  std::vector<std::string> spoiling;
  std::size_t notes = 0;
  for (const Finding& f : inspection.findings) {
    if (f.severity == Severity::kSpoils) spoiling.push_back(f.rule);
    notes += f.severity == Severity::kNote;
  }
  const std::size_t all = inspection.findings.size();
  const bool any = inspection.purpose == Purpose::kAll;
  const std::string asked = any ? "" : fmt::format(", for {}", to_string(inspection.purpose));
  if (spoiling.empty())
    return fmt::format("{} checks{}: {} passed, {}", all, asked, all - notes,
                       notes == 1 ? "1 note" : fmt::format("{} notes", notes));
  return fmt::format("{} of {} checks{} found what spoils {}: {}", spoiling.size(), all, asked,
                     any ? "the estimates" : "the answer", fmt::join(spoiling, ", "));
}

}  // namespace

const char* to_string(Severity severity) {
  return severity == Severity::kFine ? "fine" : severity == Severity::kNote ? "note" : "spoils";
}

bool Inspection::spoilt() const {
  return std::any_of(findings.begin(), findings.end(),
                     [](const Finding& f) { return f.severity == Severity::kSpoils; });
}

std::string Inspection::report() const {
  constexpr std::size_t kIndent = 27;
  std::string text = fmt::format("{:<12}{}\n", "recording", printable(file));
  for (const Finding& f : findings) {
    text +=
        fmt::format("{:<12}{:<15}{}\n", to_string(f.severity), f.rule, wrapped(printable(f.found), kIndent));
    if (!f.advice.empty())
      text += std::string(kIndent, ' ') + wrapped("-> " + printable(f.advice), kIndent + 3).append("\n");
  }
  return text + fmt::format("{:<12}{}\n", "answer", sum_of(*this));
}

Inspection inspect(const std::string& path, const ReadOptions& options, Coordinates coordinates) {
  Material m;
  m.rows = internal::recording::read_window(path, options, internal::recording::EarlierRow::kSkipped);
  m.register_input = as_it_stands(m.rows, path, options);
  m.duty = without_voltage(path, options);
  const UnitScale& position = options.columns.scales.position;
  m.position_unit = position.factor / position.divisor;
  m.commanded = !options.columns.reads_input();
  m.recording = on_grid(m.rows, options);
  m.resampled = options.resample_rate.has_value();
  m.coordinates = coordinates;
  if (options.columns.rate > 0.0) m.named_rate = named_rate(path, options.columns);
  m.signal = internal::signals::read_facts(m.recording.motor_trace());
  Inspection inspection;
  inspection.file = path;
  inspection.coordinates = coordinates;
  inspection.assumed = m.rows.assumed;
  for (const Rule rule : kRules) inspection.findings.push_back(rule(m, inspection.facts));
  return inspection;
}

}  // namespace gapscope

#include "results/traces.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string_view>

#include "base/input_file.h"
#include "base/shown.h"
#include "gapscope/base/errors.h"

namespace gapscope {

std::string trace_name(std::size_t index, const std::string& recording_file) {
  std::string stem = std::filesystem::path(recording_file).stem().string();
  for (char& c : stem)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-' && c != '_') c = '_';
  return "traces/" + std::to_string(index + 1) + "_" + (stem.empty() ? "recording" : stem) + ".csv";
}

namespace internal::results {
namespace {

constexpr std::uintmax_t kLargestTable = std::uintmax_t{16} << 30;  ///< of the longest recording that is read

constexpr Mode kModes[] = {Mode::kGap, Mode::kEngagementPlus, Mode::kEngagementMinus, Mode::kImpact,
                           Mode::kOneBody};

/// A column of a set, to read from and to fill.
template <class Value>
struct TraceColumn {
  const char* name;
  const std::vector<Value>& (*of)(const TraceSet&);
  std::vector<Value>& (*into)(TraceSet&);
};
using NumberColumn = TraceColumn<double>;
using ModeColumn = TraceColumn<Mode>;

template <class Value, class Place>
constexpr TraceColumn<Value> column(const char* name, Place) {
  return {name, [](const TraceSet& s) -> const std::vector<Value>& { return Place()(s); },
          [](TraceSet& s) -> std::vector<Value>& { return Place()(s); }};
}

constexpr const char* kPredictedMotor = "fit_predicted_x1_rad";
constexpr const char* kPredictedLoad = "fit_predicted_x2_rad";

/// The numbers of a set in their order in the file, after t_s.
constexpr NumberColumn kNumbers[] = {
    column<double>(
        "u", [](auto& s) -> auto& { return s.recording.u; }),
    column<double>(
        "x1_rad", [](auto& s) -> auto& { return s.recording.x1; }),
    column<double>(
        "x2_rad", [](auto& s) -> auto& { return s.recording.x2; }),
    column<double>(
        "e_x_rad", [](auto& s) -> auto& { return s.error.error; }),
    column<double>(
        "w1_hat_rad_s", [](auto& s) -> auto& { return s.error.velocity; }),
    column<double>(
        "fit_x1_rad", [](auto& s) -> auto& { return s.fit.x1; }),
    column<double>(
        kPredictedMotor, [](auto& s) -> auto& { return s.fit.predicted; }),
    column<double>(
        kPredictedLoad, [](auto& s) -> auto& { return s.fit.predicted; }),
    column<double>(
        "fit_x2_rad", [](auto& s) -> auto& { return s.fit.x2; }),
    column<double>(
        "error_before_rad", [](auto& s) -> auto& { return s.error_before; }),
    column<double>(
        "error_after_rad", [](auto& s) -> auto& { return s.error_after; }),
    column<double>(
        "torque_before_nm", [](auto& s) -> auto& { return s.torque_before; }),
    column<double>(
        "torque_after_nm", [](auto& s) -> auto& { return s.torque_after; }),
    column<double>(
        "simulator_x1_rad", [](auto& s) -> auto& { return s.simulator; }),
    column<double>(
        "stand_in_x1_rad", [](auto& s) -> auto& { return s.stand_in; }),
    column<double>(
        "mended_x1_rad", [](auto& s) -> auto& { return s.mended; }),
    column<double>(
        "target_rad", [](auto& s) -> auto& { return s.target; }),
    column<double>(
        "supply", [](auto& s) -> auto& { return s.supply; }),
    column<double>(
        "simulated_before_rad", [](auto& s) -> auto& { return s.simulated_before; }),
    column<double>(
        "simulated_after_rad", [](auto& s) -> auto& { return s.simulated_after; }),
};
constexpr ModeColumn kModeColumns[] = {
    column<Mode>(
        "mode", [](auto& s) -> auto& { return s.recording.mode; }),
    column<Mode>(
        "fit_mode", [](auto& s) -> auto& { return s.fit.mode; }),
};

void append(std::string& text, double value) {
  if (std::isnan(value)) return;
  char digits[32];
  const auto end = std::to_chars(digits, digits + sizeof digits, value);
  text.append(digits, end.ptr);
}

/// The filled columns of a set.
struct Columns {
  std::vector<NumberColumn> numbers;
  std::vector<ModeColumn> modes;
};

Columns filled_columns(const TraceSet& set) {
  const std::size_t n = set.recording.size();
  Columns filled;
  const bool load = set.recording.encoder == EncoderSide::kLoad;
  const char* const of_other_side = load ? kPredictedMotor : kPredictedLoad;
  const auto keep = [&](const auto& column, auto& into) {
    if (column.name == of_other_side) return;
    const std::size_t length = column.of(set).size();
    if (length != 0 && length != n)
      throw std::logic_error(set.recording.file + ": column " + column.name + " has another length than x1");
    if (length != 0) into.push_back(column);
  };
  for (const NumberColumn& column : kNumbers) keep(column, filled.numbers);
  for (const ModeColumn& column : kModeColumns) keep(column, filled.modes);
  return filled;
}

constexpr std::size_t kPiece = std::size_t{1} << 20;  ///< of a table that is held before it is written [B]

void write_rows(std::ostream& out, const TraceSet& set) {
  const Columns columns = filled_columns(set);
  std::string text = "t_s";
  for (const NumberColumn& column : columns.numbers) text += std::string(",") + column.name;
  for (const ModeColumn& column : columns.modes) text += std::string(",") + column.name;
  text += '\n';
  for (std::size_t i = 0; i < set.recording.size(); ++i) {
    append(text, set.recording.time(i));
    for (const NumberColumn& column : columns.numbers) append(text += ',', column.of(set)[i]);
    for (const ModeColumn& column : columns.modes) (text += ',') += to_string(column.of(set)[i]);
    text += '\n';
    if (text.size() < kPiece) continue;
    out << text;
    text.clear();
  }
  out << text;
}

/// Cuts the next field off a line.
std::string_view next_field(std::string_view& line) {
  const std::size_t comma = line.find(',');
  const std::string_view field = line.substr(0, comma);
  line = comma == std::string_view::npos ? std::string_view() : line.substr(comma + 1);
  return field;
}

double number_of(std::string_view field) {
  double value = kNaN;
  if (field.empty()) return value;
  const auto end = std::from_chars(field.data(), field.data() + field.size(), value);
  if (end.ec != std::errc() || end.ptr != field.data() + field.size())
    throw std::invalid_argument(shown(field) + " is no number, expected one or nothing");
  return value;
}

Mode mode_of(std::string_view field) {
  for (const Mode mode : kModes)
    if (field == to_string(mode)) return mode;
  throw std::invalid_argument(shown(field) + " is no mode, expected gap, engagement+ or -, impact, one_body");
}

template <class Column>
bool holds(const std::vector<Column>& columns, std::string_view name) {
  return std::any_of(columns.begin(), columns.end(), [&](const Column& c) { return name == c.name; });
}

Columns columns_of_header(std::string_view header, EncoderSide encoder) {
  Columns columns;
  if (next_field(header) != "t_s")
    throw std::invalid_argument("the first column is not t_s, expected a stored trace");
  while (!header.empty()) {
    const std::string_view name = next_field(header);
    const std::size_t before = columns.numbers.size() + columns.modes.size();
    for (const NumberColumn& column : kNumbers)
      if (name == column.name && !holds(columns.numbers, name)) columns.numbers.push_back(column);
    for (const ModeColumn& column : kModeColumns)
      if (name == column.name && !holds(columns.modes, name)) columns.modes.push_back(column);
    if (columns.numbers.size() + columns.modes.size() == before)
      throw std::invalid_argument("there is a column " + shown(name) +
                                  ", expected only those of a stored trace, each once");
  }
  for (const char* needed : {"u", encoder == EncoderSide::kLoad ? "x2_rad" : "x1_rad"})
    if (!holds(columns.numbers, needed))
      throw std::invalid_argument(std::string("there is no column ") + needed +
                                  ", expected one in every trace");
  return columns;
}

void read_row(std::string_view line, const Columns& columns, TraceSet& set) {
  const auto commas = static_cast<std::size_t>(std::count(line.begin(), line.end(), ','));
  if (commas != columns.numbers.size() + columns.modes.size())
    throw std::invalid_argument("has " + std::to_string(commas + 1) + " fields, expected " +
                                std::to_string(1 + columns.numbers.size() + columns.modes.size()) +
                                " as in the header");
  set.recording.stamps.push_back(number_of(next_field(line)));
  for (const NumberColumn& column : columns.numbers) column.into(set).push_back(number_of(next_field(line)));
  for (const ModeColumn& column : columns.modes) column.into(set).push_back(mode_of(next_field(line)));
}

/// Drops the stamps of a recording that is even, whose t_s is start + i dt.
/// @throws std::invalid_argument unless the others increase
void settle_stamps(Recording& r) {
  constexpr double kRounding = 1e-6;  // steps
  std::vector<double> stamps = std::move(r.stamps);
  r.stamps.clear();
  bool even = true;
  for (std::size_t i = 0; i < stamps.size(); ++i)
    even = even && std::abs(stamps[i] - r.time(i)) <= kRounding * r.dt + 1e-15 * std::abs(stamps[i]);
  if (even) return;
  for (std::size_t i = 0; i < stamps.size(); ++i)
    if (!std::isfinite(stamps[i]) || (i > 0 && !(stamps[i] > stamps[i - 1])))
      throw std::invalid_argument("t_s does not increase, expected the time of each sample");
  r.stamps = std::move(stamps);
}

}  // namespace

std::vector<StoredColumn> columns_of(TraceSet set) {
  const Columns filled = filled_columns(set);
  std::vector<StoredColumn> columns = {{"t_s", {}, {}}};
  for (std::size_t i = 0; i < set.recording.size(); ++i)
    columns.front().numbers.push_back(set.recording.time(i));
  for (const NumberColumn& column : filled.numbers)
    columns.push_back({column.name, std::move(column.into(set)), {}});
  for (const ModeColumn& column : filled.modes)
    columns.push_back({column.name, {}, std::move(column.into(set))});
  return columns;
}

TraceSink into_folder(const std::string& folder) {
  return [folder](const std::string& name, const TraceSet& set) { write_trace(folder + "/" + name, set); };
}

TraceSink into_tables(std::vector<StoredTable>& tables) {
  return [&tables](const std::string& name, TraceSet set) {
    tables.push_back({name, columns_of(std::move(set))});
  };
}

void write_trace(const std::string& path, const TraceSet& set) {
  std::ofstream out(path, std::ios::binary);
  write_rows(out, set);
  if (!out.flush()) throw std::runtime_error(path + ": cannot be written");
}

std::ifstream open_table(const std::string& path, const char* what) {
  namespace fs = std::filesystem;
  std::error_code problem;
  const std::string expected = std::string("the ") + what + " that the stored result names";
  std::ifstream in = open_input_file(path, expected);
  if (fs::file_size(path, problem) > kLargestTable)
    throw ConfigError(path, "is larger than 16 GiB, expected " + expected);
  return in;
}

void read_trace(const std::string& path, TraceSet& set) {
  std::ifstream in = open_table(path, "trace");
  Columns columns;
  int line = 0;
  for (std::string row; std::getline(in, row);) {
    ++line;
    try {
      if (line == 1)
        columns = columns_of_header(row, set.recording.encoder);
      else
        read_row(row, columns, set);
    } catch (const std::invalid_argument& error) {
      throw ConfigError(path, line, error.what());
    }
  }
  if (line == 0) throw ConfigError(path, "is empty, expected a stored trace");
  try {
    settle_stamps(set.recording);
  } catch (const std::invalid_argument& error) {
    throw ConfigError(path, error.what());
  }
}

}  // namespace internal::results
}  // namespace gapscope

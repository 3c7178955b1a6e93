#include "inspection/column_guess.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <tuple>

#include "base/shown.h"
#include "base/text.h"
#include "gapscope/base/errors.h"
#include "gapscope/base/statistics.h"
#include "inspection/column_words.h"
#include "recording/axes.h"
#include "recording/column_name.h"
#include "recording/recorded_rows.h"
#include "recording/register_look.h"
#include "recording/table_form.h"

namespace gapscope {
namespace {

using internal::inspection::ColumnRole;
using internal::inspection::likeness;
using internal::inspection::shared_words;
using internal::inspection::sidedness;
using internal::recording::FieldKind;
using internal::recording::kind_of_field;
using internal::recording::TableForm;

/// A file's columns as they are looked at.
struct Seen {
  TableForm form;  ///< of a text
  std::vector<std::string> names;
  bool is_text = false;

  bool named() const { return !is_text || form.header > 0; }
  bool has(const std::string& name) const { return contains(names, name); }
};

Seen seen_in(const std::string& path) {
  Seen seen;
  seen.names = recorded_names(path);
  seen.is_text = internal::recording::is_text_table(path);
  if (seen.is_text) seen.form = internal::recording::table_of(path);
  return seen;
}

/// Place of a name in the header of a text; -1: none.
int place_in(const TableForm& form, const std::string& name) {
  const auto found = std::find(form.names.begin(), form.names.end(), name);
  if (found != form.names.end()) return static_cast<int>(found - form.names.begin());
  int at = 0;
  const auto [end, problem] = std::from_chars(name.data(), name.data() + name.size(), at);
  const bool whole = problem == std::errc() && end == name.data() + name.size();
  return whole && at >= 1 && at <= static_cast<int>(form.names.size()) ? at - 1 : -1;
}

std::vector<std::string> fields_of(const TableForm& form, int place) {
  std::vector<std::string> fields;
  for (const auto& row : form.rows)
    if (place >= 0 && static_cast<std::size_t>(place) < row.size())
      fields.push_back(row[static_cast<std::size_t>(place)]);
  return fields;
}

/// The numbers of the first rows, those of a clock in their unit.
std::vector<double> numbers_of(const TableForm& form, int place) {
  std::vector<double> numbers;
  for (std::string text : fields_of(form, place)) {
    std::replace(text.begin(), text.end(), ',', '.');
    double value = 0.0;
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (problem == std::errc() && end == text.data() + text.size()) numbers.push_back(value);
  }
  return numbers;
}

bool has_numbers(const Seen& seen, const std::string& name) {
  if (!seen.is_text) return true;
  const int place = place_in(seen.form, name);
  if (place < 0) return true;  // an element of a list
  const auto fields = fields_of(seen.form, place);
  return std::any_of(fields.begin(), fields.end(), [&](const std::string& field) {
    const FieldKind kind = kind_of_field(field);
    return kind == FieldKind::kNumber || kind == FieldKind::kStamp;
  });
}

/// The column whose name says the role best, of these one that is of the side and none of the other, and of
/// these the one that shares most words with `beside`.
std::string by_name(const Seen& seen, ColumnRole role, EncoderSide side, const std::string& beside,
                    const std::vector<std::string>& taken) {
  std::string best;
  std::tuple<int, int, int> rank;
  for (const std::string& name : seen.names) {
    if (contains(taken, name) || !has_numbers(seen, name)) continue;
    const std::tuple now = {likeness(name, role), sidedness(name, side),
                            beside.empty() ? 0 : shared_words(name, beside)};
    if (std::get<0>(now) > 0 && (best.empty() || now > rank)) rank = now, best = name;
  }
  return best;
}

/// Whether a column stays at a level, as a supply's voltage does beside the goal that a servo follows.
bool stays(const Seen& seen, const std::string& name) {
  constexpr double kStays = 0.1;  ///< of the level: what a load takes of a supply
  const auto x = seen.is_text ? numbers_of(seen.form, place_in(seen.form, name)) : std::vector<double>();
  if (x.empty()) return false;
  const auto [low, high] = std::ranges::minmax(x);
  return high - low < kStays * std::abs(low);
}

/// Whether numbers go on by nearly the same, which positions and torques seldom do.
bool are_even(const std::vector<double>& x) {
  constexpr double kEven = 0.2;  ///< of the median step: what clocks of loggers jitter
  std::vector<double> steps;
  for (std::size_t i = 1; i < x.size(); ++i) steps.push_back(x[i] - x[i - 1]);
  const double usual = steps.empty() ? 0.0 : median(steps);
  return usual > 0.0 && std::all_of(steps.begin(), steps.end(),
                                    [=](double step) { return std::abs(step - usual) < kEven * usual; });
}

/// Whether numbers count the rows, in no unit of time.
bool count_rows(const std::vector<double>& x) {
  return std::adjacent_find(x.begin(), x.end(), [](double a, double b) { return b - a != 1.0; }) == x.end();
}

/// Where no name says which column has the time: the last one without another meaning that rises evenly.
std::string even_column(const Seen& seen) {
  std::string even;
  for (std::size_t i = 0; i < seen.form.names.size(); ++i) {
    const std::string& name = seen.form.names[i];
    const auto is = [&](ColumnRole role) { return likeness(name, role) > 0; };
    if (is(ColumnRole::kInput) || is(ColumnRole::kPosition) || is(ColumnRole::kSpeed) ||
        is(ColumnRole::kTarget))
      continue;
    const auto x = numbers_of(seen.form, static_cast<int>(i));
    const bool of_time = !unit_in_name(name, Quantity::kTime).empty() || !seen.form.units.empty();
    if (x.size() > 2 && x.size() == seen.form.rows.size() && are_even(x) && (of_time || !count_rows(x)))
      even = name;
  }
  return even;
}

/// Of a table without names: the first column that rises from row to row.
std::string rising_column(const Seen& seen) {
  for (std::size_t i = 0; i < seen.form.names.size(); ++i) {
    const auto fields = fields_of(seen.form, static_cast<int>(i));
    if (!fields.empty() && kind_of_field(fields.front()) == FieldKind::kStamp) return seen.form.names[i];
    const auto x = numbers_of(seen.form, static_cast<int>(i));
    if (x.size() < 3 || x.size() != fields.size()) continue;
    const auto falls = std::adjacent_find(x.begin(), x.end(), [](double a, double b) { return !(b > a); });
    if (falls == x.end()) return seen.form.names[i];
  }
  return "";
}

std::string listed(const Seen& seen) {
  constexpr std::size_t kMost = 12;
  std::vector<std::string> all;
  for (std::size_t i = 0; i < std::min(kMost, seen.names.size()); ++i)
    all.push_back(seen.is_text && seen.named() && i < seen.form.names.size()
                      ? fmt::format("{} {}", i + 1, shown(seen.names[i]))
                      : shown(seen.names[i]));
  return all.empty() ? "none"
                     : fmt::format("{}{}", fmt::join(all, ", "), seen.names.size() > kMost ? ", ..." : "");
}

[[noreturn]] void refuse(const std::string& path, const Seen& seen, const char* what, const char* remedy) {
  const std::string at =
      seen.is_text && seen.form.header > 0 ? fmt::format("{}:{}", path, seen.form.header) : path;
  throw ConfigError(fmt::format("{}: no column is seen to be the {} among {}, expected its name or place: {}",
                                at, what, listed(seen), remedy));
}

/// The unit of a time without one, by how it goes on: drives are not recorded once in a second.
std::string unit_by_steps(const std::vector<double>& t) {
  constexpr double kLongestSecond = 1.0, kLongest = 0.064;  ///< from row to row [s]
  std::vector<double> steps;
  for (std::size_t i = 1; i < t.size(); ++i)
    if (t[i] != t[i - 1]) steps.push_back(std::abs(t[i] - t[i - 1]));
  if (steps.size() < 3) return "";
  const double step = median(std::move(steps));
  if (step < kLongestSecond) return "";
  const bool ticks = std::abs(t.front()) > 1e17 && std::abs(t.front()) < 9e17;  // since 1601, or the year 1
  if (ticks) return "100ns";
  for (const auto& [unit, size] : {std::pair{"ms", 1e-3}, {"us", 1e-6}, {"ns", 1e-9}})
    if (step * size <= kLongest) return unit;
  return "";
}

void say(ColumnGuess& guess, const char* code, const char* words, std::vector<Remark::Value> values) {
  guess.told.emplace_back(code, words, std::move(values));
}

/// What stands below the names, of a column that has no unit in its name and none declared.
void take_unit(const Seen& seen, const std::string& column, std::initializer_list<Quantity> quantities,
               std::string& unit, ColumnGuess& guess) {
  const int place = place_in(seen.form, column);
  if (!unit.empty() || column.empty() || place < 0 ||
      static_cast<std::size_t>(place) >= seen.form.units.size())
    return;
  std::string below = seen.form.units[static_cast<std::size_t>(place)];
  if (below.starts_with('[') || below.starts_with('(')) below = below.substr(1, below.size() - 2);
  for (const Quantity quantity : quantities) {
    if (unit.empty()) unit = unit_in_name("x [" + below + "]", quantity);
  }
  if (!unit.empty()) say(guess, "unit.below_name", "{} in {}", {shown(column), unit});
}

bool are_whole(const std::vector<double>& x) {
  return x.size() > 2 && std::any_of(x.begin(), x.end(), [&](double v) { return v != x.front(); }) &&
         std::all_of(x.begin(), x.end(), [](double v) { return v == std::round(v); });
}

/// All numbers of a column as they stand.
std::vector<double> all_of(const std::string& path, const std::string& column) {
  RecordingColumns by_row;
  by_row.rate = 1.0;
  return internal::recording::column_numbers(path, column, by_row);
}

void take_units(const std::string& path, const Seen& seen, bool rated, ColumnGuess& guess) {
  const auto is_whole = [&](const std::string& column) {
    return seen.is_text && are_whole(numbers_of(seen.form, place_in(seen.form, column)));
  };
  guess.whole_positions = is_whole(guess.position);
  if (is_whole(guess.input)) guess.input_form = seen_register(all_of(path, guess.input));
  if (guess.whole_positions) guess.position_form.bits = seen_register(all_of(path, guess.position)).bits;
  take_unit(seen, guess.time, {Quantity::kTime}, guess.time_unit, guess);
  take_unit(seen, guess.input, {Quantity::kTorque, Quantity::kForce}, guess.input_unit, guess);
  take_unit(seen, guess.position, {Quantity::kAngle, Quantity::kLength}, guess.position_unit, guess);
  take_unit(seen, guess.speed, {Quantity::kTurning, Quantity::kSliding}, guess.speed_unit, guess);
  // That of an array called t is the second.
  if (rated || !guess.time_unit.empty() || !unit_in_name(guess.time, Quantity::kTime).empty() ||
      (!seen.is_text && guess.time == "t"))
    return;
  const std::string unit = unit_by_steps(seen.is_text ? numbers_of(seen.form, place_in(seen.form, guess.time))
                                                      : all_of(path, guess.time));
  if (unit.empty()) return;
  guess.time_unit = unit;
  say(guess, "unit.by_steps", "{} in {}, as it goes on", {shown(guess.time), unit});
}

/// What is in each field of a column that is a list: its first element.
std::string element_of(const Seen& seen, const std::string& name) {
  return seen.has(name + "[:, 0]") ? name + "[:, 0]" : name;
}

void take_by_order(const Seen& seen, bool rated, ColumnGuess& guess, const std::string& path) {
  if (!rated && guess.time.empty()) guess.time = rising_column(seen);
  std::vector<std::string> left;
  for (const std::string& name : seen.names)
    if (name != guess.time && name != guess.input && name != guess.position && has_numbers(seen, name))
      left.push_back(name);
  const bool none =
      guess.input.empty() && guess.position.empty() && guess.speed.empty() && guess.target.empty();
  if (!rated && guess.time.empty())
    refuse(path, seen, "time", "--time NAME, or --rate HZ where there is none");
  if (!none || left.size() != 2)
    refuse(path, seen, "input and the position",
           rated ? "--columns INPUT,POSITION" : "--columns TIME,INPUT,POSITION");
  guess.input = left[0], guess.position = left[1];
  say(guess, "columns.by_order", "{}input {}, position {}, by their order",
      {rated ? std::string() : "time " + shown(guess.time) + ", ", shown(guess.input),
       shown(guess.position)});
}

void take_by_name(const Seen& seen, bool rated, ColumnGuess& guess, const std::string& path) {
  std::vector<std::string> told;
  const auto taken = [&] {
    return std::vector<std::string>{guess.time, guess.input, guess.position, guess.speed, guess.target};
  };
  const auto take = [&](std::string& column, ColumnRole role, const char* word, const std::string& beside) {
    if (!column.empty()) return;
    const EncoderSide side = role == ColumnRole::kInput ? EncoderSide::kMotor : guess.side;  // u drives it
    column = element_of(seen, by_name(seen, role, side, beside, taken()));
    if (!column.empty()) told.push_back(fmt::format("{} {}", word, shown(column)));
  };
  if (!rated) take(guess.time, ColumnRole::kTime, "time", "");
  if (!rated && guess.time.empty()) {
    guess.time = even_column(seen);
    if (!guess.time.empty()) say(guess, "time.rises", "time {}, which rises evenly", {shown(guess.time)});
  }
  if (guess.speed.empty()) take(guess.position, ColumnRole::kPosition, "position", guess.input);
  if (guess.position.empty()) take(guess.speed, ColumnRole::kSpeed, "speed", guess.input);
  const std::string& beside = guess.position.empty() ? guess.speed : guess.position;
  if (guess.target.empty() && guess.input.empty()) {
    const std::string input = by_name(seen, ColumnRole::kInput, EncoderSide::kMotor, beside, taken());
    const std::string target = by_name(seen, ColumnRole::kTarget, guess.side, beside, taken());
    if (target.empty() || !stays(seen, input)) take(guess.input, ColumnRole::kInput, "input", beside);
  }
  if (guess.input.empty()) take(guess.target, ColumnRole::kTarget, "target", beside);
  if (!rated && guess.time.empty())
    refuse(path, seen, "time", "--time NAME, or --rate HZ where there is none");
  if (beside.empty())
    refuse(path, seen, "position", "--position NAME, or --speed NAME, or --columns TIME,INPUT,POSITION");
  if (guess.input.empty() && guess.target.empty())
    refuse(path, seen, "input",
           "--input NAME of a torque, force, current, voltage or duty, or --target NAME, or "
           "--columns TIME,INPUT,POSITION");
  if (!told.empty())
    say(guess, "columns.by_name", "{}", {fmt::format("{}, by their names", fmt::join(told, ", "))});
}

}  // namespace

ColumnGuess guess_columns(const std::string& path, ColumnGuess guess, bool rated) {
  const Seen seen = seen_in(path);
  const bool complete = (rated || !guess.time.empty()) && !(guess.position.empty() && guess.speed.empty()) &&
                        !(guess.input.empty() && guess.target.empty());
  if (!complete && (seen.names.empty() || (seen.is_text && seen.form.first == 0))) return guess;
  if (!complete) (seen.named() ? take_by_name : take_by_order)(seen, rated, guess, path);
  take_units(path, seen, rated, guess);
  return guess;
}

NamedRate named_rate(const std::string& path, const RecordingColumns& columns) {
  const Seen seen = seen_in(path);
  if (!seen.named()) return {};
  ColumnGuess guess;
  guess.input = columns.input, guess.position = columns.position;
  guess.time =
      by_name(seen, ColumnRole::kTime, guess.side, "", {columns.input, columns.position, columns.target});
  if (guess.time.empty()) return {};
  take_units(path, seen, false, guess);
  const std::string named = unit_in_name(guess.time, Quantity::kTime);
  if (named.empty() && seen.is_text && count_rows(numbers_of(seen.form, place_in(seen.form, guess.time))))
    return {};  // milliseconds or the number of the row
  RecordingColumns timed = columns;
  timed.rate = 0.0, timed.time = guess.time;
  const std::string& unit = guess.time_unit.empty() ? named : guess.time_unit;
  if (const auto scale = unit_scale(Quantity::kTime, unit.empty() ? "s" : unit)) timed.scales.time = *scale;
  try {
    const auto rows = internal::recording::read_rows(path, timed, internal::recording::EarlierRow::kSkipped);
    if (rows.size() < 2) return {};
    const auto count = static_cast<double>(std::abs(rows.line.back() - rows.line.front()));
    return {guess.time, count / (rows.t.back() - rows.t.front())};
  } catch (const ConfigError&) {
    return {};  // whoever names a rate need not have a time that is read
  }
}

}  // namespace gapscope

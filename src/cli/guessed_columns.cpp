// What is taken for granted of a recording that is named on the command line.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/shown.h"
#include "base/text.h"
#include "cli/commands.h"
#include "cli/presets.h"
#include "gapscope/base/errors.h"
#include "inspection/column_guess.h"
#include "recording/axes.h"
#include "recording/column_name.h"

namespace gapscope::cli {
namespace {

/// "1,3,5": of the time, the input and the position; of the last two where the rows come at a rate.
void take_columns(RecordingArguments& a) {
  std::vector<std::string> all(1);
  int inside = 0;  // of brackets, as in "q[:, 0]"
  for (const char c : a.columns) {
    inside += c == '[' || c == '(' ? 1 : c == ']' || c == ')' ? -1 : 0;
    if (c == ',' && inside <= 0)
      all.emplace_back();
    else
      all.back() += c;
  }
  const std::size_t count = a.rate > 0.0 ? 2 : 3;
  if (all.size() != count || contains(all, ""))
    throw ConfigError(fmt::format("gapscope: --columns is {}, expected {} names or places between commas: {}",
                                  shown(a.columns), count,
                                  count == 3 ? "TIME,INPUT,POSITION" : "INPUT,POSITION"));
  if (count == 3) a.time = all.front();
  if (a.input.empty()) a.input = all[count - 2];
  if (a.position.empty() && a.speed.empty()) a.position = all[count - 1];
  a.columns.clear();
}

/// What is declared of the columns; the usual names are where the file has them.
ColumnGuess declared_columns(const RecordingArguments& a, const std::vector<std::string>& names) {
  const std::string usual = a.side == "load" ? "x2" : "x1";
  ColumnGuess g;
  if (a.time != "t" || contains(names, a.time)) g.time = a.time;
  g.input = a.input.empty() && a.target.empty() && contains(names, "u") ? "u" : a.input;
  g.speed = a.speed, g.target = a.target;
  // The motor's own name is never taken for the load's.
  const bool has_usual = contains(names, usual) || contains(names, "x1");
  g.position = a.position.empty() && a.speed.empty() && has_usual ? usual : a.position;
  g.time_unit = a.units.time, g.input_unit = a.units.input, g.position_unit = a.units.position;
  g.speed_unit = a.units.speed;
  return g;
}

/// Whether the position is a length by its unit, and no angle.
bool is_length(const ColumnGuess& g) {
  const auto is_only = [](const std::string& declared, const std::string& column, Quantity length,
                          Quantity angle) {
    const std::string of_length = declared.empty() ? unit_in_name(column, length) : declared;
    const std::string of_angle = declared.empty() ? unit_in_name(column, angle) : declared;
    const bool named = !of_length.empty() && !decimal(of_length);
    return named && unit_scale(length, of_length) && !(!of_angle.empty() && unit_scale(angle, of_angle));
  };
  return is_only(g.position_unit, g.position, Quantity::kLength, Quantity::kAngle) ||
         is_only(g.speed_unit, g.speed, Quantity::kSliding, Quantity::kTurning);
}

/// What is declared without a file is looked at before one is.
/// @throws ConfigError for a unit or a register that is not known
void require_known_units(const RecordingArguments& a) {
  RecordingArguments declared;
  declared.units = a.units, declared.registers = a.registers, declared.input_register = a.input_register;
  declared.bits = a.bits, declared.gear = a.gear, declared.side = a.side,
  declared.speed = a.speed.empty() ? "" : "w";
  ColumnGuess position;
  position.position_unit = a.units.position, position.speed_unit = a.units.speed;
  declared.translation = a.translation || is_length(position);
  declared.configuration();
}

void take_register(const RegisterForm& seen, const std::string& column, RegisterForm& declared,
                   std::vector<Remark>& told) {
  if (!seen.is_one() || declared.is_one()) return;
  declared = seen;
  if (seen.sign_bit > 0)
    told.emplace_back("register.sign_bit", "bit {} of {} is its sign",
                      std::vector<Remark::Value>{static_cast<long>(seen.sign_bit), shown(column)});
  else
    told.emplace_back("register.bits", "{} is a signed register of {} bits",
                      std::vector<Remark::Value>{shown(column), static_cast<long>(seen.bits)});
}

}  // namespace

RecordingArguments with_guesses(RecordingArguments a) {
  require_known_units(a);
  if (!a.columns.empty()) take_columns(a);
  if (!a.axis.empty()) return a;
  ColumnGuess declared = declared_columns(a, recorded_names(a.file));
  declared.side = a.encoder().side();
  ColumnGuess g = guess_columns(a.file, std::move(declared), a.rate > 0.0);
  if (!g.time.empty()) a.time = g.time;
  a.input = g.input, a.position = g.position, a.speed = g.speed;
  if (a.target.empty() && !g.target.empty() && a.gain.empty()) {
    a.gain = kSought;
    g.told.emplace_back("controller.sought", "no input: a controller of unknown gain makes it of {}",
                        std::vector<Remark::Value>{shown(g.target)});
  }
  a.target = g.target;
  a.units.time = g.time_unit, a.units.input = g.input_unit, a.units.position = g.position_unit;
  a.units.speed = g.speed_unit;
  if (a.input_register.empty()) take_register(g.input_form, a.input, a.registers.input, g.told);
  take_register(g.position_form, a.position, a.registers.position, g.told);
  const bool no_unit = a.units.position.empty() && unit_in_name(a.position, Quantity::kAngle).empty();
  if (g.whole_positions && a.bits > 0 && no_unit) {
    a.units.position = kCounts;
    g.told.emplace_back("unit.whole_numbers", "{} in counts, being whole numbers",
                        std::vector<Remark::Value>{shown(a.position)});
  }
  if (!a.translation && is_length(g)) {
    a.translation = true;
    g.told.emplace_back("coordinates.translation", "a translation, by the unit of the position");
  }
  a.guessed = std::move(g.told);
  return a;
}

void tell_assumed(const std::vector<Remark>& assumed, Coordinates coordinates) {
  std::vector<std::string> table, others;
  for (const Remark& r : assumed)
    (r.code().starts_with("table.") ? table : others).push_back(r.text(coordinates));
  if (!table.empty()) fmt::print("{:<12}{}\n", "table", fmt::join(table, "; "));
  if (!others.empty()) fmt::print("{:<12}{}\n", "assumed", fmt::join(others, "; "));
}

}  // namespace gapscope::cli

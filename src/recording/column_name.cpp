#include "recording/column_name.h"

#include <algorithm>
#include <cctype>
#include <initializer_list>
#include <string>
#include <vector>

namespace gapscope {
namespace {

/// Other ways to write a unit in the name of a column, in small letters.
struct Spelling {
  const char *written, *unit;
};
constexpr Spelling kSpellings[] = {
    {"sec", "s"},         {"secs", "s"},        {"seconds", "s"},     {"msec", "ms"},
    {"millis", "ms"},     {"µs", "us"},         {"μs", "us"},         {"usec", "us"},
    {"micros", "us"},     {"nsec", "ns"},       {"°", "deg"},         {"degree", "deg"},
    {"degrees", "deg"},   {"radian", "rad"},    {"radians", "rad"},   {"turns", "rev"},
    {"revs", "rev"},      {"rotations", "rev"}, {"inch", "in"},       {"inches", "in"},
    {"µm", "um"},         {"μm", "um"},         {"pct", "%"},         {"percent", "%"},
    {"‰", "permille"},    {"amps", "A"},        {"amp", "A"},         {"volts", "V"},
    {"volt", "V"},        {"1/min", "rpm"},     {"r/min", "rpm"},     {"min-1", "rpm"},
    {"rps", "rev/s"},     {"rad_s", "rad/s"},   {"deg_s", "deg/s"},   {"°/s", "deg/s"},
    {"dps", "deg/s"},     {"m_s", "m/s"},       {"mps", "m/s"},       {"mm_s", "mm/s"},
    {"rads", "rad/s"},    {"inc", "counts"},    {"incs", "counts"},   {"increments", "counts"},
    {"counts", "counts"}, {"count", "counts"},  {"cnt", "counts"},    {"cnts", "counts"},
    {"ticks", "counts"},  {"lb-in", "lbf in"},  {"lbf-in", "lbf in"}, {"in-lb", "lbf in"},
    {"lb-ft", "lbf ft"},  {"ft-lb", "lbf ft"},  {"oz-in", "ozf in"},  {"kgf-cm", "kgf cm"},
    {"kg-cm", "kgf cm"}};

bool is_known(Quantity quantity, const std::string& unit) {
  const bool angle = quantity == Quantity::kAngle;
  return unit_scale(quantity, unit).has_value() ||
         (unit == kCounts && (angle || quantity == Quantity::kLength));
}

/// A unit as it is declared, of one as it is written in names; empty: it is none of this quantity.
std::string as_declared(std::string_view written, Quantity quantity) {
  std::string small(written);
  for (char& c : small) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const Spelling& s : kSpellings)
    if (small == s.written && is_known(quantity, s.unit)) return s.unit;
  return is_known(quantity, std::string(written)) ? std::string(written) : "";
}

/// What may be a unit at the end of a name, the longer one first: "deg_s", then "s".
std::vector<std::string_view> ends_of(std::string_view column) {
  const bool bracketed = column.ends_with(']') || column.ends_with(')');
  std::vector<std::string_view> ends;
  for (auto at = column.find_last_of(bracketed ? "[(" : "_ "); at != column.npos && ends.size() < 2;
       at = at == 0 || bracketed ? column.npos : column.find_last_of("_ ", at - 1)) {
    std::string_view end = column.substr(at + 1);
    if (bracketed) end.remove_suffix(1);
    const bool number = !end.empty() && std::isdigit(static_cast<unsigned char>(end.front())) != 0;
    if (end.empty() || (number && end.find('/') == end.npos) || end.front() == ':') break;
    ends.insert(ends.begin(), end);
  }
  return ends;
}

/// Whether the name says, too, what is measured in a unit of one letter.
bool says_quantity(std::string_view column, char unit) {
  const char* quantity = unit == 'A' ? "current" : unit == 'V' ? "volt" : unit == 'N' ? "force" : nullptr;
  const std::vector<std::string> words = words_of_name(column);
  return quantity != nullptr && std::any_of(words.begin(), words.end(), [&](const std::string& word) {
           return word.starts_with(quantity);
         });
}

}  // namespace

std::vector<std::string> words_of_name(std::string_view name) {
  std::vector<std::string> words(1);
  bool small = false;  // the last letter was
  for (const char letter : name) {
    const auto c = static_cast<unsigned char>(letter);
    if (std::isalpha(c) == 0 || (small && std::isupper(c) != 0)) words.emplace_back();
    if (std::isalpha(c) != 0) words.back() += static_cast<char>(std::tolower(c));
    small = std::islower(c) != 0;
  }
  std::erase(words, std::string());
  return words;
}

bool says_temperature(std::string_view column) {
  for (const std::string_view unit : {"°C", "°F", "℃", "℉", "degC", "degF"}) {
    const std::size_t at = column.find(unit), behind = at + unit.size();
    if (at == column.npos) continue;
    if (behind == column.size() || std::isalpha(static_cast<unsigned char>(column[behind])) == 0) return true;
  }
  const std::vector<std::string> words = words_of_name(column);
  return std::any_of(words.begin(), words.end(), [](const std::string& word) {
    return word == "temp" || word == "temps" || word.starts_with("temperatur") || word == "celsius" ||
           word == "fahrenheit" || word == "kelvin";
  });
}

std::string unit_in_name(std::string_view column, Quantity quantity) {
  const bool bracketed = column.ends_with(']') || column.ends_with(')');
  for (const std::string_view end : ends_of(column)) {
    if (!bracketed && end.size() == 1 && !says_quantity(column, end.front())) continue;
    if (std::string unit = as_declared(end, quantity); !unit.empty()) return unit;
  }
  return "";
}

std::string unit_of_another(std::string_view column, Quantity quantity) {
  if (!unit_in_name(column, quantity).empty()) return "";
  const auto ends = ends_of(column);
  const auto is_of = [](std::string_view end, std::initializer_list<Quantity> others) {
    return std::any_of(others.begin(), others.end(),
                       [&](Quantity other) { return !as_declared(end, other).empty(); });
  };
  for (const std::string_view end : ends)
    if (is_of(end, {Quantity::kTurning, Quantity::kSliding})) return std::string(end);
  if (!column.ends_with(']') || ends.empty()) return "";
  return std::string(ends.back());
}

}  // namespace gapscope

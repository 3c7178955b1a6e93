#include "base/input_facts.h"

#include <fmt/format.h>

#include <cctype>
#include <string_view>

#include "base/text.h"

namespace gapscope {

namespace {

constexpr std::string_view kUnit = "unit of u", kUnits = "units of u";

bool ends_in_letter(const std::string& text, std::size_t at) {
  return at < text.size() && (std::isalnum(static_cast<unsigned char>(text[at])) != 0 || text[at] == '_');
}

/// "look at the unit of u" speaks of the unit itself.
bool is_spoken_of(const std::string& text, std::size_t at) {
  constexpr std::string_view kThe = "the ";
  return at >= kThe.size() && text.compare(at - kThe.size(), kThe.size(), kThe) == 0;
}

bool follows_number(const std::string& text, std::size_t at) {
  return at >= 2 && text[at - 1] == ' ' && std::isdigit(static_cast<unsigned char>(text[at - 2])) != 0;
}

/// A torque per unit of a torque is a plain number: "1 N·m per N·m" says nothing.
std::string without_torque_per_torque(std::string text, const std::string& unit) {
  if (unit != "N m" && unit != "N") return text;
  for (const char* torque : {"N·m", "N m", "N"})
    text = replaced(text, fmt::format("{} per {}", torque, kUnit), fmt::format("(u is in {})", torque));
  return text;
}

}  // namespace

std::string with_input_unit(const std::string& told, const InputFacts& input) {
  const std::string text = without_torque_per_torque(told, input.unit);
  std::string out = input.unit.empty() ? text : replaced(text, std::string(kUnits), input.unit);
  for (std::size_t at = out.find(kUnit); at != out.npos; at = out.find(kUnit, at + 1)) {
    if (ends_in_letter(out, at + kUnit.size()) || is_spoken_of(out, at)) continue;
    if (!input.unit.empty())
      out.replace(at, kUnit.size(), input.unit);
    else if (follows_number(out, at))
      out.replace(at, kUnit.size(), kUnits);
  }
  return out;
}

}  // namespace gapscope

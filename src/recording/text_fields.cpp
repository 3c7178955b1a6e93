// What stands between the separators of a text.
#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cstring>

#include "recording/column_name.h"
#include "recording/table_form.h"

namespace gapscope::internal::recording {
namespace {

constexpr const char* kBlankSigns = " \t\r\v\f";

std::string_view trimmed(std::string_view text) {
  const auto is_blank = [](char c) { return c == ' ' || (c >= '\t' && c <= '\r' && c != '\n'); };
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::string_view unquoted(std::string_view field) {
  if (field.size() >= 2 && field.front() == '"' && field.back() == '"')
    return trimmed(field.substr(1, field.size() - 2));
  return field;
}

/// Where a comment begins: at a `#` outside quotes that begins the line or follows a blank. Others are part
/// of what they stand in, as in Microsoft's 1.#QNAN.
bool begins_comment(std::string_view text, std::size_t at) {
  return text[at] == '#' && (at == 0 || text[at - 1] == ' ' || text[at - 1] == '\t');
}

/// Of a text that has neither quotes nor comments.
void split_plain(std::string_view text, char separator, std::vector<std::string_view>& fields) {
  for (;;) {
    const void* const found = std::memchr(text.data(), separator, text.size());
    if (found == nullptr) break;
    const auto at = static_cast<std::size_t>(static_cast<const char*>(found) - text.data());
    fields.push_back(trimmed(text.substr(0, at)));
    text.remove_prefix(at + 1);
  }
  const std::string_view last = trimmed(text);
  if (!last.empty() || !fields.empty()) fields.push_back(last);
}

void split_quoted(std::string_view text, char separator, std::vector<std::string_view>& fields) {
  std::size_t begin = 0, end = 0;
  bool quoted = false;
  for (; end < text.size() && (quoted || !begins_comment(text, end)); ++end) {
    if (text[end] == '"') quoted = !quoted;
    if (text[end] != separator || quoted) continue;
    fields.push_back(unquoted(trimmed(text.substr(begin, end - begin))));
    begin = end + 1;
  }
  const std::string_view last = trimmed(text.substr(begin, end - begin));
  if (!last.empty() || !fields.empty()) fields.push_back(unquoted(last));
}

void split_at_blanks(std::string_view text, std::vector<std::string_view>& fields) {
  for (std::size_t at = text.find_first_not_of(kBlankSigns); at != text.npos && text[at] != '#';) {
    const bool quoted = text[at] == '"' && text.find('"', at + 1) != text.npos;
    const std::size_t end =
        std::min(quoted ? text.find('"', at + 1) + 1 : text.find_first_of(kBlankSigns, at), text.size());
    fields.push_back(unquoted(text.substr(at, end - at)));
    at = text.find_first_not_of(kBlankSigns, end);
  }
}

/// With a decimal point or comma: one that separates columns is in no field.
bool is_number(std::string_view field) {
  std::array<char, 64> text{};
  if (field.empty() || field.size() > text.size()) return false;
  std::copy(field.begin(), field.end(), text.begin());
  std::replace(text.begin(), text.begin() + field.size(), ',', '.');
  const char *begin = text.data(), *const end = begin + field.size();
  if (field.size() > 1 && *begin == '+' && begin[1] != '-') ++begin;
  double value = 0.0;
  const auto [read, problem] = std::from_chars(begin, end, value);
  return read == end && problem != std::errc::invalid_argument;
}

/// "10:00:00", "2024-11-27T10:00:00.5Z", "27.11.2024": digits with two signs of a date or one of a clock.
bool is_stamp(std::string_view field) {
  if (field.size() < 5 || field.size() > 40) return false;
  if (std::isdigit(static_cast<unsigned char>(field.front())) == 0) return false;
  const auto is_one = [&](const char* signs) {
    return std::count_if(field.begin(), field.end(),
                         [&](char c) { return std::strchr(signs, c) != nullptr; });
  };
  const auto letters =
      std::count_if(field.begin(), field.end(), [](unsigned char c) { return std::isalpha(c) != 0; });
  return letters <= 4 && field.find('[') == field.npos && (is_one(":") > 0 || is_one("-/.") == 2);
}

/// "[0.1, 0.2]", "[]"; "[ms]" is none.
bool is_list(std::string_view field) {
  if (field.front() != '[' || field.back() != ']') return false;
  const std::size_t at = field.find_first_not_of(" +-.", 1);
  return at == field.size() - 1 || std::isdigit(static_cast<unsigned char>(field[at])) != 0;
}

}  // namespace

bool is_blank_field(std::string_view field) {
  if (field.empty()) return true;
  if (field.size() > 4) return false;
  for (const std::string_view word : {"nan", "null", "none", "na", "n/a", "-", "--"})
    if (std::equal(word.begin(), word.end(), field.begin(), field.end(),
                   [](char a, char b) { return a == std::tolower(static_cast<unsigned char>(b)); }))
      return true;
  return false;
}

FieldKind kind_of_field(std::string_view field) {
  if (is_blank_field(field)) return FieldKind::kBlank;
  if (is_number(field)) return FieldKind::kNumber;
  if (is_list(field)) return FieldKind::kList;
  return is_stamp(field) ? FieldKind::kStamp : FieldKind::kText;
}

bool are_units(const std::vector<std::string_view>& fields) {
  constexpr std::size_t kLongest = 10;
  constexpr Quantity kAll[] = {Quantity::kTime,  Quantity::kAngle,   Quantity::kLength,  Quantity::kTorque,
                               Quantity::kForce, Quantity::kVoltage, Quantity::kTurning, Quantity::kSliding};
  std::size_t filled = 0, known = 0;
  for (std::string_view field : fields) {
    if (field.empty()) continue;
    if (field.size() > kLongest) return false;
    const bool bracketed = field.front() == '[' || field.front() == '(';
    const std::string as_name = bracketed ? "x " + std::string(field) : "x [" + std::string(field) + "]";
    ++filled;
    known += std::any_of(std::begin(kAll), std::end(kAll),
                         [&](Quantity q) { return !unit_in_name(as_name, q).empty(); });
  }
  return filled > 0 && 2 * known >= filled;
}

bool is_comment(std::string_view line) {
  const std::size_t at = line.find_first_not_of(kBlankSigns);
  if (at == line.npos) return false;
  line.remove_prefix(at);
  if (line.starts_with('#') || line.starts_with("//")) return true;
  return line.starts_with('%') && line.size() > 1 && std::strchr(",;\t\"", line[1]) == nullptr;
}

void split_fields(std::string_view text, char separator, std::vector<std::string_view>& fields) {
  fields.clear();
  if (separator == kBlanks) return split_at_blanks(text, fields);
  const bool plain = std::memchr(text.data(), '"', text.size()) == nullptr &&
                     std::memchr(text.data(), '#', text.size()) == nullptr;
  if (plain)
    split_plain(text, separator, fields);
  else
    split_quoted(text, separator, fields);
}

}  // namespace gapscope::internal::recording

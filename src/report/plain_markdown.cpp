#include "report/plain_markdown.h"

#include <algorithm>
#include <cctype>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

namespace gapscope::internal::report {
namespace {

constexpr std::size_t kNowhere = std::string_view::npos;

/// Behind the code that begins here, between as many backticks on either side; nowhere: it has no end.
std::size_t end_of_code(std::string_view text, std::size_t at) {
  const auto run = [&](std::size_t i) { return std::min(text.find_first_not_of('`', i), text.size()) - i; };
  const std::size_t length = run(at);
  for (std::size_t i = text.find('`', at + length); i < text.size(); i = text.find('`', i + run(i)))
    if (run(i) == length) return i + length;
  return kNowhere;
}

/// Whether every backtick of a line is one of a pair: in a row of a table, in its cell. Only then does no
/// reader see other code than is seen here.
bool pairs_its_backticks(std::string_view line) {
  if (line.find("\\`") != kNowhere) return false;
  for (std::size_t at = line.find('`'); at < line.size(); at = line.find('`', at)) {
    const std::size_t end = end_of_code(line, at);
    if (end == kNowhere) return false;
    if (line.starts_with('|') && line.substr(at, end - at).find('|') != kNowhere) return false;
    at = end;
  }
  return true;
}

bool begins_html(std::string_view text, std::size_t at) {
  if (text[at] != '<' || at + 1 == text.size()) return false;
  const char next = text[at + 1];
  return std::isalpha(static_cast<unsigned char>(next)) != 0 || next == '/' || next == '!' || next == '?';
}

/// "![title](file.png)" of a picture beside the report.
bool is_own_picture(std::string_view line) {
  const std::size_t middle = line.find("](");
  if (!line.starts_with("![") || !line.ends_with(')') || middle == kNowhere) return false;
  const std::string_view title = line.substr(2, middle - 2),
                         file = line.substr(middle + 2, line.size() - middle - 3);
  const auto is_plain = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-' || c == '.';
  };
  bool holds_html = false;
  for (std::size_t at = 0; at < title.size(); ++at) holds_html = holds_html || begins_html(title, at);
  return !holds_html && title.find_first_of("`\\") == kNowhere &&
         std::all_of(file.begin(), file.end(), is_plain);
}

std::string plain_line(std::string_view line, bool knows_code) {
  std::string plain;
  for (std::size_t at = 0; at < line.size();) {
    const std::size_t end = knows_code && line[at] == '`' ? end_of_code(line, at) : at + 1;
    if (begins_html(line, at))
      plain += "&lt;";
    else if (line.substr(at, 2) == "![")
      plain += "&#33;";
    else
      plain += line.substr(at, end - at);
    at = end;
  }
  return plain;
}

}  // namespace

std::string plain_markdown(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(std::move(line));
  const bool knows_code = std::all_of(lines.begin(), lines.end(), pairs_its_backticks);
  std::string plain;
  for (const std::string& line : lines)
    plain += (is_own_picture(line) ? line : plain_line(line, knows_code)) + "\n";
  if (!text.ends_with('\n') && !plain.empty()) plain.pop_back();
  return plain;
}

}  // namespace gapscope::internal::report

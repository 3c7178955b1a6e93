#include "recording/table_form.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <map>

#include "base/shown.h"
#include "gapscope/base/errors.h"
#include "recording/file_kind.h"
#include "recording/recorded_rows.h"

namespace gapscope::internal::recording {
namespace {

constexpr std::size_t kHead = 1 << 17;   ///< characters that are looked at
constexpr std::size_t kMostLines = 500;  ///< of these
constexpr std::size_t kKeptRows = 200;
constexpr std::array kSeparators = {',', ';', '\t', kBlanks};

using Cells = std::vector<std::string_view>;

struct Line {
  std::int64_t number = 0;
  std::string_view text;
  bool comment = false;
};

std::vector<Line> lines_of(std::string_view head) {
  if (head.starts_with("\xEF\xBB\xBF")) head.remove_prefix(3);
  std::vector<Line> lines;
  for (std::int64_t number = 1; !head.empty() && lines.size() < kMostLines; ++number) {
    const std::size_t end = std::min(head.find('\n'), head.size());
    std::string_view text = head.substr(0, end);
    head.remove_prefix(std::min(end + 1, head.size()));
    while (text.ends_with('\r')) text.remove_suffix(1);
    if (text.find_first_not_of(" \t,;") != text.npos) lines.push_back({number, text, is_comment(text)});
  }
  return lines;
}

bool is_value(FieldKind kind) { return kind != FieldKind::kText && kind != FieldKind::kBlank; }

/// The lines as one separator has them.
struct Split {
  char separator = ',';
  std::size_t width = 0;  ///< fields of most lines that have several
  long score = 0;         ///< values in these, less the texts
  std::vector<std::vector<FieldKind>> kinds;
  std::vector<std::size_t> columns;  ///< that have values in most of these lines
};

Split split_by(char separator, const std::vector<Line>& lines) {
  Split s{separator, 0, 0, {}, {}};
  std::map<std::size_t, long> scores;
  Cells fields;
  for (const Line& line : lines) {
    fields.clear();
    if (!line.comment) split_fields(line.text, separator, fields);
    auto& kinds = s.kinds.emplace_back();
    long score = 0;
    for (const std::string_view field : fields) {
      kinds.push_back(kind_of_field(field));
      score += is_value(kinds.back()) ? 1 : kinds.back() == FieldKind::kText ? -1 : 0;
    }
    if (fields.size() > 1) scores[fields.size()] += score;
  }
  for (const auto& [width, score] : scores)
    if (score > s.score) s.width = width, s.score = score;
  for (std::size_t column = 0; column < s.width; ++column) {
    std::size_t rows = 0, values = 0, texts = 0;
    for (const auto& kinds : s.kinds)
      if (kinds.size() == s.width)
        ++rows, values += is_value(kinds[column]), texts += kinds[column] == FieldKind::kText;
    if (values > texts && 20 * values > rows) s.columns.push_back(column);
  }
  return s;
}

/// Whether a line is a row: as wide as most, with values in their columns and no text there.
bool is_row(const Split& s, std::size_t line) {
  const auto& kinds = s.kinds[line];
  if (kinds.size() != s.width) return false;
  std::size_t values = 0;
  for (const std::size_t column : s.columns) {
    if (kinds[column] == FieldKind::kText) return false;
    values += is_value(kinds[column]);
  }
  return values > 0;
}

/// The first row; a line right above it that begins as rows do is one that something is wrong with.
std::size_t first_row(const Split& s, const std::vector<Line>& lines) {
  std::size_t first = 0;
  while (first < lines.size() && !is_row(s, first)) ++first;
  const auto begins_so = [&](std::size_t line) {
    return s.kinds[line].size() == s.width && is_value(s.kinds[line][s.columns.front()]);
  };
  while (first < lines.size() && first > 0 && begins_so(first - 1)) --first;
  return first;
}

/// What is no text in UTF-8 is taken for Latin-1.
std::string as_utf8(std::string_view text) {
  if (is_text(text)) return std::string(text);
  std::string out;
  for (const char byte : text) {
    const auto b = static_cast<unsigned char>(byte);
    if (b >= 0x80) out += static_cast<char>(0xc0 | b >> 6);
    out += static_cast<char>(b < 0x80 ? b : 0x80 | (b & 0x3f));
  }
  return out;
}

/// "Time", "[s]" read "Time [s]": of a table with blanks between the columns.
std::vector<std::string> with_their_units(const Cells& fields) {
  std::vector<std::string> names;
  for (const std::string_view field : fields) {
    const bool unit = field.size() > 2 && (field.front() == '[' || field.front() == '(');
    if (unit && !names.empty())
      names.back() += " " + as_utf8(field);
    else
      names.push_back(as_utf8(field));
  }
  return names;
}

/// The names in a line; empty where it has none.
std::vector<std::string> names_in(const Split& s, std::string_view text) {
  Cells fields;
  split_fields(text, s.separator, fields);
  while (fields.size() > 1 && fields.back().empty()) fields.pop_back();
  std::vector<std::string> names;
  std::transform(fields.begin(), fields.end(), std::back_inserter(names), as_utf8);
  if (s.separator == kBlanks && names.size() != s.width) names = with_their_units(fields);
  const bool fits = s.separator == kBlanks ? names.size() == s.width : names.size() > 1;
  const bool named = std::any_of(names.begin(), names.end(), [&](const std::string& name) {
    return kind_of_field(name) == FieldKind::kText;
  });
  return fits && named ? names : std::vector<std::string>{};
}

std::string_view without_sign(std::string_view comment) {
  const std::size_t at = comment.find_first_not_of(" \t#%/");
  return at == comment.npos ? std::string_view{} : comment.substr(at);
}

/// Names, and units below them, in the lines above the first row; or in a comment there.
void find_names(const Split& s, const std::vector<Line>& lines, std::size_t first, TableForm& form) {
  std::size_t at = first;
  const auto above = [&] {
    while (at > 0 && lines[at - 1].comment) --at;
    return at > 0 ? &lines[at - 1] : nullptr;
  };
  const Line* line = above();
  if (line == nullptr || names_in(s, line->text).empty()) {
    for (std::size_t i = first; i-- > 0;) {
      if (!lines[i].comment) continue;
      const auto names = names_in(s, without_sign(lines[i].text));
      if (names.size() != s.width) continue;
      form.header = lines[i].number, form.names = names;
      form.told.emplace_back("table.names_in_comment", "names in the comment of line {}",
                             std::vector<Remark::Value>{static_cast<long>(form.header)});
      return;
    }
    return;
  }
  Cells fields;
  split_fields(line->text, s.separator, fields);
  if (are_units(fields)) {
    --at;
    const Line* const over = above();
    const auto names = over == nullptr ? std::vector<std::string>{} : names_in(s, over->text);
    if (!names.empty()) {
      form.header = over->number, form.names = names;
      std::transform(fields.begin(), fields.end(), std::back_inserter(form.units), as_utf8);
      form.told.emplace_back("table.units_below_names", "units in line {}",
                             std::vector<Remark::Value>{static_cast<long>(line->number)});
      return;
    }
  }
  form.header = line->number, form.names = names_in(s, line->text);
}

void keep_rows(const Split& s, const std::vector<Line>& lines, std::size_t first, TableForm& form) {
  Cells fields;
  for (std::size_t i = first; i < lines.size() && form.rows.size() < kKeptRows; ++i) {
    if (lines[i].comment || s.kinds[i].size() != s.width) continue;
    split_fields(lines[i].text, s.separator, fields);
    form.rows.emplace_back(fields.begin(), fields.end());
  }
}

void tell(const Split& s, const std::vector<Line>& lines, TableForm& form) {
  const auto say = [&](const char* code, const char* words, std::vector<Remark::Value> values = {}) {
    form.told.emplace_back(code, words, std::move(values));
  };
  if (form.header == 0) say("table.no_names", "no names of columns: they are called 1, 2, ...");
  std::int64_t table = form.header > 0 ? form.header : form.first;
  long before = 0;
  for (const Line& line : lines) before += line.number < table && !line.comment;
  if (before > 0) say("table.lines_before", "lines before it: {}", {before});
  if (s.separator == kBlanks) say("table.blanks", "blanks between the columns");
}

}  // namespace

TableForm find_table(std::string_view head) {
  const std::vector<Line> lines = lines_of(head);
  Split best;
  for (const char separator : kSeparators)
    if (Split s = split_by(separator, lines); s.score > best.score) best = std::move(s);
  TableForm form;
  if (best.score <= 0) return form;
  const std::size_t first = first_row(best, lines);
  if (first == lines.size()) return form;
  form.separator = best.separator, form.first = lines[first].number;
  find_names(best, lines, first, form);
  if (form.header == 0)
    for (std::size_t i = 0; i < best.width; ++i) form.names.push_back(std::to_string(i + 1));
  keep_rows(best, lines, first, form);
  tell(best, lines, form);
  return form;
}

bool is_text_table(const std::string& path) { return kind_of(path).ending.empty(); }

TableForm table_of(const std::string& path) {
  std::ifstream in = open_recording_file(path);
  std::string head(kHead, '\0');
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  if (in.bad()) throw MachineError(path + ": cannot be read");
  head.resize(static_cast<std::size_t>(in.gcount()));
  if (head.size() == kHead) head.resize(std::min(head.rfind('\n') + 1, head.size()));  // whole lines
  return find_table(head);
}

}  // namespace gapscope::internal::recording
